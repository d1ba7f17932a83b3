//! A PLY file as a model: its mesh, with its colours if it has some.

use std::path::Path;
use std::sync::Arc;

use eyebeam_core::material::{Lambertian, MaterialDesc};
use eyebeam_core::names::Name;
use eyebeam_core::shape::{MeshData, MeshDesc};
use eyebeam_core::texture::{Color, TextureDesc, VertexColor};

use crate::error::Error;
use crate::scene::model::Model;
use crate::scene::{ReadOptions, ply};

pub(super) fn read(path: &Path, _: &ReadOptions<'_>) -> Result<Model, Error> {
    let mut model = Model::new();
    let data = MeshData::from(ply::read_ply(path)?);
    let mut mesh = MeshDesc { file: Some(path.display().to_string()), ..MeshDesc::default() };
    if !data.colors.is_empty() {
        let name = "vertex-color".to_owned();
        let albedo = Color::Texture(Name::new(&name));
        model.desc.texture.insert(name.clone(), TextureDesc::VertexColor(VertexColor::default()));
        model.desc.material.insert(name.clone(), MaterialDesc::Lambertian(Lambertian { albedo }));
        mesh.material = Some(name);
    }
    mesh.data = Some(Arc::new(data));
    model.desc.shape.mesh.push(mesh);
    Ok(model)
}
