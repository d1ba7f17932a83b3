//! Emissive: a surface that sends out light.
//!
//! Radiance is the same in all directions. As with the area lights of pbrt and Mitsuba, only the side that the normal
//! points to shines, unless `two_sided`; a lamp may also reflect, as a lambertian does, on both sides.
//!
//! ```toml
//! [material.lamp.emissive]
//! radiance = [17, 13.5, 9]
//! ```
//!
//! Radiance may be a texture: a screen, a window full of sky, a shade of paper.

use glam::Vec3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::color::{Rgb, Spectrum};
use crate::material::LambertianBsdf;
use crate::texture::{Color, Textures};
use crate::validate::Checker;

/// A lamp: the side of the normal shines.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Emissive {
    /// Emitted radiance, W / (m² sr), not negative.
    pub radiance: Color,
    /// Share of arriving light that is scattered back, as by a lambertian surface, 0..1.
    pub albedo: Color,
    /// Whether the side that the normal points away from shines too.
    pub two_sided: bool,
}

/// What a material sends out: the same in all directions.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Emission<'m> {
    pub(crate) color: &'m Color,
    /// Factor on the color, for W / (m² sr).
    pub(crate) scale: f32,
    /// Whether the side that the normal points away from shines too.
    pub(crate) two_sided: bool,
}

impl Emission<'_> {
    /// Radiance, if it is the same everywhere.
    pub(crate) fn radiance(self) -> Option<Spectrum> {
        self.color.rgb().map(|rgb| Spectrum::from(rgb) * self.scale)
    }

    /// Radiance at a point.
    #[inline]
    pub(crate) fn radiance_at(self, textures: &impl Textures) -> Spectrum {
        self.color.amount_at(textures) * self.scale
    }

    /// The same along `wo`.
    #[inline]
    pub(crate) fn le(self, wo: Vec3, textures: &impl Textures) -> Spectrum {
        if wo.z > 0.0 || self.two_sided { self.radiance_at(textures) } else { Spectrum::BLACK }
    }
}

impl Default for Emissive {
    fn default() -> Self {
        Self { radiance: Rgb::grey(1.0).into(), albedo: Rgb::grey(0.0).into(), two_sided: false }
    }
}

impl Emissive {
    pub(crate) fn check(&self, c: &mut Checker) {
        self.radiance.check_amount("radiance", c);
        self.albedo.check_share("albedo", c);
    }

    #[inline]
    pub(crate) fn bsdf(&self, textures: &impl Textures) -> LambertianBsdf {
        LambertianBsdf { albedo: self.albedo.share_at(textures) }
    }

    #[inline]
    pub(crate) fn emission(&self) -> Emission<'_> {
        Emission { color: &self.radiance, scale: 1.0, two_sided: self.two_sided }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::texture::NoTextures;

    #[test]
    fn shines_on_the_side_of_the_normal() {
        let one = Emissive::default();
        assert!(
            !one.emission().le(Vec3::Z, &NoTextures).is_black()
                && one.emission().le(Vec3::NEG_Z, &NoTextures).is_black()
        );
        let two = Emissive { two_sided: true, ..one };
        assert_eq!(two.emission().le(Vec3::Z, &NoTextures), two.emission().le(Vec3::NEG_Z, &NoTextures));
    }
}
