//! Triangles of a primitive: posed by morph targets and joints, moved by its node.
//!
//! Khronos, glTF 2.0 Specification, 2021, §3.7.

use std::collections::BTreeMap;

use eyebeam_core::shape::MeshData;
use glam::{DAffine3, DMat3, DVec3};

use crate::error::FileError;
use crate::scene::model::gltf::accessor::Buffers;
use crate::scene::model::gltf::attribute::{Attributes, Indices};
use crate::scene::model::gltf::document::Primitive;

/// A mesh with so much of each morph target, posed by its joints if there are any: where each has moved since the skin was bound. None for
/// points and lines.
pub(super) fn read(
    buffers: &Buffers<'_>,
    primitive: &Primitive,
    weights: &[f32],
    joints: Option<&[DAffine3]>,
) -> Result<Option<MeshData>, FileError> {
    let mode = primitive.mode.unwrap_or(4);
    if mode < 4 || !primitive.attributes.contains_key("POSITION") {
        return Ok(None);
    }
    let attributes = Attributes::new(buffers, primitive)?;
    let mut vertices = attributes.floats::<3>("POSITION", 0.0)?.unwrap_or_default();
    let count = vertices.len();
    let mut normals = attributes.floats::<3>("NORMAL", 0.0)?.unwrap_or_default();
    let mut tangents = attributes.floats::<4>("TANGENT", 1.0)?.unwrap_or_default();
    let uvs = |name: &str| attributes.floats::<2>(name, 0.0);
    let [uvs, uvs_1] = [uvs("TEXCOORD_0")?.unwrap_or_default(), uvs("TEXCOORD_1")?.unwrap_or_default()];
    let colors = attributes.floats::<4>("COLOR_0", 1.0)?.unwrap_or_default();
    let lengths = [
        ("NORMAL", normals.len()),
        ("TANGENT", tangents.len()),
        ("TEXCOORD_0", uvs.len()),
        ("TEXCOORD_1", uvs_1.len()),
        ("COLOR_0", colors.len()),
    ];
    for (name, length) in lengths {
        if length != 0 && length != count {
            return Err(FileError::new(format!("there are {length} {name} for {count} vertices")));
        }
    }
    if normals.iter().flatten().any(|c| !c.is_finite()) {
        normals.clear();
    }
    if normals.is_empty() || tangents.iter().flatten().any(|c| !c.is_finite()) {
        tangents.clear();
    }
    let frames = Frames { vertices: &mut vertices, normals: &mut normals, tangents: &mut tangents };
    morph(buffers, &primitive.targets, weights, frames)?;
    let is_mirrored = match joints {
        Some(joints) => {
            let frames = Frames { vertices: &mut vertices, normals: &mut normals, tangents: &mut tangents };
            skin(&attributes, joints, frames)?
        }
        None => false,
    };
    let mut triangles = triangles(&attributes, mode, count)?;
    if is_mirrored {
        turn_round(&mut triangles);
    }
    // Pictures of glTF hang from v = 0 down.
    let [uvs, uvs_1] = [uvs, uvs_1].map(|uvs| uvs.into_iter().map(|[u, v]| [finite(u), finite(1.0 - v)]).collect());
    let alphas = colors.iter().map(|[.., alpha]| finite(*alpha).clamp(0.0, 1.0));
    let alphas = if alphas.clone().any(|alpha| alpha < 1.0) { alphas.collect() } else { Vec::new() };
    let colors = colors.into_iter().map(|[r, g, b, _]| [r, g, b].map(|c| finite(c).max(0.0))).collect();
    Ok(Some(MeshData { vertices, triangles, normals, uvs, uvs_1, tangents, colors, alphas }))
}

/// Moves a mesh to where it stands. A transform that mirrors turns triangles round, so that their outsides stay outside.
pub(super) fn place(mesh: &mut MeshData, to_world: &DAffine3) {
    let MeshData { vertices, normals, tangents, .. } = mesh;
    transform(to_world, Frames { vertices, normals, tangents });
    if to_world.matrix3.determinant() < 0.0 {
        turn_round(&mut mesh.triangles);
    }
}

fn turn_round(triangles: &mut [[u32; 3]]) {
    triangles.iter_mut().for_each(|t| t.swap(1, 2));
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
    frames: Frames<'_>,
) -> Result<(), FileError> {
    let Frames { vertices, normals, tangents } = frames;
    for (target, &weight) in targets.iter().zip(weights).filter(|(_, weight)| **weight != 0.0) {
        let moves = |name: &str| target.get(name).map(|&i| buffers.floats::<3>(i, 0.0)).transpose();
        for (name, values) in [("POSITION", &mut *vertices), ("NORMAL", &mut *normals)] {
            for (value, by) in values.iter_mut().zip(moves(name)?.unwrap_or_default()) {
                value.iter_mut().zip(by).for_each(|(value, by)| *value += weight * by);
            }
        }
        for (value, by) in tangents.iter_mut().zip(moves("TANGENT")?.unwrap_or_default()) {
            value.iter_mut().zip(by).for_each(|(value, by)| *value += weight * by);
        }
    }
    Ok(())
}

fn transform(to_world: &DAffine3, Frames { vertices, normals, tangents }: Frames<'_>) {
    let of_normals = normal_matrix(to_world);
    for v in vertices {
        *v = to_world.transform_point3(double(*v)).as_vec3().into();
    }
    for n in normals {
        *n = (of_normals * double(*n)).normalize_or_zero().as_vec3().into();
    }
    // A mirror changes sides.
    let side = if to_world.matrix3.determinant() < 0.0 { -1.0 } else { 1.0 };
    for [x, y, z, w] in tangents {
        [*x, *y, *z] = to_world.transform_vector3(double([*x, *y, *z])).normalize_or_zero().as_vec3().into();
        *w *= side;
    }
}

/// The cofactors: the transposed inverse times the determinant, which also a flat matrix has.
fn normal_matrix(to_world: &DAffine3) -> DMat3 {
    let m = to_world.matrix3;
    let cofactors = DMat3::from_cols(m.y_axis.cross(m.z_axis), m.z_axis.cross(m.x_axis), m.x_axis.cross(m.y_axis));
    if m.determinant() < 0.0 { cofactors * -1.0 } else { cofactors }
}

/// Vertices, with normals and tangents if there are any.
struct Frames<'a> {
    vertices: &'a mut [[f32; 3]],
    normals: &'a mut [[f32; 3]],
    tangents: &'a mut [[f32; 4]],
}

impl Frames<'_> {
    /// Those of one vertex.
    fn one(&mut self, i: usize) -> Frames<'_> {
        Frames {
            vertices: self.vertices.get_mut(i..=i).unwrap_or_default(),
            normals: self.normals.get_mut(i..=i).unwrap_or_default(),
            tangents: self.tangents.get_mut(i..=i).unwrap_or_default(),
        }
    }
}

fn double(v: [f32; 3]) -> DVec3 {
    DVec3::from(v.map(f64::from))
}

/// Moves vertices with the joints on which they hang; whether that mirrors most of them.
fn skin(attributes: &Attributes<'_>, joints: &[DAffine3], mut frames: Frames<'_>) -> Result<bool, FileError> {
    let mut sums = vec![(DAffine3::ZERO, 0.0); frames.vertices.len()];
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
    let (mut count, mut mirrored) = (0_usize, 0_usize);
    for (i, (mut sum, total)) in sums.into_iter().enumerate().filter(|(_, (_, total))| *total > 0.0) {
        sum.matrix3 *= 1.0 / total;
        sum.translation /= total;
        count += 1;
        mirrored += usize::from(sum.matrix3.determinant() < 0.0);
        transform(&sum, frames.one(i));
    }
    Ok(2 * mirrored > count)
}
