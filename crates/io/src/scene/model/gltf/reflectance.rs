//! What surfaces that are not metal reflect straight on: `KHR_materials_ior`, `KHR_materials_specular`, and
//! `KHR_materials_pbrSpecularGlossiness`, the way of saying it before metals.
//!
//! Up to a quarter it is that of an index of refraction, F = ((n − 1) / (n + 1))². What reflects more is partly metal.

use eyebeam_core::color::Rgb;
use eyebeam_core::material::{MaterialDesc, Mix, Principled};
use eyebeam_core::texture::{Color, Encoding, Interpolation, Invert, Multiply, Scalar, TextureDesc};

use crate::scene::model::gltf::document::TextureInfo;
use crate::scene::model::gltf::extensions::{Ior, Specular, SpecularGlossiness, Transmission};
use crate::scene::model::gltf::material::{Maker, bounded, scalar};

/// Straight on, of the largest index.
const MOST: f32 = 0.25;
const LARGEST_INDEX: f32 = 3.0;

/// A part of a surface that is metal, and its colour.
pub(super) struct Mirror {
    share: Scalar,
    color: Color,
}

impl Maker<'_, '_> {
    /// `KHR_materials_pbrSpecularGlossiness`.
    pub(super) fn gloss(&mut self, p: &mut Principled) {
        let Some(old): Option<SpecularGlossiness> = self.extension("KHR_materials_pbrSpecularGlossiness") else {
            return;
        };
        p.base_metalness = 0.0.into();
        let (texture, factor) = (old.specular_glossiness_texture.as_ref(), old.glossiness_factor.unwrap_or(1.0));
        self.reflects(p, old.specular_factor.unwrap_or([1.0; 3]), texture);
        p.specular_roughness = match self.alpha_times(texture, factor, "gloss") {
            Scalar::Number(gloss) => (1.0 - gloss).into(),
            Scalar::Texture(gloss) => {
                let input = Color::Texture(gloss);
                Scalar::Texture(self.texture("roughness", TextureDesc::Invert(Invert { input })))
            }
        };
    }

    /// `KHR_materials_ior` and `KHR_materials_specular`, which metal does not heed.
    pub(super) fn specular(&mut self, p: &mut Principled) {
        if p.base_metalness.number() == Some(1.0) {
            return;
        }
        let Ior { ior } = self.extension("KHR_materials_ior").unwrap_or_default();
        let ior = ior.unwrap_or(1.5);
        // Once nothing but what `specular` says: as if the index were endless.
        let is_endless = ior == 0.0;
        p.specular_ior = if is_endless { LARGEST_INDEX } else { bounded(ior, 1.0, LARGEST_INDEX) };
        if !is_endless && p.specular_ior != ior {
            self.warn(&format!("its index of refraction {ior} is taken as {}", p.specular_ior));
        }
        let specular: Option<Specular> = self.extension("KHR_materials_specular");
        if specular.is_none() && !is_endless {
            return;
        }
        let specular = specular.unwrap_or_default();
        let factor = specular.specular_factor.unwrap_or(1.0);
        p.specular_weight = self.alpha_times(specular.specular_texture.as_ref(), factor, "specular");
        let (color, info) =
            (specular.specular_color_factor.unwrap_or([1.0; 3]), specular.specular_color_texture.as_ref());
        let is_clear =
            self.extension("KHR_materials_transmission").is_some_and(|t: Transmission| t.transmission_factor > 0.0);
        let is_bright = is_endless || color.iter().any(|c| *c > 1.0);
        if is_bright && !is_clear {
            let root = (p.specular_ior - 1.0) / (p.specular_ior + 1.0);
            let straight = if is_endless { 1.0 } else { root * root };
            self.reflects(p, color.map(|c| c * straight), info);
            return;
        }
        if is_bright {
            self.warn("what is clear reflects no more than its index of refraction says");
        }
        p.specular_color = self.color(info, color, Encoding::Auto, "specular-color");
    }

    /// Makes it reflect so much straight on, times a texture.
    fn reflects(&mut self, p: &mut Principled, reflectance: [f32; 3], info: Option<&TextureInfo>) {
        let reflectance = reflectance.map(|r| bounded(r, 0.0, 1.0));
        let brightest = reflectance.into_iter().fold(0.0, f32::max);
        let color = reflectance.map(|r| if brightest > 0.0 { r / brightest } else { 0.0 });
        let color = self.color(info, color, Encoding::Auto, "specular-color");
        if brightest <= MOST {
            let root = brightest.sqrt();
            p.specular_ior = (1.0 + root) / (1.0 - root);
            p.specular_color = color;
            return;
        }
        p.specular_ior = LARGEST_INDEX;
        let (share, color) = if color.rgb().is_some() {
            p.specular_color = color.clone();
            (((brightest - MOST) / (1.0 - MOST)).into(), color)
        } else {
            // What no index reflects is metal.
            let all = self.product("reflectance", color, Rgb::grey(brightest).into());
            let most = Multiply { a: all.clone(), b: Rgb::grey(1.0 / MOST).into() };
            p.specular_color = Color::Texture(self.texture("reflectance.of-most", TextureDesc::Multiply(most)));
            let stops = [(0.0, 0.0), (MOST, 1.0)];
            (self.ramp("reflectance.metal", scalar(all.clone()), &stops, Interpolation::Constant), all)
        };
        self.mirror = Some(Mirror { share, color });
    }

    /// The material. What `specular` says does not hold for the part of it that is metal.
    pub(super) fn partly_metal(&mut self, p: Principled) -> MaterialDesc {
        let white = Color::from(Rgb::grey(1.0));
        let is_plain = self.mirror.is_none() && p.specular_weight.number() == Some(1.0) && p.specular_color == white;
        let share = p.base_metalness.clone();
        if is_plain || share.number() == Some(0.0) {
            return self.mirrored(p);
        }
        let metal =
            Principled { base_metalness: 1.0.into(), specular_weight: 1.0.into(), specular_color: white, ..p.clone() };
        let other = self.mirrored(Principled { base_metalness: 0.0.into(), ..p });
        let a = self.part("base", other);
        let b = self.part("metal", MaterialDesc::Principled(Box::new(metal)));
        MaterialDesc::Mix(Mix { a, b, share })
    }

    /// Of which a part reflects as metal does.
    fn mirrored(&mut self, p: Principled) -> MaterialDesc {
        let Some(Mirror { share, color }) = self.mirror.take() else { return MaterialDesc::Principled(Box::new(p)) };
        let metal = Principled {
            base_color: color,
            base_metalness: 1.0.into(),
            specular_color: Rgb::grey(1.0).into(),
            ..p.clone()
        };
        let a = self.part("dielectric", MaterialDesc::Principled(Box::new(p)));
        let b = self.part("mirror", MaterialDesc::Principled(Box::new(metal)));
        MaterialDesc::Mix(Mix { a, b, share })
    }
}
