//! glTF 2.0 and GLB: what most programs of the field exchange scenes in.
//!
//! Khronos, glTF 2.0 Specification, 2021 (ISO/IEC 12113:2022). What is read, approximated and ignored is told in docs/formats/gltf.md.

mod accessor;
mod animation;
mod attribute;
mod camera;
mod closed;
mod container;
mod directions;
mod document;
mod draco;
mod extensions;
mod light;
mod material;
mod mesh;
mod meshopt;
mod node;
mod plan;
mod reflectance;
mod shapes;
mod surroundings;
mod tangents;
mod texture;
mod variants;

use self::accessor::{Buffers, Bytes};
use self::container::Container;
use self::document::Document;
use self::material::Materials;
use self::texture::Pictures;
use crate::error::{At, Error, FileError};
use crate::memory::Memory;
use crate::scene::model::Model;
use crate::scene::model::choose::choose;
use crate::scene::model::files::{Files, Input};
use crate::scene::{Contents, ReadOptions};
use crate::warning::Warning;

pub(super) fn read(input: &Input<'_>, options: &ReadOptions<'_>, memory: &Memory) -> Result<Model, Error> {
    let Input { name, files, .. } = input;
    read_bytes(name, &input.bytes()?, *files, options, memory).map_err(|e| e.of(name))
}

fn read_bytes(
    name: &str,
    bytes: &[u8],
    files: Files<'_>,
    options: &ReadOptions<'_>,
    memory: &Memory,
) -> Result<Model, FileError> {
    let Container { json, bytes } = Container::open(bytes)?;
    memory.check(document::size(json))?;
    let mut document: Document =
        serde_json::from_slice(json).map_err(|e| FileError::new(e.to_string()).at(At::Line(e.line())))?;
    let version = &document.asset.version;
    if !version.starts_with("2.") || document.asset.min_version.as_ref().is_some_and(|least| least != "2.0") {
        return Err(FileError::new(format!("this is glTF of version `{version}`")).hint("export it as glTF 2.0"));
    }
    let mut model = Model::new();
    extensions::check(&document, &mut model.warnings)?;
    let bytes = Bytes::new(&document, load(&document, bytes, files, memory)?, memory)?;
    pose(&mut document, &bytes, memory, options, &mut model.warnings)?;
    if let Some(variant) = options.variant {
        variants::apply(&mut document, variant)?;
    }
    let buffers = Buffers { document: &document, bytes: &bytes, memory };
    let pictures = Pictures::read(&buffers, files, &mut model.warnings);
    let mut materials = Materials::new(&document, &pictures, name);
    let scene = scene(&document, options.scene, &mut model.warnings)?;
    let placed = node::in_world(&document, scene)?;
    model.contents = Contents {
        generator: document.asset.generator.clone(),
        scenes: document.scenes.iter().map(|scene| scene.name.clone()).collect(),
        scene: Some(scene).filter(|&scene| scene < document.scenes.len()),
        animations: animation::all(&buffers),
        variants: variants::names(&document)?,
        ..Contents::default()
    };
    plan::check(&buffers, &placed)?;
    let lights = light::all(&document)?;
    for &(index, to_world) in &placed {
        let Some(node) = document.nodes.get(index) else { continue };
        camera::read(&document, node, &to_world, &mut model);
        light::read(&lights, node, &to_world, &mut model)?;
    }
    surroundings::read(&buffers, scene, files, &mut model)?;
    shapes::read(&buffers, &placed, &mut materials, &mut model)?;
    model.warnings.dedup();
    Ok(model)
}

/// The scene that is wanted, or that the file says; of others that nobody asked for there is a warning.
fn scene(document: &Document, wanted: Option<&str>, warnings: &mut Vec<Warning>) -> Result<usize, FileError> {
    if let Some(wanted) = wanted {
        return choose("scene", wanted, document.scenes.iter().map(|scene| scene.name.as_str()));
    }
    let scene = document.scene.unwrap_or(0);
    if document.scene.is_some() && scene >= document.scenes.len() {
        return Err(accessor::missing("scene", scene));
    }
    if document.scenes.len() > 1 {
        let other = usize::from(scene == 0);
        let message = format!("of {} scenes number {scene} is read alone", document.scenes.len());
        warnings.push(Warning::new(message).hint(format!("`--scene {other}` reads another")));
    }
    Ok(scene)
}

/// Moves nodes to where an animation has them; of one that nobody asked for there is a warning.
fn pose(
    document: &mut Document,
    bytes: &Bytes,
    memory: &Memory,
    options: &ReadOptions<'_>,
    warnings: &mut Vec<Warning>,
) -> Result<(), FileError> {
    let Some(name) = options.animation else {
        if let [first, ..] = &document.animations[..] {
            let count = document.animations.len();
            let message = format!("of {count} animations none is chosen: all is as it rests");
            let name = if first.name.is_empty() { "0" } else { &first.name };
            warnings.push(Warning::new(message).hint(format!("`--animation \"{name}\" --at 0.5` poses it")));
        }
        return Ok(());
    };
    let animation = animation::find(document, name)?;
    let changes = animation::sample(&Buffers { document, bytes, memory }, animation, options.at)?;
    animation::apply(document, changes);
    Ok(())
}

/// The bytes of all buffers; the first may be those behind the JSON.
fn load(
    document: &Document,
    mut behind: Option<&[u8]>,
    files: Files<'_>,
    memory: &Memory,
) -> Result<Vec<Vec<u8>>, FileError> {
    let mut buffers = Vec::new();
    for (i, buffer) in document.buffers.iter().enumerate() {
        let bytes = match (&buffer.uri, behind.take()) {
            (Some(uri), _) => container::resolve(uri, files)?,
            (None, Some(bytes)) if i == 0 => bytes.to_vec(),
            // Filled by an extension, if at all.
            (None, _) => Vec::new(),
        };
        if bytes.len() < buffer.byte_length && !bytes.is_empty() {
            let (has, wants) = (bytes.len(), buffer.byte_length);
            return Err(FileError::new(format!("buffer {i} has {has} of {wants} bytes")));
        }
        memory.take(bytes.len() as u64)?;
        buffers.push(bytes);
    }
    Ok(buffers)
}
