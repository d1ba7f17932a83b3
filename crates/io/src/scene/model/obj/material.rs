//! What materials of a library become: [`Principled`].
//!
//! Colours are linear, pictures of colours sRGB unless they hold light; amounts in pictures are linear.
//!
//! - `Kd` and `map_Kd` are the base colour, their product if there are both; a black `Kd` leaves the picture alone, since some
//!   programs write it so.
//! - `Ks`: the largest channel weighs the specular lobe of index `Ni` (1.5), the rest is its colour; `map_Ks` takes the place of both.
//!   None with `illum` 0 and 1, and whole if there is anything of the extension for PBR.
//! - `Ns` is an exponent of Phong's: alpha = √(2 / (Ns + 2)), roughness = √alpha. Walter et al. 2007, "Microfacet Models for
//!   Refraction through Rough Surfaces", doi:10.2312/EGWR/EGSR07/195-206, §5.2. `Pr` is the roughness itself.
//! - `illum` 3 and 5 with a `Ks` brighter than `Kd`: metal of the colour `Ks`, polished if there is no `Ns`.
//! - `illum` 4, 6, 7 and 9: clear by 1 − `d`; 6 and 7 all clear if `d` is 1 and `Kd` about black. `Tf` is the colour of
//!   what goes through; without an index but 1 it is a sheet.
//! - `d` else, times `map_d`: the share of the surface that is there ([`Mask`]); of a picture its alpha, if it has any, as in Blender, and
//!   else how bright it is, as in three.js. 0 leaves the picture alone, as a black `Kd` does.
//! - `Ke`, `map_Ke`: radiance, on the side of the normal.
//! - `bump`, `map_Bump`: heights, `-bm` centimetres from black to white; `norm`: normals as of OpenGL, `-bm` their strength. Blender
//!   writes these as `map_Bump`, too: what [looks like normals](are_normals) is taken as such.
//! - `Pm` metalness, `Ps` fuzz, `Pc` and `Pcr` coat and its roughness, `aniso` anisotropy, turned by `anisor` of a whole turn; `map_Pr`, `map_Pm` and `map_Ps` take their
//!   places.

use eyebeam_core::color::{LUMENS_PER_WATT, Rgb};
use eyebeam_core::film::Wrap;
use eyebeam_core::material::{Bump, Mask, MaterialDesc, NormalMap, Principled};
use eyebeam_core::names::Name;
use eyebeam_core::texture::{ChannelOf, Color, Encoding, ImageTexture, Mapping, Multiply, Scalar, TextureDesc};

use super::mtl::{Map, Mtl, Part};
use super::pictures::{Pictures, are_normals};
use crate::scene::model::Model;
use crate::warning::Warning;

/// `Kd` of glass is no brighter.
const ABOUT_BLACK: f32 = 0.05;

/// Adds a material and its textures; the name that meshes are to use.
pub(super) fn add(name: &str, mtl: &Mtl, pictures: &mut Pictures<'_>, model: &mut Model) -> String {
    let mut maker = Maker { name, mtl, pictures, model };
    let mut principled = Box::<Principled>::default();
    let is_clear = maker.lobes(&mut principled);
    maker.extension(&mut principled);
    maker.emission(&mut principled);
    let mut layers = vec![MaterialDesc::Principled(principled)];
    layers.extend(maker.relief());
    let opacity = maker.opacity(is_clear);
    if opacity.number() != Some(1.0) {
        layers.push(MaterialDesc::Mask(Mask::new(Name::new(""), opacity)));
    }
    let mut below = String::new();
    let count = layers.len();
    for (i, mut layer) in layers.into_iter().enumerate() {
        match &mut layer {
            MaterialDesc::NormalMap(NormalMap { of, .. })
            | MaterialDesc::Bump(Bump { of, .. })
            | MaterialDesc::Mask(Mask { of, .. }) => *of = Name::new(&below),
            _ => {}
        }
        below = if i + 1 == count { name.to_owned() } else { format!("{name} (layer {i})") };
        while model.desc.material.contains_key(&below) {
            below.push('\'');
        }
        model.desc.material.insert(below.clone(), layer);
    }
    below
}

struct Maker<'a, 'f> {
    name: &'a str,
    mtl: &'a Mtl,
    pictures: &'a mut Pictures<'f>,
    model: &'a mut Model,
}

impl Maker<'_, '_> {
    /// A number of the library in 0..`most`.
    fn number(&self, key: &str, default: f32, most: f32) -> f32 {
        self.mtl.numbers.get(key).map_or(default, |number| number.clamp(0.0, most))
    }

    /// A colour of the library, 0..1 in each channel.
    fn color(&self, key: &str) -> Option<[f32; 3]> {
        self.mtl.colors.get(key).map(|color| color.map(|c| c.clamp(0.0, 1.0)))
    }

    /// The name of a picture as a texture.
    fn picture(&mut self, key: &str, encoding: Encoding) -> Option<String> {
        let image = self.image(key, encoding)?;
        Some(self.texture(key, TextureDesc::Image(image)))
    }

    fn image(&mut self, key: &str, encoding: Encoding) -> Option<ImageTexture> {
        let map = self.mtl.maps.get(key)?;
        let (path, pixels) = self.pictures.get(&self.mtl.folder, &map.file, &mut self.model.warnings)?;
        Some(ImageTexture {
            encoding,
            wrap: if map.clamp { Wrap::Clamp } else { Wrap::Repeat },
            mapping: Mapping { scale: map.scale, offset: map.offset, ..Mapping::default() },
            ..ImageTexture::new(&path.display().to_string(), Some(pixels))
        })
    }

    fn texture(&mut self, key: &str, texture: TextureDesc) -> String {
        let mut name = format!("{} {key}", self.name);
        while self.model.desc.texture.contains_key(&name) {
            name.push('\'');
        }
        self.model.desc.texture.insert(name.clone(), texture);
        name
    }

    /// A picture of amounts.
    fn amount(&mut self, key: &str) -> Option<Scalar> {
        let image = self.image(key, Encoding::Linear)?;
        Some(self.amount_of(key, image))
    }

    fn amount_of(&mut self, key: &str, mut image: ImageTexture) -> Scalar {
        let part = self.mtl.maps.get(key).and_then(|map| map.channel);
        // Opaque pictures have lost their alpha.
        let has_alpha = image.pixels.as_ref().is_some_and(|pixels| pixels.channels().is_multiple_of(2));
        image.alpha = part == Some(Part::Alpha) || part.is_none() && key == "d" && has_alpha;
        let mut name = Name::new(&self.texture(key, TextureDesc::Image(image)));
        if let Some(Part::Color(channel)) = part {
            let part = ChannelOf { input: Color::Texture(name), channel };
            name = Name::new(&self.texture(&format!("{key} channel"), TextureDesc::Channel(part)));
        }
        Scalar::Texture(name)
    }

    /// What turns normals, without its material.
    fn relief(&mut self) -> Option<MaterialDesc> {
        let strength = |map: &Map| map.bump.clamp(-100.0, 100.0);
        let turned = |map: String, strength| {
            let map = Color::Texture(Name::new(&map));
            Some(MaterialDesc::NormalMap(NormalMap { of: Name::new(""), map, strength }))
        };
        let [norm, bump] = ["norm", "bump"].map(|key| self.mtl.maps.get(key));
        if let Some(norm) = norm
            && let Some(map) = self.picture("norm", Encoding::Linear)
        {
            if bump.is_some_and(|bump| bump.file != norm.file) {
                self.warn("its `bump` is not used beside its `norm`");
            }
            return turned(map, strength(norm));
        }
        let (bump, image) = (bump?, self.image("bump", Encoding::Linear)?);
        if bump.channel.is_none() && image.pixels.as_ref().is_some_and(|pixels| are_normals(pixels)) {
            return turned(self.texture("bump", TextureDesc::Image(image)), strength(bump));
        }
        let (height, scale) = (self.amount_of("bump", image), 0.01 * bump.bump.clamp(-1e4, 1e4));
        Some(MaterialDesc::Bump(Bump { of: Name::new(""), height, scale }))
    }

    /// The share that is there.
    fn opacity(&mut self, is_clear: bool) -> Scalar {
        let share = if is_clear { 1.0 } else { self.number("d", 1.0, 1.0) };
        match self.amount("d") {
            None => Scalar::Number(share),
            Some(Scalar::Texture(map)) if share > 0.0 && share < 1.0 => {
                let product = Multiply { a: Color::Texture(map), b: Color::Rgb(Rgb::grey(share)) };
                Scalar::Texture(Name::new(&self.texture("d times", TextureDesc::Multiply(product))))
            }
            Some(map) => map,
        }
    }

    fn warn(&mut self, message: &str) {
        self.model.warnings.push(Warning::new(message).part(format!("material `{}`", self.name)));
    }

    /// A picture times a colour; a black or a white one leaves it as it is.
    fn tinted(&mut self, key: &str, tint: Option<[f32; 3]>) -> Option<Color> {
        let picture = Color::Texture(Name::new(&self.picture(key, Encoding::Auto)?));
        match tint.filter(|tint| *tint != [0.0; 3] && *tint != [1.0; 3]) {
            None => Some(picture),
            Some(tint) => {
                let product = Multiply { a: picture, b: Color::Rgb(Rgb(tint)) };
                let name = self.texture(&format!("{key} tinted"), TextureDesc::Multiply(product));
                Some(Color::Texture(Name::new(&name)))
            }
        }
    }

    /// The base, the specular lobe and what goes through; whether it is clear.
    fn lobes(&mut self, p: &mut Principled) -> bool {
        let illum = self.mtl.illum();
        let (kd, ks) = (self.color("Kd"), self.color("Ks"));
        if let Some(kd) = kd {
            p.base_color = Color::Rgb(Rgb(kd));
        }
        let picture = self.tinted("kd", kd);
        let has_picture = picture.is_some();
        if let Some(picture) = picture {
            p.base_color = picture;
        }
        let shininess = self.mtl.numbers.get("Ns").map(|ns| ns.clamp(0.0, 1e9));
        if let Some(ns) = shininess {
            p.specular_roughness = Scalar::Number((2.0 / (ns + 2.0)).sqrt().sqrt());
        }
        let [kd, ks] = [kd, ks].map(Option::unwrap_or_default);
        let has_gloss = !matches!(illum, Some(0 | 1));
        if !self.mtl.is_pbr() {
            let weight = if has_gloss { most(ks) } else { 0.0 };
            p.specular_weight = Scalar::Number(weight);
            if weight > 0.0 {
                p.specular_color = Color::Rgb(Rgb(ks.map(|c| c / weight)));
            }
            if has_gloss && let Some(map) = self.tinted("ks", Some(ks)) {
                p.specular_weight = Scalar::Number(1.0);
                p.specular_color = map;
            }
        }
        let index = self.mtl.numbers.get("Ni").copied();
        if let Some(index) = index.filter(|index| *index > 1.0) {
            p.specular_ior = index.min(3.0);
        }
        if matches!(illum, Some(3 | 5)) && !has_picture && Rgb(ks).luminance() > Rgb(kd).luminance() {
            p.base_metalness = Scalar::Number(1.0);
            p.base_color = Color::Rgb(Rgb(ks));
            p.specular_color = Color::Rgb(Rgb::grey(1.0));
            p.specular_weight = Scalar::Number(1.0);
            if shininess.is_none() {
                p.specular_roughness = Scalar::Number(0.0);
            }
        }
        let opacity = self.number("d", 1.0, 1.0);
        let is_dark = !has_picture && most(kd) <= ABOUT_BLACK;
        let is_clear = match illum {
            _ if self.mtl.maps.contains_key("d") => false,
            Some(6 | 7) => opacity < 1.0 || is_dark,
            Some(4 | 9) => opacity < 1.0,
            _ => false,
        };
        let filter = self.color("Tf");
        if !is_clear && filter.is_some_and(|filter| filter != [0.0; 3] && filter != [1.0; 3]) {
            self.warn("its `Tf` is not used: it is not clear");
        }
        if is_clear {
            p.transmission_weight = Scalar::Number(if opacity < 1.0 { 1.0 - opacity } else { 1.0 });
            p.specular_weight = Scalar::Number(1.0);
            p.specular_color = Color::Rgb(Rgb::grey(1.0));
            p.geometry_thin_walled = index.is_none_or(|index| index <= 1.0);
            if let Some(filter) = filter.filter(|filter| *filter != [0.0; 3]) {
                p.transmission_color = Color::Rgb(Rgb(filter));
            }
            if shininess.is_none() {
                p.specular_roughness = Scalar::Number(0.0);
            }
        }
        is_clear
    }

    /// The extension for PBR.
    fn extension(&mut self, p: &mut Principled) {
        let parts = [
            ("Pr", "pr", &mut p.specular_roughness),
            ("Pm", "pm", &mut p.base_metalness),
            ("Ps", "ps", &mut p.fuzz_weight),
            ("Pc", "", &mut p.coat_weight),
            ("Pcr", "", &mut p.coat_roughness),
            ("aniso", "", &mut p.specular_roughness_anisotropy),
        ];
        for (key, map, part) in parts {
            if self.mtl.numbers.contains_key(key) {
                *part = Scalar::Number(self.number(key, 0.0, 1.0));
            }
            if let Some(picture) = self.amount(map) {
                *part = picture;
            }
        }
        p.specular_rotation = 360.0 * self.number("anisor", 0.0, 1.0);
    }

    /// The light that it sends out.
    fn emission(&mut self, p: &mut Principled) {
        let ke = self.mtl.colors.get("Ke").map(|color| color.map(|c| c.clamp(0.0, 1e6)));
        let strongest = most(ke.unwrap_or_default());
        let color = if strongest > 0.0 { ke.unwrap_or_default().map(|c| c / strongest) } else { [1.0; 3] };
        let picture = self.tinted("ke", Some(color));
        let radiance = if strongest > 0.0 || picture.is_none() { strongest } else { 1.0 };
        p.emission_luminance = (radiance * LUMENS_PER_WATT).min(1e9);
        p.emission_color = picture.unwrap_or(Color::Rgb(Rgb(color)));
    }
}

/// The largest channel.
fn most(color: [f32; 3]) -> f32 {
    color.into_iter().fold(0.0, f32::max)
}
