//! Extensions as their JSON has them, and which are read at all.

use std::collections::BTreeMap;

use serde::Deserialize;
use serde::de::DeserializeOwned;

use crate::error::FileError;
use crate::scene::model::gltf::document::{Document, Extensions, TextureInfo};
use crate::warning::Warning;

/// What is read, wholly or nearly.
const READ: &[&str] = &[
    "EXT_lights_image_based",
    "EXT_mesh_gpu_instancing",
    "EXT_meshopt_compression",
    "EXT_texture_webp",
    "KHR_draco_mesh_compression",
    "KHR_lights_punctual",
    "KHR_materials_anisotropy",
    "KHR_materials_clearcoat",
    "KHR_materials_diffuse_transmission",
    "KHR_materials_dispersion",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_iridescence",
    "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_sheen",
    "KHR_materials_specular",
    "KHR_materials_transmission",
    "KHR_materials_unlit",
    "KHR_materials_variants",
    "KHR_materials_volume",
    "KHR_mesh_quantization",
    "KHR_texture_basisu",
    "KHR_texture_transform",
];

/// Refuses what the file cannot be read without, and notes what is ignored.
pub(super) fn check(document: &Document, warnings: &mut Vec<Warning>) -> Result<(), FileError> {
    let is_known = |name: &&String| READ.contains(&name.as_str());
    if let Some(name) = document.extensions_required.iter().find(|name| !is_known(name)) {
        let hint = format!("export it without {name}");
        return Err(FileError::new(format!("the model needs the extension {name}, which is not read")).hint(hint));
    }
    let ignored = document.extensions_used.iter().filter(|name| !is_known(name));
    warnings.extend(ignored.map(|name| Warning::new(format!("the extension {name} is ignored"))));
    Ok(())
}

/// An extension of an object, if it has that.
///
/// # Errors
/// If it is not as its specification says.
pub(super) fn get<T: DeserializeOwned>(extensions: &Extensions, name: &str) -> Result<Option<T>, FileError> {
    let value = extensions.get(name).map(T::deserialize).transpose();
    value.map_err(|e| FileError::new(format!("{name}: {e}")))
}

/// `KHR_materials_clearcoat`
#[derive(Debug, Default, Deserialize)]
#[serde(rename_all = "camelCase", default)]
pub(super) struct Clearcoat {
    pub(super) clearcoat_factor: f32,
    pub(super) clearcoat_texture: Option<TextureInfo>,
    pub(super) clearcoat_roughness_factor: f32,
    pub(super) clearcoat_roughness_texture: Option<TextureInfo>,
    pub(super) clearcoat_normal_texture: Option<TextureInfo>,
}

/// `KHR_materials_sheen`
#[derive(Debug, Default, Deserialize)]
#[serde(rename_all = "camelCase", default)]
pub(super) struct Sheen {
    pub(super) sheen_color_factor: [f32; 3],
    pub(super) sheen_color_texture: Option<TextureInfo>,
    pub(super) sheen_roughness_factor: f32,
    pub(super) sheen_roughness_texture: Option<TextureInfo>,
}

/// `KHR_materials_transmission`
#[derive(Debug, Default, Deserialize)]
#[serde(rename_all = "camelCase", default)]
pub(super) struct Transmission {
    pub(super) transmission_factor: f32,
    pub(super) transmission_texture: Option<TextureInfo>,
}

/// `KHR_materials_diffuse_transmission`
#[derive(Debug, Default, Deserialize)]
#[serde(rename_all = "camelCase", default)]
pub(super) struct Leaf {
    pub(super) diffuse_transmission_factor: f32,
    pub(super) diffuse_transmission_texture: Option<TextureInfo>,
    pub(super) diffuse_transmission_color_factor: Option<[f32; 3]>,
    pub(super) diffuse_transmission_color_texture: Option<TextureInfo>,
}

/// `KHR_materials_volume`
#[derive(Debug, Default, Deserialize)]
#[serde(rename_all = "camelCase", default)]
pub(super) struct Volume {
    pub(super) thickness_factor: f32,
    pub(super) attenuation_distance: Option<f32>,
    pub(super) attenuation_color: Option<[f32; 3]>,
}

/// `KHR_materials_dispersion`
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct Dispersion {
    pub(super) dispersion: f32,
}

/// `KHR_materials_specular`
#[derive(Debug, Default, Deserialize)]
#[serde(rename_all = "camelCase", default)]
pub(super) struct Specular {
    pub(super) specular_factor: Option<f32>,
    pub(super) specular_texture: Option<TextureInfo>,
    pub(super) specular_color_factor: Option<[f32; 3]>,
    pub(super) specular_color_texture: Option<TextureInfo>,
}

/// `KHR_materials_ior`
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct Ior {
    pub(super) ior: Option<f32>,
}

/// `KHR_materials_emissive_strength`
#[derive(Debug, Default, Deserialize)]
#[serde(rename_all = "camelCase", default)]
pub(super) struct EmissiveStrength {
    pub(super) emissive_strength: Option<f32>,
}

/// `KHR_materials_iridescence`
#[derive(Debug, Default, Deserialize)]
#[serde(rename_all = "camelCase", default)]
pub(super) struct Iridescence {
    pub(super) iridescence_factor: f32,
    pub(super) iridescence_texture: Option<TextureInfo>,
    pub(super) iridescence_ior: Option<f32>,
    pub(super) iridescence_thickness_minimum: Option<f32>,
    pub(super) iridescence_thickness_maximum: Option<f32>,
    pub(super) iridescence_thickness_texture: Option<TextureInfo>,
}

/// `KHR_materials_anisotropy`
#[derive(Debug, Default, Deserialize)]
#[serde(rename_all = "camelCase", default)]
pub(super) struct Anisotropy {
    pub(super) anisotropy_strength: f32,
    pub(super) anisotropy_rotation: f32,
    pub(super) anisotropy_texture: Option<TextureInfo>,
}

/// `KHR_materials_pbrSpecularGlossiness`
#[derive(Debug, Default, Deserialize)]
#[serde(rename_all = "camelCase", default)]
pub(super) struct SpecularGlossiness {
    pub(super) diffuse_factor: Option<[f32; 4]>,
    pub(super) diffuse_texture: Option<TextureInfo>,
    pub(super) specular_factor: Option<[f32; 3]>,
    pub(super) glossiness_factor: Option<f32>,
    pub(super) specular_glossiness_texture: Option<TextureInfo>,
}

/// `EXT_mesh_gpu_instancing`
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(super) struct Instancing {
    pub(super) attributes: BTreeMap<String, usize>,
}
