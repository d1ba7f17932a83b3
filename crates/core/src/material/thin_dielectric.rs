//! Thin dielectric: a pane of glass or a soap bubble, as a surface without thickness.
//!
//! Each of its two boundaries reflects the share R by Fresnel's equations, from outside and from inside. All added up,
//!
//! R' = R + R (1 − R)² (1 + R² + R⁴ + …) = 2R / (1 + R), T' = 1 − R'
//!
//! are reflected and go straight on: what is bent at one boundary is bent back at the other. With an `eta` below 1, all
//! is reflected past the critical angle. Pharr, Jakob & Humphreys 2023, Physically Based Rendering, 4th ed., §9.5.1.
//!
//! ```toml
//! [material.window.thin-dielectric]
//! eta = 1.5
//! color = [0.9, 0.95, 0.92]
//! ```

use glam::Vec3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::color::{Rgb, Spectrum};
use crate::material::{BsdfSample, Fresnel};
use crate::math::reflect;
use crate::texture::{Color, Textures};
use crate::validate::Checker;

/// Clear and thin: reflects, and lets through what it does not.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct ThinDielectric {
    /// Index of refraction of the pane over that around it, above 0. Glass 1.5, water 1.33.
    #[schemars(range(min = 0.01, max = 100.0))]
    pub eta: f32,
    /// Share that is left of the light that goes through, 0..1 in each channel, at any angle.
    pub color: Color,
}

impl Default for ThinDielectric {
    fn default() -> Self {
        Self { eta: 1.5, color: Rgb::grey(1.0).into() }
    }
}

impl ThinDielectric {
    pub(crate) fn check(&self, c: &mut Checker) {
        c.in_range("eta", self.eta, 0.01, 100.0);
        self.color.check_share("color", c);
    }

    #[inline]
    pub(crate) fn bsdf(&self, textures: &impl Textures) -> ThinDielectricBsdf {
        ThinDielectricBsdf { eta: self.eta, color: Rgb(self.color.share_at(textures).to_rgb()) }
    }
}

/// The lobe of [`ThinDielectric`].
#[derive(Clone, Copy, Debug)]
pub struct ThinDielectricBsdf {
    eta: f32,
    color: Rgb,
}

impl ThinDielectricBsdf {
    #[inline(never)]
    pub(crate) fn sample(&self, wo: Vec3, uc: f32) -> Option<BsdfSample> {
        let once = Fresnel::dielectric(wo.z.abs().min(1.0), self.eta).reflectance;
        let reflectance = 2.0 * once / (1.0 + once);
        if uc < reflectance {
            return Some(BsdfSample {
                wi: reflect(wo),
                weight: Spectrum::ONE,
                pdf: reflectance,
                delta: true,
                eta: 1.0,
            });
        }
        let weight = Spectrum::from(self.color);
        (!weight.is_black()).then_some(BsdfSample { wi: -wo, weight, pdf: 1.0 - reflectance, delta: true, eta: 1.0 })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::Bsdf;
    use crate::sampler::Independent;
    use crate::testing::chi2_counts;
    use crate::texture::NoTextures;
    use glam::Vec2;

    fn pane(eta: f32, color: [f32; 3]) -> Bsdf {
        Bsdf::ThinDielectric(ThinDielectric { eta, color: Rgb(color).into() }.bsdf(&NoTextures))
    }

    fn direction(degrees: f32, side: f32) -> Vec3 {
        let (sin, cos) = degrees.to_radians().sin_cos();
        Vec3::new(0.6 * sin, 0.8 * sin, side * cos)
    }

    /// As often reflected as light that is followed from boundary to boundary of a thick plate.
    #[test]
    fn chances_are_those_of_a_plate() {
        const N: u32 = 50_000;
        for (degrees, side) in [0.0, 40.0, 60.0, 85.0].into_iter().flat_map(|d| [(d, 1.0), (d, -1.0)]) {
            let wo = direction(degrees, side);
            let r = f64::from(Fresnel::dielectric(wo.z.abs(), 1.5).reflectance);
            let (mut back, mut inside) = (r, 1.0 - r);
            for _ in 0..100 {
                back += inside * r * (1.0 - r);
                inside *= r * r;
            }
            let mut counts = [0_u64; 2];
            for i in 0..N {
                let uc = Independent::new(3, glam::UVec2::ZERO, i).get_1d();
                let s = pane(1.5, [0.5, 0.7, 1.0]).sample(wo, uc, Vec2::ZERO).unwrap();
                let reflected = s.wi == reflect(wo);
                assert!(s.delta && s.eta == 1.0 && (reflected || s.wi == -wo));
                let (weight, chance) = if reflected { ([1.0; 3], back) } else { ([0.5, 0.7, 1.0], 1.0 - back) };
                assert!(s.weight.to_rgb() == weight && (f64::from(s.pdf) - chance).abs() < 1e-6, "{s:?}");
                counts[usize::from(!reflected)] += 1;
            }
            chi2_counts(&counts, &[back * f64::from(N), (1.0 - back) * f64::from(N)]).unwrap();
        }
    }

    #[test]
    fn edge_cases() {
        let all = [0.0, 0.3, 0.999_999];
        for uc in all {
            let through = pane(1.0, [1.0; 3]).sample(direction(50.0, 1.0), uc, Vec2::ZERO).unwrap();
            assert!(through.wi == -direction(50.0, 1.0) && through.pdf == 1.0);
            let total = pane(0.5, [1.0; 3]).sample(direction(31.0, -1.0), uc, Vec2::ZERO).unwrap();
            assert!(total.wi == reflect(direction(31.0, -1.0)) && total.pdf == 1.0);
        }
        assert!(pane(1.5, [0.0; 3]).sample(Vec3::Z, 0.9, Vec2::ZERO).is_none());
        for (eta, z, uc) in [0.01_f32, 0.999, 1.0, 1.5, 100.0]
            .into_iter()
            .flat_map(|eta| [0.0_f32, -0.0, 1e-42, -1e-20, 1.0, 1.000_000_1].map(|z| (eta, z)))
            .flat_map(|(eta, z)| all.map(|uc| (eta, z, uc)))
        {
            let wo = Vec3::new((1.0 - z * z).max(0.0).sqrt(), 0.0, z);
            let s = pane(eta, [1.0; 3]).sample(wo, uc, Vec2::ZERO).unwrap();
            assert!(s.pdf > 0.0 && s.pdf <= 1.0 && s.wi.is_finite(), "{s:?} at index {eta}, cosine {z}");
        }
        assert!(pane(1.5, [1.0; 3]).is_delta() && pane(1.5, [1.0; 3]).eval_pdf(Vec3::Z, -Vec3::Z).1 == 0.0);
    }
}
