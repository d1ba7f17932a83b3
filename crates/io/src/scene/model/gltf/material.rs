//! Materials of glTF as [`Principled`], which is what most of their extensions were made after.
//!
//! | glTF | principled |
//! |---|---|
//! | base colour, metallic, roughness | base_color, base_metalness, specular_roughness |
//! | clearcoat | coat, with normals of its own |
//! | sheen | fuzz, of the weight of its brightest channel |
//! | transmission | transmission; a sheet (thin-walled) unless there is a volume |
//! | volume | transmission_color at transmission_depth, with the base colour over its thickness |
//! | dispersion | transmission_dispersion |
//! | specular, ior | specular_weight, specular_color, specular_ior; partly metal where it reflects more than a quarter |
//! | iridescence | thin_film |
//! | anisotropy | specular_roughness_anisotropy, specular_rotation, geometry_tangent |
//! | emissive, emissive_strength | emission |
//! | diffuse transmission | mixed with `diffuse-transmission`, which has no gloss |
//! | normal texture | `normal-map` |
//! | alphaMode MASK, BLEND | `mask` |
//! | doubleSided | a `mask` that is one-sided, if it is absent and the mesh is open: else nobody sees its back |
//! | unlit | a lamp of this radiance |
//!
//! Occlusion is computed by light and not read.

use std::collections::BTreeMap;

use eyebeam_core::color::{LUMENS_PER_WATT, Rgb};
use eyebeam_core::desc::SceneDesc;
use eyebeam_core::material::{DiffuseTransmission, Emissive, Mask, MaterialDesc, Mix, NormalMap, Principled};
use eyebeam_core::names::Name;
use eyebeam_core::texture::{
    Channel, ChannelOf, Color, Encoding, Interpolation, Multiply, Ramp, Scalar, Stop, TextureDesc, VertexColor,
};
use serde::de::DeserializeOwned;

use crate::scene::model::gltf::directions::CLEARCOAT;
use crate::scene::model::gltf::document::{Document, Material, TextureInfo};
use crate::scene::model::gltf::extensions::{
    Clearcoat, Dispersion, EmissiveStrength, Iridescence, Leaf, Sheen, SpecularGlossiness, Transmission, Volume,
};
use crate::scene::model::gltf::reflectance::Mirror;
use crate::scene::model::gltf::texture::Pictures;
use crate::warning::Warning;

/// Makes materials where they are first used.
pub(super) struct Materials<'a> {
    pub(super) document: &'a Document,
    pub(super) pictures: &'a Pictures,
    /// The file's name.
    pub(super) file: &'a str,
    /// Names by the index of a material, and what vertices say.
    names: BTreeMap<(Option<usize>, Painted), String>,
    /// How many there are of a name.
    counts: BTreeMap<String, usize>,
    /// The fronts of those that have one side.
    fronts: BTreeMap<String, String>,
}

/// What a mesh says to materials.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Painted {
    /// Whether its vertices have colours.
    pub(super) colors: bool,
    /// Whether they have alphas.
    pub(super) alphas: bool,
    /// Whether what shines does so to both sides: it is open.
    pub(super) both_sides: bool,
}

impl<'a> Materials<'a> {
    pub(super) fn new(document: &'a Document, pictures: &'a Pictures, file: &'a str) -> Self {
        Self { document, pictures, file, names: BTreeMap::new(), counts: BTreeMap::new(), fronts: BTreeMap::new() }
    }

    /// The name of a material, of the default one if there is no index, that is in the scene now.
    pub(super) fn name(
        &mut self,
        index: Option<usize>,
        painted: Painted,
        desc: &mut SceneDesc,
        warnings: &mut Vec<Warning>,
    ) -> String {
        let (index, missing) = match index {
            Some(index) if index >= self.document.materials.len() => (None, Some(index)),
            index => (index, None),
        };
        let no_such = |index| Warning::new("there is no such material").part(format!("material {index}"));
        warnings.extend(missing.map(no_such));
        if let Some(known) = self.names.get(&(index, painted)) {
            return known.clone();
        }
        let default = Material::default();
        let material = index.and_then(|i| self.document.materials.get(i)).unwrap_or(&default);
        let mut name = if material.name.is_empty() { "material".to_owned() } else { material.name.clone() };
        let count = self.counts.entry(name.clone()).or_insert(1);
        let base = name.clone();
        while desc.material.contains_key(&name) {
            *count += 1;
            name = format!("{base}-{count}");
        }
        Maker { all: self, material, name: &name, painted, mirror: None, desc, warnings }.make();
        self.names.insert((index, painted), name.clone());
        name
    }

    /// The name of the front of a material, that is in the scene now.
    pub(super) fn front(&mut self, desc: &mut SceneDesc, of: &str) -> String {
        let front = || {
            let mask = MaterialDesc::Mask(Mask::one_sided(Name::new(of)));
            insert(&mut desc.material, format!("{of}.front"), mask)
        };
        self.fronts.entry(of.to_owned()).or_insert_with(front).clone()
    }
}

impl Material {
    /// Whether parts of it can be missing.
    pub(super) fn uses_alpha(&self) -> bool {
        matches!(self.alpha_mode.as_deref(), Some("MASK" | "BLEND"))
    }

    /// Whether it sends out light.
    pub(super) fn shines(&self) -> bool {
        self.emissive_factor != [0.0; 3] || self.extensions.contains_key("KHR_materials_unlit")
    }

    /// Whether it hides what is behind it from its front only. What light goes through has two sides.
    pub(super) fn is_one_sided(&self) -> bool {
        let through = ["KHR_materials_transmission", "KHR_materials_diffuse_transmission"];
        !self.double_sided && !through.iter().any(|name| self.extensions.contains_key(*name))
    }
}

/// Puts something under a name that nothing else has.
fn insert<T: PartialEq>(all: &mut BTreeMap<String, T>, mut name: String, value: T) -> String {
    while all.get(&name).is_some_and(|other| *other != value) {
        name.push('\'');
    }
    all.insert(name.clone(), value);
    name
}

/// One material in the making.
pub(super) struct Maker<'m, 'a> {
    all: &'m Materials<'a>,
    pub(super) material: &'m Material,
    name: &'m str,
    painted: Painted,
    /// A part of it that is metal, whatever its metalness.
    pub(super) mirror: Option<Mirror>,
    desc: &'m mut SceneDesc,
    warnings: &'m mut Vec<Warning>,
}

impl Maker<'_, '_> {
    fn make(mut self) {
        let Material { normal_texture, alpha_mode, extensions, .. } = self.material;
        let (alpha, mut surface) = if extensions.contains_key("KHR_materials_unlit") {
            let [color, alpha] = self.base_color();
            let lamp = Emissive { radiance: color, albedo: Rgb::grey(0.0).into(), two_sided: true };
            (alpha, MaterialDesc::Emissive(lamp))
        } else {
            let (alpha, principled) = self.principled();
            (alpha, self.partly_metal(principled))
        };
        if let Some(leaf) = self.extension::<Leaf>("KHR_materials_diffuse_transmission") {
            let (texture, factor) = (leaf.diffuse_transmission_texture.as_ref(), leaf.diffuse_transmission_factor);
            let share = self.alpha_times(texture, factor, "through");
            self.warn("where light goes through it and is scattered, it has no gloss");
            if extensions.contains_key("KHR_materials_volume") && !extensions.contains_key("KHR_materials_transmission")
            {
                self.warn("its volume is ignored");
            }
            let color = leaf.diffuse_transmission_color_factor.unwrap_or([1.0; 3]);
            let info = leaf.diffuse_transmission_color_texture.as_ref();
            let transmittance = self.color(info, color, Encoding::Auto, "through-color");
            let through = DiffuseTransmission { reflectance: Rgb::grey(0.0).into(), transmittance };
            let a = self.part("front", surface);
            let b = self.part("through", MaterialDesc::DiffuseTransmission(through));
            surface = MaterialDesc::Mix(Mix { a, b, share });
        }
        if let Some(info) = normal_texture
            && let Some(map) = self.image(info, Encoding::Linear, false, "normal")
        {
            let of = self.part("surface", surface);
            let strength = bounded(info.scale.unwrap_or(1.0), -100.0, 100.0);
            surface = MaterialDesc::NormalMap(NormalMap { of, map: Color::Texture(map), strength });
        }
        if let Some(opacity) = self.opacity(alpha_mode.as_deref(), alpha) {
            let of = self.part("opaque", surface);
            surface = MaterialDesc::Mask(Mask::new(of, opacity));
        }
        if self.material.occlusion_texture.is_some() {
            self.warn("occlusion is computed, not read");
        }
        self.desc.material.insert(self.name.to_owned(), surface);
    }

    /// A material that others are made of.
    pub(super) fn part(&mut self, part: &str, material: MaterialDesc) -> Name {
        Name::new(&insert(&mut self.desc.material, format!("{}.{part}", self.name), material))
    }

    fn opacity(&mut self, mode: Option<&str>, alpha: Color) -> Option<Scalar> {
        let alpha = scalar(alpha);
        match mode {
            Some("BLEND") => (alpha != Scalar::Number(1.0)).then_some(alpha),
            Some("MASK") => {
                let cutoff = self.material.alpha_cutoff.unwrap_or(0.5);
                match alpha {
                    Scalar::Number(alpha) => (alpha < cutoff).then_some(0.0.into()),
                    Scalar::Texture(_) if cutoff <= 0.0 => None,
                    input => {
                        let stops = [(0.0, 0.0), (bounded(cutoff, 1e-6, 10.0), 1.0)];
                        Some(self.ramp("cutoff", input, &stops, Interpolation::Constant))
                    }
                }
            }
            _ => None,
        }
    }

    /// With the alpha.
    fn principled(&mut self) -> (Color, Principled) {
        let pbr = &self.material.pbr_metallic_roughness;
        let [base_color, alpha] = self.base_color();
        let packed = pbr.metallic_roughness_texture.as_ref();
        let mut p = Principled {
            base_color,
            base_metalness: self.channel(packed, Channel::Blue, pbr.metallic_factor.unwrap_or(1.0), "metalness"),
            specular_roughness: self.channel(packed, Channel::Green, pbr.roughness_factor.unwrap_or(1.0), "roughness"),
            ..Principled::default()
        };
        self.specular(&mut p);
        self.gloss(&mut p);
        self.anisotropy(&mut p);
        self.layers(&mut p);
        self.transmission(&mut p);
        self.emission(&mut p);
        (alpha, p)
    }

    /// The colour and the alpha of the surface.
    fn base_color(&mut self) -> [Color; 2] {
        let old: Option<SpecularGlossiness> = self.extension("KHR_materials_pbrSpecularGlossiness");
        let pbr = &self.material.pbr_metallic_roughness;
        let (factor, info) = match &old {
            Some(old) => (old.diffuse_factor, old.diffuse_texture.as_ref()),
            None => (pbr.base_color_factor, pbr.base_color_texture.as_ref()),
        };
        let [r, g, b, a] = factor.unwrap_or([1.0; 4]);
        let mut color = self.color(info, [r, g, b], Encoding::Auto, "base-color");
        let of_vertices = |alpha| TextureDesc::VertexColor(VertexColor { otherwise: Rgb::grey(1.0), alpha });
        if self.painted.colors {
            let vertices = self.texture("vertices", of_vertices(false));
            color = self.product("base-color.painted", color, Color::Texture(vertices));
        }
        let uses_alpha = self.material.uses_alpha();
        let image = info.filter(|_| uses_alpha).and_then(|info| self.image(info, Encoding::Auto, true, "alpha"));
        let factor = Color::from(Rgb::grey(bounded(a, 0.0, 1.0)));
        let mut alpha = match image {
            Some(image) => self.product("alpha.scaled", Color::Texture(image), factor),
            None => factor,
        };
        if self.painted.alphas && uses_alpha {
            let vertices = self.texture("vertices.alpha", of_vertices(true));
            alpha = self.product("alpha.painted", alpha, Color::Texture(vertices));
        }
        [color, alpha]
    }

    fn layers(&mut self, p: &mut Principled) {
        if let Some(coat) = self.extension::<Clearcoat>(CLEARCOAT) {
            p.coat_weight = self.channel(coat.clearcoat_texture.as_ref(), Channel::Red, coat.clearcoat_factor, "coat");
            let (texture, factor) = (coat.clearcoat_roughness_texture.as_ref(), coat.clearcoat_roughness_factor);
            p.coat_roughness = self.channel(texture, Channel::Green, factor, "coat-roughness");
            (p.coat_ior, p.coat_darkening) = (1.5, 0.0);
            self.coat_normals(&coat, p);
        }
        if let Some(sheen) = self.extension::<Sheen>("KHR_materials_sheen") {
            let brightest = sheen.sheen_color_factor.into_iter().fold(0.0, f32::max);
            if brightest > 0.0 {
                let color = sheen.sheen_color_factor.map(|c| c / brightest);
                p.fuzz_weight = bounded(brightest, 0.0, 1.0).into();
                p.fuzz_color = self.color(sheen.sheen_color_texture.as_ref(), color, Encoding::Auto, "sheen");
                let (texture, factor) = (sheen.sheen_roughness_texture.as_ref(), sheen.sheen_roughness_factor);
                p.fuzz_roughness = self.alpha_times(texture, factor, "sheen-roughness");
            }
        }
        if let Some(film) = self.extension::<Iridescence>("KHR_materials_iridescence") {
            p.thin_film_weight =
                self.channel(film.iridescence_texture.as_ref(), Channel::Red, film.iridescence_factor, "film");
            p.thin_film_ior = bounded(film.iridescence_ior.unwrap_or(1.3), 1.0, 5.0);
            // Nanometres to micrometres.
            if film.iridescence_thickness_maximum.is_some_and(|thickness| thickness > 2000.0) {
                self.warn("its film is taken as 2000 nm thick at most");
            }
            let [least, most] =
                [(film.iridescence_thickness_minimum, 100.0), (film.iridescence_thickness_maximum, 400.0)]
                    .map(|(thickness, default)| bounded(thickness.unwrap_or(default) * 1e-3, 0.0, 2.0));
            let info = film.iridescence_thickness_texture.as_ref();
            p.thin_film_thickness = match self.channel(info, Channel::Green, 1.0, "film-thickness") {
                Scalar::Number(_) => most.into(),
                input => self.ramp("film-thickness.ramp", input, &[(0.0, least), (1.0, most)], Interpolation::Linear),
            };
        }
    }

    fn transmission(&mut self, p: &mut Principled) {
        let Some(transmission) = self.extension::<Transmission>("KHR_materials_transmission") else { return };
        let factor = transmission.transmission_factor;
        p.transmission_weight =
            self.channel(transmission.transmission_texture.as_ref(), Channel::Red, factor, "transmission");
        let volume: Volume = self.extension("KHR_materials_volume").unwrap_or_default();
        let Dispersion { dispersion } = self.extension("KHR_materials_dispersion").unwrap_or_default();
        if volume.thickness_factor > 0.0 {
            let distance = volume.attenuation_distance.filter(|d| d.is_finite() && *d > 0.0);
            p.transmission_color =
                Rgb(volume.attenuation_color.unwrap_or([1.0; 3]).map(|c| bounded(c, 0.0, 1.0))).into();
            match distance {
                Some(distance) => {
                    p.transmission_depth = distance;
                    self.tint_inside(p, volume.thickness_factor);
                }
                None => p.transmission_color = p.base_color.clone(),
            }
            // 20 over Abbe's number.
            p.transmission_dispersion_scale = bounded(dispersion, 0.0, 1.0);
            p.transmission_dispersion_abbe_number = bounded(20.0 / dispersion.max(1.0), 1.0, 20.0);
        } else {
            p.geometry_thin_walled = true;
            p.transmission_color = p.base_color.clone();
        }
    }

    /// The base colour tints what goes through, besides what is inside: as if that were inside, too, in its full thickness.
    fn tint_inside(&mut self, p: &mut Principled, thickness: f32) {
        let base = p.base_color.rgb();
        if base == Some(Rgb::grey(1.0)) {
            return;
        }
        let (Some(Rgb(base)), Some(Rgb(inside))) = (base, p.transmission_color.rgb()) else {
            return self.warn("the texture of its base colour does not tint what goes through it");
        };
        let turns = p.transmission_depth / thickness;
        let tinted = [0, 1, 2].map(|i| inside[i] * libm::powf(base[i], turns));
        p.transmission_color = Rgb(tinted.map(|c| bounded(c, 0.0, 1.0))).into();
        self.warn("its base colour is taken for that of what is inside, as thick as it says");
    }

    fn emission(&mut self, p: &mut Principled) {
        let factor = self.material.emissive_factor;
        let brightest = factor.into_iter().filter(|c| c.is_finite()).fold(0.0, f32::max);
        if brightest > 0.0 {
            let strength: EmissiveStrength = self.extension("KHR_materials_emissive_strength").unwrap_or_default();
            let luminance = LUMENS_PER_WATT * brightest * strength.emissive_strength.unwrap_or(1.0);
            p.emission_two_sided = self.painted.both_sides;
            p.emission_luminance = bounded(luminance, 0.0, 1e9);
            let color = factor.map(|c| c / brightest);
            p.emission_color = self.color(self.material.emissive_texture.as_ref(), color, Encoding::Auto, "emission");
        }
    }

    /// An extension, if there is one that makes sense.
    pub(super) fn extension<T: DeserializeOwned>(&mut self, name: &str) -> Option<T> {
        let extension = T::deserialize(self.material.extensions.get(name)?);
        extension.map_err(|e| self.warn(&format!("{name} is ignored: {e}"))).ok()
    }

    pub(super) fn warn(&mut self, message: &str) {
        self.warnings.push(Warning::new(message).part(format!("material `{}`", self.name)));
    }

    /// A texture of the material, by a name of its own.
    pub(super) fn texture(&mut self, part: &str, texture: TextureDesc) -> Name {
        Name::new(&insert(&mut self.desc.texture, format!("{}.{part}", self.name), texture))
    }

    /// A function of a number, by its values at some.
    pub(super) fn ramp(
        &mut self,
        part: &str,
        input: Scalar,
        stops: &[(f32, f32)],
        interpolation: Interpolation,
    ) -> Scalar {
        let stops = stops.iter().map(|&(at, grey)| Stop { at, color: Rgb::grey(grey) }).collect();
        Scalar::Texture(self.texture(part, TextureDesc::Ramp(Ramp { input, stops, interpolation })))
    }

    pub(super) fn image(&mut self, info: &TextureInfo, encoding: Encoding, alpha: bool, part: &str) -> Option<Name> {
        let Materials { document, pictures, file, .. } = *self.all;
        let mut image = pictures.texture(document, info, encoding, file, self.warnings)?;
        image.alpha = alpha;
        Some(self.texture(&format!("{part}.picture"), TextureDesc::Image(image)))
    }

    /// The alpha of a picture times a factor, in 0..1; the factor if there is no picture.
    pub(super) fn alpha_times(&mut self, info: Option<&TextureInfo>, factor: f32, part: &str) -> Scalar {
        let factor = bounded(factor, 0.0, 1.0);
        match info.and_then(|info| self.image(info, Encoding::Auto, true, part)) {
            Some(alpha) => scalar(self.product(part, Color::Texture(alpha), Rgb::grey(factor).into())),
            None => factor.into(),
        }
    }

    pub(super) fn product(&mut self, part: &str, a: Color, b: Color) -> Color {
        let is_one = |c: &Color| c.rgb() == Some(Rgb::grey(1.0));
        if is_one(&b) {
            return a;
        }
        if is_one(&a) {
            return b;
        }
        Color::Texture(self.texture(part, TextureDesc::Multiply(Multiply { a, b })))
    }

    /// A picture times a factor, in 0..1; the factor if there is no picture.
    pub(super) fn color(
        &mut self,
        info: Option<&TextureInfo>,
        factor: [f32; 3],
        encoding: Encoding,
        part: &str,
    ) -> Color {
        let factor = Color::from(Rgb(factor.map(|c| bounded(c, 0.0, 1.0))));
        match info.and_then(|info| self.image(info, encoding, false, part)) {
            Some(image) => self.product(part, Color::Texture(image), factor),
            None => factor,
        }
    }

    /// A channel of a picture of data times a factor, in 0..1; the factor if there is no picture.
    pub(super) fn channel(&mut self, info: Option<&TextureInfo>, channel: Channel, factor: f32, part: &str) -> Scalar {
        let factor = bounded(factor, 0.0, 1.0);
        let Some(image) = info.and_then(|info| self.image(info, Encoding::Linear, false, part)) else {
            return factor.into();
        };
        let input = Color::Texture(image);
        let channel = self.texture(part, TextureDesc::Channel(ChannelOf { input, channel }));
        scalar(self.product(&format!("{part}.scaled"), Color::Texture(channel), Rgb::grey(factor).into()))
    }
}

/// A grey as a number.
pub(super) fn scalar(color: Color) -> Scalar {
    match color {
        Color::Rgb(rgb) => Scalar::Number(rgb.0[1]),
        Color::Texture(name) => Scalar::Texture(name),
    }
}

/// In a range; what is no number is its lower end.
pub(super) fn bounded(number: f32, lo: f32, hi: f32) -> f32 {
    if number.is_nan() { lo } else { number.clamp(lo, hi) }
}
