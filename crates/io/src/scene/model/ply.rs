//! A PLY file as a model: its mesh, with its colours if it has some.

use std::sync::Arc;

use eyebeam_core::shape::{MeshData, MeshDesc};

use crate::error::Error;
use crate::scene::model::Model;
use crate::scene::model::files::Input;
use crate::scene::{ReadOptions, ply};

pub(super) fn read(input: &Input<'_>, _: &ReadOptions<'_>) -> Result<Model, Error> {
    let mut model = Model::new();
    let data = MeshData::from(ply::read_ply_bytes(&input.name, &input.bytes()?)?);
    let material = (!data.colors.is_empty()).then(|| model.vertex_color());
    let (file, data) = (Some(input.name.clone()), Some(Arc::new(data)));
    model.desc.shape.mesh.push(MeshDesc { file, material, data, ..MeshDesc::default() });
    Ok(model)
}
