//! Where nodes are in the world.

use std::collections::BTreeSet;

use glam::{DAffine3, DMat4, DQuat};

use crate::error::FileError;
use crate::scene::model::gltf::accessor::{Buffers, missing};
use crate::scene::model::gltf::document::{Document, Node};
use crate::scene::model::gltf::extensions::{Instancing, get};

/// Nodes within each other.
const MAX_DEPTH: usize = 1000;

/// Stands for all scenes, and what is in none.
pub(super) const EVERYWHERE: usize = usize::MAX;

/// The nodes of a scene with their transforms, parents before children.
///
/// # Errors
/// If a node does not exist, or has more than one parent.
pub(super) fn in_world(document: &Document, scene: usize) -> Result<Vec<(usize, DAffine3)>, FileError> {
    let roots = match document.scenes.get(scene) {
        Some(scene) => scene.nodes.clone(),
        // As in a file without scenes: all nodes without parents.
        None => {
            let children: BTreeSet<_> = document.nodes.iter().flat_map(|node| &node.children).collect();
            (0..document.nodes.len()).filter(|i| !children.contains(i)).collect()
        }
    };
    let mut seen = vec![false; document.nodes.len()];
    let mut placed = Vec::new();
    let mut open: Vec<_> = roots.into_iter().rev().map(|root| (root, DAffine3::IDENTITY, 0)).collect();
    while let Some((index, parent, depth)) = open.pop() {
        let node = document.nodes.get(index).ok_or_else(|| missing("node", index))?;
        if seen.get(index).is_none_or(|&seen| seen) {
            return Err(FileError::new(format!("node {index} is in more than one place, or within itself")));
        }
        if depth > MAX_DEPTH {
            return Err(FileError::new(format!("node {index} is within more than {MAX_DEPTH} others")));
        }
        seen[index] = true;
        let to_world = parent * local(node);
        if !to_world.is_finite() {
            return Err(FileError::new(format!("node {index} is nowhere: its transform is not finite")));
        }
        placed.push((index, to_world));
        open.extend(node.children.iter().rev().map(|&child| (child, to_world, depth + 1)));
    }
    Ok(placed)
}

fn local(node: &Node) -> DAffine3 {
    if let Some(matrix) = node.matrix {
        return DAffine3::from_mat4(DMat4::from_cols_array(&matrix));
    }
    let rotation = node.rotation.unwrap_or([0.0, 0.0, 0.0, 1.0]);
    transform(node.translation.unwrap_or_default(), rotation, node.scale.unwrap_or([1.0; 3]))
}

/// A scale, then a turn, then a move.
fn transform(translation: [f64; 3], rotation: [f64; 4], scale: [f64; 3]) -> DAffine3 {
    let rotation = DQuat::from_array(rotation);
    let rotation = if rotation.length_squared() > 0.0 { rotation.normalize() } else { DQuat::IDENTITY };
    DAffine3::from_scale_rotation_translation(scale.into(), rotation, translation.into())
}

/// How many copies of a node's mesh there are, if that is said.
pub(super) fn copy_count(document: &Document, node: &Node) -> Result<Option<usize>, FileError> {
    let count = |Instancing { attributes }| {
        let names = ["TRANSLATION", "ROTATION", "SCALE"];
        let accessors = names.iter().filter_map(|name| document.accessors.get(*attributes.get(*name)?));
        accessors.map(|accessor| accessor.count).min().unwrap_or_default()
    };
    Ok(get(&node.extensions, INSTANCING)?.map(count))
}

const INSTANCING: &str = "EXT_mesh_gpu_instancing";

/// Where the copies of a node's mesh are in its space: `EXT_mesh_gpu_instancing`; one that rests if there is no such thing.
pub(super) fn copies(buffers: &Buffers<'_>, node: &Node) -> Result<Vec<DAffine3>, FileError> {
    let Some(Instancing { attributes }) = get(&node.extensions, INSTANCING)? else {
        return Ok(vec![DAffine3::IDENTITY]);
    };
    let [moves, scales] = [("TRANSLATION", 0.0), ("SCALE", 1.0)]
        .map(|(name, rest)| attributes.get(name).map(|&i| buffers.floats::<3>(i, rest)).transpose());
    let (moves, scales) = (moves?, scales?);
    let turns = attributes.get("ROTATION").map(|&i| buffers.floats::<4>(i, 0.0)).transpose()?;
    let count = copy_count(buffers.document, node)?.unwrap_or_default();
    let copy = |i: usize| {
        let vector =
            |list: &Option<Vec<[f32; 3]>>, rest| list.as_ref().and_then(|l| l.get(i)).copied().unwrap_or([rest; 3]);
        let turn = turns.as_ref().and_then(|l| l.get(i)).copied().unwrap_or([0.0, 0.0, 0.0, 1.0]);
        transform(vector(&moves, 0.0).map(f64::from), turn.map(f64::from), vector(&scales, 1.0).map(f64::from))
    };
    Ok((0..count).map(copy).collect())
}
