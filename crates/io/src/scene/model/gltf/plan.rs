//! What the meshes of a scene take where they stand, before any is read.
//!
//! A mesh may be in many nodes, each may have many copies, and vertices of a buffer may be those of many meshes: a short file can
//! be a model of any size.

use glam::DAffine3;

use eyebeam_core::shape::MeshDesc;

use crate::error::FileError;
use crate::scene::model::gltf::accessor::Buffers;
use crate::scene::model::gltf::document::{Mesh, Primitive};
use crate::scene::model::gltf::node;

/// Triangles of all meshes.
const MOST_TRIANGLES: u64 = 100_000_000;

/// Takes the memory of all meshes.
///
/// # Errors
/// If it is more than is allowed, or there are too many triangles.
pub(super) fn check(buffers: &Buffers<'_>, placed: &[(usize, DAffine3)]) -> Result<(), FileError> {
    let document = buffers.document;
    let sizes: Vec<_> = document.meshes.iter().map(|mesh| size(buffers, mesh)).collect();
    let (mut triangles, mut bytes) = (0_u64, 0_u64);
    for node in placed.iter().filter_map(|(index, _)| document.nodes.get(*index)) {
        let Some([of_triangles, of_bytes]) = node.mesh.and_then(|mesh| sizes.get(mesh)) else { continue };
        let copies = node::copy_count(document, node).unwrap_or(1) as u64;
        triangles = triangles.saturating_add(of_triangles.saturating_mul(copies));
        bytes = bytes.saturating_add(of_bytes.saturating_mul(copies));
    }
    if triangles > MOST_TRIANGLES {
        return Err(FileError::new(format!("the model has {triangles} triangles, more than {MOST_TRIANGLES}")));
    }
    buffers.memory.take(bytes)
}

/// Triangles and bytes of a mesh.
fn size(buffers: &Buffers<'_>, mesh: &Mesh) -> [u64; 2] {
    let sizes = mesh.primitives.iter().map(|primitive| size_of_primitive(buffers, primitive));
    sizes.fold([0, 0], |[t, b], [more_t, more_b]| [t.saturating_add(more_t), b.saturating_add(more_b)])
}

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
    let attributes = [("POSITION", 12), ("NORMAL", 12), ("TEXCOORD_0", 8), ("COLOR_0", 12)];
    let width: u64 =
        attributes.iter().filter(|(name, _)| primitive.attributes.contains_key(*name)).map(|(_, size)| size).sum();
    let vertices = if mode < 4 { 0 } else { vertices.saturating_mul(width) };
    [triangles, vertices.saturating_add(triangles.saturating_mul(12)).saturating_add(size_of::<MeshDesc>() as u64)]
}
