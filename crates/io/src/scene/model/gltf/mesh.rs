//! Triangles of a primitive, in the world: posed by morph targets and joints, moved by its node.
//!
//! Khronos, glTF 2.0 Specification, 2021, §3.7. A transform that mirrors turns triangles round, so that their outsides stay outside.

use std::collections::BTreeMap;

use eyebeam_core::shape::MeshData;
use glam::{DAffine3, DMat3, DVec3};

use crate::error::FileError;
use crate::scene::model::gltf::accessor::Buffers;
use crate::scene::model::gltf::attribute::{Attributes, Indices};
use crate::scene::model::gltf::document::Primitive;

/// How a mesh stands.
pub(super) struct Pose<'a> {
    pub(super) to_world: DAffine3,
    /// How much there is of each morph target.
    pub(super) weights: &'a [f32],
    /// To the world from where each joint was when the skin was bound; these take the place of `to_world`.
    pub(super) joints: Option<&'a [DAffine3]>,
}

/// None for points and lines.
pub(super) fn read(
    buffers: &Buffers<'_>,
    primitive: &Primitive,
    pose: &Pose<'_>,
) -> Result<Option<MeshData>, FileError> {
    let mode = primitive.mode.unwrap_or(4);
    if mode < 4 || !primitive.attributes.contains_key("POSITION") {
        return Ok(None);
    }
    let attributes = Attributes::new(buffers, primitive)?;
    let mut vertices = attributes.floats::<3>("POSITION", 0.0)?.unwrap_or_default();
    let count = vertices.len();
    let mut normals = attributes.floats::<3>("NORMAL", 0.0)?.unwrap_or_default();
    let uvs = attributes.floats::<2>("TEXCOORD_0", 0.0)?.unwrap_or_default();
    let colors = attributes.floats::<3>("COLOR_0", 0.0)?.unwrap_or_default();
    for (name, length) in [("NORMAL", normals.len()), ("TEXCOORD_0", uvs.len()), ("COLOR_0", colors.len())] {
        if length != 0 && length != count {
            return Err(FileError::new(format!("there are {length} {name} for {count} vertices")));
        }
    }
    if normals.iter().flatten().any(|c| !c.is_finite()) {
        normals.clear();
    }
    morph(buffers, &primitive.targets, pose.weights, &mut vertices, &mut normals)?;
    let mirrored = match pose.joints {
        Some(joints) => {
            skin(&attributes, joints, &mut vertices, &mut normals)?;
            false
        }
        None => {
            place(&pose.to_world, &mut vertices, &mut normals);
            pose.to_world.matrix3.determinant() < 0.0
        }
    };
    let mut triangles = triangles(&attributes, mode, count)?;
    if mirrored {
        triangles.iter_mut().for_each(|t| t.swap(1, 2));
    }
    // Pictures of glTF hang from v = 0 down.
    let uvs = uvs.into_iter().map(|[u, v]| [finite(u), finite(1.0 - v)]).collect();
    let colors = colors.into_iter().map(|c| c.map(|c| finite(c).max(0.0))).collect();
    Ok(Some(MeshData { vertices, triangles, normals, uvs, colors }))
}

fn finite(number: f32) -> f32 {
    if number.is_finite() { number } else { 0.0 }
}

fn triangles(attributes: &Attributes<'_>, mode: u32, count: usize) -> Result<Vec<[u32; 3]>, FileError> {
    let Indices { indices, mode } = attributes.indices(mode, count)?;
    if let Some(bad) = indices.iter().find(|&&i| i as usize >= count) {
        return Err(FileError::new(format!("a triangle names vertex {bad} of {count}")));
    }
    let triangles = match (mode, indices.first()) {
        (4, _) => indices.chunks_exact(3).filter_map(|t| t.try_into().ok()).collect(),
        // Every other triangle of a strip is the other way round.
        (5, _) => {
            let windows = indices.windows(3).enumerate();
            let turned = |(i, t): (usize, &[u32])| -> Option<[u32; 3]> {
                let [a, b, c] = t.try_into().ok()?;
                Some(if i % 2 == 0 { [a, b, c] } else { [b, a, c] })
            };
            windows.filter_map(turned).collect()
        }
        (6, Some(&first)) => {
            indices.get(1..).unwrap_or_default().windows(2).map(|edge| [first, edge[0], edge[1]]).collect()
        }
        (6, None) => Vec::new(),
        _ => return Err(FileError::new(format!("the mode {mode} of a mesh does not exist"))),
    };
    Ok(triangles)
}

fn morph(
    buffers: &Buffers<'_>,
    targets: &[BTreeMap<String, usize>],
    weights: &[f32],
    vertices: &mut [[f32; 3]],
    normals: &mut [[f32; 3]],
) -> Result<(), FileError> {
    for (target, &weight) in targets.iter().zip(weights).filter(|(_, weight)| **weight != 0.0) {
        for (name, values) in [("POSITION", &mut *vertices), ("NORMAL", &mut *normals)] {
            let Some(&index) = target.get(name) else { continue };
            for (value, by) in values.iter_mut().zip(buffers.floats::<3>(index, 0.0)?) {
                value.iter_mut().zip(by).for_each(|(value, by)| *value += weight * by);
            }
        }
    }
    Ok(())
}

fn place(to_world: &DAffine3, vertices: &mut [[f32; 3]], normals: &mut [[f32; 3]]) {
    let of_normals = normal_matrix(to_world);
    for v in vertices {
        *v = to_world.transform_point3(double(*v)).as_vec3().into();
    }
    for n in normals {
        *n = (of_normals * double(*n)).normalize_or_zero().as_vec3().into();
    }
}

/// The cofactors: the transposed inverse times the determinant, which also a flat matrix has.
fn normal_matrix(to_world: &DAffine3) -> DMat3 {
    let m = to_world.matrix3;
    let cofactors = DMat3::from_cols(m.y_axis.cross(m.z_axis), m.z_axis.cross(m.x_axis), m.x_axis.cross(m.y_axis));
    if m.determinant() < 0.0 { cofactors * -1.0 } else { cofactors }
}

fn double(v: [f32; 3]) -> DVec3 {
    DVec3::from(v.map(f64::from))
}

fn skin(
    attributes: &Attributes<'_>,
    joints: &[DAffine3],
    vertices: &mut [[f32; 3]],
    normals: &mut [[f32; 3]],
) -> Result<(), FileError> {
    let mut sums = vec![(DAffine3::ZERO, 0.0); vertices.len()];
    for set in 0.. {
        let ids = attributes.numbers::<4>(&format!("JOINTS_{set}"))?;
        let weights = attributes.floats::<4>(&format!("WEIGHTS_{set}"), 0.0)?;
        let (Some(ids), Some(weights)) = (ids, weights) else { break };
        let parts = ids.into_iter().zip(weights);
        for ((sum, total), (ids, weights)) in sums.iter_mut().zip(parts) {
            for (id, weight) in ids.into_iter().zip(weights.map(f64::from)).filter(|&(_, weight)| weight > 0.0) {
                let joint = joints.get(id as usize);
                let joint =
                    joint.ok_or_else(|| FileError::new(format!("a vertex hangs on joint {id} of {}", joints.len())))?;
                sum.matrix3 += joint.matrix3 * weight;
                sum.translation += joint.translation * weight;
                *total += weight;
            }
        }
    }
    for (i, (mut sum, total)) in sums.into_iter().enumerate().filter(|(_, (_, total))| *total > 0.0) {
        sum.matrix3 *= 1.0 / total;
        sum.translation /= total;
        place(&sum, vertices.get_mut(i..=i).unwrap_or_default(), normals.get_mut(i..=i).unwrap_or_default());
    }
    Ok(())
}
