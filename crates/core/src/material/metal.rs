//! Metal: a mirror whose reflections blur with roughness.
//!
//! The reflected direction is m + r b, normalised: m the unit mirror direction, r the roughness, b a uniform point of
//! the unit ball. A direction that ends below the surface is absorbed. Ray Tracing in One Weekend, edition of
//! December 2020, §9.6 ("fuzz").
//!
//! Its density: the line of a direction at angle θ to m crosses the ball of radius r around m between
//! t₁,₂ = cos θ ∓ √(r² − sin² θ), clipped to t ≥ 0; the share of the ball in a cone about it gives
//!
//! pdf = (t₂³ − t₁³) / (4π r³), and f cos θᵢ = albedo · pdf above the surface.
//!
//! Not reciprocal, and what falls below the surface is lost; it is the reference of the paper that this renderer began
//! with, and of its figures.
//!
//! ```toml
//! [material.brushed.metal]
//! albedo = [0.9, 0.75, 0.4]
//! roughness = 0.2
//! ```

use std::f32::consts::PI;

use glam::{Vec2, Vec3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::color::{Rgb, Spectrum};
use crate::material::BsdfSample;
use crate::math::reflect;
use crate::sampling::uniform_ball;
use crate::texture::{Color, Scalar, Textures};
use crate::validate::Checker;

/// Mirror (roughness 0) to completely rough metal (roughness 1), which still keeps the mirror's directionality.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Metal {
    /// Share of the light that is reflected, 0..1 in each channel.
    pub albedo: Color,
    /// Radius of the ball around the unit mirror direction, 0..1. Below 1e-4 it is a perfect mirror.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub roughness: Scalar,
}

impl Default for Metal {
    fn default() -> Self {
        Self { albedo: Rgb::grey(0.8).into(), roughness: 0.0.into() }
    }
}

impl Metal {
    pub(crate) fn check(&self, c: &mut Checker) {
        self.albedo.check_share("albedo", c);
        self.roughness.check_range("roughness", 0.0, 1.0, c);
    }

    #[inline]
    pub(crate) fn bsdf(&self, textures: &impl Textures) -> MetalBsdf {
        MetalBsdf { albedo: self.albedo.share_at(textures), roughness: self.roughness.at(textures, 0.0, 1.0) }
    }
}

/// The lobe of [`Metal`].
#[derive(Clone, Copy, Debug)]
pub struct MetalBsdf {
    albedo: Spectrum,
    roughness: f32,
}

impl MetalBsdf {
    /// Rougher than this, the lobe has a density that single precision can hold.
    const MIN_ROUGHNESS: f32 = 1e-4;

    pub(crate) fn albedo(&self) -> Spectrum {
        self.albedo
    }

    #[inline]
    pub(crate) fn is_delta(&self) -> bool {
        self.roughness < Self::MIN_ROUGHNESS
    }

    #[inline]
    pub(crate) fn sample(&self, wo: Vec3, uc: f32, u: Vec2) -> Option<BsdfSample> {
        let mirror = reflect(wo);
        if self.is_delta() {
            return Some(BsdfSample { wi: mirror, weight: self.albedo, pdf: 1.0, delta: true, eta: 1.0 });
        }
        let wi = (mirror + self.roughness * uniform_ball(uc, u)).try_normalize()?;
        if wi.z * wo.z <= 0.0 {
            return None;
        }
        Some(BsdfSample { wi, weight: self.albedo, pdf: self.pdf(wo, wi), delta: false, eta: 1.0 })
    }

    #[inline]
    pub(crate) fn eval_pdf(&self, wo: Vec3, wi: Vec3) -> (Spectrum, f32) {
        let pdf = self.pdf(wo, wi);
        (if wi.z * wo.z > 0.0 { self.albedo * pdf } else { Spectrum::BLACK }, pdf)
    }

    /// Over the whole sphere: directions below the surface have a density too, that of being absorbed.
    #[inline]
    fn pdf(&self, wo: Vec3, wi: Vec3) -> f32 {
        if self.is_delta() {
            return 0.0;
        }
        let r = self.roughness;
        let mirror = reflect(wo);
        let cos = mirror.dot(wi);
        let half_chord_sq = r * r - mirror.cross(wi).length_squared();
        if half_chord_sq <= 0.0 {
            return 0.0;
        }
        let half_chord = half_chord_sq.sqrt();
        let (t1, t2) = ((cos - half_chord).max(0.0), (cos + half_chord).max(0.0));
        (t2 - t1) * (t2 * t2 + t1 * t2 + t1 * t1) / (4.0 * PI * r * r * r)
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
        for roughness in [0.1, 0.33, 0.66, 1.0] {
            let metal = Metal { albedo: Rgb([0.9, 0.6, 0.2]).into(), roughness: roughness.into() };
            check_lobe(&Bsdf::Metal(metal.bsdf(&NoTextures)), Reciprocal::No).unwrap();
        }
    }

    #[test]
    fn roughness_0_is_a_mirror() {
        let wo = Vec3::new(0.6, 0.0, 0.8);
        let sample = Metal::default().bsdf(&NoTextures).sample(wo, 0.9, Vec2::new(0.1, 0.7)).unwrap();
        assert!(sample.delta);
        assert_eq!(sample.wi, Vec3::new(-0.6, 0.0, 0.8));
    }
}
