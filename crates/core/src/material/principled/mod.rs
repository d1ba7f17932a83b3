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
//! and what goes from facet to facet comes back as in [`Conductor`](crate::material::Conductor). White loses no light, but rough glass
//! loses some. Reciprocal without fuzz, coat and film; the same on both sides, but for glass.
//!
//! Under a coat, highlights get wider, indices are over that of the coat, and colours darken by the light that the coat sends
//! back inside (`coat_darkening`). A film interferes on the base's facets (see [`ThinFilm`]).
//!
//! A sheet (`geometry_thin_walled`) reflects at both of its boundaries, and rough ones scatter what goes through as what is reflected.
//!
//! Andersson et al. 2024, "OpenPBR Surface specification", Academy Software Foundation. What scatters below the surface is told at the
//! surface: `subsurface_weight` mixes the matte base with `subsurface_color`. What is clear is filled and absorbs light if there is
//! a `transmission_depth` (see [`medium`](crate::medium)).
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

use glam::{Vec2, Vec3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::color::{LUMENS_PER_WATT, Rgb, Spectrum};
use crate::material::microfacet::Ggx;
use crate::material::reflected::Boundary;
use crate::material::{Emission, ThinFilm};
use crate::math::sin_cos_degrees;
use crate::medium::Filling;
use crate::names::Named;
use crate::texture::{Color, Scalar, Textures};
use crate::validate::Checker;

pub use bsdf::PrincipledBsdf;

/// Layers: fuzz over a coat over metal, glass or something matte under facets; the parameters of OpenPBR Surface.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Principled {
    /// Factor on `base_color`, 0..1.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub base_weight: Scalar,
    /// Share of the light that a matte base scatters, and that metal reflects straight on, 0..1 in each channel.
    pub base_color: Color,
    /// Of a matte base: 0 is lambertian, 1 completely rough.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub base_diffuse_roughness: Scalar,
    /// How much of the base is metal, 0..1.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub base_metalness: Scalar,
    /// Factor on what metal reflects, and on what others reflect straight on, 0..1.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub specular_weight: Scalar,
    /// Factor on what facets reflect, of metal only near 82 degrees from the normal, 0..1 in each channel.
    pub specular_color: Color,
    /// Of the facets: 0 is polished, 1 completely rough; alpha is its square. Below 0.022 it is a perfect mirror.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub specular_roughness: Scalar,
    /// Highlights are long along the x axis of the surface's frame, the more so the nearer this is to 1: across, alpha is 1 − this
    /// of that along. Above 0.9 it is as at 0.9.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub specular_roughness_anisotropy: Scalar,
    /// Turns that axis counter-clockwise, towards growing v, degrees, -10000..10000.
    #[schemars(range(min = -1e4, max = 1e4))]
    pub specular_rotation: f32,
    /// Index of refraction of what is not metal, 1..3.
    #[schemars(range(min = 1.0, max = 3.0))]
    pub specular_ior: f32,
    /// How much of what is not metal is clear, 0..1.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub transmission_weight: Scalar,
    /// The colour of white light after `transmission_depth` inside, 0..1 in each channel; if that is 0 or the colour is a texture, what is
    /// left of it behind, having gone through the surface twice; of a sheet, once.
    pub transmission_color: Color,
    /// Metres, not negative, in which light that goes through gets its colour.
    #[schemars(range(min = 0.0))]
    pub transmission_depth: f32,
    /// How much the index of refraction inside changes with the colour of light, 0..1: a factor on 1 / `transmission_dispersion_abbe_number`.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub transmission_dispersion_scale: f32,
    /// Abbe's number at a scale of 1, 1..10000: `specular_ior` is the index at 587.56 nm.
    #[schemars(range(min = 1.0, max = 10_000.0))]
    pub transmission_dispersion_abbe_number: f32,
    /// How much of the matte base is of `subsurface_color`, 0..1.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub subsurface_weight: Scalar,
    /// Share of the light that comes back from below the surface, 0..1 in each channel. It comes back where it went in.
    pub subsurface_color: Color,
    /// How much of the surface has a coat, 0..1.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub coat_weight: Scalar,
    /// Left of the light that goes through the coat and back, 0..1 in each channel.
    pub coat_color: Color,
    /// Of the coat's facets: 0 is polished, 1 completely rough.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub coat_roughness: Scalar,
    /// Index of refraction of the coat, 1..3.
    #[schemars(range(min = 1.0, max = 3.0))]
    pub coat_ior: f32,
    /// How much the base darkens by light that the coat sends back to it, 0..1.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub coat_darkening: f32,
    /// How much of the surface has fuzz, 0..1.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub fuzz_weight: Scalar,
    /// Share of the light that fuzz does not absorb, 0..1 in each channel.
    pub fuzz_color: Color,
    /// Of fuzz: 0.3 and less is upright, 1 tangled.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub fuzz_roughness: Scalar,
    /// How much of the base has a thin film, 0..1.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub thin_film_weight: Scalar,
    /// Micrometres, 0..2.
    #[schemars(range(min = 0.0, max = 2.0))]
    pub thin_film_thickness: Scalar,
    /// Index of refraction of the film, 1..5.
    #[schemars(range(min = 1.0, max = 5.0))]
    pub thin_film_ior: f32,
    /// Luminance of the light that it sends out on the side of the normal where `emission_color` is white, cd / m², 0..1e9; 203 of
    /// them are a radiance of 1, as light is even over the visible.
    #[schemars(range(min = 0.0, max = 1e9))]
    pub emission_luminance: f32,
    /// Color of that light, 0..1 in each channel.
    pub emission_color: Color,
    /// Whether it sends light out on the other side, too.
    pub emission_two_sided: bool,
    /// The direction in which highlights are long, before `specular_rotation`, as a colour: red and green from 0 to 1 are from -1 to 1 along growing
    /// u and v, as in pictures of normals. Along growing u if absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub geometry_tangent: Option<Color>,
    /// Normals of the coat, as colours, over the shape's own ones, whatever normal maps and reliefs do to what is below: [0.5, 0.5, 1] is as
    /// smooth as the shape. As those of what is below if absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub geometry_coat_normal: Option<Color>,
    /// Factor on the slopes of these, -100..100.
    #[schemars(range(min = -100.0, max = 100.0))]
    pub geometry_coat_normal_strength: f32,
    /// Whether the surface is a sheet without an inside, such as a pane or a leaf, that light goes through unbent.
    pub geometry_thin_walled: bool,
}

impl Default for Principled {
    fn default() -> Self {
        let grey = |value| Color::Rgb(Rgb::grey(value));
        Self {
            base_weight: 1.0.into(),
            base_color: grey(0.8),
            base_diffuse_roughness: 0.0.into(),
            base_metalness: 0.0.into(),
            specular_weight: 1.0.into(),
            specular_color: grey(1.0),
            specular_roughness: 0.3.into(),
            specular_roughness_anisotropy: 0.0.into(),
            specular_rotation: 0.0,
            specular_ior: 1.5,
            transmission_weight: 0.0.into(),
            transmission_color: grey(1.0),
            transmission_depth: 0.0,
            transmission_dispersion_scale: 0.0,
            transmission_dispersion_abbe_number: 20.0,
            subsurface_weight: 0.0.into(),
            subsurface_color: grey(0.8),
            coat_weight: 0.0.into(),
            coat_color: grey(1.0),
            coat_roughness: 0.0.into(),
            coat_ior: 1.6,
            coat_darkening: 1.0,
            fuzz_weight: 0.0.into(),
            fuzz_color: grey(1.0),
            fuzz_roughness: 0.5.into(),
            thin_film_weight: 0.0.into(),
            thin_film_thickness: 0.5.into(),
            thin_film_ior: 1.4,
            emission_luminance: 0.0,
            emission_color: grey(1.0),
            emission_two_sided: false,
            geometry_tangent: None,
            geometry_coat_normal: None,
            geometry_coat_normal_strength: 1.0,
            geometry_thin_walled: false,
        }
    }
}

impl Principled {
    /// Of a film, micrometres.
    const MAX_FILM: f32 = 1e-3 * ThinFilm::MAX_THICKNESS;

    pub(crate) fn check(&self, c: &mut Checker) {
        c.in_range("coat_darkening", self.coat_darkening, 0.0, 1.0);
        c.in_range("specular_ior", self.specular_ior, 1.0, Boundary::MAX_ETA);
        c.in_range("coat_ior", self.coat_ior, 1.0, Boundary::MAX_ETA);
        c.in_range("emission_luminance", self.emission_luminance, 0.0, 1e9);
        c.in_range("transmission_depth", self.transmission_depth, 0.0, 1e15);
        c.in_range("transmission_dispersion_scale", self.transmission_dispersion_scale, 0.0, 1.0);
        c.in_range("transmission_dispersion_abbe_number", self.transmission_dispersion_abbe_number, 1.0, 1e4);
        c.in_range("thin_film_ior", self.thin_film_ior, 1.0, ThinFilm::MAX_ETA);
        c.in_range("specular_rotation", self.specular_rotation, -1e4, 1e4);
        c.in_range("geometry_coat_normal_strength", self.geometry_coat_normal_strength, -100.0, 100.0);
        let mut copy = self.clone();
        let (colors, numbers) = copy.parts();
        colors.into_iter().for_each(|(key, color)| color.check_share(key, c));
        numbers.into_iter().for_each(|(key, number, most)| number.check_range(key, 0.0, most, c));
    }

    /// Its colours and its numbers that can be textures, by their keys, and how large numbers can be.
    #[expect(clippy::type_complexity, reason = "said once")]
    fn parts(&mut self) -> (Vec<(&'static str, &mut Color)>, [(&'static str, &mut Scalar, f32); 14]) {
        let mut colors = vec![
            ("base_color", &mut self.base_color),
            ("specular_color", &mut self.specular_color),
            ("transmission_color", &mut self.transmission_color),
            ("subsurface_color", &mut self.subsurface_color),
            ("coat_color", &mut self.coat_color),
            ("fuzz_color", &mut self.fuzz_color),
            ("emission_color", &mut self.emission_color),
        ];
        // See `directions`.
        colors.extend(self.geometry_tangent.as_mut().map(|color| ("geometry_tangent", color)));
        colors.extend(self.geometry_coat_normal.as_mut().map(|color| ("geometry_coat_normal", color)));
        let numbers = [
            ("base_weight", &mut self.base_weight, 1.0),
            ("base_diffuse_roughness", &mut self.base_diffuse_roughness, 1.0),
            ("base_metalness", &mut self.base_metalness, 1.0),
            ("specular_weight", &mut self.specular_weight, 1.0),
            ("specular_roughness", &mut self.specular_roughness, 1.0),
            ("specular_roughness_anisotropy", &mut self.specular_roughness_anisotropy, 1.0),
            ("transmission_weight", &mut self.transmission_weight, 1.0),
            ("subsurface_weight", &mut self.subsurface_weight, 1.0),
            ("coat_weight", &mut self.coat_weight, 1.0),
            ("coat_roughness", &mut self.coat_roughness, 1.0),
            ("fuzz_weight", &mut self.fuzz_weight, 1.0),
            ("fuzz_roughness", &mut self.fuzz_roughness, 1.0),
            ("thin_film_weight", &mut self.thin_film_weight, 1.0),
            ("thin_film_thickness", &mut self.thin_film_thickness, Self::MAX_FILM),
        ];
        (colors, numbers)
    }

    /// Its colours that are directions, by their keys.
    pub(crate) fn directions(&self) -> [(&'static str, Option<&Color>); 2] {
        [
            ("geometry_tangent", self.geometry_tangent.as_ref()),
            ("geometry_coat_normal", self.geometry_coat_normal.as_ref()),
        ]
    }

    /// The textures that it takes, by their keys.
    pub(crate) fn textures(&mut self) -> Named<'_> {
        let (colors, numbers) = self.parts();
        let colors = colors.into_iter().map(|(key, color)| (key, color.texture()));
        colors.chain(numbers.into_iter().map(|(key, number, _)| (key, number.texture()))).collect()
    }

    /// Whether highlights, or the coat, can have a direction.
    pub(crate) fn has_directions(&self) -> bool {
        self.specular_roughness_anisotropy.number() != Some(0.0) || self.geometry_coat_normal.is_some()
    }

    /// In which direction highlights are long, of unit length, in the surface's frame.
    fn long_axis(&self, textures: &impl Textures) -> Vec2 {
        let along_u = textures.u_axis();
        if self.specular_rotation == 0.0 && self.geometry_tangent.is_none() {
            return along_u;
        }
        let (sin, cos) = sin_cos_degrees(self.specular_rotation);
        let by_texture = self.geometry_tangent.as_ref().and_then(|map| {
            let [x, y, _] = map.share_at(textures).to_rgb();
            (2.0 * Vec2::new(x, y) - 1.0).try_normalize()
        });
        let turned = Vec2::new(cos, sin).rotate(by_texture.unwrap_or(Vec2::X));
        along_u.rotate(if textures.is_mirrored() { Vec2::new(turned.x, -turned.y) } else { turned })
    }

    /// How far the coat's normal is from that of the surface, in its frame.
    fn coat_tilt(&self, textures: &impl Textures) -> Vec2 {
        let Some(map) = &self.geometry_coat_normal else { return Vec2::ZERO };
        let strength = Vec3::new(self.geometry_coat_normal_strength, self.geometry_coat_normal_strength, 1.0);
        let n = (2.0 * Vec3::from(map.share_at(textures).to_rgb()) - 1.0) * strength;
        let n = textures.above_smooth(n.normalize_or(Vec3::Z));
        // Where it is on the other side of the surface, it is as steep as can be.
        n.with_z(n.z.max(0.05)).normalize().truncate()
    }

    /// The light that it sends out, if any.
    #[inline]
    pub(crate) fn emission(&self) -> Option<Emission<'_>> {
        let scale = self.emission_luminance / LUMENS_PER_WATT;
        (scale > 0.0).then_some(Emission { color: &self.emission_color, scale, two_sided: self.emission_two_sided })
    }

    /// Whether `transmission_color` is that of what is inside.
    fn is_filled(&self) -> bool {
        self.transmission_depth > 0.0 && self.transmission_color.rgb().is_some() && !self.geometry_thin_walled
    }

    /// What is left of light each time that it goes through the surface.
    fn left_at_surface(&self, textures: &impl Textures) -> Rgb {
        if self.is_filled() {
            return Rgb::grey(1.0);
        }
        let color = self.transmission_color.share_at(textures).to_rgb();
        // What has an inside is gone through twice.
        Rgb(if self.geometry_thin_walled { color } else { color.map(f32::sqrt) })
    }

    /// What is inside, if it is clear.
    pub(crate) fn filling(&self) -> Option<Filling> {
        let clear = self.transmission_weight.number() != Some(0.0) && !self.geometry_thin_walled;
        let color = self.transmission_color.rgb().filter(|_| self.is_filled()).unwrap_or(Rgb::grey(1.0));
        let dispersion = self.transmission_dispersion_scale / self.transmission_dispersion_abbe_number;
        clear.then(|| Filling { dispersion, ..Filling::of_color(color, self.transmission_depth, self.specular_ior, 0) })
    }

    #[inline(never)]
    pub(crate) fn bsdf(&self, textures: &impl Textures) -> PrincipledBsdf {
        let color = |color: &Color| color.share_at(textures);
        let number = |number: &Scalar| number.at(textures, 0.0, 1.0);
        let base = color(&self.base_color) * number(&self.base_weight);
        let matte = base.lerp(color(&self.subsurface_color), number(&self.subsurface_weight));
        let (specular, metalness) = (number(&self.specular_weight), number(&self.base_metalness));
        let transmission = number(&self.transmission_weight);
        let [clear, opaque] = [transmission, 1.0 - transmission].map(|share| (1.0 - metalness) * share);
        let (fuzz, thickness) = (number(&self.fuzz_weight), self.thin_film_thickness.at(textures, 0.0, Self::MAX_FILM));
        let [coat_weight, coat_roughness, roughness] =
            [&self.coat_weight, &self.coat_roughness, &self.specular_roughness].map(number);
        let coat = Coat {
            weight: coat_weight,
            roughness: coat_roughness,
            boundary: Boundary::new(coat_roughness * coat_roughness, self.coat_ior),
        };
        // Light that the coat sends back comes back from what is clear and from white as if there were no coat.
        let below = base * (metalness * specular) + matte * opaque + Spectrum::ONE * clear;
        let tint = coat.darkening(below, metalness * (1.0 - roughness), self.coat_darkening) * color(&self.coat_color);
        PrincipledBsdf {
            matte: Rgb((matte * opaque).to_rgb()),
            matte_roughness: number(&self.base_diffuse_roughness),
            metal_color: Rgb(base.to_rgb()),
            specular_color: Rgb(color(&self.specular_color).to_rgb()),
            metal: metalness * specular,
            opaque,
            clear,
            ggx: facets(coat.roughen(roughness), number(&self.specular_roughness_anisotropy)),
            eta: coat.eta_below(self.specular_ior, specular),
            x: self.long_axis(textures),
            eta_through: if self.geometry_thin_walled { 1.0 } else { self.specular_ior },
            is_thin: self.geometry_thin_walled,
            transmission: self.left_at_surface(textures),
            coat: coat.boundary,
            coat_weight,
            coat_tilt: if coat_weight > 0.0 { self.coat_tilt(textures) } else { Vec2::ZERO },
            coat_tint: Rgb(Spectrum::ONE.lerp(tint, coat_weight).to_rgb()),
            fuzz_color: Rgb((color(&self.fuzz_color) * fuzz).to_rgb()),
            fuzz_weight: fuzz,
            fuzz_roughness: number(&self.fuzz_roughness),
            film: ThinFilm { thickness: 1e3 * thickness, eta: self.thin_film_ior },
            film_weight: if thickness > 0.0 { number(&self.thin_film_weight) } else { 0.0 },
        }
    }
}

/// The base's facets.
fn facets(roughness: f32, anisotropy: f32) -> Ggx {
    if anisotropy == 0.0 {
        return Ggx::from_roughness(roughness);
    }
    // Alpha along is √(2 / (1 + narrow²)) roughness², and across narrow times that.
    let narrow = (1.0 - anisotropy).max(Ggx::MIN_ASPECT * Ggx::MIN_ASPECT);
    let alpha = roughness * roughness * (2.0 * narrow / (1.0 + narrow * narrow)).sqrt();
    let aspect = narrow.sqrt().max((Ggx::MIN_ALPHA / alpha.max(f32::MIN_POSITIVE)).min(1.0));
    Ggx::from_alpha(alpha).with_aspect(aspect)
}

/// The coat, and what it does to the base.
struct Coat {
    weight: f32,
    roughness: f32,
    boundary: Boundary,
}

impl Coat {
    /// The roughness of the base's facets: variances of slopes add up, of the coat's for the way in and the way out.
    fn roughen(&self, roughness: f32) -> f32 {
        if self.weight == 0.0 || self.roughness == 0.0 {
            return roughness;
        }
        let fourth = |x: f32| (x * x) * (x * x);
        let both = (fourth(roughness) + 2.0 * fourth(self.roughness)).min(1.0).sqrt().sqrt();
        roughness + self.weight * (both - roughness)
    }

    /// The index by which the base's facets reflect if they are not metal: over that of the coat, from the side where light is
    /// faster; and such that straight on the part `specular` of it is reflected.
    fn eta_below(&self, ior: f32, specular: f32) -> f32 {
        let eta = ior + self.weight * (ior / self.boundary.eta() - ior);
        let eta = eta.max(1.0 / eta);
        let amplitude = (eta - 1.0) / (eta + 1.0) * specular.sqrt();
        (1.0 + amplitude) / (1.0 - amplitude)
    }

    /// What is left of the light of a base of an albedo, (1 − K) / (1 − K albedo), where the share K goes back to the base: more
    /// of what is scattered than of what a mirror sends, which `mirror` of it is.
    fn darkening(&self, albedo: Spectrum, mirror: f32, amount: f32) -> Spectrum {
        if self.weight == 0.0 {
            return Spectrum::ONE;
        }
        let straight = self.boundary.fresnel(1.0);
        let back = self.boundary.mean_share_inside();
        let back = back + mirror * (straight - back);
        Spectrum::from_rgb(albedo.to_rgb().map(|albedo| 1.0 + amount * ((1.0 - back) / (1.0 - back * albedo) - 1.0)))
    }
}
