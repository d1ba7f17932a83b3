//! The vertices of a PLY file: positions, and what else they have.

use eyebeam_core::color::srgb_decode;
use eyebeam_core::shape::MeshData;

use crate::error::{At, FileError};
use crate::scene::ply::header::{Element, Kind, Scalar};
use crate::scene::ply::skip_property;
use crate::scene::ply::values::Values;

/// Names of texture coordinates, the first that are there.
const UV: [[&str; 2]; 4] = [["u", "v"], ["s", "t"], ["texture_u", "texture_v"], ["texture_s", "texture_t"]];

/// Names of colours, the first that are there.
const COLOR: [[&str; 3]; 3] =
    [["red", "green", "blue"], ["diffuse_red", "diffuse_green", "diffuse_blue"], ["r", "g", "b"]];

/// Which properties are read, by their indices.
struct Columns {
    position: Option<[usize; 3]>,
    normal: Option<[usize; 3]>,
    uv: Option<[usize; 2]>,
    uv_1: Option<[usize; 2]>,
    tangent: Option<[usize; 4]>,
    color: Option<[usize; 3]>,
    alpha: Option<[usize; 1]>,
}

impl Columns {
    fn new(element: &Element) -> Self {
        let normal = element.scalars(["nx", "ny", "nz"]);
        Self {
            position: element.scalars(["x", "y", "z"]),
            normal,
            uv: UV.iter().find_map(|names| element.scalars(*names)),
            uv_1: element.scalars(["u1", "v1"]),
            tangent: element.scalars(["tx", "ty", "tz", "tw"]).filter(|_| normal.is_some()),
            color: COLOR.iter().find_map(|names| element.scalars(*names)),
            alpha: element.scalars(["alpha"]),
        }
    }

    /// Those that hold colours and alphas.
    fn shares(&self) -> impl Iterator<Item = usize> {
        self.color.into_iter().flatten().chain(self.alpha.into_iter().flatten())
    }
}

/// Which properties of vertices are read, by their indices.
pub(super) fn read_columns(element: &Element) -> Vec<usize> {
    let columns = Columns::new(element);
    let triples = [columns.position, columns.normal].into_iter().flatten().flatten();
    let pairs = [columns.uv, columns.uv_1].into_iter().flatten().flatten();
    triples.chain(pairs).chain(columns.tangent.into_iter().flatten()).chain(columns.shares()).collect()
}

pub(super) fn read_vertices(element: &Element, values: &mut impl Values, mesh: &mut MeshData) -> Result<(), FileError> {
    let columns = Columns::new(element);
    let Columns { position, normal, uv, uv_1, tangent, color, alpha } = columns;
    let position = position
        .ok_or_else(|| FileError::new("vertices have no numbers `x`, `y` and `z`").at(At::Line(element.line)))?;
    mesh.vertices.reserve_exact(element.count);
    let count = |is_there: bool| if is_there { element.count } else { 0 };
    mesh.normals.reserve_exact(count(normal.is_some()));
    mesh.uvs.reserve_exact(count(uv.is_some()));
    mesh.uvs_1.reserve_exact(count(uv_1.is_some()));
    mesh.tangents.reserve_exact(count(tangent.is_some()));
    mesh.colors.reserve_exact(count(color.is_some()));
    mesh.alphas.reserve_exact(count(alpha.is_some()));
    let kind = |k: usize| element.properties[k].kind;
    let untold: Vec<_> = columns.shares().filter(|&k| is_untold(kind(k))).collect();
    let mut most = 0.0_f32;
    let mut row = vec![0.0; element.properties.len()];
    for i in 0..element.count {
        let at = values.at();
        for (value, property) in row.iter_mut().zip(&element.properties) {
            match property.kind {
                Kind::Scalar(scalar) => *value = values.next(scalar)? as f32,
                kind @ Kind::List(..) => skip_property(values, kind)?,
            }
        }
        let p = position.map(|k| row[k]);
        if p.iter().any(|c| !c.is_finite()) {
            return Err(FileError::new(format!("vertex {i} is at {p:?}, which is not finite")).at(at));
        }
        for &k in &untold {
            // Who writes bytes as `char` means those above 127, too.
            if kind(k) == Kind::Scalar(Scalar::I8) && row[k] < 0.0 {
                row[k] += 256.0;
            }
            most = most.max(Some(row[k]).filter(|value| value.is_finite()).unwrap_or_default());
        }
        mesh.vertices.push(p);
        mesh.normals.extend(normal.map(|n| finite(n.map(|k| row[k]))));
        mesh.uvs.extend(uv.map(|uv| finite(uv.map(|k| row[k]))));
        mesh.uvs_1.extend(uv_1.map(|uv| finite(uv.map(|k| row[k]))));
        mesh.tangents.extend(tangent.map(|t| finite(t.map(|k| row[k]))));
        mesh.alphas.extend(alpha.map(|[k]| row[k]));
        mesh.colors.extend(color.map(|color| color.map(|k| row[k])));
    }
    if let Some(color) = color {
        let largest = color.map(|k| largest(kind(k), most));
        for c in &mut mesh.colors {
            for (value, largest) in c.iter_mut().zip(largest) {
                *value = light(*value, largest);
            }
        }
    }
    if let Some([k]) = alpha {
        let largest = largest(kind(k), most);
        mesh.alphas.iter_mut().for_each(|alpha| *alpha = share(*alpha, largest));
    }
    Ok(())
}

/// Whether it is a type of whole numbers that seldom is as large as shares need: only its values tell up to what they count.
fn is_untold(kind: Kind) -> bool {
    matches!(kind, Kind::Scalar(Scalar::I8 | Scalar::I16 | Scalar::I32 | Scalar::U32))
}

/// What a whole number counts up to where it stands for a share; `most` is the largest of the file whose type does not tell.
fn largest(kind: Kind, most: f32) -> Option<f32> {
    match kind {
        Kind::Scalar(Scalar::U8) => Some(255.0),
        Kind::Scalar(Scalar::U16) => Some(65535.0),
        kind if !is_untold(kind) => None,
        _ if most <= 255.0 => Some(255.0),
        _ => Some(most.max(65535.0)),
    }
}

/// The linear light that a number stands for.
fn light(value: f32, largest: Option<f32>) -> f32 {
    match largest {
        _ if !value.is_finite() => 0.0,
        Some(largest) => srgb_decode(value.max(0.0) / largest),
        None => value.max(0.0),
    }
}

/// The share that a number stands for.
fn share(value: f32, largest: Option<f32>) -> f32 {
    let share = value / largest.unwrap_or(1.0);
    if share.is_nan() { 1.0 } else { share.clamp(0.0, 1.0) }
}

/// Zero if one of them is not.
fn finite<const N: usize>(v: [f32; N]) -> [f32; N] {
    if v.iter().all(|c| c.is_finite()) { v } else { [0.0; N] }
}
