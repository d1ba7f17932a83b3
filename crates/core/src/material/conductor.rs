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
//! A thin film, such as oxide, changes what each facet reflects (see [`ThinFilm`]).
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
//!
//! [material.tempered.conductor]
//! metal = "iron"
//! roughness = 0.3
//! thin_film = { thickness = 50, eta = 2.4 }
//! ```

use std::f32::consts::FRAC_1_PI;

use glam::{Vec2, Vec3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::color::{Rgb, Spectrum};
use crate::material::fresnel::Reflectance;
use crate::material::lost::{horizon_over_cosine, lost, mean_lost, near_horizon};
use crate::material::metals::NamedMetal;
use crate::material::microfacet::{Ggx, reflect_at};
use crate::material::{BsdfSample, ThinFilm};
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
    /// A film on it; none if nothing is said.
    pub thin_film: Option<ThinFilm>,
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
            thin_film: None,
        }
    }
}

impl Conductor {
    const DEFAULT_REFLECTANCE: Rgb = Rgb::grey(0.9);

    pub(crate) fn check(&self, c: &mut Checker) {
        self.roughness.check_range("roughness", 0.0, 1.0, c);
        if let Some(film) = self.thin_film {
            c.within("thin_film", |c| film.check(c));
        }
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
        let film = self.thin_film.unwrap_or(ThinFilm::NONE);
        let mut facets = ConductorBsdf { reflectance, film, ggx, x: Vec2::X, compensation };
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
    film: ThinFilm,
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
        self.facet_reflectance(1.0)
    }

    #[inline]
    pub(crate) fn is_delta(&self) -> bool {
        self.ggx.alpha() < Ggx::MIN_ALPHA
    }

    #[inline]
    pub(crate) fn sample(&self, wo: Vec3, uc: f32, u: Vec2) -> Option<BsdfSample> {
        if self.is_delta() {
            let weight = self.facet_reflectance(wo.z.abs());
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
        let f = self.mean_reflectance().to_rgb();
        let f_ms = f.map(|f| f * f * (1.0 - mean_lost) / (1.0 - f * mean_lost));
        let max = |rgb: [f32; 3]| rgb[0].max(rgb[1]).max(rgb[2]);
        let (once, often) = (max(f) * (1.0 - lost), max(f_ms) * lost);
        // Where nothing is reflected, neither matters.
        let chance = often / (once + often).max(f32::MIN_POSITIVE);
        Multiple { scale: Spectrum::from_rgb(f_ms) * (lost * FRAC_1_PI / mean_lost), chance }
    }

    /// What a facet reflects.
    #[inline]
    fn facet_reflectance(&self, cos: f32) -> Spectrum {
        if self.film.is_there() { self.reflectance_of_film(cos) } else { self.reflectance.at(cos) }
    }

    #[inline(never)]
    fn reflectance_of_film(&self, cos: f32) -> Spectrum {
        match self.reflectance {
            Reflectance::Constant(share) => self.film.on_mirror(cos, share.into()),
            Reflectance::Fresnel { eta, k } => self.film.on_metal(cos, eta, k),
        }
    }

    /// The mean of it over an evenly lit surface.
    fn mean_reflectance(&self) -> Spectrum {
        if self.film.is_there() {
            Reflectance::mean_of(|cos| self.reflectance_of_film(cos))
        } else {
            self.reflectance.mean()
        }
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
        Some((self.facet_reflectance(facet.cos_o.min(1.0)) * self.ggx.g2_over_g1(wo, wi), facet.pdf))
    }
}

#[cfg(test)]
mod tests;
