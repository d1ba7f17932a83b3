//! Lambertian: matte, equally bright from everywhere.
//!
//! f = albedo / π, on both sides of the surface. Sampled with the cosine of the angle, so every sample weighs `albedo`.
//! Lambert, Photometria, 1760; Ray Tracing in One Weekend (Shirley 2020) draws the same distribution.
//!
//! ```toml
//! [material.clay.lambertian]
//! albedo = [0.7, 0.3, 0.2]
//! ```

use std::f32::consts::FRAC_1_PI;

use glam::{Vec2, Vec3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::color::{Rgb, Spectrum};
use crate::material::BsdfSample;
use crate::sampling::cosine_hemisphere;
use crate::texture::{Color, Textures};
use crate::validate::Checker;

/// Matte: scatters light evenly to all sides.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Lambertian {
    /// Share of the light that is not absorbed, 0..1 in each channel.
    pub albedo: Color,
}

impl Default for Lambertian {
    fn default() -> Self {
        Self { albedo: Rgb::grey(0.5).into() }
    }
}

impl Lambertian {
    pub(crate) fn check(&self, c: &mut Checker) {
        self.albedo.check_share("albedo", c);
    }

    #[inline]
    pub(crate) fn bsdf(&self, textures: &impl Textures) -> LambertianBsdf {
        LambertianBsdf { albedo: self.albedo.share_at(textures) }
    }
}

/// The lobe of [`Lambertian`].
#[derive(Clone, Copy, Debug)]
pub struct LambertianBsdf {
    pub(crate) albedo: Spectrum,
}

impl LambertianBsdf {
    #[inline]
    pub(crate) fn sample(&self, wo: Vec3, u: Vec2) -> Option<BsdfSample> {
        let mut wi = cosine_hemisphere(u);
        if wi.z == 0.0 || self.albedo.is_black() {
            return None;
        }
        wi.z = wi.z.copysign(wo.z);
        Some(BsdfSample { wi, weight: self.albedo, pdf: wi.z.abs() * FRAC_1_PI, delta: false, eta: 1.0 })
    }

    #[inline]
    pub(crate) fn eval_pdf(&self, wo: Vec3, wi: Vec3) -> (Spectrum, f32) {
        let pdf = if wo.z * wi.z > 0.0 { wi.z.abs() * FRAC_1_PI } else { 0.0 };
        (self.albedo * pdf, pdf)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::Bsdf;
    use crate::testing::{Reciprocal, check_lobe};
    use crate::texture::NoTextures;

    #[test]
    fn lobe() {
        let albedo = Rgb([0.9, 0.5, 0.1]).into();
        check_lobe(&Bsdf::Lambertian(Lambertian { albedo }.bsdf(&NoTextures)), Reciprocal::Yes).unwrap();
    }
}
