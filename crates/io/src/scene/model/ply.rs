//! A PLY file as a model: its mesh, with its colours if it has some.

use std::sync::Arc;

use eyebeam_core::shape::MeshDesc;

use crate::error::Error;
use crate::memory::Memory;
use crate::scene::model::Model;
use crate::scene::model::files::Input;
use crate::scene::{ReadOptions, ply};

pub(super) fn read(input: &Input<'_>, _: &ReadOptions<'_>, memory: &Memory) -> Result<Model, Error> {
    let mut model = Model::new();
    let bytes = input.bytes()?;
    memory.take(ply::mesh_size(&input.name, &bytes)?).map_err(|e| e.of(&input.name))?;
    let data = ply::read_ply_bytes(&input.name, &bytes)?;
    let material = (!data.colors.is_empty()).then(|| model.vertex_color());
    let (file, data) = (Some(input.name.clone()), Some(Arc::new(data)));
    model.desc.shape.mesh.push(MeshDesc { file, material, data, ..MeshDesc::default() });
    Ok(model)
}
