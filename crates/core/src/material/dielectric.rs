//! Dielectric: smooth glass, water, diamond.
//!
//! Light is either reflected, with the chance that Fresnel's equations give for unpolarised light, or refracted by
//! Snell's law; past the critical angle all of it is reflected. Refracted radiance is divided by eta², as it spreads over
//! another solid angle (Veach 1997, Robust Monte Carlo Methods, §5.2); entering and leaving cancel.
//!
//! A hollow ball is a ball of glass with a smaller one of eta = 1/1.5 inside.
//!
//! ```toml
//! [material.glass.dielectric]
//! eta = 1.5
//! ```

use glam::Vec3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::color::Spectrum;
use crate::material::BsdfSample;
use crate::math::{reflect, refract};
use crate::validate::Checker;

/// Clear and smooth: reflects and refracts.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Dielectric {
    /// Index of refraction inside over outside, above 0; inside is where the normal points away from. Glass 1.5, water
    /// 1.33, diamond 2.42.
    #[schemars(range(min = 0.01, max = 100.0))]
    pub eta: f32,
}

impl Default for Dielectric {
    fn default() -> Self {
        Self { eta: 1.5 }
    }
}

impl Dielectric {
    pub(crate) fn check(&self, c: &mut Checker) {
        c.in_range("eta", self.eta, 0.01, 100.0);
    }

    #[inline]
    pub(crate) fn bsdf(&self) -> DielectricBsdf {
        DielectricBsdf { eta: self.eta }
    }
}

/// The lobe of [`Dielectric`]: two delta directions.
#[derive(Clone, Copy, Debug)]
pub struct DielectricBsdf {
    eta: f32,
}

impl DielectricBsdf {
    #[inline]
    pub(crate) fn sample(&self, wo: Vec3, uc: f32) -> Option<BsdfSample> {
        let eta = if wo.z > 0.0 { self.eta } else { 1.0 / self.eta };
        let fresnel = Fresnel::dielectric(wo.z.abs(), eta);
        Some(if uc < fresnel.reflectance {
            BsdfSample { wi: reflect(wo), weight: Spectrum::ONE, pdf: fresnel.reflectance, delta: true }
        } else {
            let weight = Spectrum::ONE * (1.0 / (eta * eta));
            BsdfSample { wi: refract(wo, eta, fresnel.cos_t), weight, pdf: 1.0 - fresnel.reflectance, delta: true }
        })
    }
}

/// What happens to unpolarised light at a smooth boundary.
#[derive(Clone, Copy, Debug)]
pub struct Fresnel {
    /// Share that is reflected, 0..1.
    pub reflectance: f32,
    /// Cosine of the refracted angle; 0 if all is reflected.
    pub cos_t: f32,
}

impl Fresnel {
    /// Fresnel's equations; `cos_i` >= 0 is the cosine of the angle of incidence, `eta` the index behind over before.
    #[inline]
    pub fn dielectric(cos_i: f32, eta: f32) -> Self {
        let sin_sq_t = (1.0 - cos_i * cos_i).max(0.0) / (eta * eta);
        if sin_sq_t >= 1.0 {
            return Self { reflectance: 1.0, cos_t: 0.0 };
        }
        let cos_t = (1.0 - sin_sq_t).sqrt();
        let parallel = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
        let perpendicular = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
        Self { reflectance: 0.5 * (parallel * parallel + perpendicular * perpendicular), cos_t }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::chi2_counts;

    fn direction(degrees: f32) -> Vec3 {
        let (sin, cos) = degrees.to_radians().sin_cos();
        Vec3::new(sin, 0.0, cos)
    }

    /// Reflections and refractions come as often as Fresnel says, in the directions of the mirror and of Snell.
    #[test]
    fn chooses_by_fresnel() {
        const N: u32 = 100_000;
        let glass = Dielectric::default().bsdf();
        for degrees in [0.0_f32, 30.0, 60.0, 85.0] {
            for side in [1.0, -1.0] {
                let wo = direction(degrees) * Vec3::new(1.0, 1.0, side);
                let eta = if side > 0.0 { 1.5 } else { 1.0 / 1.5 };
                let reflectance = f64::from(Fresnel::dielectric(wo.z.abs(), eta).reflectance);
                let mut counts = [0_u64; 2];
                for i in 0..N {
                    let mut numbers = crate::sampler::Independent::new(3, glam::UVec2::ZERO, i);
                    let sample = glass.sample(wo, numbers.get_1d()).unwrap();
                    let reflected = sample.wi.z * wo.z > 0.0;
                    counts[usize::from(!reflected)] += 1;
                    assert!((sample.wi.length() - 1.0).abs() < 1e-5 && sample.delta);
                    if reflected {
                        assert_eq!(sample.wi, reflect(wo));
                    } else {
                        assert!((eta * sample.wi.x + wo.x).abs() < 1e-5, "Snell at {degrees} degrees");
                    }
                }
                if reflectance == 1.0 {
                    assert_eq!(counts[1], 0, "total reflection at {degrees} degrees");
                } else {
                    chi2_counts(&counts, &[reflectance * f64::from(N), (1.0 - reflectance) * f64::from(N)]).unwrap();
                }
            }
        }
    }

    /// Known values: 4 % at normal incidence on glass; 0 for the parallel half at Brewster's angle; total at the end.
    #[test]
    fn fresnel_values() {
        assert!((Fresnel::dielectric(1.0, 1.5).reflectance - 0.04).abs() < 1e-6);
        assert!((Fresnel::dielectric(1.0, 1.0 / 1.5).reflectance - 0.04).abs() < 1e-6);
        let brewster = 1.5_f32.atan();
        let r = Fresnel::dielectric(brewster.cos(), 1.5).reflectance;
        let perpendicular = (2.0 * brewster).cos().powi(2);
        assert!((r - 0.5 * perpendicular).abs() < 1e-6);
        assert!((Fresnel::dielectric(0.0, 1.5).reflectance - 1.0).abs() < 1e-6);
        assert_eq!(Fresnel::dielectric(0.7, 1.0 / 1.5).reflectance, 1.0);
    }
}
