//! Principled: one material for nearly everything that is opaque, metallic or clear, from layers: the parameters of OpenPBR
//! Surface 1.1.
//!
//! From the top: fuzz, a coat, and a base, which is a mixture of metal (`base_metalness`) and of something that is not, and this
//! of something clear (`transmission_weight`) and of a matte one under facets. What a layer does not send back goes on to what lies below,
//!
//! f = f_fuzz + (1 − E_fuzz(wo)) (f_coat + (1 − E_coat(wo)) c f_base),
//!
//! where E is the share of the light that a layer scatters, times its weight, and c the coat's colour. Under the base's facets is
//! a matte one as in [`Plastic`](crate::material::Plastic), but with colours as they are said: with ρ its albedo,
//!
//! f = ρ / π · (1 − E(wo)) (1 − E(wi)) / (1 − Ē), or EON if it is rough.
//!
//! Metal reflects by Fresnel's equations in Schlick's form, with `specular_color` as the tint at 82 degrees (Kutz, Hašan & Edmondson
//! 2021, "Novel aspects of the Adobe Standard Material"):
//!
//! F = S − (1 − t) S(1/7) cos (1 − cos)⁶ / (1/7 (6/7)⁶), S = F₀ + (1 − F₀) (1 − cos)⁵,
//!
//! and what goes from facet to facet comes back as in [`Conductor`](crate::material::Conductor). A white furnace leaves a white one as it is,
//! but rough glass loses some. Reciprocal without fuzz, coat and film; the same on both sides, but for glass.
//!
//! Under a coat, highlights get wider, indices are over that of the coat, and colours darken by the light that the coat sends
//! back inside (`coat_darkening`). A film interferes on the base's facets (see [`ThinFilm`]).
//!
//! Andersson, Edmondson, Guertault, Herubel, King, Kutz, Machizaud, Portsmouth, Servant & Stone 2024, "OpenPBR Surface specification",
//! Academy Software Foundation. What it has below the surface is told at the surface: `subsurface_weight` mixes the matte base
//! with `subsurface_color`, and `transmission_color` is what is left of the light each time that it goes through.
//!
//! Directions come from one layer, chosen by about its share of the light, and are weighed by all of them.
//!
//! ```toml
//! [material.car.principled]
//! base_color = [0.5, 0.02, 0.01]
//! base_metalness = 0.6
//! specular_roughness = 0.4
//! coat_weight = 1
//!
//! [material.bottle.principled]
//! transmission_weight = 1
//! transmission_color = [0.6, 0.9, 0.7]
//! specular_roughness = 0
//! ```

mod bsdf;
#[cfg(test)]
mod tests;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::color::{Rgb, Spectrum};
use crate::material::ThinFilm;
use crate::material::microfacet::Ggx;
use crate::material::reflected::Boundary;
use crate::texture::{Color, Textures};
use crate::validate::Checker;

pub use bsdf::PrincipledBsdf;

/// Layers: fuzz over a coat over metal, glass or something matte under facets; the parameters of OpenPBR Surface.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Principled {
    /// Factor on `base_color`, 0..1.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub base_weight: f32,
    /// Share of the light that a matte base scatters, and that metal reflects straight on, 0..1 in each channel.
    pub base_color: Color,
    /// Of a matte base: 0 is lambertian, 1 completely rough.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub base_diffuse_roughness: f32,
    /// How much of the base is metal, 0..1.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub base_metalness: f32,
    /// Factor on what metal reflects, and on what others reflect straight on, 0..1.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub specular_weight: f32,
    /// Factor on what facets reflect, of metal only near 82 degrees from the normal, 0..1 in each channel.
    pub specular_color: Color,
    /// Of the facets: 0 is polished, 1 completely rough; alpha is its square. Below 0.022 it is a perfect mirror.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub specular_roughness: f32,
    /// Highlights are long along the x axis of the surface's frame, the more so the nearer this is to 1: across, alpha is 1 − this
    /// of that along. Above 0.9 it is as at 0.9.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub specular_roughness_anisotropy: f32,
    /// Index of refraction of what is not metal, 1..3.
    #[schemars(range(min = 1.0, max = 3.0))]
    pub specular_ior: f32,
    /// How much of what is not metal is clear, 0..1.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub transmission_weight: f32,
    /// Left of the light each time that it goes through the surface, 0..1 in each channel.
    pub transmission_color: Color,
    /// Metres, not negative, in which light that goes through would get its color. It gets it at the surface, whatever this says.
    #[schemars(range(min = 0.0))]
    pub transmission_depth: f32,
    /// How much of the matte base is of `subsurface_color`, 0..1.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub subsurface_weight: f32,
    /// Share of the light that comes back from below the surface, 0..1 in each channel. It comes back where it went in.
    pub subsurface_color: Color,
    /// How much of the surface has a coat, 0..1.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub coat_weight: f32,
    /// Left of the light that goes through the coat and back, 0..1 in each channel.
    pub coat_color: Color,
    /// Of the coat's facets: 0 is polished, 1 completely rough.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub coat_roughness: f32,
    /// Index of refraction of the coat, 1..3.
    #[schemars(range(min = 1.0, max = 3.0))]
    pub coat_ior: f32,
    /// How much the base darkens by light that the coat sends back to it, 0..1.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub coat_darkening: f32,
    /// How much of the surface has fuzz, 0..1.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub fuzz_weight: f32,
    /// Share of the light that fuzz does not absorb, 0..1 in each channel.
    pub fuzz_color: Color,
    /// Of fuzz: 0.3 and less is upright, 1 tangled.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub fuzz_roughness: f32,
    /// How much of the base has a thin film, 0..1.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub thin_film_weight: f32,
    /// Micrometres, 0..2.
    #[schemars(range(min = 0.0, max = 2.0))]
    pub thin_film_thickness: f32,
    /// Index of refraction of the film, 1..5.
    #[schemars(range(min = 1.0, max = 5.0))]
    pub thin_film_ior: f32,
}

impl Default for Principled {
    fn default() -> Self {
        let grey = |value| Color::Rgb(Rgb::grey(value));
        Self {
            base_weight: 1.0,
            base_color: grey(0.8),
            base_diffuse_roughness: 0.0,
            base_metalness: 0.0,
            specular_weight: 1.0,
            specular_color: grey(1.0),
            specular_roughness: 0.3,
            specular_roughness_anisotropy: 0.0,
            specular_ior: 1.5,
            transmission_weight: 0.0,
            transmission_color: grey(1.0),
            transmission_depth: 0.0,
            subsurface_weight: 0.0,
            subsurface_color: grey(0.8),
            coat_weight: 0.0,
            coat_color: grey(1.0),
            coat_roughness: 0.0,
            coat_ior: 1.6,
            coat_darkening: 1.0,
            fuzz_weight: 0.0,
            fuzz_color: grey(1.0),
            fuzz_roughness: 0.5,
            thin_film_weight: 0.0,
            thin_film_thickness: 0.5,
            thin_film_ior: 1.4,
        }
    }
}

impl Principled {
    pub(crate) fn check(&self, c: &mut Checker) {
        for (key, value) in [
            ("base_weight", self.base_weight),
            ("base_diffuse_roughness", self.base_diffuse_roughness),
            ("base_metalness", self.base_metalness),
            ("specular_weight", self.specular_weight),
            ("specular_roughness", self.specular_roughness),
            ("specular_roughness_anisotropy", self.specular_roughness_anisotropy),
            ("transmission_weight", self.transmission_weight),
            ("subsurface_weight", self.subsurface_weight),
            ("coat_weight", self.coat_weight),
            ("coat_roughness", self.coat_roughness),
            ("coat_darkening", self.coat_darkening),
            ("fuzz_weight", self.fuzz_weight),
            ("fuzz_roughness", self.fuzz_roughness),
            ("thin_film_weight", self.thin_film_weight),
        ] {
            c.in_range(key, value, 0.0, 1.0);
        }
        c.in_range("specular_ior", self.specular_ior, 1.0, Boundary::MAX_ETA);
        c.in_range("coat_ior", self.coat_ior, 1.0, Boundary::MAX_ETA);
        c.in_range("transmission_depth", self.transmission_depth, 0.0, 1e15);
        c.in_range("thin_film_thickness", self.thin_film_thickness, 0.0, 1e-3 * ThinFilm::MAX_THICKNESS);
        c.in_range("thin_film_ior", self.thin_film_ior, 1.0, ThinFilm::MAX_ETA);
        self.clone().colors().into_iter().for_each(|(key, color)| color.check_share(key, c));
    }

    /// Its colours, by their keys.
    pub(crate) fn colors(&mut self) -> Vec<(&'static str, &mut Color)> {
        vec![
            ("base_color", &mut self.base_color),
            ("specular_color", &mut self.specular_color),
            ("transmission_color", &mut self.transmission_color),
            ("subsurface_color", &mut self.subsurface_color),
            ("coat_color", &mut self.coat_color),
            ("fuzz_color", &mut self.fuzz_color),
        ]
    }

    #[inline(never)]
    pub(crate) fn bsdf(&self, textures: &impl Textures) -> PrincipledBsdf {
        let color = |color: &Color| color.share_at(textures);
        let base = color(&self.base_color) * self.base_weight;
        let matte = base.lerp(color(&self.subsurface_color), self.subsurface_weight);
        let [metal, not_metal] = [self.base_metalness, 1.0 - self.base_metalness];
        let [clear, opaque] = [not_metal * self.transmission_weight, not_metal * (1.0 - self.transmission_weight)];
        let coat = Boundary::new(self.coat_roughness * self.coat_roughness, self.coat_ior);
        // Light that the coat sends back comes back from what is clear and from white as if there were no coat.
        let below = base * (metal * self.specular_weight) + matte * opaque + Spectrum::ONE * clear;
        PrincipledBsdf {
            matte: Rgb((matte * opaque).to_rgb()),
            matte_roughness: self.base_diffuse_roughness,
            metal_color: Rgb(base.to_rgb()),
            specular_color: Rgb(color(&self.specular_color).to_rgb()),
            metal: metal * self.specular_weight,
            opaque,
            clear,
            ggx: self.facets(),
            eta: self.eta_of_facets(),
            eta_through: self.specular_ior,
            transmission: Rgb(color(&self.transmission_color).to_rgb()),
            coat,
            coat_weight: self.coat_weight,
            coat_tint: Rgb(self.coat_tint(coat, below, textures).to_rgb()),
            fuzz_color: Rgb((color(&self.fuzz_color) * self.fuzz_weight).to_rgb()),
            fuzz_weight: self.fuzz_weight,
            fuzz_roughness: self.fuzz_roughness,
            film: ThinFilm { thickness: 1e3 * self.thin_film_thickness, eta: self.thin_film_ior },
            film_weight: if self.thin_film_thickness > 0.0 { self.thin_film_weight } else { 0.0 },
        }
    }

    /// The base's facets; a rough coat makes them rougher, as variances of slopes add up.
    fn facets(&self) -> Ggx {
        let fourth = |x: f32| (x * x) * (x * x);
        let roughness = self.specular_roughness;
        let both = (fourth(roughness) + 2.0 * fourth(self.coat_roughness)).min(1.0).sqrt().sqrt();
        let roughness = if self.coat_weight > 0.0 { roughness + self.coat_weight * (both - roughness) } else { roughness };
        if self.specular_roughness_anisotropy == 0.0 {
            return Ggx::from_roughness(roughness);
        }
        // Alpha along is √(2 / (1 + narrow²)) roughness², and across narrow times that.
        let narrow = (1.0 - self.specular_roughness_anisotropy).max(Ggx::MIN_ASPECT * Ggx::MIN_ASPECT);
        let alpha = roughness * roughness * (2.0 * narrow / (1.0 + narrow * narrow)).sqrt();
        let aspect = narrow.sqrt().max((Ggx::MIN_ALPHA / alpha.max(f32::MIN_POSITIVE)).min(1.0));
        Ggx::from_alpha(alpha).with_aspect(aspect)
    }

    /// The index by which facets that are not metal reflect: over that of the coat, from the side where light is
    /// faster; and such that straight on `specular_weight` of it is reflected.
    fn eta_of_facets(&self) -> f32 {
        let coated = self.specular_ior / self.coat_ior;
        let eta = self.specular_ior + self.coat_weight * (coated - self.specular_ior);
        let eta = eta.max(1.0 / eta);
        let amplitude = (eta - 1.0) / (eta + 1.0) * self.specular_weight.sqrt();
        (1.0 + amplitude) / (1.0 - amplitude)
    }

    /// What the coat leaves of the light of a base of the albedo `below`: its colour, and (1 − K) / (1 − K below), where the
    /// share K goes back to the base. Metal sends light back as the coat's mirror does, the less rough it is.
    fn coat_tint(&self, coat: Boundary, below: Spectrum, textures: &impl Textures) -> Spectrum {
        if self.coat_weight == 0.0 {
            return Spectrum::ONE;
        }
        let scattered = 1.0 - self.base_metalness * (1.0 - self.specular_roughness);
        let straight = coat.fresnel(1.0);
        let back = straight + scattered * (coat.mean_share_inside() - straight);
        let left = below.to_rgb().map(|below| {
            let left = (1.0 - back) / (1.0 - back * below);
            1.0 + self.coat_darkening * (left - 1.0)
        });
        Spectrum::ONE.lerp(self.coat_color.share_at(textures) * Spectrum::from_rgb(left), self.coat_weight)
    }
}
