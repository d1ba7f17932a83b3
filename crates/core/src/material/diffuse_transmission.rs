//! Diffuse transmission: a thin matte sheet that light comes through, such as a leaf, paper or a lampshade.
//!
//! f = reflectance / π on the side that light comes from, transmittance / π on the other. Both sides are alike. Samples
//! choose a side by the largest channel of its share, and a direction by the cosine. Nothing is refracted: the sheet
//! has no inside. Lambert, Photometria, 1760, on either side, as in Pharr, Jakob & Humphreys 2023, Physically Based
//! Rendering, 4th ed., §9.9.
//!
//! ```toml
//! [material.leaf.diffuse-transmission]
//! reflectance = [0.08, 0.2, 0.04]
//! transmittance = [0.06, 0.25, 0.02]
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

/// Thin and matte: scatters light evenly to its own side and to the other.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct DiffuseTransmission {
    /// Share of the light that is scattered back, 0..1 in each channel.
    pub reflectance: Color,
    /// Share of the light that comes through, 0..1 in each channel; with `reflectance` at most 1, whatever
    /// textures say.
    pub transmittance: Color,
}

impl Default for DiffuseTransmission {
    fn default() -> Self {
        Self { reflectance: Rgb::grey(0.25).into(), transmittance: Rgb::grey(0.25).into() }
    }
}

impl DiffuseTransmission {
    pub(crate) fn check(&self, c: &mut Checker) {
        /// What shares such as 0.9 and 0.1 may be off.
        const ROUNDING: f32 = 1e-6;
        self.reflectance.check_share("reflectance", c);
        self.transmittance.check_share("transmittance", c);
        let (Some(reflectance), Some(transmittance)) = (self.reflectance.rgb(), self.transmittance.rgb()) else {
            return;
        };
        let sums = reflectance.0.into_iter().zip(transmittance.0).map(|(r, t)| r + t);
        if let Some(sum) = sums.into_iter().find(|sum| *sum > 1.0 + ROUNDING) {
            let message = format!("`reflectance` and `transmittance` add up to {sum}");
            let hint = "a sheet cannot scatter more light than it gets: keep their sum at most 1 in each channel";
            c.problem("transmittance", message, Some(hint.to_owned()));
        }
    }

    #[inline]
    pub(crate) fn bsdf(&self, textures: &impl Textures) -> DiffuseTransmissionBsdf {
        let reflectance = self.reflectance.share_at(textures);
        let mut transmittance = self.transmittance.share_at(textures).to_rgb();
        // Textures may say more than there is: then less comes through.
        for (through, back) in transmittance.iter_mut().zip(reflectance.to_rgb()) {
            *through = through.min(1.0 - back);
        }
        DiffuseTransmissionBsdf { reflectance, transmittance: Rgb(transmittance).into() }
    }
}

/// The lobe of [`DiffuseTransmission`].
#[derive(Clone, Copy, Debug)]
pub struct DiffuseTransmissionBsdf {
    reflectance: Spectrum,
    transmittance: Spectrum,
}

impl DiffuseTransmissionBsdf {
    pub(crate) fn albedo(&self) -> Spectrum {
        self.reflectance + self.transmittance
    }

    /// What is scattered to a side, and the chance that it is chosen.
    #[inline]
    fn share(&self, reflected: bool) -> (Spectrum, f32) {
        let [r, t] = [self.reflectance, self.transmittance].map(Spectrum::max_component);
        let (share, part) = if reflected { (self.reflectance, r) } else { (self.transmittance, t) };
        (share, if part > 0.0 { part / (r + t) } else { 0.0 })
    }

    #[inline(never)]
    pub(crate) fn sample(&self, wo: Vec3, uc: f32, u: Vec2) -> Option<BsdfSample> {
        let reflected = uc < self.share(true).1;
        let (share, chance) = self.share(reflected);
        let mut wi = cosine_hemisphere(u);
        if wi.z == 0.0 || chance == 0.0 {
            return None;
        }
        let pdf = chance * wi.z * FRAC_1_PI;
        wi.z = wi.z.copysign(if reflected { wo.z } else { -wo.z });
        Some(BsdfSample { wi, weight: share * (1.0 / chance), pdf, delta: false, eta: 1.0 })
    }

    #[inline]
    pub(crate) fn eval_pdf(&self, wo: Vec3, wi: Vec3) -> (Spectrum, f32) {
        let (share, chance) = self.share(wo.z * wi.z > 0.0);
        let cos = if wo.z == 0.0 { 0.0 } else { wi.z.abs() * FRAC_1_PI };
        (share * cos, chance * cos)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::Bsdf;
    use crate::testing::{Reciprocal, check_lobe};
    use crate::texture::NoTextures;
    use crate::validate::Problem;

    fn sheet(reflectance: [f32; 3], transmittance: [f32; 3]) -> DiffuseTransmission {
        DiffuseTransmission { reflectance: Rgb(reflectance).into(), transmittance: Rgb(transmittance).into() }
    }

    #[test]
    fn lobe() {
        for sheet in [
            sheet([0.08, 0.2, 0.04], [0.06, 0.25, 0.02]),
            sheet([0.9, 0.0, 0.2], [0.1, 1.0, 0.0]),
            sheet([0.7; 3], [0.0; 3]),
            sheet([0.0; 3], [1.0; 3]),
        ] {
            check_lobe(&Bsdf::DiffuseTransmission(sheet.bsdf(&NoTextures)), Reciprocal::Yes).unwrap();
        }
    }

    /// On either side of either side, the mean of what samples bring is what the sheet was said to scatter.
    #[test]
    fn shares_are_as_described() {
        const N: u32 = 20_000;
        let (r, t) = ([0.5, 0.1, 0.0], [0.2, 0.6, 0.3]);
        let bsdf = sheet(r, t).bsdf(&NoTextures);
        for wo in [Vec3::new(0.6, 0.0, 0.8), Vec3::new(0.0, 0.8, -0.6)] {
            let mut sums = [[0.0; 3]; 2];
            for i in 0..N {
                let mut numbers = crate::sampler::Independent::new(3, glam::UVec2::ZERO, i);
                let s = bsdf.sample(wo, numbers.get_1d(), numbers.get_2d()).unwrap();
                let sum = &mut sums[usize::from(s.wi.z * wo.z < 0.0)];
                sum.iter_mut().zip(s.weight.to_rgb()).for_each(|(sum, w)| *sum += w / N as f32);
            }
            for (mean, share) in sums.as_flattened().iter().zip([r, t].as_flattened()) {
                assert!((mean - share).abs() < 0.012, "{mean}, not {share}");
            }
        }
    }

    #[test]
    fn black_and_grazing_are_finite() {
        let black = sheet([0.0; 3], [0.0; 3]).bsdf(&NoTextures);
        assert!(black.sample(Vec3::Z, 0.0, Vec2::splat(0.3)).is_none());
        assert_eq!(black.eval_pdf(Vec3::Z, Vec3::Z), (Spectrum::BLACK, 0.0));
        let faint = sheet([1e-38, 0.0, 0.0], [0.0, 1e-30, 0.0]).bsdf(&NoTextures);
        for (z, uc) in [(0.0, 0.0), (-0.0, 0.9), (1e-42, 0.5), (1.0, 0.999), (-1e-30, 0.0)] {
            for bsdf in [black, faint] {
                let wo = Vec3::new((1.0_f32 - z * z).sqrt(), 0.0, z);
                if let Some(s) = bsdf.sample(wo, uc, Vec2::new(0.0, 0.5)) {
                    assert!(s.weight.to_rgb().iter().all(|w| (0.0..=1.0).contains(w)) && s.pdf > 0.0, "{s:?}");
                }
                assert!(bsdf.eval_pdf(wo, -wo).1.is_finite());
            }
        }
    }

    #[test]
    fn too_much_light_is_a_problem() {
        let problems = |sheet: DiffuseTransmission| {
            let mut c = Checker::default();
            sheet.check(&mut c);
            c.into_problems().into_iter().map(|Problem { path, .. }| path.join(".")).collect::<Vec<_>>()
        };
        assert!(problems(DiffuseTransmission::default()).is_empty());
        assert!(problems(sheet([0.9, 0.7, 0.35], [0.1, 0.3, 0.65])).is_empty());
        assert_eq!(problems(sheet([0.5, 0.5, 0.6], [0.5, 0.5, 0.5])), ["transmittance"]);
        assert_eq!(problems(sheet([-0.5; 3], [0.5; 3])), ["reflectance"]);
    }
}
