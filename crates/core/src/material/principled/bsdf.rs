//! The lobe of [`Principled`](super::Principled).

use std::f32::consts::FRAC_1_PI;

use glam::{Vec2, Vec3};

use crate::color::{Rgb, Spectrum};
use crate::material::charlie::Charlie;
use crate::material::lost::{horizon_over_cosine, lost, mean_lost, near_horizon};
use crate::material::microfacet::{Ggx, reflect_at, refract_at, upright};
use crate::material::oren_nayar::OrenNayarBsdf;
use crate::material::reflected::Boundary;
use crate::material::{BsdfSample, Fresnel, ThinFilm};
use crate::math::{Frame, reflect, refract};
use crate::sampling::{cosine_hemisphere, uniform_sphere};

/// The lobe of [`Principled`](super::Principled).
#[derive(Clone, Copy, Debug)]
pub struct PrincipledBsdf {
    /// Albedo of the matte base, times its share of the surface.
    pub(super) matte: Rgb,
    pub(super) matte_roughness: f32,
    /// F₀ of metal.
    pub(super) metal_color: Rgb,
    pub(super) specular_color: Rgb,
    /// Shares of the surface: of metal, times its factor; of the matte base, and of what is clear.
    pub(super) metal: f32,
    pub(super) opaque: f32,
    pub(super) clear: f32,
    /// The base's facets.
    pub(super) ggx: Ggx,
    /// By which they reflect if they are not metal, at least 1.
    pub(super) eta: f32,
    /// In which direction highlights are long.
    pub(super) x: Vec2,
    /// By which light that goes through is bent; 1 of what has no inside.
    pub(super) eta_through: f32,
    /// Whether there is no inside.
    pub(super) is_thin: bool,
    pub(super) transmission: Rgb,
    pub(super) coat: Boundary,
    pub(super) coat_weight: f32,
    /// What of the coat's unit normal lies in the surface.
    pub(super) coat_tilt: Vec2,
    /// What the coat leaves of the base's light, but for what it reflects.
    pub(super) coat_tint: Rgb,
    /// Times its weight.
    pub(super) fuzz_color: Rgb,
    pub(super) fuzz_weight: f32,
    pub(super) fuzz_roughness: f32,
    pub(super) film: ThinFilm,
    pub(super) film_weight: f32,
}

/// What directions are drawn from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Part {
    Fuzz,
    Coat,
    Facets,
    /// The matte base, and half of what goes from facet to facet.
    Cosine,
    /// The other half.
    Horizon,
    Through,
}

impl Part {
    const ALL: [Self; 6] = [Self::Fuzz, Self::Coat, Self::Facets, Self::Cosine, Self::Horizon, Self::Through];
}

/// The surface from one direction above it.
struct View {
    wo: Vec3,
    /// Whether above is inside.
    inside: bool,
    /// The frame of the coat's normal, if that is not the surface's.
    coat: Option<Frame>,
    /// The part of the light that fuzz leaves.
    under_fuzz: f32,
    /// The part that fuzz and coat leave.
    under_coat: f32,
    /// The part of the light under the coat that facets leave to the matte base.
    left: Spectrum,
    /// f_ms (1 / (1 − E(wi))) of metal.
    often: Spectrum,
    /// With which each part is chosen; their sum is 1, or 0 if no light comes from anywhere.
    chances: [f32; 6],
}

impl View {
    fn chance(&self, part: Part) -> f32 {
        self.chances[part as usize]
    }

    /// A direction in the frame of the coat.
    fn to_coat(&self, w: Vec3) -> Vec3 {
        self.coat.map_or(w, |frame| frame.to_local(w))
    }

    /// A direction from there.
    fn out_of_coat(&self, w: Vec3) -> Vec3 {
        self.coat.map_or(w, |frame| frame.to_world(w))
    }

    fn choose(&self, uc: f32) -> Option<Part> {
        let mut sum = 0.0;
        let mut last = None;
        for part in Part::ALL {
            let chance = self.chance(part);
            if chance > 0.0 {
                sum += chance;
                last = Some(part);
                if uc < sum {
                    break;
                }
            }
        }
        last
    }
}

impl PrincipledBsdf {
    /// Makes its inside that of one wavelength.
    pub(crate) fn disperse(&mut self, bend: f32, color: Spectrum) {
        if !self.is_thin {
            self.eta_through *= bend;
            self.transmission = Rgb((Spectrum::from(self.transmission) * color).to_rgb());
        }
    }

    /// Whether the facets are a mirror.
    #[inline]
    fn is_smooth(&self) -> bool {
        self.ggx.alpha() < Ggx::MIN_ALPHA
    }

    /// Whether what goes through goes one way.
    #[inline]
    fn is_smooth_through(&self) -> bool {
        let narrow = self.ggx.alpha() * (self.eta_through - 1.0) < Ggx::MIN_ALPHA * self.eta_through;
        self.is_smooth() || narrow && !self.is_thin
    }

    #[inline(never)]
    pub(crate) fn is_delta(&self) -> bool {
        let smooth_coat = self.coat_weight == 0.0 || self.coat.is_smooth();
        let smooth_base = self.is_smooth() && (self.clear == 0.0 || self.is_smooth_through());
        smooth_coat && smooth_base && self.matte.0 == [0.0; 3] && self.fuzz_weight == 0.0
    }

    /// Into the frame whose x axis is that of long highlights.
    fn turn(&self, w: Vec3) -> Vec3 {
        Vec2::new(self.x.x, -self.x.y).rotate(w.truncate()).extend(w.z)
    }

    #[inline(never)]
    pub(crate) fn sample(&self, wo: Vec3, uc: f32, u: Vec2) -> Option<BsdfSample> {
        let sample = self.sample_turned(self.turn(wo), uc, u)?;
        Some(BsdfSample { wi: self.x.rotate(sample.wi.truncate()).extend(sample.wi.z), ..sample })
    }

    /// The frame around the coat's normal, as it is seen from above.
    fn coat_frame(&self, side: f32) -> Option<Frame> {
        (self.coat_tilt != Vec2::ZERO).then(|| {
            let tilt = Vec2::new(self.x.x, -self.x.y).rotate(self.coat_tilt);
            Frame::from_z((side * tilt).extend((1.0 - tilt.length_squared()).max(0.0).sqrt()))
        })
    }

    fn sample_turned(&self, wo: Vec3, uc: f32, u: Vec2) -> Option<BsdfSample> {
        let side = 1.0_f32.copysign(wo.z);
        let up = upright(wo, side);
        let view = self.view(up, side);
        let part = view.choose(uc)?;
        let (wi, eta) = match part {
            Part::Fuzz => {
                let wi = uniform_sphere(u);
                (upright(wi, 1.0_f32.copysign(wi.z)), 1.0)
            }
            Part::Coat if self.coat.is_smooth() => return self.coat_mirror(&view, side),
            Part::Coat => {
                let above = view.to_coat(up);
                let wi = reflect_at(above, self.coat.ggx().sample(above, u));
                if wi.z <= 0.0 {
                    return None;
                }
                (view.out_of_coat(wi), 1.0)
            }
            Part::Facets if self.is_smooth() => return Some(self.mirror(wo, &view)),
            Part::Facets => (reflect_at(up, self.ggx.sample(up, u)), 1.0),
            Part::Cosine => (cosine_hemisphere(u), 1.0),
            Part::Horizon => (near_horizon(self.ggx.alpha(), u), 1.0),
            Part::Through if self.is_smooth_through() => return self.straight_through(wo, &view),
            Part::Through if self.is_thin => (upright(reflect_at(up, self.ggx.sample(up, u)), -1.0), 1.0),
            Part::Through => {
                let eta = self.eta_behind(&view);
                let m = self.ggx.sample(up, u);
                let cos_t = Fresnel::dielectric(up.dot(m).clamp(0.0, 1.0), eta).cos_t;
                if cos_t == 0.0 {
                    return None;
                }
                (refract_at(up, m, eta, cos_t), eta)
            }
        };
        if (part == Part::Through) != (wi.z < 0.0) {
            return None;
        }
        let sample = BsdfSample::of_eval(upright(wi, side), self.eval_pdf_from(&view, wi))?;
        Some(BsdfSample { eta, ..sample })
    }

    #[inline(never)]
    pub(crate) fn eval_pdf(&self, wo: Vec3, wi: Vec3) -> (Spectrum, f32) {
        let (wo, wi, side) = (self.turn(wo), self.turn(wi), 1.0_f32.copysign(wo.z));
        self.eval_pdf_from(&self.view(upright(wo, side), side), upright(wi, side))
    }

    fn eval_pdf_from(&self, view: &View, wi: Vec3) -> (Spectrum, f32) {
        let (eval, pdf) = if view.wo.z <= 0.0 || wi.z == 0.0 {
            (Spectrum::BLACK, 0.0)
        } else if wi.z > 0.0 {
            self.reflected(view, wi)
        } else {
            self.transmitted(view, wi)
        };
        if pdf > f32::MIN_POSITIVE { (eval, pdf) } else { (Spectrum::BLACK, 0.0) }
    }

    /// eval and pdf of what is reflected but by mirrors, for directions above the surface.
    fn reflected(&self, view: &View, wi: Vec3) -> (Spectrum, f32) {
        let wo = view.wo;
        let mut eval = self.base(view, wi) * Spectrum::from(self.coat_tint) * view.under_coat;
        let mut pdf = FRAC_1_PI
            * wi.z
            * (view.chance(Part::Cosine)
                + view.chance(Part::Horizon) * horizon_over_cosine(self.ggx.alpha().max(Ggx::MIN_ALPHA), wi.z));
        let facet = if self.is_smooth() { None } else { self.ggx.facet(wo, wi, 1.0) };
        if let Some(facet) = facet {
            let share = self.facet_reflectance(facet.cos_o.min(1.0), view.inside);
            let tint = Spectrum::from(self.coat_tint) * view.under_coat;
            eval += share * tint * (self.ggx.g2_over_g1(wo, wi) * facet.pdf);
            pdf += view.chance(Part::Facets) * facet.pdf;
        }
        let (coat, rough_coat) = (self.coat.ggx(), self.coat_weight > 0.0 && !self.coat.is_smooth());
        let (wo, wi_coat) = (view.to_coat(wo), view.to_coat(wi));
        let is_seen = rough_coat && wo.z > 0.0 && wi_coat.z > 0.0;
        let facet = if is_seen { coat.facet(wo, wi_coat, 1.0) } else { None };
        if let Some(facet) = facet {
            let share = self.coat_weight * view.under_fuzz * self.coat.fresnel(facet.cos_o);
            eval += Spectrum::ONE * (share * coat.g2_over_g1(wo, wi_coat) * facet.pdf);
            pdf += view.chance(Part::Coat) * facet.pdf;
        }
        if self.fuzz_weight > 0.0 {
            let fuzz = Charlie::from_roughness(self.fuzz_roughness).eval(view.wo, wi) * wi.z;
            eval += Spectrum::from(self.fuzz_color) * fuzz;
            pdf += view.chance(Part::Fuzz) * 0.5 * FRAC_1_PI;
        }
        (eval, pdf)
    }

    /// The matte base (with a film, it does not matter whence light comes in), and what goes from facet to facet of metal, times cos θᵢ.
    fn base(&self, view: &View, wi: Vec3) -> Spectrum {
        let mut eval = Spectrum::BLACK;
        if self.matte.0 != [0.0; 3] {
            let matte = OrenNayarBsdf::new(self.matte, self.matte_roughness).eval(view.wo, wi);
            eval += matte * view.left;
            if self.film_weight == 0.0 {
                let boundary = self.facets_of_matte();
                let mean = boundary.mean_share();
                // Grooves send a little more than others to where facets let it out; none is made of it.
                let rough = 1.0 + 0.09 * self.matte_roughness * mean / (1.0 - mean);
                eval = eval * ((1.0 - boundary.share(wi.z)) / ((1.0 - mean) * rough));
            }
        }
        if !view.often.is_black() {
            eval += view.often * (lost(self.ggx, wi) * wi.z);
        }
        eval
    }

    /// eval and pdf of what goes through facets, for `wi` below the surface.
    fn transmitted(&self, view: &View, wi: Vec3) -> (Spectrum, f32) {
        if self.clear == 0.0 || self.is_smooth_through() {
            return (Spectrum::BLACK, 0.0);
        }
        // Of what has no inside, as if it were reflected to the other side.
        let (wi, eta) = if self.is_thin { (upright(wi, -1.0), 1.0) } else { (wi, self.eta_behind(view)) };
        let Some(facet) = self.ggx.facet(view.wo, wi, eta) else {
            return (Spectrum::BLACK, 0.0);
        };
        let seen = if self.is_thin { self.ggx.g2_over_g1(view.wo, wi) } else { self.ggx.g1(wi) / (eta * eta) };
        let share = self.goes_through(view, facet.cos_o.min(1.0));
        (share * (seen * facet.pdf), view.chance(Part::Through) * facet.pdf)
    }

    fn coat_mirror(&self, view: &View, side: f32) -> Option<BsdfSample> {
        let above = view.to_coat(view.wo);
        let wi = view.out_of_coat(reflect(above));
        let chance = view.chance(Part::Coat);
        let share = self.coat_weight * view.under_fuzz * self.coat.fresnel(above.z);
        let weight = Spectrum::ONE * (share / chance);
        (wi.z > 0.0).then(|| BsdfSample { wi: upright(wi, side), weight, pdf: chance, delta: true, eta: 1.0 })
    }

    fn mirror(&self, wo: Vec3, view: &View) -> BsdfSample {
        let chance = view.chance(Part::Facets);
        let tint = Spectrum::from(self.coat_tint) * (view.under_coat / chance);
        let weight = self.facet_reflectance(view.wo.z.min(1.0), view.inside) * tint;
        BsdfSample { wi: reflect(wo), weight, pdf: chance, delta: true, eta: 1.0 }
    }

    fn straight_through(&self, wo: Vec3, view: &View) -> Option<BsdfSample> {
        let (chance, eta) = (view.chance(Part::Through), self.eta_behind(view));
        let cos = view.wo.z.min(1.0);
        let cos_t = Fresnel::dielectric(cos, eta).cos_t;
        let weight = self.goes_through(view, cos) * (1.0 / (chance * eta * eta));
        (cos_t > 0.0).then(|| BsdfSample { wi: refract(wo, eta, cos_t), weight, pdf: chance, delta: true, eta })
    }

    /// The part of the light that goes through facets at a cosine, by all layers.
    fn goes_through(&self, view: &View, cos: f32) -> Spectrum {
        let left = rest(self.pane_reflectance(cos, view.inside));
        left * Spectrum::from(self.transmission) * Spectrum::from(self.coat_tint) * (self.clear * view.under_coat)
    }

    /// The index behind the surface over that before it.
    fn eta_behind(&self, view: &View) -> f32 {
        if view.inside { 1.0 / self.eta_through } else { self.eta_through }
    }

    /// What a facet reflects, of each kind by its share of the surface.
    fn facet_reflectance(&self, cos: f32, inside: bool) -> Spectrum {
        let mut sum = Spectrum::BLACK;
        if self.opaque > 0.0 {
            sum += self.clear_reflectance(cos, false) * Spectrum::from(self.specular_color) * self.opaque;
        }
        if self.clear > 0.0 {
            let color = if inside { Spectrum::ONE } else { self.specular_color.into() };
            sum += self.pane_reflectance(cos, inside) * color * self.clear;
        }
        if self.metal > 0.0 {
            let bare = self.metal_reflectance(cos);
            let metal =
                if self.film_weight > 0.0 { bare.lerp(self.film.on_mirror(cos, bare), self.film_weight) } else { bare };
            sum += metal * self.metal;
        }
        sum
    }

    /// What a facet that is not metal reflects, without its color.
    fn clear_reflectance(&self, cos: f32, inside: bool) -> Spectrum {
        if inside && Fresnel::dielectric(cos, 1.0 / self.eta_through).cos_t == 0.0 {
            return Spectrum::ONE;
        }
        let eta = if inside { 1.0 / self.eta } else { self.eta };
        let Fresnel { reflectance, cos_t } = Fresnel::dielectric(cos, eta);
        let bare = Spectrum::ONE * reflectance;
        if self.film_weight > 0.0 {
            bare.lerp(self.film.on_clear([cos, cos_t], eta, !inside), self.film_weight)
        } else {
            bare
        }
    }

    /// What is clear reflects, without its color: a facet, or, if there is no inside, a pane of two, with all that goes to and fro.
    fn pane_reflectance(&self, cos: f32, inside: bool) -> Spectrum {
        let once = self.clear_reflectance(cos, inside);
        if self.is_thin { Spectrum::from_rgb(once.to_rgb().map(|r| 2.0 * r / (1.0 + r))) } else { once }
    }

    /// F of metal.
    fn metal_reflectance(&self, cos: f32) -> Spectrum {
        let x = (1.0 - cos).max(0.0);
        let (sq, sixth) = (x * x, x * x * x * (x * x * x));
        let fifth = sq * sq * x;
        self.each_of_metal(|f0, edge| {
            let schlick = f0 + (1.0 - f0) * fifth;
            (schlick - Self::dip(f0, edge) * cos * sixth).max(0.0)
        })
    }

    /// The mean of F over an evenly lit surface, ∫ F 2 cos d(cos).
    fn mean_metal_reflectance(&self) -> Spectrum {
        self.each_of_metal(|f0, edge| (f0 + (1.0 - f0) / 21.0 - Self::dip(f0, edge) / 126.0).max(0.0))
    }

    /// (1 − t) S(1/7) / (1/7 (6/7)⁶).
    fn dip(f0: f32, edge: f32) -> f32 {
        const X: f32 = 6.0 / 7.0;
        const FIFTH: f32 = X * X * X * X * X;
        (1.0 - edge) * (f0 + (1.0 - f0) * FIFTH) * (7.0 / (FIFTH * X))
    }

    fn each_of_metal(&self, f: impl Fn(f32, f32) -> f32) -> Spectrum {
        Spectrum::from_rgb(std::array::from_fn(|i| f(self.metal_color.0[i], self.specular_color.0[i])))
    }

    /// The facets over the matte base.
    fn facets_of_matte(&self) -> Boundary {
        Boundary::new(self.ggx.alpha(), self.eta)
    }

    /// The part of the light at a cosine that facets let through to the matte base, 1 − E.
    fn left_by_facets(&self, cos: f32) -> Spectrum {
        let reflected = |cos: f32| self.clear_reflectance(cos.min(1.0), false);
        rest(self.facets_of_matte().share_of(cos, reflected))
    }

    /// What goes from facet to facet of metal: the lobe over 1 − E(wi), and its share of the light.
    fn facet_to_facet(&self, wo: Vec3) -> (Spectrum, Spectrum) {
        if self.metal == 0.0 || self.is_smooth() || wo.z <= 0.0 {
            return (Spectrum::BLACK, Spectrum::BLACK);
        }
        let (lost, mean_lost) = (lost(self.ggx, wo), mean_lost(self.ggx));
        let color = self.mean_metal_reflectance().to_rgb().map(|f| f * f * (1.0 - mean_lost) / (1.0 - f * mean_lost));
        let share = Spectrum::from_rgb(color) * (self.metal * lost);
        (share * (FRAC_1_PI / mean_lost), share)
    }

    /// About the part of the light at a cosine that facets send back at once; exactly if they are a mirror.
    fn by_facets(&self, cos: f32, inside: bool, left: Spectrum) -> Spectrum {
        if self.is_smooth() {
            return self.facet_reflectance(cos, inside);
        }
        let mut sum = rest(left) * Spectrum::from(self.specular_color) * self.opaque;
        if self.metal > 0.0 {
            sum += self.metal_reflectance(cos) * self.metal;
        }
        if self.clear > 0.0 {
            // Some facets see what this one does not.
            let other = if inside { Boundary::new(0.0, self.eta_through).mean_share_inside() } else { 0.0 };
            let here = self.pane_reflectance(cos, inside);
            sum += here.lerp(Spectrum::ONE * other, 0.5 * self.ggx.alpha()) * self.clear;
        }
        sum
    }

    /// About the part of the light at a cosine that goes through.
    fn by_going_through(&self, cos: f32, inside: bool) -> f32 {
        let eta = if inside { 1.0 / self.eta_through } else { self.eta_through };
        if self.clear == 0.0 || self.is_smooth_through() && Fresnel::dielectric(cos, eta).cos_t == 0.0 {
            return 0.0;
        }
        let through = rest(self.pane_reflectance(cos, inside)).clamp(0.02, 1.0);
        (through * Spectrum::from(self.transmission)).max_component().min(1.0) * self.clear
    }

    /// What does not depend on `wi`, for `wo` above the surface, which is seen from below if `side` is -1.
    fn view(&self, wo: Vec3, side: f32) -> View {
        let (cos, inside) = (wo.z.clamp(0.0, 1.0), side < 0.0 && !self.is_thin);
        let coat = self.coat_frame(side);
        let coat_cos = coat.map_or(cos, |frame| frame.to_local(wo).z.min(1.0));
        let by_fuzz =
            if self.fuzz_weight > 0.0 { Charlie::from_roughness(self.fuzz_roughness).share(cos) } else { 0.0 };
        let under_fuzz = 1.0 - self.fuzz_weight * by_fuzz;
        let sees_coat = self.coat_weight > 0.0 && (coat_cos > 0.0 || coat.is_none());
        let by_coat = if sees_coat { self.coat_weight * self.coat.share(coat_cos) } else { 0.0 };
        let under_coat = under_fuzz * (1.0 - by_coat);
        let left = if self.opaque > 0.0 { self.left_by_facets(cos) } else { Spectrum::ONE };
        let (often, often_share) = self.facet_to_facet(wo);
        let tint = Spectrum::from(self.coat_tint) * under_coat;
        let most = |color: Spectrum| (color * tint).max_component();
        let half_of_often = 0.5 * most(often_share);
        let mut chances = [
            Spectrum::from(self.fuzz_color).max_component() * by_fuzz,
            by_coat * under_fuzz,
            most(self.by_facets(cos, inside, left)),
            most(Spectrum::from(self.matte) * left) + half_of_often,
            half_of_often,
            self.by_going_through(cos, inside) * tint.max_component(),
        ];
        let sum: f32 = chances.iter().sum();
        if sum > 0.0 {
            chances.iter_mut().for_each(|chance| *chance /= sum);
        }
        View { wo, inside, coat, under_fuzz, under_coat, left, often, chances }
    }

    /// About the share of light from straight above that is scattered, to either side.
    pub(crate) fn albedo(&self) -> Spectrum {
        let view = self.view(Vec3::Z, 1.0);
        let base = self.by_facets(1.0, false, view.left)
            + Spectrum::from(self.matte) * view.left
            + Spectrum::from(self.transmission) * self.clear;
        let above = Spectrum::from(self.fuzz_color) * Charlie::from_roughness(self.fuzz_roughness).share(1.0)
            + Spectrum::ONE * (view.under_fuzz - view.under_coat);
        above + base * Spectrum::from(self.coat_tint) * view.under_coat
    }
}

/// What is left of one, 1 − `share`.
fn rest(share: Spectrum) -> Spectrum {
    Spectrum::ONE + share * -1.0
}
