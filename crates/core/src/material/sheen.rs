//! Sheen: velvet and other cloth, whose nap shines at the edges.
//!
//! Upright fibres (see [`Charlie`]) of a color c over a lambertian base:
//!
//! f = c D V + albedo / π · (1 − c E(θₒ)) (1 − c E(θᵢ)) / (1 − c Ē),
//!
//! where E is the share of the light that D V scatters, and Ē its mean. So the base gets, and lets out, what the
//! fibres leave: with a white one nothing is lost, but for 0.5 % by interpolation of E. Reciprocal, and the same on
//! both sides.
//!
//! The fibres: Estevez & Kulla 2017, "Production Friendly Microfacet Sheen BRDF"; the base: Kelemen & Szirmay-Kalos
//! 2001, doi:10.2312/egs.20011026, as for a coat.
//!
//! Drawn evenly for the fibres, as the source does, and by the cosine for the base.
//!
//! ```toml
//! [material.velvet.sheen]
//! color = [0.6, 0.2, 0.3]
//! roughness = 0.5
//! albedo = [0.2, 0.02, 0.05]
//! ```

use std::f32::consts::FRAC_1_PI;

use glam::{Vec2, Vec3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::color::{Rgb, Spectrum};
use crate::material::BsdfSample;
use crate::material::charlie::Charlie;
use crate::material::microfacet::upright;
use crate::sampling::{cosine_hemisphere, uniform_sphere};
use crate::texture::{Color, Scalar, Textures};
use crate::validate::Checker;

/// Cloth: upright fibres over a matte base.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Sheen {
    /// Share of the light that fibres do not absorb, 0..1 in each channel; at 0 there are none.
    pub color: Color,
    /// 0 is upright, 1 tangled; alpha is its square. Below 0.3 it is as at 0.3.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub roughness: Scalar,
    /// Share of the light that the base does not absorb, 0..1 in each channel.
    pub albedo: Color,
}

impl Default for Sheen {
    fn default() -> Self {
        Self { color: Rgb::grey(0.5).into(), roughness: 0.5.into(), albedo: Rgb::grey(0.2).into() }
    }
}

impl Sheen {
    pub(crate) fn check(&self, c: &mut Checker) {
        self.color.check_share("color", c);
        self.roughness.check_range("roughness", 0.0, 1.0, c);
        self.albedo.check_share("albedo", c);
    }

    #[inline]
    pub(crate) fn bsdf(&self, textures: &impl Textures) -> SheenBsdf {
        let [color, albedo] = [&self.color, &self.albedo].map(|color| Rgb(color.share_at(textures).to_rgb()));
        SheenBsdf { color, roughness: self.roughness.at(textures, 0.0, 1.0), albedo }
    }
}

/// The lobe of [`Sheen`].
#[derive(Clone, Copy, Debug)]
pub struct SheenBsdf {
    color: Rgb,
    roughness: f32,
    albedo: Rgb,
}

impl SheenBsdf {
    #[inline(never)]
    pub(crate) fn sample(&self, wo: Vec3, uc: f32, u: Vec2) -> Option<BsdfSample> {
        let chance = self.chance_of_fibres(&Charlie::from_roughness(self.roughness), wo.z.abs());
        let mut wi = if uc < chance { uniform_sphere(u) } else { cosine_hemisphere(u) };
        wi.z = wi.z.abs().copysign(wo.z);
        BsdfSample::of_eval(wi, self.eval_pdf(wo, wi))
    }

    #[inline(never)]
    pub(crate) fn eval_pdf(&self, wo: Vec3, wi: Vec3) -> (Spectrum, f32) {
        let side = 1.0_f32.copysign(wo.z);
        let (wo, wi) = (upright(wo, side), upright(wi, side));
        if wo.z <= 0.0 || wi.z <= 0.0 {
            return (Spectrum::BLACK, 0.0);
        }
        let fibres = Charlie::from_roughness(self.roughness);
        let chance = self.chance_of_fibres(&fibres, wo.z);
        let pdf = FRAC_1_PI * (0.5 * chance + (1.0 - chance) * wi.z);
        (self.eval(&fibres, wo, wi), pdf)
    }

    /// The BRDF times cos θᵢ for directions above the surface.
    fn eval(&self, fibres: &Charlie, wo: Vec3, wi: Vec3) -> Spectrum {
        let scattered = fibres.eval(wo, wi);
        let (share_o, share_i, mean) = (fibres.share(wo.z), fibres.share(wi.z), fibres.mean_share());
        self.each(|color, albedo| {
            let base = albedo * FRAC_1_PI * (1.0 - color * share_o) * (1.0 - color * share_i) / (1.0 - color * mean);
            (color * scattered + base) * wi.z
        })
    }

    /// About the fibres' part of what is scattered.
    fn chance_of_fibres(&self, fibres: &Charlie, cos: f32) -> f32 {
        let share = fibres.share(cos);
        let by_fibres = self.each(|color, _| color * share).max_component();
        let all = by_fibres + self.each(|color, albedo| albedo * (1.0 - color * share)).max_component();
        if by_fibres > 0.0 { by_fibres / all } else { 0.0 }
    }

    /// The share of light from straight above that is scattered.
    pub(crate) fn albedo(&self) -> Spectrum {
        let share = Charlie::from_roughness(self.roughness).share(1.0);
        self.each(|color, albedo| color * share + albedo * (1.0 - color * share))
    }

    /// A function of the color and the albedo of each channel.
    fn each(&self, f: impl Fn(f32, f32) -> f32) -> Spectrum {
        Spectrum::from_rgb(std::array::from_fn(|i| f(self.color.0[i], self.albedo.0[i])))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::{Bsdf, Lambertian};
    use crate::testing::{Reciprocal, check_lobe};
    use crate::texture::NoTextures;

    fn cloth(color: [f32; 3], roughness: f32, albedo: [f32; 3]) -> SheenBsdf {
        Sheen { color: Rgb(color).into(), roughness: roughness.into(), albedo: Rgb(albedo).into() }.bsdf(&NoTextures)
    }

    /// The share of light at an angle that is scattered, by midpoints in √cos θᵢ and the azimuth.
    fn share(bsdf: SheenBsdf, cos: f32) -> [f64; 3] {
        const N: u32 = 100;
        let wo = Vec3::new((1.0 - cos * cos).sqrt(), 0.0, cos);
        let mut sum = [0.0; 3];
        for (i, j) in (0..N).flat_map(|i| (0..N).map(move |j| (i, j))) {
            let [x, turn] = [i, j].map(|i| (f64::from(i) + 0.5) / f64::from(N));
            let (sin, phi) = ((1.0 - x.powi(4)).sqrt(), turn * std::f64::consts::TAU);
            let wi = Vec3::new((sin * phi.cos()) as f32, (sin * phi.sin()) as f32, (x * x) as f32);
            let weight = 2.0 * x * std::f64::consts::TAU / f64::from(N * N);
            sum.iter_mut().zip(bsdf.eval_pdf(wo, wi).0.to_rgb()).for_each(|(sum, e)| *sum += f64::from(e) * weight);
        }
        sum
    }

    #[test]
    fn lobe() {
        for (color, roughness, albedo) in [
            ([0.6, 0.2, 0.3], 0.3, [0.2, 0.02, 0.05]),
            ([1.0, 0.5, 0.0], 0.6, [0.0; 3]),
            ([1.0; 3], 1.0, [1.0; 3]),
            ([0.0; 3], 0.5, [0.5; 3]),
        ] {
            check_lobe(&Bsdf::Sheen(cloth(color, roughness, albedo)), Reciprocal::Yes).unwrap();
        }
    }

    /// Over a white base nothing is lost, whatever the color of the fibres.
    #[test]
    fn white_base_gives_what_fibres_leave() {
        for roughness in [0.0, 0.4, 0.7, 1.0] {
            for cos in [0.002, 0.02, 0.1, 0.4, 0.8, 1.0] {
                for share in share(cloth([1.0, 0.5, 0.1], roughness, [1.0; 3]), cos) {
                    assert!((share - 1.0).abs() < 5e-3, "{share} at roughness {roughness}, cosine {cos}");
                }
            }
        }
    }

    #[test]
    fn without_fibres_it_is_lambertian() {
        let matte = Lambertian { albedo: Rgb::grey(0.5).into() }.bsdf(&NoTextures);
        let (wo, wi) = (Vec3::new(0.6, 0.0, -0.8), Vec3::new(0.0, 0.8, -0.6));
        let ((eval, pdf), (matte, matte_pdf)) =
            (cloth([0.0; 3], 0.4, [0.5; 3]).eval_pdf(wo, wi), matte.eval_pdf(wo, wi));
        assert!((eval.to_rgb()[1] - matte.to_rgb()[1]).abs() < 1e-7 && (pdf - matte_pdf).abs() < 1e-7);
    }

    /// Fibres alone shine at the edge; and the albedo is what comes from straight above.
    #[test]
    fn shines_at_the_edge() {
        let fibres = cloth([1.0; 3], 0.5, [0.0; 3]);
        let [[edge, ..], [above, ..]] = [share(fibres, 0.05), share(fibres, 1.0)];
        assert!(edge > 0.5 && above < 0.05, "{edge} at the edge, {above} from above");
        let bsdf = cloth([0.9, 0.5, 0.1], 0.8, [0.1, 0.4, 0.7]);
        for (exact, albedo) in share(bsdf, 1.0).into_iter().zip(bsdf.albedo().to_rgb()) {
            assert!((exact - f64::from(albedo)).abs() < 2e-3, "{albedo}, not {exact}");
        }
    }

    #[test]
    fn grazing_light_is_finite() {
        for bsdf in [cloth([1.0; 3], 0.0, [0.0; 3]), cloth([1.0; 3], 1.0, [1.0; 3]), cloth([0.0; 3], 0.5, [0.0; 3])] {
            for z in [0.0_f32, -0.0, 1e-42, 1e-30, -1e-20, 1e-10, -1e-5, 1.0] {
                let wo = Vec3::new((1.0 - z * z).sqrt(), 0.0, z);
                for (uc, u) in [(0.0, Vec2::ZERO), (0.999, Vec2::new(0.5, 0.0)), (0.0, Vec2::new(0.5, 0.3))] {
                    if let Some(s) = bsdf.sample(wo, uc, u) {
                        assert!(s.weight.to_rgb().iter().all(|w| (0.0..1e3).contains(w)) && s.pdf > 0.0, "{s:?}");
                    }
                }
                for wi in [Vec3::new(-1.0, 0.0, z), wo, -wo, Vec3::Z, Vec3::X, Vec3::new(-1.0, 0.0, 1e-25)] {
                    let (eval, pdf) = bsdf.eval_pdf(wo, wi);
                    assert!(eval.to_rgb().iter().all(|e| e.is_finite() && *e >= 0.0) && pdf.is_finite() && pdf >= 0.0);
                }
            }
        }
    }
}
