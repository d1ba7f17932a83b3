//! A projector: a point that throws a picture.
//!
//! Intensity along a direction is the picture's value where the direction meets the picture plane, as with a pinhole camera
//! that works backwards: I(w) = scale · image(x, y) within the frustum, 0 outside. Between the centres of pixels the
//! picture is interpolated bilinearly. Pharr, Jakob & Humphreys, Physically Based Rendering, 4th ed. 2023, §12.2.3.
//!
//! ```toml
//! [[light.projector]]
//! file = "slide.png"
//! position = [0, 1, 3]
//! look_at = [0, 1, 0]
//! fov = 40
//! scale = 20
//! ```

use std::sync::Arc;

use glam::{Vec2, Vec3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::array::array;
use crate::color::{Rgb, Spectrum};
use crate::film::{Image, Wrap};
use crate::light::select::LightBounds;
use crate::light::unscaled;
use crate::math::Pose;
use crate::validate::Checker;

/// A lamp without size that throws a picture.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ProjectorLight {
    /// The picture (.png, .jpg, .hdr, .exr). A relative name is looked for beside the scene file that says it.
    pub file: String,
    /// Where it is, metres.
    #[serde(deserialize_with = "array")]
    pub position: [f32; 3],
    /// Where the middle of the picture falls, metres.
    #[serde(deserialize_with = "array")]
    pub look_at: [f32; 3],
    /// The direction of the picture's top, of any length, not along the line of sight.
    #[serde(default = "up", deserialize_with = "array")]
    pub up: [f32; 3],
    /// Angle from the left to the right edge of the picture, degrees, 0.1..170.
    #[serde(default = "fov")]
    #[schemars(range(min = 0.1, max = 170.0))]
    pub fov: f32,
    /// Radiant intensity where the picture is 1, W / sr, not negative.
    #[serde(default = "unscaled")]
    #[schemars(range(min = 0.0))]
    pub scale: f32,
    /// The picture, once a reader has loaded it.
    #[serde(skip)]
    pub image: Option<Arc<Image>>,
}

fn up() -> [f32; 3] {
    [0.0, 1.0, 0.0]
}

fn fov() -> f32 {
    40.0
}

impl ProjectorLight {
    pub(super) fn check(&self, c: &mut Checker) {
        c.line_of_sight("position", self.position, self.look_at, "it points");
        c.up(self.up, self.position, self.look_at);
        c.in_range("fov", self.fov, 0.1, 170.0);
        c.in_range("scale", self.scale, 0.0, 1e9);
        if self.image.is_none() {
            c.not_loaded(&self.file);
        }
    }

    /// Whether it gives no light.
    pub(crate) fn is_dark(&self) -> bool {
        self.scale == 0.0 || self.image.as_ref().is_none_or(|image| image.is_black())
    }

    /// None if the picture is not loaded, which the check has found.
    pub(super) fn compile(&self) -> Option<Projector> {
        let image = self.image.clone()?;
        let half_width = libm::tanf(0.5 * self.fov.to_radians());
        let half = Vec2::new(half_width, half_width * image.height() as f32 / image.width() as f32);
        Some(Projector { pose: Pose::new(self.position, self.look_at, self.up), half, scale: self.scale, image })
    }
}

/// A projector, ready to shine.
#[derive(Clone, Debug)]
pub(crate) struct Projector {
    pose: Pose,
    /// Half the picture's size at distance 1.
    half: Vec2,
    scale: f32,
    image: Arc<Image>,
}

impl Projector {
    pub(super) fn position(&self) -> Vec3 {
        self.pose.eye
    }

    /// Intensity along the unit direction `w` away from it, W / sr.
    #[inline]
    pub(super) fn intensity(&self, w: Vec3) -> Spectrum {
        let local = self.pose.direction_to_local(w);
        if local.z <= 0.0 {
            return Spectrum::BLACK;
        }
        let place = local.truncate() / (local.z * self.half);
        let is_inside = place.x.abs() <= 1.0 && place.y.abs() <= 1.0;
        if is_inside { self.image.bilinear(0.5 * place + 0.5, Wrap::Clamp) * self.scale } else { Spectrum::BLACK }
    }

    pub(super) fn bounds(&self) -> LightBounds {
        let bounds = LightBounds::sphere(self.pose.eye, 0.0, self.power());
        // To the picture's corner, and a little beyond, as the edge itself still shines.
        let cos_theta_e = 0.9999 / (1.0 + self.half.length_squared()).sqrt();
        LightBounds { axis: self.pose.forward, cos_theta_o: 1.0, cos_theta_e, ..bounds }
    }

    /// Of luminance, W: the sum over pixels of intensity and solid angle, cos³ θ times the area at distance 1.
    fn power(&self) -> f32 {
        let (width, height) = (self.image.width(), self.image.height());
        let area = f64::from(4.0 * self.half.x * self.half.y) / (f64::from(width) * f64::from(height));
        let mut sum = 0.0;
        for (y, row) in self.image.pixels().chunks(width as usize).enumerate() {
            let v = self.half.y * (2.0 * (y as f32 + 0.5) / height as f32 - 1.0);
            for (x, &rgb) in row.iter().enumerate() {
                let u = self.half.x * (2.0 * (x as f32 + 0.5) / width as f32 - 1.0);
                let distance_sq = f64::from(1.0 + u * u + v * v);
                sum += f64::from(Rgb(rgb).luminance()) / (distance_sq * distance_sq.sqrt());
            }
        }
        (sum * area * f64::from(self.scale)).min(f64::from(f32::MAX)) as f32
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampler::Independent;
    use crate::sampling::uniform_sphere;

    /// Pixel (x, y) has red x + 1 and green y + 1.
    fn numbered(width: u32, height: u32) -> Image {
        let mut image = Image::new(width, height);
        for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
            image.set_pixel(x, y, [x as f32 + 1.0, y as f32 + 1.0, 0.0]);
        }
        image
    }

    fn light(image: Image) -> ProjectorLight {
        ProjectorLight {
            file: String::new(),
            position: [0.0, 0.0, 2.0],
            look_at: [0.0; 3],
            up: [0.0, 1.0, 0.0],
            fov: 90.0,
            scale: 2.0,
            image: Some(Arc::new(image)),
        }
    }

    /// Seen from the projector the picture is upright and not mirrored; it is 4 wide and 2 high on the plane z = 0.
    #[test]
    fn pixels_fall_where_they_should() {
        let projector = light(numbered(4, 2)).compile().unwrap();
        for (x, y) in (0..2).flat_map(|y| (0..4).map(move |x| (x, y))) {
            let on_plane = Vec3::new(x as f32 - 1.5, 0.5 - y as f32, 0.0);
            let [r, g, _] = projector.intensity((on_plane - projector.position()).normalize()).to_rgb();
            let expected = (2.0 * (x as f32 + 1.0), 2.0 * (y as f32 + 1.0));
            assert!((r - expected.0).abs() < 1e-4 && (g - expected.1).abs() < 1e-4, "{x}, {y}: {r} {g}");
        }
        for (x, y, is_lit) in [(1.99, 0.0, true), (2.01, 0.0, false), (0.0, -0.99, true), (0.0, -1.01, false)] {
            let w = (Vec3::new(x, y, 0.0) - projector.position()).normalize();
            assert_eq!(!projector.intensity(w).is_black(), is_lit, "{x}, {y}");
        }
        assert!(projector.intensity(Vec3::Z).is_black());
    }

    /// Power is the mean of the intensity over the sphere, times 4π, and the bounds' cone holds all that shines.
    #[test]
    fn bounds_hold_the_light() {
        const N: u32 = 400_000;
        let projector = light(numbered(5, 7)).compile().unwrap();
        let bounds = projector.bounds();
        let (mut sum, mut sum_sq) = (0.0, 0.0);
        for i in 0..N {
            let w = uniform_sphere(Independent::new(3, glam::UVec2::ZERO, i).get_2d());
            let l = f64::from(Rgb(projector.intensity(w).to_rgb()).luminance());
            assert!(l == 0.0 || w.dot(bounds.axis) > bounds.cos_theta_e, "{w}");
            sum += l;
            sum_sq += l * l;
        }
        let mean = sum / f64::from(N);
        let error = ((sum_sq / f64::from(N) - mean * mean) / f64::from(N)).sqrt();
        let found = f64::from(bounds.power) / (4.0 * std::f64::consts::PI);
        // The sum over pixels is not that of the interpolated picture; 1 % is for that.
        assert!((found - mean).abs() < 4.0 * error + 0.01 * mean, "{found}, not {mean} ± {error}");
    }

    #[test]
    fn extremes() {
        for (fov, image) in [(0.1, numbered(1, 1)), (170.0, numbered(1, 300)), (170.0, numbered(300, 1))] {
            let projector = ProjectorLight { fov, ..light(image) }.compile().unwrap();
            let bounds = projector.bounds();
            assert!(bounds.power > 0.0 && bounds.power.is_finite() && (0.0..1.0).contains(&bounds.cos_theta_e));
            assert!(!projector.intensity(projector.pose.forward).is_black());
            for i in 0..1000 {
                let w = uniform_sphere(Independent::new(3, glam::UVec2::ZERO, i).get_2d());
                assert!(projector.intensity(w).to_rgb().iter().all(|c| c.is_finite()));
            }
        }
    }
}
