//! A lamp as its maker measured it: a point whose intensity differs by direction, as an [`IesProfile`] says.
//!
//! The profile is in candela. Intensity is in W / sr of light that is even over the visible 370 to 730 nm, of which
//! 1 W is 683 · 106.86 / 360 ≈ 203 lm (106.86 nm is the integral of CIE ȳ). So the lamp fits others in W / sr, and a `sky` of
//! `scale = 49.3`; beside a sky of `scale = 1` its `scale` is 0.0203.
//!
//! ```toml
//! [[light.ies]]
//! file = "downlight.ies"
//! position = [0, 2.5, 0]
//! ```

use std::sync::Arc;

use glam::{DVec3, Vec3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::array::array;
use crate::color::{LUMENS_PER_WATT, Rgb, Spectrum};
use crate::light::ies::IesProfile;
use crate::light::select::LightBounds;
use crate::light::{one, unscaled};
use crate::validate::Checker;

/// A lamp without size that shines as a photometric file says.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct IesLight {
    /// The file (.ies), IES LM-63 of type C. A relative name is looked for beside the scene file that says it.
    pub file: String,
    /// Where it is, metres.
    #[serde(deserialize_with = "array")]
    pub position: [f32; 3],
    /// Where the lamp's nadir (vertical angle 0) points, of any length; straight down if absent. The lamp is tilted there
    /// the shortest way.
    #[serde(default = "down", deserialize_with = "array")]
    pub direction: [f32; 3],
    /// Turns the lamp about its axis before it is tilted, degrees, counter-clockwise seen from above. At 0, horizontal
    /// angle 0 is +x, and 90 is −z.
    #[serde(default)]
    #[schemars(range(min = -360.0, max = 360.0))]
    pub rotation: f32,
    /// Factor on the file's intensity, not negative.
    #[serde(default = "unscaled")]
    #[schemars(range(min = 0.0))]
    pub scale: f32,
    /// Colour of the light: a factor in each channel, not negative.
    #[serde(default = "one")]
    pub color: Rgb,
    /// What is in the file, once a reader has loaded it.
    #[serde(skip)]
    pub profile: Option<Arc<IesProfile>>,
}

fn down() -> [f32; 3] {
    [0.0, -1.0, 0.0]
}

impl IesLight {
    pub(super) fn check(&self, c: &mut Checker) {
        c.finite("position", &self.position);
        c.nonzero("direction", self.direction);
        c.in_range("rotation", self.rotation, -360.0, 360.0);
        c.in_range("scale", self.scale, 0.0, 1e6);
        c.radiance("color", self.color);
        if self.profile.is_none() {
            c.not_loaded(&self.file);
        }
    }

    /// Whether it gives no light.
    pub(crate) fn is_dark(&self) -> bool {
        let is_off = self.scale == 0.0 || self.color.0 == [0.0; 3];
        is_off || self.profile.as_ref().is_none_or(|profile| profile.flux() == 0.0)
    }

    /// None if the profile is not loaded, which the check has found.
    pub(super) fn compile(&self) -> Option<Luminaire> {
        Some(Luminaire {
            position: self.position.into(),
            axes: axes(Vec3::from(self.direction).normalize(), self.rotation.to_radians()),
            unit: Spectrum::from(self.color) * (self.scale / LUMENS_PER_WATT),
            profile: self.profile.clone()?,
        })
    }
}

/// The lamp's axes x, y, z in the world: turned by `rotation` about +y, then tilted so that −y is `nadir`.
fn axes(nadir: Vec3, rotation: f32) -> [Vec3; 3] {
    let d = nadir.as_dvec3().normalize();
    // The shortest way takes +x to x − x·d / (1 − d·y) (d − y). Where d points up, 1 − d·y keeps more digits as
    // (1 − (d·y)²) / (1 + d·y); a lamp that points straight up is tilted about x.
    let height = if d.y > 0.0 { (d.x * d.x + d.z * d.z) / (1.0 + d.y) } else { 1.0 - d.y };
    let x = if height > 0.0 { DVec3::X - d.x / height * DVec3::new(d.x, -height, d.z) } else { DVec3::X };
    let x = (x - x.dot(d) * d).normalize_or(d.any_orthonormal_vector());
    let [x, y, z] = [x, -d, d.cross(x)].map(|axis| axis.as_vec3());
    let (sin, cos) = (libm::sinf(rotation), libm::cosf(rotation));
    [x * cos - z * sin, y, x * sin + z * cos]
}

/// An IES light, ready to shine.
#[derive(Clone, Debug)]
pub(crate) struct Luminaire {
    pub(super) position: Vec3,
    axes: [Vec3; 3],
    /// Intensity of 1 cd, W / sr.
    unit: Spectrum,
    profile: Arc<IesProfile>,
}

impl Luminaire {
    /// Intensity along the unit direction `w` away from it, W / sr.
    #[inline]
    pub(super) fn intensity(&self, w: Vec3) -> Spectrum {
        let [x, y, z] = self.axes.map(|axis| axis.dot(w));
        self.unit * self.profile.eval(Vec3::new(x, y, z))
    }

    pub(super) fn bounds(&self) -> LightBounds {
        let power = self.profile.flux() * Rgb(self.unit.to_rgb()).luminance();
        LightBounds::sphere(self.position, 0.0, power)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampler::Independent;
    use crate::sampling::uniform_sphere;

    #[test]
    fn stands_as_the_profile_says() {
        assert_eq!(axes(Vec3::NEG_Y, 0.0), [Vec3::X, Vec3::Y, Vec3::Z]);
        let quarter = axes(Vec3::NEG_Y, 90_f32.to_radians());
        assert!((quarter[0] - Vec3::NEG_Z).length() < 1e-6, "{quarter:?}");
        // Tilted towards +x, what was +x points up.
        let tilted = axes(Vec3::X, 0.0);
        assert!((tilted[0] - Vec3::Y).length() < 1e-6 && (tilted[2] - Vec3::Z).length() < 1e-6, "{tilted:?}");
        assert_eq!(axes(Vec3::Y, 0.0), [Vec3::X, Vec3::NEG_Y, Vec3::NEG_Z]);
    }

    /// A rotation about the axis across, for all directions, also those next to straight up.
    #[test]
    fn is_tilted_the_shortest_way() {
        for i in 0..10_000_u32 {
            let mut nadir = uniform_sphere(Independent::new(1, glam::UVec2::ZERO, i).get_2d());
            if i % 2 == 0 {
                let shrink = 10_f32.powi(-(i as i32 / 2 % 18));
                nadir = Vec3::new(nadir.x * shrink, nadir.y.abs() + 0.1, nadir.z * shrink).normalize();
            }
            let [x, y, z] = axes(nadir, 0.0);
            assert!((y + nadir).length() < 1e-6 && (x.cross(y) - z).length() < 1e-6, "{nadir}");
            assert!((x.length() - 1.0).abs() < 1e-6 && x.dot(y).abs() < 1e-6, "{nadir}: {x} {y}");
            // What is across both the nadir and the vertical stays where it is.
            let across = Vec3::NEG_Y.cross(nadir).normalize();
            let turned = across.x * x + across.y * y + across.z * z;
            assert!((turned - across).length() < 1e-5, "{nadir}: {across} becomes {turned}");
        }
    }

    #[test]
    fn intensity_is_the_profile_in_watts() {
        let profile = IesProfile::new(vec![0.0, 90.0], vec![0.0], vec![2027.0, 0.0]).unwrap();
        let light = IesLight {
            file: String::new(),
            position: [1.0, 2.0, 3.0],
            direction: [3.0, 0.0, 0.0],
            rotation: 0.0,
            scale: 0.5,
            color: Rgb([1.0, 0.5, 0.0]),
            profile: Some(Arc::new(profile)),
        };
        let lamp = light.compile().unwrap();
        let [r, g, b] = lamp.intensity(Vec3::X).to_rgb();
        assert!((r - 5.0).abs() < 0.01 && (g - 2.5).abs() < 0.01 && b == 0.0, "{r} {g} {b}");
        assert!(lamp.intensity(Vec3::NEG_X).is_black());
        let luminance = 0.2126 * r + 0.7152 * g;
        // 1 − θ / 90° over the half sphere: 2π (1 − 2 / π).
        let power = lamp.bounds().power;
        assert!((power / luminance - (std::f32::consts::TAU - 4.0)).abs() < 1e-3, "{power}");
    }
}
