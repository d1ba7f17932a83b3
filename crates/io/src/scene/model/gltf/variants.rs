//! `KHR_materials_variants`: other materials for the same meshes, of which one set is chosen.

use serde::Deserialize;

use crate::error::FileError;
use crate::scene::model::choose::choose;
use crate::scene::model::gltf::document::{Document, Primitive};
use crate::scene::model::gltf::extensions::get;

const NAME: &str = "KHR_materials_variants";

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
struct Variants {
    variants: Vec<Variant>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
struct Variant {
    name: String,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
struct Mappings {
    mappings: Vec<Mapping>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
struct Mapping {
    material: Option<usize>,
    variants: Vec<usize>,
}

/// Names of all variants.
pub(super) fn names(document: &Document) -> Result<Vec<String>, FileError> {
    let Variants { variants } = get(&document.extensions, NAME)?.unwrap_or_default();
    Ok(variants.into_iter().map(|variant| variant.name).collect())
}

/// Gives meshes the materials of a variant, by its name or its number.
///
/// # Errors
/// If there is none; they are listed.
pub(super) fn apply(document: &mut Document, wanted: &str) -> Result<(), FileError> {
    let chosen = choose("variant", wanted, names(document)?.iter().map(String::as_str))?;
    for primitive in document.meshes.iter_mut().flat_map(|mesh| &mut mesh.primitives) {
        if let Some(material) = material(primitive, chosen)? {
            primitive.material = Some(material);
        }
    }
    Ok(())
}

/// The material of a variant, if that has one of its own.
fn material(primitive: &Primitive, variant: usize) -> Result<Option<usize>, FileError> {
    let Mappings { mappings } = get(&primitive.extensions, NAME)?.unwrap_or_default();
    let mapping = mappings.into_iter().find(|mapping| mapping.variants.contains(&variant));
    Ok(mapping.and_then(|mapping| mapping.material))
}
