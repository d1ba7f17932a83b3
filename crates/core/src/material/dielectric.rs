//! Dielectric: glass, water, diamond, smooth or frosted.
//!
//! Light is either reflected, with the chance that Fresnel's equations give for unpolarised light, or refracted by
//! Snell's law; past the critical angle all of it is reflected. Refracted radiance is divided by eta², as it spreads
//! over another solid angle (Veach 1997, Robust Monte Carlo Methods, §5.2); entering and leaving cancel.
//!
//! A rough one does so at facets (see [`Ggx`]) of alpha = roughness². With h = wo + eta wi along the facet's normal m,
//!
//! f cos θᵢ = R D G₂ / (4 cos θₒ) for reflection, f cos θᵢ = (1 − R) D G₁(wo) G₁(wi) |wo · m| |wi · m| / (cos θₒ |h|²)
//! for refraction.
//!
//! Visible normals are drawn, so samples weigh G₂ / G₁(wo) and G₁(wi) / eta². Walter et al. 2007,
//! doi:10.2312/EGWR/EGSR07/195-206. Light from facet to facet is lost. f(wo, wi) eta² = f(wi, wo), where eta is the
//! index on the side of `wi` over that on the side of `wo`.
//!
//! A thin film, such as soap or oil, changes how much each facet reflects, and the rest goes through (see [`ThinFilm`]). A soap
//! bubble is a ball of eta = 1 with a film.
//!
//! A hollow ball is a ball of glass with a smaller one of eta = 1/1.5 inside.
//!
//! ```toml
//! [material.glass.dielectric]
//! eta = 1.5
//!
//! [material.frosted.dielectric]
//! eta = 1.5
//! roughness = 0.4
//!
//! [material.bubble.dielectric]
//! eta = 1.0
//! thin_film = { thickness = 400, eta = 1.33 }
//!
//! [material.wine.dielectric]
//! eta = 1.34
//! transmittance = [0.6, 0.03, 0.05]
//! transmittance_distance = 0.02
//! priority = 1
//! ```
//!
//! What is inside absorbs light and may overlap other fillings: see [`medium`](crate::medium).

use glam::{Vec2, Vec3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::color::{Rgb, Spectrum};
use crate::material::microfacet::{Ggx, reflect_at, refract_at, upright};
use crate::material::{BsdfSample, Fresnel, ThinFilm};
use crate::math::{reflect, refract};
use crate::medium::Filling;
use crate::texture::{Scalar, Textures};
use crate::validate::Checker;

/// Clear: reflects and refracts.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Dielectric {
    /// Index of refraction inside over outside, above 0; inside is where the normal points away from. Glass 1.5, water
    /// 1.33, diamond 2.42.
    #[schemars(range(min = 0.01, max = 100.0))]
    pub eta: f32,
    /// Abbe's number, 1..10000: how little the index changes with the colour of light. `eta` is that at 587.56 nm. Crown glass 60, flint
    /// glass 30, diamond 55; the same index for all if nothing is said.
    #[schemars(range(min = 1.0, max = 10_000.0))]
    pub abbe_number: Option<f32>,
    /// 0 is polished, 1 completely rough; alpha is its square. It is polished, too, where it would blur by less than
    /// 0.03 degrees: for glass below 0.04.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub roughness: Scalar,
    /// A film on its outside; none if nothing is said.
    pub thin_film: Option<ThinFilm>,
    /// How strongly light is absorbed on its way inside, 1/m, 0..1e6 in each channel; 0 if nothing is said.
    pub absorption: Option<Rgb>,
    /// The colour of white light after `transmittance_distance` inside, 0..1 in each channel: another way to say absorption.
    pub transmittance: Option<Rgb>,
    /// That distance, metres, above 0.
    #[schemars(range(min = 0.0))]
    pub transmittance_distance: f32,
    /// Where filled shapes overlap, the one of the higher priority is there, 0..1000. Above 0, `eta` is the index itself, not that over
    /// what is around; at 0 the shape takes no part in this.
    #[schemars(range(max = 1000))]
    pub priority: u32,
}

impl Default for Dielectric {
    fn default() -> Self {
        Self {
            eta: 1.5,
            abbe_number: None,
            roughness: 0.0.into(),
            absorption: None,
            transmittance: None,
            transmittance_distance: 1.0,
            priority: 0,
            thin_film: None,
        }
    }
}

impl Dielectric {
    pub(crate) fn check(&self, c: &mut Checker) {
        c.in_range("eta", self.eta, 0.01, 100.0);
        c.in_range("abbe_number", self.abbe_number.unwrap_or(1.0), 1.0, 1e4);
        self.roughness.check_range("roughness", 0.0, 1.0, c);
        if let Some(film) = self.thin_film {
            c.within("thin_film", |c| film.check(c));
        }
        for (key, value, hi) in
            [("absorption", self.absorption, Filling::DARKEST), ("transmittance", self.transmittance, 1.0)]
        {
            if let Some(bad) = value.and_then(|rgb| rgb.0.into_iter().find(|channel| !(0.0..=hi).contains(channel))) {
                c.in_range(key, bad, 0.0, hi);
            }
        }
        if self.absorption.is_some() && self.transmittance.is_some() {
            let hint = "keep one of them".to_owned();
            c.problem("transmittance", "`absorption` and `transmittance` both say what is absorbed", Some(hint));
        }
        c.positive("transmittance_distance", self.transmittance_distance);
        if self.priority > Self::HIGHEST_PRIORITY {
            let message = format!("`priority` must be at most {}, not {}", Self::HIGHEST_PRIORITY, self.priority);
            c.problem("priority", message, None);
        }
    }

    const HIGHEST_PRIORITY: u32 = 1000;

    /// What is inside.
    pub(crate) fn filling(&self) -> Filling {
        let color = self.transmittance.unwrap_or(Rgb::grey(1.0));
        let filling = Filling::of_color(color, self.transmittance_distance, self.eta, self.priority);
        let sigma_a = self.absorption.map_or(filling.sigma_a, |Rgb(absorption)| Spectrum::from_rgb(absorption));
        Filling { sigma_a, dispersion: self.abbe_number.map_or(0.0, f32::recip), ..filling }
    }

    #[inline]
    pub(crate) fn bsdf(&self, textures: &impl Textures) -> DielectricBsdf {
        let ggx = Ggx::from_roughness(self.roughness.at(textures, 0.0, 1.0));
        DielectricBsdf { eta: self.eta, ggx, film: self.thin_film.unwrap_or(ThinFilm::NONE), through: Rgb::grey(1.0) }
    }
}

/// The lobe of [`Dielectric`].
#[derive(Clone, Copy, Debug)]
pub struct DielectricBsdf {
    eta: f32,
    ggx: Ggx,
    film: ThinFilm,
    /// The colour of what goes through.
    through: Rgb,
}

impl DielectricBsdf {
    /// Puts it between other indices.
    pub(crate) fn set_eta(&mut self, eta: f32) {
        self.eta = eta;
    }

    /// Makes it that of one wavelength.
    pub(crate) fn disperse(&mut self, bend: f32, color: Spectrum) {
        self.eta *= bend;
        self.through = Rgb(color.to_rgb());
    }

    /// The refracted lobe is as narrow as the facets' slopes and the bend at each are small.
    #[inline]
    pub(crate) fn is_delta(&self) -> bool {
        self.ggx.alpha() * (self.eta - 1.0).abs() < Ggx::MIN_ALPHA * self.eta.max(1.0)
    }

    /// The index behind the surface over that before it, as seen from `wo`.
    #[inline]
    fn eta_from(&self, wo: Vec3) -> f32 {
        if wo.z > 0.0 { self.eta } else { 1.0 / self.eta }
    }

    #[inline]
    pub(crate) fn sample(&self, wo: Vec3, uc: f32, u: Vec2) -> Option<BsdfSample> {
        let eta = self.eta_from(wo);
        if self.is_delta() { Some(self.sample_smooth(wo, eta, uc)) } else { self.sample_rough(wo, eta, uc, u) }
    }

    #[inline]
    fn sample_smooth(&self, wo: Vec3, eta: f32, uc: f32) -> BsdfSample {
        let cos = wo.z.abs();
        let fresnel = Fresnel::dielectric(cos, eta);
        let split = self.split(cos, fresnel, eta, wo.z > 0.0);
        if uc < split.chance {
            BsdfSample { wi: reflect(wo), weight: split.reflected, pdf: split.chance, delta: true, eta: 1.0 }
        } else {
            let weight = split.refracted * (1.0 / (eta * eta));
            BsdfSample { wi: refract(wo, eta, fresnel.cos_t), weight, pdf: 1.0 - split.chance, delta: true, eta }
        }
    }

    /// How light that meets a facet at a cosine divides.
    #[inline]
    fn split(&self, cos: f32, fresnel: Fresnel, eta: f32, outside: bool) -> Split {
        if self.film.is_there() && fresnel.cos_t > 0.0 {
            let split = Split::by_color(self.film.on_clear([cos, fresnel.cos_t], eta, outside));
            Split { refracted: split.refracted * Spectrum::from(self.through), ..split }
        } else {
            Split { chance: fresnel.reflectance, reflected: Spectrum::ONE, refracted: self.through.into() }
        }
    }

    #[inline]
    fn sample_rough(&self, wo: Vec3, eta: f32, uc: f32, u: Vec2) -> Option<BsdfSample> {
        let side = 1.0_f32.copysign(wo.z);
        let up = upright(wo, side);
        let m = self.ggx.sample(up, u);
        let cos = up.dot(m).clamp(0.0, 1.0);
        let fresnel = Fresnel::dielectric(cos, eta);
        let reflected = uc < self.split(cos, fresnel, eta, side > 0.0).chance;
        let wi = if reflected { reflect_at(up, m) } else { refract_at(up, m, eta, fresnel.cos_t) };
        if reflected != (wi.z > 0.0) {
            return None;
        }
        let (weight, pdf) = self.weight_pdf(up, wi, eta, side > 0.0)?;
        let eta = if reflected { 1.0 } else { eta };
        Some(BsdfSample { wi: upright(wi, side), weight, pdf, delta: false, eta })
    }

    #[inline]
    pub(crate) fn eval_pdf(&self, wo: Vec3, wi: Vec3) -> (Spectrum, f32) {
        let side = 1.0_f32.copysign(wo.z);
        if self.is_delta() {
            return (Spectrum::BLACK, 0.0);
        }
        let (up, eta) = (upright(wo, side), self.eta_from(wo));
        self.weight_pdf(up, upright(wi, side), eta, side > 0.0)
            .map_or((Spectrum::BLACK, 0.0), |(weight, pdf)| (weight * pdf, pdf))
    }

    /// eval / pdf and pdf, for `wo` above the surface, of a rough one; none if no light goes that way.
    #[inline]
    fn weight_pdf(&self, wo: Vec3, wi: Vec3, eta: f32, outside: bool) -> Option<(Spectrum, f32)> {
        if wo.z <= 0.0 || wi.z == 0.0 {
            return None;
        }
        let reflected = wi.z > 0.0;
        let facet = self.ggx.facet(wo, wi, if reflected { 1.0 } else { eta })?;
        let cos = facet.cos_o.min(1.0);
        let (weight, chance) = if reflected {
            let split = self.split(cos, Fresnel::dielectric(cos, eta), eta, outside);
            (split.reflected * self.ggx.g2_over_g1(wo, wi), split.chance)
        } else {
            let reflectance = Fresnel::between(facet.cos_o, facet.cos_i, eta);
            let split = self.split(cos, Fresnel { reflectance, cos_t: facet.cos_i.min(1.0) }, eta, outside);
            (split.refracted * (self.ggx.g1(wi) / (eta * eta)), 1.0 - split.chance)
        };
        (chance > 0.0).then_some((weight, chance * facet.pdf))
    }
}

/// How light divides at a facet.
#[derive(Clone, Copy, Debug)]
struct Split {
    /// Of reflection.
    chance: f32,
    /// The share that is reflected, over that chance.
    reflected: Spectrum,
    /// The share that goes through, over the other chance.
    refracted: Spectrum,
}

impl Split {
    /// By the share of each channel that is reflected.
    #[inline(never)]
    fn by_color(reflectance: Spectrum) -> Self {
        let rgb = reflectance.to_rgb();
        let chance = (rgb[0] + rgb[1] + rgb[2]) * (1.0 / 3.0);
        let over = |share: f32, chance: f32| share / chance.max(f32::MIN_POSITIVE);
        Self {
            chance,
            reflected: Spectrum::from_rgb(rgb.map(|r| over(r, chance))),
            refracted: Spectrum::from_rgb(rgb.map(|r| over(1.0 - r, 1.0 - chance))),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::Bsdf;
    use crate::testing::{Reciprocal, check_lobe, chi2_counts};
    use crate::texture::NoTextures;

    fn glass(eta: f32, roughness: f32) -> DielectricBsdf {
        Dielectric { eta, roughness: roughness.into(), ..Dielectric::default() }.bsdf(&NoTextures)
    }

    fn direction(degrees: f32) -> Vec3 {
        let (sin, cos) = degrees.to_radians().sin_cos();
        Vec3::new(sin, 0.0, cos)
    }

    /// Reflections and refractions come as often as Fresnel says, in the directions of the mirror and of Snell.
    #[test]
    fn chooses_by_fresnel() {
        const N: u32 = 100_000;
        let glass = Dielectric::default().bsdf(&NoTextures);
        for degrees in [0.0_f32, 30.0, 60.0, 85.0] {
            for side in [1.0, -1.0] {
                let wo = direction(degrees) * Vec3::new(1.0, 1.0, side);
                let eta = if side > 0.0 { 1.5 } else { 1.0 / 1.5 };
                let reflectance = f64::from(Fresnel::dielectric(wo.z.abs(), eta).reflectance);
                let mut counts = [0_u64; 2];
                for i in 0..N {
                    let mut numbers = crate::sampler::Independent::new(3, glam::UVec2::ZERO, i);
                    let sample = glass.sample(wo, numbers.get_1d(), Vec2::ZERO).unwrap();
                    let reflected = sample.wi.z * wo.z > 0.0;
                    counts[usize::from(!reflected)] += 1;
                    assert!((sample.wi.length() - 1.0).abs() < 1e-5 && sample.delta);
                    if reflected {
                        assert_eq!((sample.wi, sample.eta), (reflect(wo), 1.0));
                    } else {
                        assert!((eta * sample.wi.x + wo.x).abs() < 1e-5, "Snell at {degrees} degrees");
                        assert_eq!(sample.eta, eta);
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

    #[test]
    fn lobe() {
        for (eta, roughness) in [(1.5, 0.05), (1.5, 0.3), (1.5, 1.0), (0.4, 0.2), (1.05, 0.6)] {
            check_lobe(&Bsdf::Dielectric(glass(eta, roughness)), Reciprocal::Yes).unwrap();
        }
    }

    /// Of one wavelength.
    #[test]
    fn bends_one_color() {
        let mut lobe = Bsdf::Dielectric(glass(1.5, 0.4));
        lobe.disperse(1.04, Spectrum::from_rgb([0.1, 0.95, 0.45]));
        check_lobe(&lobe, Reciprocal::Yes).unwrap();
        let mut smooth = Bsdf::Dielectric(glass(1.5, 0.0));
        smooth.disperse(1.04, Spectrum::from_rgb([0.1, 0.95, 0.45]));
        let [reflected, through] =
            [0.0, 1.0 - f32::EPSILON].map(|uc| smooth.sample(direction(40.0), uc, Vec2::ZERO).unwrap());
        assert_eq!((reflected.weight, through.eta), (Spectrum::ONE, 1.5 * 1.04));
        let rgb = through.weight.to_rgb();
        assert!((rgb[1] / rgb[0] - 9.5).abs() < 1e-4 && (rgb[1] / rgb[2] - 0.95 / 0.45).abs() < 1e-4, "{rgb:?}");
    }

    /// With a film, all light goes somewhere, as much of each colour either way through a facet; and the colours differ.
    #[test]
    fn film() {
        let thin_film = Some(ThinFilm { thickness: 450.0, eta: 1.7 });
        for (eta, roughness) in [(1.5, 0.3), (1.5, 0.6), (0.7, 0.4)] {
            let glass =
                Dielectric { eta, roughness: roughness.into(), thin_film, ..Dielectric::default() }.bsdf(&NoTextures);
            check_lobe(&Bsdf::Dielectric(glass), Reciprocal::Yes).unwrap();
        }
        let glass = |eta| Dielectric { eta, thin_film, ..Dielectric::default() }.bsdf(&NoTextures);
        for (eta, degrees, side) in [(1.5, 0.0, 1.0), (1.5, 60.0, 1.0), (1.5, 35.0, -1.0), (1.0, 45.0, 1.0)] {
            let (wo, lobe) = (direction(degrees) * Vec3::new(1.0, 1.0, side), glass(eta));
            let [reflection, refraction] = [0.0, 1.0 - f32::EPSILON].map(|uc| lobe.sample(wo, uc, Vec2::ZERO).unwrap());
            let parts = [reflection, refraction].map(|s| (s.weight * (s.pdf * s.eta * s.eta)).to_rgb());
            let back = lobe.sample(refraction.wi, 0.0, Vec2::ZERO).unwrap();
            let back = (back.weight * back.pdf).to_rgb();
            assert!(reflection.wi.z * wo.z > 0.0 && refraction.wi.z * wo.z < 0.0);
            for i in 0..3 {
                assert!((parts[0][i] + parts[1][i] - 1.0).abs() < 1e-5, "{parts:?}");
                assert!((parts[0][i] - back[i]).abs() < 1e-4, "{parts:?} {back:?}");
            }
            let [r, g, b] = parts[0];
            assert!(r.max(g).max(b) > 1.2 * r.min(g).min(b), "{parts:?}");
        }
    }

    /// Shares of energy that are reflected and that go through.
    fn energy(glass: DielectricBsdf, wo: Vec3) -> [f64; 2] {
        const N: u32 = 20_000;
        let mut shares = [0.0; 2];
        for i in 0..N {
            let mut numbers = crate::sampler::Independent::new(4, glam::UVec2::ZERO, i);
            if let Some(s) = glass.sample(wo, numbers.get_1d(), numbers.get_2d()) {
                let share = s.weight.to_rgb()[0] * s.eta * s.eta;
                shares[usize::from(s.wi.z * wo.z < 0.0)] += f64::from(share) / f64::from(N);
            }
        }
        shares
    }

    /// The smoother, the nearer to Fresnel's shares, and the less is lost; never is any won.
    #[test]
    fn energy_is_kept_or_lost() {
        for (degrees, side) in [0.0, 35.0, 60.0, 80.0].into_iter().flat_map(|d| [(d, 1.0), (d, -1.0)]) {
            let wo = direction(degrees) * Vec3::new(1.0, 1.0, side);
            let eta = if side > 0.0 { 1.5 } else { 1.0 / 1.5 };
            let reflectance = f64::from(Fresnel::dielectric(wo.z.abs(), eta).reflectance);
            let [reflected, refracted] = energy(glass(1.5, 0.05), wo);
            assert!((reflected - reflectance).abs() < 0.015, "{reflected} reflected at {degrees} degrees");
            assert!((reflected + refracted - 1.0).abs() < 2e-3, "{reflected} + {refracted} at {degrees} degrees");
            for roughness in [0.3, 0.6, 1.0] {
                let sum: f64 = energy(glass(1.5, roughness), wo).iter().sum();
                assert!(sum > 0.35 && sum <= 1.0 + 1e-6, "{sum} at {degrees} degrees, roughness {roughness}");
            }
        }
    }

    /// Reflection is reciprocal; refraction is once radiance is divided by the index squared.
    #[test]
    fn light_can_be_sent_either_way() {
        let (glass, wo, above) = (glass(1.5, 0.6), direction(30.0), direction(-50.0));
        let f = |wo: Vec3, wi: Vec3| glass.eval_pdf(wo, wi).0.to_rgb()[0] / wi.z.abs();
        assert!((f(wo, above) - f(above, wo)).abs() < 1e-6 && f(wo, above) > 0.01);
        let below = Vec3::new(-0.3, 0.1, -0.9).normalize();
        assert!((f(wo, below) * 1.5 * 1.5 - f(below, wo)).abs() < 1e-5 && f(wo, below) > 0.1);
    }

    /// Where there is no boundary, all goes straight on, however rough.
    #[test]
    fn nothing_happens_at_index_1() {
        for (roughness, uc) in [(0.0, 0.0), (0.3, 0.5), (1.0, 0.99)] {
            for wo in [direction(0.0), direction(50.0), -direction(80.0)] {
                let sample = glass(1.0, roughness).sample(wo, uc, Vec2::new(0.2, 0.8)).unwrap();
                assert!(sample.delta && (sample.wi + wo).length() < 1e-6 && sample.weight.to_rgb() == [1.0; 3]);
            }
        }
    }

    /// Finite up to the horizon and for extreme indices.
    #[test]
    fn grazing_light_is_finite() {
        for eta in [0.01_f32, 0.67, 0.999, 1.0, 1.001, 1.5, 100.0] {
            for roughness in [0.0, 0.04, 0.3, 1.0] {
                let glass = glass(eta, roughness);
                for z in [0.0_f32, -0.0, 1e-42, 1e-30, -1e-20, -1e-10, 1e-5, 0.9] {
                    let wo = Vec3::new((1.0 - z * z).sqrt(), 0.0, z);
                    for (uc, u) in [
                        (0.0, Vec2::ZERO),
                        (0.999_999, Vec2::new(0.3, 1.0 - f32::EPSILON / 2.0)),
                        (0.9, Vec2::splat(0.4)),
                    ] {
                        if let Some(s) = glass.sample(wo, uc, u) {
                            let energy = s.weight.to_rgb()[0] * s.eta * s.eta;
                            assert!((0.0..=1.0 + 1e-5).contains(&energy) && s.wi.is_normalized(), "{s:?}");
                            assert!(s.pdf.is_finite() && s.pdf > 0.0, "{s:?}");
                        }
                    }
                    for wi in [Vec3::new(-wo.x, 0.0, z), wo, -wo, Vec3::Z, Vec3::X, Vec3::new(-1.0, 0.0, -1e-25)] {
                        let (eval, pdf) = glass.eval_pdf(wo, wi);
                        assert!(
                            eval.to_rgb()[0].is_finite() && eval.to_rgb()[0] >= 0.0 && pdf.is_finite() && pdf >= 0.0
                        );
                    }
                }
            }
        }
    }
}
