//! Plastic: something matte under a clear coat, such as glossy paint, varnished wood, ceramics and billiard balls.
//!
//! The coat's facets (see [`Ggx`](crate::material::Ggx)) reflect by Fresnel's equations, or as a mirror if they are smooth; what
//! they let in is scattered by a lambertian base and leaves through the coat, or is reflected back to the base, as often as it takes:
//!
//! f = F D G₂ / (4 cos θₒ cos θᵢ) + ρ′ / π · (1 − E(wo)) (1 − E(wi)) / (1 − Ē), ρ′ = ρ (1 − K) / (1 − ρ K),
//!
//! where E is the share that the coat reflects of the light from a direction (see `reflected.rs`), Ē its mean, and K the mean
//! share that it reflects back inside, with eta² (1 − K) = 1 − Ē. So a white base loses nothing at any roughness, and
//! colours get deeper by what happens below the coat. Reciprocal, and the same on both sides.
//!
//! The base under the coat: Kelemen & Szirmay-Kalos 2001, doi:10.2312/egs.20011026; light back and forth inside: Saunderson
//! 1942, doi:10.1364/JOSA.32.000727, as Mitsuba's `plastic` has it. The coat gets samples by its share of the light.
//!
//! ```toml
//! [material.ball.plastic]
//! albedo = [0.7, 0.05, 0.03]
//!
//! [material.table.plastic]
//! albedo = "#8a5a33"
//! eta = 1.45
//! roughness = 0.35
//! ```

use std::f32::consts::FRAC_1_PI;

use glam::{Vec2, Vec3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::color::{Rgb, Spectrum};
use crate::material::BsdfSample;
use crate::material::microfacet::{reflect_at, upright};
use crate::material::reflected::Boundary;
use crate::math::reflect;
use crate::sampling::cosine_hemisphere;
use crate::texture::{Color, Scalar, Textures};
use crate::validate::Checker;

/// Matte under a clear coat.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Plastic {
    /// Share of the light that the base does not absorb each time that it is scattered, 0..1 in each channel.
    pub albedo: Color,
    /// Index of refraction of the coat, 1..3; 1 is no coat.
    #[schemars(range(min = 1.0, max = 3.0))]
    pub eta: f32,
    /// Of the coat: 0 is polished, 1 completely rough; alpha is its square. Below 0.022 it is a perfect mirror.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub roughness: Scalar,
}

impl Default for Plastic {
    fn default() -> Self {
        Self { albedo: Rgb::grey(0.5).into(), eta: 1.5, roughness: 0.0.into() }
    }
}

impl Plastic {
    pub(crate) fn check(&self, c: &mut Checker) {
        self.albedo.check_share("albedo", c);
        c.in_range("eta", self.eta, 1.0, Boundary::MAX_ETA);
        self.roughness.check_range("roughness", 0.0, 1.0, c);
    }

    #[inline]
    pub(crate) fn bsdf(&self, textures: &impl Textures) -> PlasticBsdf {
        let albedo = Rgb(self.albedo.share_at(textures).to_rgb());
        let roughness = self.roughness.at(textures, 0.0, 1.0);
        PlasticBsdf { albedo, coat: Boundary::new(roughness * roughness, self.eta) }
    }
}

/// The lobe of [`Plastic`].
#[derive(Clone, Copy, Debug)]
pub struct PlasticBsdf {
    albedo: Rgb,
    coat: Boundary,
}

impl PlasticBsdf {
    #[inline(never)]
    pub(crate) fn sample(&self, wo: Vec3, uc: f32, u: Vec2) -> Option<BsdfSample> {
        let side = 1.0_f32.copysign(wo.z);
        let up = upright(wo, side);
        let chance = self.chance_of_coat(up.z);
        let wi = if uc >= chance {
            cosine_hemisphere(u)
        } else if self.coat.is_smooth() {
            let weight = Spectrum::ONE * (self.coat.fresnel(up.z) / chance);
            return Some(BsdfSample { wi: reflect(wo), weight, pdf: chance, delta: true, eta: 1.0 });
        } else {
            reflect_at(up, self.coat.ggx().sample(up, u))
        };
        BsdfSample::of_eval(upright(wi, side), self.eval_pdf_above(up, wi))
    }

    #[inline(never)]
    pub(crate) fn eval_pdf(&self, wo: Vec3, wi: Vec3) -> (Spectrum, f32) {
        let side = 1.0_f32.copysign(wo.z);
        self.eval_pdf_above(upright(wo, side), upright(wi, side))
    }

    /// For directions above the surface; without what a smooth coat reflects.
    fn eval_pdf_above(&self, wo: Vec3, wi: Vec3) -> (Spectrum, f32) {
        if wo.z <= 0.0 || wi.z <= 0.0 {
            return (Spectrum::BLACK, 0.0);
        }
        let chance = self.chance_of_coat(wo.z);
        let (by_coat, pdf) = self.coat_eval_pdf(wo, wi);
        let base = self.saturated() * (self.base(wo.z, wi.z) * wi.z);
        (Spectrum::ONE * by_coat + base, pdf * chance + wi.z * FRAC_1_PI * (1.0 - chance))
    }

    /// What facets of the coat reflect, times cos θᵢ, and the density with which they are drawn.
    fn coat_eval_pdf(&self, wo: Vec3, wi: Vec3) -> (f32, f32) {
        let ggx = self.coat.ggx();
        let facet = if self.coat.is_smooth() { None } else { ggx.facet(wo, wi, 1.0) };
        facet.map_or((0.0, 0.0), |facet| {
            (self.coat.fresnel(facet.cos_o) * ggx.g2_over_g1(wo, wi) * facet.pdf, facet.pdf)
        })
    }

    /// The BRDF of the base over ρ′.
    fn base(&self, cos_o: f32, cos_i: f32) -> f32 {
        let through = |cos| 1.0 - self.coat.share(cos);
        FRAC_1_PI * through(cos_o) * through(cos_i) / (1.0 - self.coat.mean_share())
    }

    /// ρ′.
    fn saturated(&self) -> Spectrum {
        let inside = self.coat.mean_share_inside();
        Spectrum::from_rgb(self.albedo.0.map(|rho| rho * (1.0 - inside) / (1.0 - rho * inside)))
    }

    /// The coat's part of the light that is scattered.
    fn chance_of_coat(&self, cos: f32) -> f32 {
        let share = self.coat.share(cos);
        let all = share + (1.0 - share) * self.saturated().max_component();
        if share > 0.0 { share / all } else { 0.0 }
    }

    /// The share of light from straight above that is scattered.
    pub(crate) fn albedo(&self) -> Spectrum {
        let share = self.coat.share(1.0);
        Spectrum::ONE * share + self.saturated() * (1.0 - share)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::Bsdf;
    use crate::testing::{Reciprocal, check_lobe};
    use crate::texture::NoTextures;

    fn plastic(albedo: [f32; 3], eta: f32, roughness: f32) -> PlasticBsdf {
        Plastic { albedo: Rgb(albedo).into(), eta, roughness: roughness.into() }.bsdf(&NoTextures)
    }

    /// The share of light from a direction of this cosine that is scattered: visible normals for the coat, and midpoints in
    /// √cos θᵢ for the base, which does not depend on the azimuth.
    fn share(bsdf: PlasticBsdf, cos: f32) -> [f64; 3] {
        const N: u16 = 100;
        let midpoint = |i: u16| (f32::from(i) + 0.5) / f32::from(N);
        let wo = Vec3::new((1.0 - cos * cos).sqrt(), 0.0, cos);
        let mut coat = 0.0;
        for (i, j) in (0..N).flat_map(|i| (0..N).map(move |j| (i, j))) {
            let rest = midpoint(j);
            let m = bsdf.coat.ggx().sample(wo, Vec2::new(midpoint(i), 1.0 - rest * rest));
            let wi = reflect_at(wo, m);
            if wi.z > 0.0 {
                let seen = bsdf.coat.ggx().g2_over_g1(wo, wi) * 2.0 * rest;
                coat += f64::from(seen * bsdf.coat.fresnel(wo.dot(m).max(0.0))) / f64::from(N).powi(2);
            }
        }
        if bsdf.coat.is_smooth() {
            coat = f64::from(bsdf.coat.fresnel(cos));
        }
        let ring = |i: u16| {
            let x = midpoint(i);
            f64::from(bsdf.base(cos, x * x) * x * x * 2.0 * x) * std::f64::consts::TAU / f64::from(N)
        };
        let base: f64 = (0..N).map(ring).sum();
        bsdf.saturated().to_rgb().map(|albedo| coat + base * f64::from(albedo))
    }

    #[test]
    fn lobe() {
        for (albedo, eta, roughness) in [
            ([0.7, 0.2, 0.1], 1.5, 0.0),
            ([1.0; 3], 1.5, 0.3),
            ([0.9, 0.5, 0.0], 1.33, 0.6),
            ([0.5; 3], 2.4, 1.0),
            ([0.0; 3], 1.5, 0.2),
            ([0.0; 3], 1.5, 0.0),
            ([0.5; 3], 1.0, 0.5),
        ] {
            check_lobe(&Bsdf::Plastic(plastic(albedo, eta, roughness)), Reciprocal::Yes).unwrap();
        }
    }

    /// A white furnace: nothing is lost, and nothing is won.
    #[test]
    fn white_plastic_keeps_all_light() {
        for eta in [1.1, 1.33, 1.5, 1.9, 3.0] {
            for roughness in [0.0, 0.025, 0.1, 0.22, 0.4, 0.63, 0.85, 1.0] {
                for cos in [1.0, 0.8, 0.5, 0.25, 0.1, 0.04, 0.01, 2e-3] {
                    for share in share(plastic([1.0; 3], eta, roughness), cos) {
                        assert!((share - 1.0).abs() < 5e-3, "{share}: eta {eta}, roughness {roughness}, cosine {cos}");
                    }
                }
            }
        }
    }

    /// Below the coat light meets the base again and again, which makes a colour deeper; and the albedo is what comes from
    /// straight above.
    #[test]
    fn colours_are_deeper_below_a_coat() {
        let [[r, g, _], [bare_r, bare_g, _]] =
            [1.5, 1.0].map(|eta| plastic([0.8, 0.4, 0.1], eta, 0.0).albedo().to_rgb());
        assert!((bare_r - 0.8).abs() < 1e-6 && (bare_g - 0.4).abs() < 1e-6);
        assert!((g - 0.04) / (r - 0.04) < 0.9 * bare_g / bare_r, "{r} {g}");
        for roughness in [0.0, 0.5, 1.0] {
            let bsdf = plastic([0.8, 0.4, 0.1], 1.5, roughness);
            for (exact, albedo) in share(bsdf, 1.0).into_iter().zip(bsdf.albedo().to_rgb()) {
                assert!((exact - f64::from(albedo)).abs() < 2e-3, "{albedo}, not {exact}");
            }
        }
    }

    #[test]
    fn grazing_light_is_finite() {
        for (eta, roughness) in [(1.0, 0.0), (1.5, 0.0), (1.0, 1.0), (1.5, 0.03), (3.0, 0.5), (1.001, 1.0)] {
            for albedo in [0.0, 0.5, 1.0] {
                let bsdf = plastic([albedo; 3], eta, roughness);
                for z in [0.0_f32, -0.0, 1e-42, 1e-30, -1e-20, 1e-10, -1e-5, 0.3, 1.0] {
                    let wo = Vec3::new((1.0 - z * z).sqrt(), 0.0, z);
                    for (uc, u) in [(0.0, Vec2::ZERO), (0.999, Vec2::new(0.5, 0.0)), (0.5, Vec2::new(0.5, 0.3))] {
                        if let Some(s) = bsdf.sample(wo, uc, u) {
                            assert!(s.weight.to_rgb().iter().all(|w| (0.0..4.0).contains(w)) && s.pdf > 0.0, "{s:?}");
                        }
                    }
                    for wi in [Vec3::new(-1.0, 0.0, z), wo, -wo, Vec3::Z, Vec3::X, Vec3::new(-1.0, 0.0, 1e-25)] {
                        let (eval, pdf) = bsdf.eval_pdf(wo, wi);
                        assert!(eval.to_rgb().iter().all(|e| e.is_finite() && *e >= 0.0) && pdf.is_finite());
                    }
                }
            }
        }
    }

    /// The table of docs/theory/microfacets.md: the share of the light, in percent, that the coat of plastic reflects, and that
    /// plastic with a white base scatters.
    #[test]
    fn documented_shares() {
        let mut table =
            String::from("| roughness of the coat | 0° | 30° | 60° | 80° | 89° |\n|---|---|---|---|---|---|\n");
        for roughness in [0.0, 0.2, 0.4, 0.6, 0.8, 1.0] {
            let shares = [0.0_f32, 30.0, 60.0, 80.0, 89.0].map(|degrees| {
                let [coat, all] = [0.0, 1.0]
                    .map(|white| 100.0 * share(plastic([white; 3], 1.5, roughness), degrees.to_radians().cos())[0]);
                format!("{coat:.0} → {all:.0}")
            });
            table += &format!("| {roughness:.1} | {} |\n", shares.join(" | "));
        }
        let page = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/theory/microfacets.md");
        let text = std::fs::read_to_string(page).unwrap();
        assert!(text.contains(&table), "the table of {page} should be\n\n{table}");
    }
}
