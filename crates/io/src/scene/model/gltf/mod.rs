//! glTF 2.0 and GLB: what most programs of the field exchange scenes in.
//!
//! Khronos, glTF 2.0 Specification, 2021 (ISO/IEC 12113:2022). What is read, approximated and ignored is told in docs/formats/gltf.md.

mod accessor;
mod animation;
mod camera;
mod container;
mod document;
mod extensions;
mod light;
mod material;
mod mesh;
mod meshopt;
mod node;
mod texture;

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;

use eyebeam_core::shape::MeshDesc;
use glam::{DAffine3, DMat4};

use self::accessor::{Buffers, Bytes, missing};
use self::container::Container;
use self::document::Document;
use self::material::Materials;
use self::mesh::Pose;
use self::texture::Pictures;
use crate::error::{At, Error, FileError};
use crate::file;
use crate::scene::model::Model;
use crate::scene::model::choose::choose;
use crate::scene::model::folder::Folder;
use crate::scene::{Contents, ReadOptions};
use crate::warning::Warning;

/// Triangles of all meshes where they stand.
const MOST_TRIANGLES: usize = 100_000_000;

pub(super) fn read(path: &Path, options: &ReadOptions<'_>) -> Result<Model, Error> {
    let bytes = file::read(path)?;
    let name = path.display().to_string();
    read_bytes(&name, &bytes, &Folder::of(path, options.allow_outside), options).map_err(|e| e.of(&name))
}

fn read_bytes(name: &str, bytes: &[u8], folder: &Folder, options: &ReadOptions<'_>) -> Result<Model, FileError> {
    let Container { json, bytes } = Container::open(bytes)?;
    let mut document: Document =
        serde_json::from_slice(json).map_err(|e| FileError::new(e.to_string()).at(At::Line(e.line())))?;
    let version = &document.asset.version;
    if !version.starts_with("2.") || document.asset.min_version.as_ref().is_some_and(|least| least != "2.0") {
        return Err(FileError::new(format!("this is glTF of version `{version}`")).hint("export it as glTF 2.0"));
    }
    let mut model = Model::new();
    extensions::check(&document, &mut model.warnings)?;
    let bytes = Bytes::new(&document, load(&document, bytes, folder)?)?;
    pose(&mut document, &bytes, options, &mut model.warnings)?;
    let buffers = Buffers { document: &document, bytes: &bytes };
    let pictures = Pictures::read(&buffers, folder, &mut model.warnings);
    let mut materials = Materials::new(&document, &pictures, name);
    let scene = scene(&document, options.scene, &mut model.warnings)?;
    let placed = node::in_world(&document, scene)?;
    model.contents = Contents {
        generator: document.asset.generator.clone(),
        scenes: document.scenes.iter().map(|scene| scene.name.clone()).collect(),
        scene: Some(scene).filter(|&scene| scene < document.scenes.len()),
        animations: animation::all(&buffers),
        ..Contents::default()
    };
    let in_world: BTreeMap<usize, DAffine3> = placed.iter().copied().collect();
    let (mut triangles, mut skipped) = (0, 0);
    for &(index, to_world) in &placed {
        let Some(node) = document.nodes.get(index) else { continue };
        camera::read(&document, node, &to_world, &mut model);
        light::read(&document, node, &to_world, &mut model)?;
        let Some(mesh) = node.mesh else { continue };
        let mesh = document.meshes.get(mesh).ok_or_else(|| missing("mesh", mesh))?;
        let joints = node.skin.map(|skin| joints(&buffers, skin, &in_world)).transpose()?;
        let weights = if node.weights.is_empty() { &mesh.weights } else { &node.weights };
        let copies = node::copies(&buffers, node)?;
        for (primitive, copy) in mesh.primitives.iter().flat_map(|p| copies.iter().map(move |copy| (p, copy))) {
            let skinned = joints.as_deref().filter(|_| primitive.attributes.contains_key("JOINTS_0"));
            let pose = Pose { to_world: to_world * *copy, weights, joints: skinned };
            let Some(data) = mesh::read(&buffers, primitive, &pose)? else {
                skipped += 1;
                continue;
            };
            triangles += data.triangles.len();
            if triangles > MOST_TRIANGLES {
                return Err(FileError::new(format!("the model has more than {MOST_TRIANGLES} triangles")));
            }
            let has_colors = !data.colors.is_empty();
            let material = materials.name(primitive.material, has_colors, &mut model.desc, &mut model.warnings);
            model.desc.shape.mesh.push(MeshDesc {
                file: Some(format!("{name}#node{index}")),
                material: Some(material),
                data: Some(Arc::new(data)),
                ..MeshDesc::default()
            });
        }
    }
    if skipped > 0 {
        model.warnings.push(Warning::new(format!("{skipped} sets of points or lines are left out")));
    }
    model.warnings.dedup();
    Ok(model)
}

/// The scene that is wanted, or that the file says; of others that nobody asked for there is a warning.
fn scene(document: &Document, wanted: Option<&str>, warnings: &mut Vec<Warning>) -> Result<usize, FileError> {
    if let Some(wanted) = wanted {
        return choose("scene", wanted, document.scenes.iter().map(|scene| scene.name.as_str()));
    }
    let scene = document.scene.unwrap_or(0);
    if document.scenes.len() > 1 {
        let other = usize::from(scene == 0);
        let message = format!("of {} scenes number {scene} is read alone", document.scenes.len());
        let hint = Some(format!("`--scene {other}` reads another"));
        warnings.push(Warning { hint, ..Warning::new(message) });
    }
    Ok(scene)
}

/// Moves nodes to where an animation has them; of one that nobody asked for there is a warning.
fn pose(
    document: &mut Document,
    bytes: &Bytes,
    options: &ReadOptions<'_>,
    warnings: &mut Vec<Warning>,
) -> Result<(), FileError> {
    let Some(name) = options.animation else {
        if let [first, ..] = &document.animations[..] {
            let count = document.animations.len();
            let message = format!("of {count} animations none is chosen: all is as it rests");
            let hint = Some(format!("`--animation \"{}\" --at 0.5` poses it", first.name));
            warnings.push(Warning { hint, ..Warning::new(message) });
        }
        return Ok(());
    };
    let animation = animation::find(document, name)?;
    let changes = animation::sample(&Buffers { document, bytes }, animation, options.at)?;
    animation::apply(document, changes);
    Ok(())
}

/// The bytes of all buffers; the first may be those behind the JSON.
fn load(document: &Document, mut behind: Option<&[u8]>, folder: &Folder) -> Result<Vec<Vec<u8>>, FileError> {
    let mut buffers = Vec::new();
    for (i, buffer) in document.buffers.iter().enumerate() {
        let bytes = match (&buffer.uri, behind.take()) {
            (Some(uri), _) => container::resolve(uri, folder)?,
            (None, Some(bytes)) if i == 0 => bytes.to_vec(),
            // Filled by an extension, if at all.
            (None, _) => Vec::new(),
        };
        if bytes.len() < buffer.byte_length && !bytes.is_empty() {
            let (has, wants) = (bytes.len(), buffer.byte_length);
            return Err(FileError::new(format!("buffer {i} has {has} of {wants} bytes")));
        }
        buffers.push(bytes);
    }
    Ok(buffers)
}

/// From where the joints of a skin were when it was bound to where they are in the world.
fn joints(
    buffers: &Buffers<'_>,
    index: usize,
    in_world: &BTreeMap<usize, DAffine3>,
) -> Result<Vec<DAffine3>, FileError> {
    let skin = buffers.document.skins.get(index).ok_or_else(|| missing("skin", index))?;
    let bound = skin.inverse_bind_matrices.map(|i| buffers.floats::<16>(i, 0.0)).transpose()?;
    let joint = |(i, joint): (usize, &usize)| {
        let to_world = *in_world.get(joint).ok_or_else(|| missing("joint", *joint))?;
        let bound = match &bound {
            Some(matrices) => matrices.get(i).ok_or_else(|| missing("inverse bind matrix", i))?.map(f64::from),
            None => return Ok(to_world),
        };
        Ok(to_world * DAffine3::from_mat4(DMat4::from_cols_array(&bound)))
    };
    skin.joints.iter().enumerate().map(joint).collect()
}
