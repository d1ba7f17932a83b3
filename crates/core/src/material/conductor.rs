//! Conductor: metal, from polished to dull.
//!
//! Facets (see [`Ggx`]) that reflect by Fresnel's equations for metals, from measured indices of refraction, or the
//! same share at all angles:
//!
//! f = F D G₂ / (4 cos θₒ cos θᵢ).
//!
//! Visible normals are drawn, so a sample weighs F G₂ / G₁. Cook & Torrance 1982, doi:10.1145/357290.357293; Walter et al.
//! 2007, doi:10.2312/EGWR/EGSR07/195-206. The facets' alpha is roughness². Reciprocal, and the same on both sides.
//!
//! What goes from facet to facet is lost that way: of light from straight above 1 % at roughness 0.3, 18 % at 0.6, 69 % at 1.
//! By default it is sent back as a second lobe,
//!
//! f_ms = F_ms (1 − E(wo)) (1 − E(wi)) / (π (1 − Ē)), F_ms = F̄² Ē / (1 − F̄ (1 − Ē)),
//!
//! where E is the share that white facets send on at once (see `lost.rs`), Ē its mean, F̄ that of F over all angles: each further
//! facet takes its share, so colours get deeper. Kulla & Conty 2017, "Revisiting Physically Based Shading at Imageworks";
//! F_ms after Hill 2018, "A Multi-Faceted Exploration". Each lobe gets samples by about its share of the light. Those of the second
//! one are half from a cosine lobe, which fits rough metal, and half from one that is as near to the horizon as alpha is
//! small, where smooth facets hide one another; from roughness 0.2 on all weights are below 2 (3.3 if brushed). To scale the
//! first lobe up instead (Turquin 2019) would be cheaper, but is not reciprocal, and has weights up to 3.3 where this has 1.8.
//! docs/theory/microfacets.md has numbers.
//!
//! ```toml
//! [material.ring.conductor]
//! metal = "gold"
//! roughness = 0.3
//!
//! [material.zinc.conductor]
//! eta = [1.20, 0.91, 0.66]
//! k = [5.82, 4.91, 3.92]
//!
//! [material.steel.conductor]
//! reflectance = [0.56, 0.57, 0.58]
//! roughness = 0.4
//! ```

use std::f32::consts::FRAC_1_PI;

use glam::{Vec2, Vec3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::color::{Rgb, Spectrum};
use crate::material::BsdfSample;
use crate::material::fresnel::Reflectance;
use crate::material::lost::{horizon_over_cosine, lost, mean_lost, near_horizon};
use crate::material::metals::NamedMetal;
use crate::material::microfacet::{Ggx, reflect_at};
use crate::math::{reflect, sin_cos_turns};
use crate::sampling::cosine_hemisphere;
use crate::texture::{Color, Scalar, Textures};
use crate::validate::Checker;

/// Metal of facets: `metal`, or `eta` and `k`, or `reflectance`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Conductor {
    /// The metal by its name, which stands for measured `eta` and `k`.
    pub metal: Option<NamedMetal>,
    /// Real part of the index of refraction in each channel, 0.01..100; together with `k`.
    pub eta: Option<Rgb>,
    /// Imaginary part of the index of refraction in each channel, 0..100; together with `eta`.
    pub k: Option<Rgb>,
    /// Share of the light that is reflected at any angle, 0..1 in each channel, whatever the metal; 0.9 if
    /// nothing is said.
    pub reflectance: Option<Color>,
    /// 0 is a mirror, 1 completely rough; alpha is its square. Below 0.022 it is a perfect mirror.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub roughness: Scalar,
    /// Highlights of brushed metal are long in one direction, the more so the nearer this is to 1: along it alpha is divided
    /// by √(1 − 0.9 anisotropy), across it multiplied. 0 is the same all around.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub anisotropy: f32,
    /// Turns that direction about the normal, counter-clockwise as seen from outside, degrees, -360..360. At 0 it is that
    /// of growing u: along the first edge of a quad, around a sphere, as the coordinates of a mesh say.
    #[schemars(range(min = -360.0, max = 360.0))]
    pub rotation: f32,
    /// Whether light that goes from facet to facet comes back, as it does; without, rough metal is too dark, as in renderers
    /// that know single scattering only.
    pub compensation: bool,
}

impl Default for Conductor {
    fn default() -> Self {
        Self {
            metal: None,
            eta: None,
            k: None,
            reflectance: None,
            roughness: 0.0.into(),
            anisotropy: 0.0,
            rotation: 0.0,
            compensation: true,
        }
    }
}

impl Conductor {
    const DEFAULT_REFLECTANCE: Rgb = Rgb::grey(0.9);

    pub(crate) fn check(&self, c: &mut Checker) {
        self.roughness.check_range("roughness", 0.0, 1.0, c);
        c.in_range("anisotropy", self.anisotropy, 0.0, 1.0);
        c.in_range("rotation", self.rotation, -360.0, 360.0);
        for (key, value, lo) in [("eta", self.eta, 0.01), ("k", self.k, 0.0)] {
            let outside = |channel: &f32| !(lo..=100.0).contains(channel);
            if let Some(&bad) = value.as_ref().and_then(|rgb| rgb.0.iter().find(|channel| outside(channel))) {
                c.in_range(key, bad, lo, 100.0);
            }
        }
        if let Some(reflectance) = &self.reflectance {
            reflectance.check_share("reflectance", c);
        }
        let hint = |text: &str| Some(text.to_owned());
        match (self.eta, self.k) {
            (Some(_), None) => c.problem("eta", "`eta` of a metal needs `k`", hint("add `k`")),
            (None, Some(_)) => c.problem("k", "`k` of a metal needs `eta`", hint("add `eta`")),
            _ => {}
        }
        let index = self.eta.is_some() || self.k.is_some();
        let said = [("metal", self.metal.is_some()), ("eta", index), ("reflectance", self.reflectance.is_some())];
        let mut said = said.into_iter().filter_map(|(key, said)| said.then_some(key));
        if let (Some(first), Some(second)) = (said.next(), said.next()) {
            c.problem(
                second,
                format!("`{first}` says how much is reflected, and so does `{second}`"),
                hint("keep one of them: `metal`, `eta` and `k`, or `reflectance`"),
            );
        }
    }

    #[inline]
    pub(crate) fn bsdf(&self, textures: &impl Textures) -> ConductorBsdf {
        let reflectance = match (self.metal.map(NamedMetal::eta_k), self.eta, self.k) {
            (Some((eta, k)), ..) | (None, Some(eta), Some(k)) => Reflectance::Fresnel { eta, k },
            _ => Reflectance::Constant(
                self.reflectance
                    .as_ref()
                    .map_or(Self::DEFAULT_REFLECTANCE, |color| Rgb(color.share_at(textures).to_rgb())),
            ),
        };
        let (ggx, compensation) = (Ggx::from_roughness(self.roughness.at(textures, 0.0, 1.0)), self.compensation);
        let mut facets = ConductorBsdf { reflectance, ggx, x: Vec2::X, compensation };
        if self.anisotropy > 0.0 {
            facets.ggx = facets.ggx.stretched(self.anisotropy);
            let (sin, cos) = sin_cos_turns(self.rotation / 360.0);
            facets.x = textures.u_axis().rotate(Vec2::new(cos, sin));
        }
        facets
    }
}

/// The lobe of [`Conductor`].
#[derive(Clone, Copy, Debug)]
pub struct ConductorBsdf {
    reflectance: Reflectance,
    ggx: Ggx,
    /// The facets' x axis in the surface's frame.
    x: Vec2,
    compensation: bool,
}

/// What goes from facet to facet and comes back to one direction.
#[derive(Clone, Copy, Debug)]
struct Multiple {
    /// f_ms (1 / (1 − E(wi))).
    scale: Spectrum,
    /// The chance with which it is sampled: about its share of the light.
    chance: f32,
}

impl ConductorBsdf {
    pub(crate) fn albedo(&self) -> Spectrum {
        self.reflectance.at(1.0)
    }

    #[inline]
    pub(crate) fn is_delta(&self) -> bool {
        self.ggx.alpha() < Ggx::MIN_ALPHA
    }

    #[inline]
    pub(crate) fn sample(&self, wo: Vec3, uc: f32, u: Vec2) -> Option<BsdfSample> {
        if self.is_delta() {
            let weight = self.reflectance.at(wo.z.abs());
            return Some(BsdfSample { wi: reflect(wo), weight, pdf: 1.0, delta: true, eta: 1.0 });
        }
        let side = 1.0_f32.copysign(wo.z);
        let up = self.by_facets(wo, side);
        let (wi, weight, pdf) = if self.compensation {
            self.sample_compensated(up, uc, u)?
        } else {
            let wi = reflect_at(up, self.ggx.sample(up, u));
            let (weight, pdf) = self.weight_pdf(up, wi)?;
            (wi, weight, pdf)
        };
        Some(BsdfSample { wi: self.by_surface(wi, side), weight, pdf, delta: false, eta: 1.0 })
    }

    #[inline]
    pub(crate) fn eval_pdf(&self, wo: Vec3, wi: Vec3) -> (Spectrum, f32) {
        if self.is_delta() {
            return (Spectrum::BLACK, 0.0);
        }
        let side = 1.0_f32.copysign(wo.z);
        let (wo, wi) = (self.by_facets(wo, side), self.by_facets(wi, side));
        if self.compensation {
            self.eval_pdf_compensated(wo, wi)
        } else {
            self.weight_pdf(wo, wi).map_or((Spectrum::BLACK, 0.0), |(weight, pdf)| (weight * pdf, pdf))
        }
    }

    /// A direction, its weight and its density, for `wo` above the surface.
    #[inline(never)]
    fn sample_compensated(&self, wo: Vec3, uc: f32, u: Vec2) -> Option<(Vec3, Spectrum, f32)> {
        if wo.z <= 0.0 {
            return None;
        }
        let multiple = self.multiple(wo);
        let wi = if uc < 0.5 * multiple.chance {
            cosine_hemisphere(u)
        } else if uc < multiple.chance {
            near_horizon(self.ggx.alpha(), u)
        } else {
            reflect_at(wo, self.ggx.sample(wo, u))
        };
        let (eval, pdf) = self.both(wo, wi, multiple);
        (pdf > 0.0).then(|| (wi, eval * (1.0 / pdf), pdf))
    }

    #[inline(never)]
    fn eval_pdf_compensated(&self, wo: Vec3, wi: Vec3) -> (Spectrum, f32) {
        if wo.z <= 0.0 { (Spectrum::BLACK, 0.0) } else { self.both(wo, wi, self.multiple(wo)) }
    }

    /// What is scattered once and more often, for `wo` above the surface: eval and pdf.
    #[inline]
    fn both(&self, wo: Vec3, wi: Vec3, multiple: Multiple) -> (Spectrum, f32) {
        if wi.z <= 0.0 {
            return (Spectrum::BLACK, 0.0);
        }
        let (weight, pdf) = self.weight_pdf(wo, wi).unwrap_or((Spectrum::BLACK, 0.0));
        let eval = weight * pdf + multiple.scale * (lost(self.ggx, wi) * wi.z);
        let pdf_multiple = 0.5 * wi.z * FRAC_1_PI * (1.0 + horizon_over_cosine(self.ggx.alpha(), wi.z));
        (eval, pdf * (1.0 - multiple.chance) + pdf_multiple * multiple.chance)
    }

    /// The second lobe, for `wo` above the surface.
    #[inline]
    fn multiple(&self, wo: Vec3) -> Multiple {
        let (lost, mean_lost) = (lost(self.ggx, wo), mean_lost(self.ggx));
        let f = self.reflectance.mean().to_rgb();
        let f_ms = f.map(|f| f * f * (1.0 - mean_lost) / (1.0 - f * mean_lost));
        let max = |rgb: [f32; 3]| rgb[0].max(rgb[1]).max(rgb[2]);
        let (once, often) = (max(f) * (1.0 - lost), max(f_ms) * lost);
        // Where nothing is reflected, neither matters.
        let chance = often / (once + often).max(f32::MIN_POSITIVE);
        Multiple { scale: Spectrum::from_rgb(f_ms) * (lost * FRAC_1_PI / mean_lost), chance }
    }

    /// `w` by the facets' axes, seen from above if `side` is 1, from below if it is -1.
    #[inline]
    fn by_facets(&self, w: Vec3, side: f32) -> Vec3 {
        Vec2::new(self.x.x, -self.x.y).rotate(w.truncate()).extend(w.z * side)
    }

    /// The inverse of [`by_facets`](Self::by_facets).
    #[inline]
    fn by_surface(&self, w: Vec3, side: f32) -> Vec3 {
        self.x.rotate(w.truncate()).extend(w.z * side)
    }

    /// eval / pdf and pdf, for `wo` above the surface; none if `wi` is not.
    #[inline]
    fn weight_pdf(&self, wo: Vec3, wi: Vec3) -> Option<(Spectrum, f32)> {
        if wo.z <= 0.0 || wi.z <= 0.0 {
            return None;
        }
        let facet = self.ggx.facet(wo, wi, 1.0)?;
        Some((self.reflectance.at(facet.cos_o.min(1.0)) * self.ggx.g2_over_g1(wo, wi), facet.pdf))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::Bsdf;
    use crate::material::microfacet::upright;
    use crate::sampler::Independent;
    use crate::testing::{Reciprocal, check_lobe};
    use crate::texture::NoTextures;
    use crate::validate::Problem;

    fn gold(roughness: f32) -> Conductor {
        Conductor { metal: Some(NamedMetal::Gold), roughness: roughness.into(), ..Conductor::default() }
    }

    /// Without what goes from facet to facet.
    fn once(metal: Conductor) -> Conductor {
        Conductor { compensation: false, ..metal }
    }

    fn white(roughness: f32) -> Conductor {
        Conductor { reflectance: Some(Rgb::grey(1.0).into()), roughness: roughness.into(), ..Conductor::default() }
    }

    fn direction(degrees: f32) -> Vec3 {
        let (sin, cos) = degrees.to_radians().sin_cos();
        Vec3::new(0.6 * sin, 0.8 * sin, cos)
    }

    /// Mean weight of samples: the share of light from everywhere that is reflected.
    fn albedo(metal: &Conductor, wo: Vec3) -> [f64; 3] {
        const N: u32 = 20_000;
        let mut sum = [0.0; 3];
        for i in 0..N {
            let mut numbers = Independent::new(7, glam::UVec2::ZERO, i);
            let (uc, u) = (numbers.get_1d(), numbers.get_2d());
            let weight = metal.bsdf(&NoTextures).sample(wo, uc, u).map_or(Spectrum::BLACK, |s| s.weight).to_rgb();
            sum.iter_mut().zip(weight).for_each(|(sum, w)| *sum += f64::from(w) / f64::from(N));
        }
        sum
    }

    #[test]
    fn lobe() {
        for roughness in [0.05, 0.3, 1.0] {
            for metal in [once(gold(roughness)), once(white(roughness))] {
                check_lobe(&Bsdf::Conductor(metal.bsdf(&NoTextures)), Reciprocal::Yes).unwrap();
            }
        }
        // Narrow beside wide, the integral of the density would not be found; turned, rounding shows.
        for roughness in [0.3, 1.0] {
            let brushed = Conductor { anisotropy: 0.8, rotation: 30.0, ..white(roughness) };
            for metal in [gold(roughness), white(roughness), once(brushed.clone()), brushed] {
                check_lobe(&Bsdf::Conductor(metal.bsdf(&NoTextures)), Reciprocal::Yes).unwrap();
            }
        }
    }

    /// As the density is that of which samples come, the mean of another density over it is 1; also of smooth metal.
    #[test]
    fn smooth_lobe_has_its_density() {
        const N: u32 = 100_000;
        for (roughness, degrees) in [(0.05, 89.0), (0.1, 88.0), (0.3, 85.0)] {
            let (metal, wo) = (white(roughness).bsdf(&NoTextures), direction(degrees));
            let mean = (0..N).map(|i| {
                let mut numbers = Independent::new(8, glam::UVec2::ZERO, i);
                let (uc, u) = (numbers.get_1d(), numbers.get_2d());
                metal.sample(wo, uc, u).map_or(0.0, |s| {
                    let other = s.wi.z * FRAC_1_PI * 0.5 * (1.0 + horizon_over_cosine(metal.ggx.alpha(), s.wi.z));
                    f64::from(other / s.pdf) / f64::from(N)
                })
            });
            let mean: f64 = mean.sum();
            assert!((mean - 1.0).abs() < 0.1, "{mean} at roughness {roughness}");
        }
    }

    /// The smoother, the nearer to Fresnel's share, on both sides.
    #[test]
    fn smooth_metal_reflects_as_fresnel_says() {
        for degrees in [0.0, 40.0, 70.0] {
            for side in [1.0, -1.0] {
                let wo = upright(direction(degrees), side);
                let fresnel = gold(0.0).bsdf(&NoTextures).reflectance.at(wo.z.abs()).to_rgb();
                let mirror = gold(0.02).bsdf(&NoTextures).sample(wo, 0.0, Vec2::new(0.3, 0.9)).unwrap();
                assert!(mirror.delta && mirror.wi == reflect(wo) && mirror.weight.to_rgb() == fresnel);
                assert!(
                    gold(0.02).bsdf(&NoTextures).is_delta()
                        && gold(0.02).bsdf(&NoTextures).eval_pdf(wo, mirror.wi).1 == 0.0
                );
                for (a, f) in albedo(&gold(0.06), wo).into_iter().zip(fresnel) {
                    assert!((a - f64::from(f)).abs() < 1e-3, "{a}, not {f}, at {degrees} degrees");
                }
            }
        }
    }

    /// Highlights are long in the direction that `rotation` says, and only there.
    #[test]
    fn brushed_metal_has_a_direction() {
        let spread = |anisotropy, rotation| {
            let metal = Conductor { anisotropy, rotation, ..white(0.3) };
            let mut mean = Vec2::ZERO;
            for i in 0..4000 {
                let u = Independent::new(3, glam::UVec2::ZERO, i).get_2d();
                if let Some(s) = once(metal.clone()).bsdf(&NoTextures).sample(Vec3::Z, 0.0, u) {
                    mean += (s.wi.truncate() * s.wi.truncate()) / 4000.0;
                }
            }
            mean
        };
        let (round, along, across) = (spread(0.0, 0.0), spread(0.8, 0.0), spread(0.8, -90.0));
        assert!((round.x / round.y - 1.0).abs() < 0.1, "{round}");
        assert!(along.x > 6.0 * along.y && (across.y / along.x - 1.0).abs() < 0.1, "{along}, {across}");
        // The azimuth of what an oblique view reflects lies in the turned direction, too.
        let metal = Conductor { anisotropy: 0.8, rotation: 40.0, ..white(0.3) };
        let at = |degrees: f32| {
            let (sin, cos) = degrees.to_radians().sin_cos();
            metal.bsdf(&NoTextures).eval_pdf(Vec3::Z, Vec3::new(0.3 * cos, 0.3 * sin, 0.91_f32.sqrt())).1
        };
        assert!(at(40.0) > 3.0 * at(130.0) && (at(40.0) / at(220.0) - 1.0).abs() < 1e-5);
    }

    /// Straight down on roughness 1: D = 1 / π and wi = 2θ from the axis, so the albedo is an integral over cos θᵢ
    /// alone: ∫ G₂ / (4 cos θₒ) D 2π d(cos θᵢ) with G₂ = 2 cos / (1 + cos).
    #[test]
    fn rough_metal_loses_what_the_integral_says() {
        const N: u32 = 1000;
        let exact = 1.0 - std::f64::consts::LN_2;
        let midpoints: f64 = (0..N)
            .map(|i| (f64::from(i) + 0.5) / f64::from(N))
            .map(|cos| {
                let wi = Vec3::new((1.0 - cos * cos).sqrt() as f32, 0.0, cos as f32);
                f64::from(once(white(1.0)).bsdf(&NoTextures).eval_pdf(Vec3::Z, wi).0.to_rgb()[0])
                    * std::f64::consts::TAU
                    / f64::from(N)
            })
            .sum();
        assert!((midpoints - exact).abs() < 1e-5, "{midpoints}, not {exact}");
        let [mean, ..] = albedo(&once(white(1.0)), Vec3::Z);
        assert!((mean - exact).abs() < 0.01, "{mean}, not {exact}");
    }

    /// Finite up to the horizon and at directions that are no directions of light.
    #[test]
    fn grazing_light_is_finite() {
        for roughness in [0.0, 0.0224, 0.05, 0.5, 1.0] {
            for metal in [gold(roughness), once(gold(roughness)), white(roughness)] {
                let most = if metal.compensation { 16.0 } else { 1.0 };
                let metal = metal.bsdf(&NoTextures);
                for z in [0.0_f32, -0.0, 1e-42, 1e-30, 1e-20, -1e-10, 1e-5] {
                    let wo = Vec3::new(1.0, 0.0, z);
                    for u in
                        [Vec2::ZERO, Vec2::new(0.5, 0.0), Vec2::new(0.3, 1.0 - f32::EPSILON / 2.0), Vec2::splat(0.4)]
                    {
                        if let Some(s) = metal.sample(wo, u.x, u) {
                            assert!(s.weight.to_rgb().iter().all(|w| (0.0..=most).contains(w)), "{s:?}");
                            assert!(s.pdf.is_finite() && s.pdf >= 0.0 && s.wi.is_finite(), "{s:?}");
                        }
                    }
                    for wi in [Vec3::new(-1.0, 0.0, z), wo, -wo, Vec3::Z, Vec3::X, Vec3::new(-1.0, 0.0, 1e-25)] {
                        let (eval, pdf) = metal.eval_pdf(wo, wi);
                        assert!(
                            eval.to_rgb().iter().all(|e| e.is_finite() && *e >= 0.0) && pdf.is_finite() && pdf >= 0.0
                        );
                    }
                }
            }
        }
    }

    #[test]
    fn contradictions_are_problems() {
        let problems = |metal: Conductor| {
            let mut c = Checker::default();
            metal.check(&mut c);
            c.into_problems().into_iter().map(|Problem { path, .. }| path.join(".")).collect::<Vec<_>>()
        };
        assert!(problems(gold(0.5)).is_empty() && problems(white(0.5)).is_empty());
        assert!(problems(Conductor::default()).is_empty());
        let index = |eta: f32, k: f32| Conductor {
            eta: Some(Rgb([eta, 1.0, 1.0])),
            k: Some(Rgb([k, 1.0, 1.0])),
            ..Conductor::default()
        };
        assert!(problems(index(1.0, 1.0)).is_empty());
        assert_eq!(problems(Conductor { k: None, ..index(1.0, 1.0) }), ["eta"]);
        assert_eq!(problems(Conductor { eta: None, ..index(1.0, 1.0) }), ["k"]);
        assert_eq!(
            problems(Conductor { reflectance: Some(Rgb::grey(0.5).into()), ..index(1.0, 1.0) }),
            ["reflectance"]
        );
        assert_eq!(problems(Conductor { metal: Some(NamedMetal::Iron), ..index(1.0, 1.0) }), ["eta"]);
        assert_eq!(problems(Conductor { metal: Some(NamedMetal::Iron), ..white(0.0) }), ["reflectance"]);
        assert_eq!(problems(index(0.0, 1.0)), ["eta"]);
        assert_eq!(problems(Conductor { roughness: 1.5.into(), ..index(1.0, f32::NAN) }), ["roughness", "k"]);
        assert_eq!(problems(Conductor { reflectance: Some(Rgb::grey(1.5).into()), ..white(0.5) }), ["reflectance"]);
    }
}
