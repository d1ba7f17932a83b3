//! A PLY file as a model: its mesh, with its colours if it has some, and with holes where its alphas are below 1.

use std::sync::Arc;

use eyebeam_core::shape::MeshDesc;

use crate::error::Error;
use crate::memory::Memory;
use crate::scene::model::Model;
use crate::scene::model::files::Input;
use crate::scene::{ReadOptions, ply};
use crate::warning::Warning;

pub(super) fn read(input: &Input<'_>, _: &ReadOptions<'_>, memory: &Memory) -> Result<Model, Error> {
    let mut model = Model::new();
    let bytes = input.bytes()?;
    memory.take(ply::mesh_size(&input.name, &bytes)?).map_err(|e| e.of(&input.name))?;
    let (mut data, warnings) = ply::read_ply_bytes(&input.name, &bytes)?;
    model.warnings = warnings;
    let is_seen = data.alphas.is_empty() || data.alphas.iter().any(|&alpha| alpha > 0.0);
    if !is_seen {
        data.alphas.clear();
        model.warnings.push(Warning::new("all `alpha` are 0, as if nothing were to be seen: they are not used"));
    }
    let has_holes = data.alphas.iter().any(|&alpha| alpha < 1.0);
    let material = (has_holes || !data.colors.is_empty()).then(|| model.vertex_color());
    let material = if has_holes { material.map(|of| model.vertex_alpha(&of)) } else { material };
    let (file, data) = (Some(input.name.clone()), Some(Arc::new(data)));
    model.desc.shape.mesh.push(MeshDesc { file, material, data, ..MeshDesc::default() });
    Ok(model)
}
