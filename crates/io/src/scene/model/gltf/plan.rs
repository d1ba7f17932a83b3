//! What the meshes of a scene take where they stand, before any is read.
//!
//! A mesh may be in many nodes, each may have many copies, and vertices of a buffer may be those of many meshes: a short file can
//! be a model of any size.

use std::collections::BTreeMap;

use eyebeam_core::shape::MeshDesc;
use glam::DAffine3;

use crate::error::FileError;
use crate::scene::model::gltf::accessor::Buffers;
use crate::scene::model::gltf::document::Primitive;
use crate::scene::model::gltf::{node, shapes};

/// Triangles of all meshes.
const MOST_TRIANGLES: u64 = 100_000_000;

/// Takes the memory of all meshes.
///
/// # Errors
/// If it is more than is allowed, or there are too many triangles.
pub(super) fn check(buffers: &Buffers<'_>, placed: &[(usize, DAffine3)]) -> Result<(), FileError> {
    let document = buffers.document;
    // Of meshes that stand as they are; those in a pose of their own are there for each node.
    let (mut copies_of, mut posed) = (BTreeMap::<usize, u64>::new(), Vec::new());
    for node in placed.iter().filter_map(|(index, _)| document.nodes.get(*index)) {
        let Some(mesh) = node.mesh else { continue };
        let copies = node::copy_count(document, node)?.unwrap_or(1) as u64;
        if shapes::is_plain(node) {
            let all = copies_of.entry(mesh).or_default();
            *all = all.saturating_add(copies);
        } else {
            posed.push((mesh, copies));
        }
    }
    let (mut triangles, mut bytes) = (0_u64, 0_u64);
    for (mesh, copies) in copies_of.into_iter().chain(posed) {
        let Some(mesh) = document.meshes.get(mesh) else { continue };
        bytes = bytes.saturating_add(copies.saturating_mul(size_of::<DAffine3>() as u64));
        for primitive in &mesh.primitives {
            let [of_triangles, of_bytes] = size_of_primitive(buffers, primitive);
            let is_shared = shapes::is_shared(document, primitive, copies, of_triangles);
            let meshes = if is_shared { 1 } else { copies };
            let places = if is_shared { copies.saturating_mul(size_of::<[f32; 12]>() as u64) } else { 0 };
            triangles = triangles.saturating_add(of_triangles.saturating_mul(meshes));
            bytes = bytes.saturating_add(of_bytes.saturating_mul(meshes)).saturating_add(places);
        }
    }
    if triangles > MOST_TRIANGLES {
        return Err(FileError::new(format!("the model has {triangles} triangles, more than {MOST_TRIANGLES}")));
    }
    buffers.memory.take(bytes)
}

/// Triangles of a primitive, and the bytes of its mesh.
fn size_of_primitive(buffers: &Buffers<'_>, primitive: &Primitive) -> [u64; 2] {
    let accessors = &buffers.document.accessors;
    let count = |index: usize| accessors.get(index).map_or(0, |accessor| accessor.count as u64);
    let mode = primitive.mode.unwrap_or(4);
    let vertices = primitive.attributes.get("POSITION").map_or(0, |&index| count(index));
    let corners = primitive.indices.map_or(vertices, count);
    let triangles = match mode {
        // Points and lines, of which there is no mesh.
        0..4 => 0,
        4 => corners / 3,
        _ => corners.saturating_sub(2),
    };
    // Normals, and tangents that are made of them.
    let attributes = [("POSITION", 12), ("NORMAL", 28), ("TEXCOORD_0", 8), ("TEXCOORD_1", 8), ("COLOR_0", 16)];
    let width: u64 =
        attributes.iter().filter(|(name, _)| primitive.attributes.contains_key(*name)).map(|(_, size)| size).sum();
    let vertices = if mode < 4 { 0 } else { vertices.saturating_mul(width) };
    [triangles, vertices.saturating_add(triangles.saturating_mul(12)).saturating_add(size_of::<MeshDesc>() as u64)]
}
