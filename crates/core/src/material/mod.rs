//! How surfaces scatter and emit light.
//!
//! A [`MaterialDesc`] is what a scene says; at a hit it becomes a [`Bsdf`], a small lobe of numbers with the triple
//! `sample`, `eval`, `pdf`. Directions are unit vectors in the surface's local frame (normal = +z) that point away
//! from the surface: `wo` to where light is going, `wi` to where it comes from.

mod bump;
mod charlie;
mod conductor;
mod dielectric;
mod diffuse_transmission;
mod emissive;
mod fresnel;
mod lambertian;
mod lost;
mod mask;
mod metal;
mod metals;
mod microfacet;
mod mix;
mod normal_map;
mod null;
mod oren_nayar;
mod plastic;
mod principled;
mod reflected;
mod sheen;
mod thin_dielectric;
mod thin_film;

use std::collections::BTreeMap;
use std::iter;

use glam::{Vec2, Vec3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::color::Spectrum;
use crate::desc::SceneDesc;
use crate::names::{self, Named, Nesting};
use crate::texture::{Color, Textures};
use crate::validate::Checker;

pub use bump::Bump;
pub use conductor::{Conductor, ConductorBsdf};
pub use dielectric::{Dielectric, DielectricBsdf};
pub use diffuse_transmission::{DiffuseTransmission, DiffuseTransmissionBsdf};
pub(crate) use emissive::Emission;
pub use emissive::Emissive;
pub use fresnel::{Fresnel, fresnel_conductor};
pub use lambertian::{Lambertian, LambertianBsdf};
pub use mask::Mask;
pub use metal::{Metal, MetalBsdf};
pub use metals::NamedMetal;
pub use microfacet::{Facet, Ggx};
pub use mix::Mix;
pub use normal_map::NormalMap;
pub use null::{Null, NullBsdf};
pub use oren_nayar::{OrenNayar, OrenNayarBsdf};
pub use plastic::{Plastic, PlasticBsdf};
pub use principled::{Principled, PrincipledBsdf};
pub use sheen::{Sheen, SheenBsdf};
pub use thin_dielectric::{ThinDielectric, ThinDielectricBsdf};
pub use thin_film::ThinFilm;

/// A material as a scene states it: `[material.NAME.KIND]`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum MaterialDesc {
    /// Matte.
    Lambertian(Lambertian),
    /// Matte and rough.
    OrenNayar(OrenNayar),
    /// A matte leaf, paper.
    DiffuseTransmission(DiffuseTransmission),
    /// Matte under a clear coat.
    Plastic(Plastic),
    /// Layers: fuzz, a coat, metal or glass or something matte.
    Principled(Box<Principled>),
    /// Velvet, cloth.
    Sheen(Sheen),
    /// Mirror to rough metal.
    Metal(Metal),
    /// Polished to rough metal, of facets.
    Conductor(Conductor),
    /// Glass, water, diamond, smooth or frosted.
    Dielectric(Dielectric),
    /// A pane of glass.
    ThinDielectric(ThinDielectric),
    /// A lamp.
    Emissive(Emissive),
    /// Nothing.
    Null(Null),
    /// One or the other.
    Mix(Mix),
    /// With holes.
    Mask(Mask),
    /// With normals from a texture.
    NormalMap(NormalMap),
    /// With a relief.
    Bump(Bump),
}

/// Notes what is wrong with materials, names that do not exist, and materials that are made of themselves.
pub(crate) fn check(materials: &BTreeMap<String, MaterialDesc>, textures: &Nesting<'_>, c: &mut Checker) {
    let words = ["material", "materials", "add one as [material.NAME.KIND]"];
    let parts = |material: &MaterialDesc| names::words(material.clone().parts());
    let named = materials.iter().map(|(name, material)| (name.as_str(), parts(material)));
    let mut nesting = Nesting::new(words, iter::once((SceneDesc::DEFAULT_MATERIAL, vec![])).chain(named));
    for (name, material) in materials {
        c.within(name, |c| {
            material.check(c);
            let mut material = material.clone();
            let (kind, names) = material.textures();
            textures.check_names(kind, names, c);
            nesting.check_names(kind, material.parts(), c);
            nesting.check(name, kind, c);
        });
    }
}

impl Default for MaterialDesc {
    /// Grey matte.
    fn default() -> Self {
        Self::Lambertian(Lambertian::default())
    }
}

impl MaterialDesc {
    pub(crate) fn check(&self, c: &mut Checker) {
        match self {
            Self::Lambertian(m) => c.within("lambertian", |c| m.check(c)),
            Self::OrenNayar(m) => c.within("oren-nayar", |c| m.check(c)),
            Self::DiffuseTransmission(m) => c.within("diffuse-transmission", |c| m.check(c)),
            Self::Plastic(m) => c.within("plastic", |c| m.check(c)),
            Self::Principled(m) => c.within("principled", |c| m.check(c)),
            Self::Sheen(m) => c.within("sheen", |c| m.check(c)),
            Self::Metal(m) => c.within("metal", |c| m.check(c)),
            Self::Conductor(m) => c.within("conductor", |c| m.check(c)),
            Self::Dielectric(m) => c.within("dielectric", |c| m.check(c)),
            Self::ThinDielectric(m) => c.within("thin-dielectric", |c| m.check(c)),
            Self::Emissive(m) => c.within("emissive", |c| m.check(c)),
            Self::Null(Null {}) => {}
            Self::Mix(m) => c.within("mix", |c| m.check(c)),
            Self::Mask(m) => c.within("mask", |c| m.check(c)),
            Self::NormalMap(m) => c.within("normal-map", |c| m.check(c)),
            Self::Bump(m) => c.within("bump", |c| m.check(c)),
        }
    }

    /// The lobe that scatters light at a point, where `textures` have the colours that they are asked for. Of what is made of
    /// other materials it is that of nothing.
    #[inline]
    pub fn bsdf(&self, textures: &impl Textures) -> Bsdf {
        if let Self::Lambertian(m) = self { Bsdf::Lambertian(m.bsdf(textures)) } else { self.any_bsdf(textures) }
    }

    /// Out of line: the room that long lobes take on the stack would cost the shortest one time.
    #[inline(never)]
    fn any_bsdf(&self, textures: &impl Textures) -> Bsdf {
        match self {
            Self::Lambertian(m) => Bsdf::Lambertian(m.bsdf(textures)),
            Self::OrenNayar(m) => Bsdf::OrenNayar(m.bsdf(textures)),
            Self::DiffuseTransmission(m) => Bsdf::DiffuseTransmission(m.bsdf(textures)),
            Self::Plastic(m) => Bsdf::Plastic(m.bsdf(textures)),
            Self::Principled(m) => Bsdf::Principled(m.bsdf(textures)),
            Self::Sheen(m) => Bsdf::Sheen(m.bsdf(textures)),
            Self::Metal(m) => Bsdf::Metal(m.bsdf(textures)),
            Self::Conductor(m) => Bsdf::Conductor(m.bsdf(textures)),
            Self::Dielectric(m) => Bsdf::Dielectric(m.bsdf(textures)),
            Self::ThinDielectric(m) => Bsdf::ThinDielectric(m.bsdf(textures)),
            Self::Emissive(m) => Bsdf::Lambertian(m.bsdf(textures)),
            Self::Null(_) | Self::Mix(_) | Self::Mask(_) | Self::NormalMap(_) | Self::Bump(_) => Bsdf::NOTHING,
        }
    }

    /// The key of its kind, and the textures that it takes, by their keys.
    pub(crate) fn textures(&mut self) -> (&'static str, Named<'_>) {
        match self {
            Self::Lambertian(m) => ("lambertian", vec![("albedo", m.albedo.texture())]),
            Self::OrenNayar(m) => {
                ("oren-nayar", vec![("albedo", m.albedo.texture()), ("roughness", m.roughness.texture())])
            }
            Self::DiffuseTransmission(m) => (
                "diffuse-transmission",
                vec![("reflectance", m.reflectance.texture()), ("transmittance", m.transmittance.texture())],
            ),
            Self::Plastic(m) => ("plastic", vec![("albedo", m.albedo.texture()), ("roughness", m.roughness.texture())]),
            Self::Principled(m) => ("principled", m.textures()),
            Self::Sheen(m) => (
                "sheen",
                vec![
                    ("color", m.color.texture()),
                    ("roughness", m.roughness.texture()),
                    ("albedo", m.albedo.texture()),
                ],
            ),
            Self::Metal(m) => ("metal", vec![("albedo", m.albedo.texture()), ("roughness", m.roughness.texture())]),
            Self::Conductor(m) => (
                "conductor",
                vec![
                    ("reflectance", m.reflectance.as_mut().and_then(Color::texture)),
                    ("roughness", m.roughness.texture()),
                ],
            ),
            Self::Dielectric(m) => ("dielectric", vec![("roughness", m.roughness.texture())]),
            Self::ThinDielectric(m) => ("thin-dielectric", vec![("color", m.color.texture())]),
            Self::Emissive(m) => ("emissive", vec![("radiance", m.radiance.texture()), ("albedo", m.albedo.texture())]),
            Self::Null(_) => ("null", vec![]),
            Self::Mix(m) => ("mix", vec![("share", m.share.texture())]),
            Self::Mask(m) => ("mask", vec![("opacity", m.opacity.texture())]),
            Self::NormalMap(m) => ("normal-map", vec![("map", m.map.texture())]),
            Self::Bump(m) => ("bump", vec![("height", m.height.texture())]),
        }
    }

    /// The materials that it is made of, by their keys.
    pub(crate) fn parts(&mut self) -> Named<'_> {
        match self {
            Self::Mix(m) => vec![("a", Some(&mut m.a)), ("b", Some(&mut m.b))],
            Self::Mask(m) => vec![("of", Some(&mut m.of))],
            Self::NormalMap(m) => vec![("of", Some(&mut m.of))],
            Self::Bump(m) => vec![("of", Some(&mut m.of))],
            _ => vec![],
        }
    }

    /// Whether highlights or coats have a direction, so that it matters how coordinates lie on the shape.
    pub(crate) fn has_directions(&self) -> bool {
        match self {
            Self::Conductor(m) => m.anisotropy > 0.0,
            Self::Principled(m) => m.has_directions(),
            _ => false,
        }
    }

    /// How it shines, if it does.
    #[inline]
    pub(crate) fn emission(&self) -> Option<Emission<'_>> {
        match self {
            Self::Emissive(m) => Some(m.emission()),
            Self::Principled(m) => m.emission(),
            _ => None,
        }
    }

    /// Radiance that the surface itself sends along `wo`.
    #[inline]
    pub fn le(&self, wo: Vec3, textures: &impl Textures) -> Spectrum {
        self.emission().map_or(Spectrum::BLACK, |emission| emission.le(wo, textures))
    }
}

/// A scattering lobe.
#[derive(Clone, Copy, Debug)]
pub enum Bsdf {
    /// See [`Lambertian`].
    Lambertian(LambertianBsdf),
    /// See [`OrenNayar`].
    OrenNayar(OrenNayarBsdf),
    /// See [`DiffuseTransmission`].
    DiffuseTransmission(DiffuseTransmissionBsdf),
    /// See [`Plastic`].
    Plastic(PlasticBsdf),
    /// See [`Principled`].
    Principled(PrincipledBsdf),
    /// See [`Sheen`].
    Sheen(SheenBsdf),
    /// See [`Metal`].
    Metal(MetalBsdf),
    /// See [`Conductor`].
    Conductor(ConductorBsdf),
    /// See [`Dielectric`].
    Dielectric(DielectricBsdf),
    /// See [`ThinDielectric`].
    ThinDielectric(ThinDielectricBsdf),
    /// See [`Null`].
    Null(NullBsdf),
}

/// A direction drawn from a lobe.
#[derive(Clone, Copy, Debug)]
pub struct BsdfSample {
    /// Where the light comes from.
    pub wi: Vec3,
    /// f · |cos θ| / pdf: the factor on the light that comes from there.
    pub weight: Spectrum,
    /// Density of `wi` per solid angle (1/sr); for a delta lobe the chance of this branch.
    pub pdf: f32,
    /// Whether `wi` is one of finitely many directions, which [`Bsdf::pdf`] knows nothing of.
    pub delta: bool,
    /// By what the index of refraction changes along the path: that on the side of `wi` over that on the side of `wo`;
    /// 1 for reflection. `weight` eta² is a share of energy, at most 1.
    pub eta: f32,
}

impl BsdfSample {
    /// A direction of which the lobe says `eval` and `pdf`; none if no light comes from there.
    #[inline]
    fn of_eval(wi: Vec3, (eval, pdf): (Spectrum, f32)) -> Option<Self> {
        (!eval.is_black()).then(|| Self { wi, weight: eval * (1.0 / pdf), pdf, delta: false, eta: 1.0 })
    }
}

impl Bsdf {
    /// That of a surface that is not there.
    pub const NOTHING: Self = Self::Null(NullBsdf);

    /// Puts it between other indices of refraction: that inside over that outside.
    pub(crate) fn set_eta(&mut self, eta: f32) {
        if let Self::Dielectric(b) = self {
            b.set_eta(eta);
        }
    }

    /// Makes its inside that of one wavelength: an index of refraction `bend` times as large, and what is bent is of a colour, of which
    /// the mean over all wavelengths is white.
    pub(crate) fn disperse(&mut self, bend: f32, color: Spectrum) {
        match self {
            Self::Dielectric(b) => b.disperse(bend, color),
            Self::Principled(b) => b.disperse(bend, color),
            _ => {}
        }
    }

    /// Draws `wi` for a `wo`; none if the light is absorbed.
    #[inline(always)]
    pub fn sample(&self, wo: Vec3, uc: f32, u: Vec2) -> Option<BsdfSample> {
        match self {
            Self::Lambertian(b) => b.sample(wo, u),
            Self::OrenNayar(b) => b.sample(wo, uc, u),
            Self::DiffuseTransmission(b) => b.sample(wo, uc, u),
            Self::Plastic(b) => b.sample(wo, uc, u),
            Self::Principled(b) => b.sample(wo, uc, u),
            Self::Sheen(b) => b.sample(wo, uc, u),
            Self::Metal(b) => b.sample(wo, uc, u),
            Self::Conductor(b) => b.sample(wo, uc, u),
            Self::Dielectric(b) => b.sample(wo, uc, u),
            Self::ThinDielectric(b) => b.sample(wo, uc),
            Self::Null(NullBsdf) => Some(NullBsdf::sample(wo)),
        }
    }

    /// [`eval`](Self::eval) and [`pdf`](Self::pdf) at once.
    #[inline]
    pub fn eval_pdf(&self, wo: Vec3, wi: Vec3) -> (Spectrum, f32) {
        match self {
            Self::Lambertian(b) => b.eval_pdf(wo, wi),
            Self::OrenNayar(b) => b.eval_pdf(wo, wi),
            Self::DiffuseTransmission(b) => b.eval_pdf(wo, wi),
            Self::Plastic(b) => b.eval_pdf(wo, wi),
            Self::Principled(b) => b.eval_pdf(wo, wi),
            Self::Sheen(b) => b.eval_pdf(wo, wi),
            Self::Metal(b) => b.eval_pdf(wo, wi),
            Self::Conductor(b) => b.eval_pdf(wo, wi),
            Self::Dielectric(b) => b.eval_pdf(wo, wi),
            Self::ThinDielectric(_) | Self::Null(_) => (Spectrum::BLACK, 0.0),
        }
    }

    /// The BSDF times |cos θ| of `wi`; 0 for delta lobes.
    #[inline]
    pub fn eval(&self, wo: Vec3, wi: Vec3) -> Spectrum {
        self.eval_pdf(wo, wi).0
    }

    /// The density per solid angle with which [`sample`](Self::sample) draws `wi`; 0 for delta lobes.
    #[inline]
    pub fn pdf(&self, wo: Vec3, wi: Vec3) -> f32 {
        self.eval_pdf(wo, wi).1
    }

    /// About the share of light from straight above that is scattered, to either side, whatever the roughness; 1 for
    /// what is clear.
    pub fn albedo(&self) -> Spectrum {
        match self {
            Self::Lambertian(b) => b.albedo,
            Self::OrenNayar(b) => b.albedo(),
            Self::DiffuseTransmission(b) => b.albedo(),
            Self::Plastic(b) => b.albedo(),
            Self::Principled(b) => b.albedo(),
            Self::Sheen(b) => b.albedo(),
            Self::Metal(b) => b.albedo(),
            Self::Conductor(b) => b.albedo(),
            Self::Dielectric(_) | Self::ThinDielectric(_) | Self::Null(_) => Spectrum::ONE,
        }
    }

    /// Whether all samples are delta, so that `eval` and `pdf` are 0 everywhere.
    #[inline]
    pub fn is_delta(&self) -> bool {
        match self {
            Self::Lambertian(_)
            | Self::OrenNayar(_)
            | Self::DiffuseTransmission(_)
            | Self::Plastic(_)
            | Self::Sheen(_) => false,
            Self::Principled(b) => b.is_delta(),
            Self::Metal(b) => b.is_delta(),
            Self::Conductor(b) => b.is_delta(),
            Self::Dielectric(b) => b.is_delta(),
            Self::ThinDielectric(_) | Self::Null(_) => true,
        }
    }
}
