//! Wrong lobes.

use eyebeam_core::color::Spectrum;
use eyebeam_core::material::BsdfSample;
use eyebeam_core::testing::Lobe;
use glam::{Vec2, Vec3};

use crate::mistake::Mistake;

#[derive(Debug)]
pub(crate) struct Wrong(pub(crate) Mistake, pub(crate) Box<dyn Lobe>);

impl Wrong {
    /// What a pdf or an eval is wrong by: that of `wo` and `wi`.
    fn factors(&self, wo: Vec3, wi: Vec3) -> [f32; 2] {
        match self.0 {
            Mistake::PdfDoubled => [1.0, 2.0],
            Mistake::EvalWithoutCosine | Mistake::CosineLost => [1.0 / wi.z.abs().max(1e-6), 1.0],
            Mistake::HalfVectorJacobianLost => [1.0, 4.0 * wo.dot((wo + wi).normalize_or_zero()).abs().max(1e-6)],
            _ => [1.0, 1.0],
        }
    }
}

impl Lobe for Wrong {
    fn sample(&self, wo: Vec3, uc: f32, u: Vec2) -> Option<BsdfSample> {
        match self.0 {
            Mistake::IndexSwapped => {
                let turned = |w: Vec3| Vec3::new(w.x, w.y, -w.z);
                let sample = self.1.sample(turned(wo), uc, u)?;
                return Some(BsdfSample { wi: turned(sample.wi), ..sample });
            }
            Mistake::FresnelOfTheOtherSide => {
                let other = self.1.sample(Vec3::new(wo.x, wo.y, -wo.z), uc, u)?;
                let uc = if other.eta == 1.0 { 0.0 } else { 1.0 - 0.5 * f32::EPSILON };
                return self.1.sample(wo, uc, u);
            }
            _ => {}
        }
        let sample = self.1.sample(wo, uc, u)?;
        let [eval, pdf] = self.factors(wo, sample.wi);
        let weight = match self.0 {
            Mistake::RadianceNotScaled => sample.weight * (sample.eta * sample.eta),
            // Here the weight is as it should be, and does not fit to what is evaluated.
            Mistake::EvalWithoutCosine => sample.weight,
            _ => sample.weight * (eval / pdf),
        };
        Some(BsdfSample { weight, pdf: sample.pdf * pdf, ..sample })
    }

    fn eval_pdf(&self, wo: Vec3, wi: Vec3) -> (Spectrum, f32) {
        let ((eval, pdf), factors) = (self.1.eval_pdf(wo, wi), self.factors(wo, wi));
        (eval * factors[0], pdf * factors[1])
    }
}
