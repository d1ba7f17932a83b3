//! Conductor: metal, from polished to dull.
//!
//! Facets (see [`Ggx`]) that reflect by Fresnel's equations for metals, from measured indices of refraction, or the
//! same share at all angles:
//!
//! f = F D G₂ / (4 cos θₒ cos θᵢ).
//!
//! Visible normals are drawn, so a sample weighs F G₂ / G₁. Cook & Torrance 1982, doi:10.1145/357290.357293; Walter et
//! al. 2007, doi:10.2312/EGWR/EGSR07/195-206. The facets' alpha is roughness². Reciprocal, and the same on both sides.
//!
//! What is reflected from facet to facet is lost: straight on, 1 % of the light at roughness 0.3, 9 % at 0.5, 18 % at
//! 0.6, 69 % at 1.
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

use glam::{Vec2, Vec3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::color::{Rgb, Spectrum};
use crate::material::BsdfSample;
use crate::material::fresnel::fresnel_conductor;
use crate::material::metals::NamedMetal;
use crate::material::microfacet::{Ggx, reflect_at};
use crate::math::{reflect, sin_cos_turns};
use crate::validate::Checker;

/// Metal of facets: `metal`, or `eta` and `k`, or `reflectance`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
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
    pub reflectance: Option<Rgb>,
    /// 0 is a mirror, 1 completely rough; alpha is its square. Below 0.022 it is a perfect mirror.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub roughness: f32,
    /// Highlights of brushed metal are long in one direction, the more so the nearer this is to 1: along it alpha is divided
    /// by √(1 − 0.9 anisotropy), across it multiplied. 0 is the same all around.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub anisotropy: f32,
    /// Turns that direction about the normal, counter-clockwise as seen from outside, degrees, -360..360. At 0 it is the x
    /// axis of the surface's frame, which follows from the normal alone.
    #[schemars(range(min = -360.0, max = 360.0))]
    pub rotation: f32,
}

impl Conductor {
    const DEFAULT_REFLECTANCE: Rgb = Rgb::grey(0.9);

    pub(crate) fn check(&self, c: &mut Checker) {
        c.in_range("roughness", self.roughness, 0.0, 1.0);
        c.in_range("anisotropy", self.anisotropy, 0.0, 1.0);
        c.in_range("rotation", self.rotation, -360.0, 360.0);
        for (key, value, lo) in [("eta", self.eta, 0.01), ("k", self.k, 0.0)] {
            let outside = |channel: &f32| !(lo..=100.0).contains(channel);
            if let Some(&bad) = value.as_ref().and_then(|rgb| rgb.0.iter().find(|channel| outside(channel))) {
                c.in_range(key, bad, lo, 100.0);
            }
        }
        if let Some(reflectance) = self.reflectance {
            c.albedo("reflectance", reflectance);
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
    pub(crate) fn bsdf(&self) -> ConductorBsdf {
        let reflectance = match (self.metal.map(NamedMetal::eta_k), self.eta, self.k) {
            (Some((eta, k)), ..) | (None, Some(eta), Some(k)) => Reflectance::Fresnel { eta, k },
            _ => Reflectance::Constant(self.reflectance.unwrap_or(Self::DEFAULT_REFLECTANCE)),
        };
        let mut facets = ConductorBsdf { reflectance, ggx: Ggx::from_roughness(self.roughness), x: Vec2::X };
        if self.anisotropy > 0.0 {
            facets.ggx = facets.ggx.stretched(self.anisotropy);
            let (sin, cos) = sin_cos_turns(self.rotation / 360.0);
            facets.x = Vec2::new(cos, sin);
        }
        facets
    }
}

/// What a facet reflects.
#[derive(Clone, Copy, Debug)]
enum Reflectance {
    Constant(Rgb),
    Fresnel { eta: Rgb, k: Rgb },
}

impl Reflectance {
    #[inline]
    fn at(self, cos: f32) -> Spectrum {
        match self {
            Self::Constant(reflectance) => reflectance.into(),
            Self::Fresnel { eta, k } => {
                Spectrum::from_rgb(std::array::from_fn(|i| fresnel_conductor(cos, eta.0[i], k.0[i])))
            }
        }
    }
}

/// The lobe of [`Conductor`].
#[derive(Clone, Copy, Debug)]
pub struct ConductorBsdf {
    reflectance: Reflectance,
    ggx: Ggx,
    /// The facets' x axis in the surface's frame.
    x: Vec2,
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
    pub(crate) fn sample(&self, wo: Vec3, u: Vec2) -> Option<BsdfSample> {
        if self.is_delta() {
            let weight = self.reflectance.at(wo.z.abs());
            return Some(BsdfSample { wi: reflect(wo), weight, pdf: 1.0, delta: true, eta: 1.0 });
        }
        let side = 1.0_f32.copysign(wo.z);
        let up = self.to_facets(wo, side);
        let wi = reflect_at(up, self.ggx.sample(up, u));
        let (weight, pdf) = self.weight_pdf(up, wi)?;
        Some(BsdfSample { wi: self.from_facets(wi, side), weight, pdf, delta: false, eta: 1.0 })
    }

    #[inline]
    pub(crate) fn eval_pdf(&self, wo: Vec3, wi: Vec3) -> (Spectrum, f32) {
        let side = 1.0_f32.copysign(wo.z);
        match self.weight_pdf(self.to_facets(wo, side), self.to_facets(wi, side)) {
            Some((weight, pdf)) if !self.is_delta() => (weight * pdf, pdf),
            _ => (Spectrum::BLACK, 0.0),
        }
    }

    /// `w` by the facets' axes, seen from above if `side` is 1, from below if it is -1.
    #[inline]
    fn to_facets(&self, w: Vec3, side: f32) -> Vec3 {
        Vec2::new(self.x.x, -self.x.y).rotate(w.truncate()).extend(w.z * side)
    }

    /// The inverse of [`to_facets`](Self::to_facets).
    #[inline]
    fn from_facets(&self, w: Vec3, side: f32) -> Vec3 {
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
    use crate::validate::Problem;

    fn gold(roughness: f32) -> Conductor {
        Conductor { metal: Some(NamedMetal::Gold), roughness, ..Conductor::default() }
    }

    fn white(roughness: f32) -> Conductor {
        Conductor { reflectance: Some(Rgb::grey(1.0)), roughness, ..Conductor::default() }
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
            let u = Independent::new(7, glam::UVec2::ZERO, i).get_2d();
            let weight = metal.bsdf().sample(wo, u).map_or(Spectrum::BLACK, |s| s.weight).to_rgb();
            sum.iter_mut().zip(weight).for_each(|(sum, w)| *sum += f64::from(w) / f64::from(N));
        }
        sum
    }

    #[test]
    fn lobe() {
        for roughness in [0.05, 0.3, 1.0] {
            let brushed = Conductor { anisotropy: 0.8, rotation: 30.0, ..white(roughness) };
            for metal in [gold(roughness), white(roughness), brushed] {
                check_lobe(&Bsdf::Conductor(metal.bsdf()), Reciprocal::Yes).unwrap();
            }
        }
    }

    /// The smoother, the nearer to Fresnel's share, on both sides.
    #[test]
    fn smooth_metal_reflects_as_fresnel_says() {
        for degrees in [0.0, 40.0, 70.0] {
            for side in [1.0, -1.0] {
                let wo = upright(direction(degrees), side);
                let fresnel = gold(0.0).bsdf().reflectance.at(wo.z.abs()).to_rgb();
                let mirror = gold(0.02).bsdf().sample(wo, Vec2::new(0.3, 0.9)).unwrap();
                assert!(mirror.delta && mirror.wi == reflect(wo) && mirror.weight.to_rgb() == fresnel);
                assert!(gold(0.02).bsdf().is_delta() && gold(0.02).bsdf().eval_pdf(wo, mirror.wi).1 == 0.0);
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
                if let Some(s) = metal.bsdf().sample(Vec3::Z, u) {
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
            metal.bsdf().eval_pdf(Vec3::Z, Vec3::new(0.3 * cos, 0.3 * sin, 0.91_f32.sqrt())).1
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
                f64::from(white(1.0).bsdf().eval_pdf(Vec3::Z, wi).0.to_rgb()[0]) * std::f64::consts::TAU / f64::from(N)
            })
            .sum();
        assert!((midpoints - exact).abs() < 1e-5, "{midpoints}, not {exact}");
        let [mean, ..] = albedo(&white(1.0), Vec3::Z);
        assert!((mean - exact).abs() < 0.01, "{mean}, not {exact}");
    }

    /// Finite up to the horizon and at directions that are no directions of light.
    #[test]
    fn grazing_light_is_finite() {
        for roughness in [0.0, 0.0224, 0.05, 0.5, 1.0] {
            for metal in [gold(roughness).bsdf(), white(roughness).bsdf()] {
                for z in [0.0_f32, -0.0, 1e-42, 1e-30, 1e-20, -1e-10, 1e-5] {
                    let wo = Vec3::new(1.0, 0.0, z);
                    for u in
                        [Vec2::ZERO, Vec2::new(0.5, 0.0), Vec2::new(0.3, 1.0 - f32::EPSILON / 2.0), Vec2::splat(0.4)]
                    {
                        if let Some(s) = metal.sample(wo, u) {
                            assert!(s.weight.to_rgb().iter().all(|w| (0.0..=1.0).contains(w)), "{s:?}");
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
        assert_eq!(problems(Conductor { reflectance: Some(Rgb::grey(0.5)), ..index(1.0, 1.0) }), ["reflectance"]);
        assert_eq!(problems(Conductor { metal: Some(NamedMetal::Iron), ..index(1.0, 1.0) }), ["eta"]);
        assert_eq!(problems(Conductor { metal: Some(NamedMetal::Iron), ..white(0.0) }), ["reflectance"]);
        assert_eq!(problems(index(0.0, 1.0)), ["eta"]);
        assert_eq!(problems(Conductor { roughness: 1.5, ..index(1.0, f32::NAN) }), ["roughness", "k"]);
        assert_eq!(problems(Conductor { reflectance: Some(Rgb::grey(1.5)), ..white(0.5) }), ["reflectance"]);
    }
}
