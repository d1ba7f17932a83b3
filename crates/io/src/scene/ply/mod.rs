//! PLY: polygons as text or binary, with whatever else their maker wrote.
//!
//! Read are the element `vertex` with `x y z`, `nx ny nz`, `u v` (also `s t`, `texture_u texture_v`, `texture_s texture_t`),
//! `red green blue` (also `diffuse_red` and so on, `r g b`) and `alpha`, of `face` the list `vertex_indices` or `vertex_index`, of
//! `tristrips` the same list, where -1 ends a strip. Polygons become fans of triangles; faces of fewer than three corners are dropped.
//! Colours of whole numbers are sRGB signals from 0 to their type's largest, others linear light. Second coordinates `u1 v1` and tangents
//! `tx ty tz tw` are ours. Everything else is skipped. Turk, "The PLY Polygon File Format", 1994.

mod header;
mod values;
mod write;

use std::path::Path;

use eyebeam_core::color::srgb_decode;
use eyebeam_core::shape::MeshData;

use crate::error::{At, Error, FileError};
use crate::file;
use header::{Element, Format, Header, Kind, Scalar};
use values::{Binary, Text, Values};

pub use write::encode_ply;

/// Reads a mesh.
///
/// # Errors
/// If the file cannot be read, is damaged, or has no faces.
pub fn read_ply(path: &Path) -> Result<MeshData, Error> {
    read_ply_bytes(&path.display().to_string(), &file::read(path)?)
}

/// As [`read_ply`], from the bytes of a file; `name` stands for it in errors.
///
/// # Errors
/// If the bytes are damaged, or have no faces.
pub fn read_ply_bytes(name: &str, bytes: &[u8]) -> Result<MeshData, Error> {
    read(bytes).map_err(|e| e.of(name))
}

/// About the memory that the mesh takes, by the header alone.
///
/// # Errors
/// If that is damaged.
pub fn mesh_size(name: &str, bytes: &[u8]) -> Result<u64, Error> {
    let header = Header::parse(bytes).map_err(|e| e.of(name))?;
    let size = |element: &Element| {
        let each = match element.name.as_str() {
            "vertex" => VERTEX.min(element.properties.len() as u64 * 4),
            // Two triangles.
            "face" => 24,
            _ => 0,
        };
        // An element takes a byte at least.
        element.count.min(bytes.len()) as u64 * each
    };
    Ok(header.elements.iter().map(size).sum())
}

/// The bytes of a position, a normal, two coordinates, a tangent, a colour and an alpha.
const VERTEX: u64 = 72;

fn read(bytes: &[u8]) -> Result<MeshData, FileError> {
    let header = Header::parse(bytes)?;
    let vertices = header.only("vertex")?.map_or(0, |e| e.count);
    if vertices > u32::MAX as usize {
        return Err(FileError::new(format!("{vertices} vertices are too many")));
    }
    if header.only("face")?.is_none() && header.only("tristrips")?.is_none() {
        return Err(FileError::new("the file has no faces").hint("it is a cloud of points; make a mesh of it"));
    }
    let body = &bytes[header.length..];
    match header.format {
        Format::Ascii => read_body(&header, Text::new(body, header.lines)),
        Format::LittleEndian => read_body(&header, Binary::<false>::new(body, header.length)),
        Format::BigEndian => read_body(&header, Binary::<true>::new(body, header.length)),
    }
}

fn read_body(header: &Header, mut values: impl Values) -> Result<MeshData, FileError> {
    let mut mesh = MeshData::default();
    let vertices = header.only("vertex")?.map_or(0, |e| e.count) as u32;
    let is_read = |e: &Element| matches!(e.name.as_str(), "vertex" | "face" | "tristrips");
    let last = header.elements.iter().rposition(is_read).unwrap_or_default();
    for element in header.elements.iter().take(last + 1).filter(|e| is_read(e) || !e.properties.is_empty()) {
        // Every value takes some bytes, so what is allocated is bounded by the length of the file.
        let shortest = element.properties.iter().map(|p| values.shortest(p.kind)).sum::<usize>();
        if element.count.saturating_mul(shortest) > values.remaining() {
            let Element { name, count, .. } = element;
            return Err(FileError::new(format!("the file is too short for {count} of its element `{name}`"))
                .at(values.at())
                .hint("it is cut off, or its header is wrong"));
        }
        match element.name.as_str() {
            "vertex" => read_vertices(element, &mut values, &mut mesh)?,
            "face" => read_faces(element, &mut values, vertices, &mut mesh.triangles, false)?,
            "tristrips" => read_faces(element, &mut values, vertices, &mut mesh.triangles, true)?,
            _ => (0..element.count).try_for_each(|_| skip(&mut values, element))?,
        }
    }
    Ok(mesh)
}

/// Names of texture coordinates, the first that are there.
const UV: [[&str; 2]; 4] = [["u", "v"], ["s", "t"], ["texture_u", "texture_v"], ["texture_s", "texture_t"]];

/// Names of colours, the first that are there.
const COLOR: [[&str; 3]; 3] =
    [["red", "green", "blue"], ["diffuse_red", "diffuse_green", "diffuse_blue"], ["r", "g", "b"]];

/// What a whole number counts up to where it stands for a share.
fn largest(kind: Kind) -> Option<f32> {
    match kind {
        Kind::Scalar(Scalar::U8) => Some(255.0),
        Kind::Scalar(Scalar::U16) => Some(65535.0),
        _ => None,
    }
}

/// The linear light that a number stands for.
fn light(value: f32, kind: Kind) -> f32 {
    match largest(kind) {
        Some(largest) => srgb_decode(value / largest),
        None if value.is_finite() => value.max(0.0),
        None => 0.0,
    }
}

/// The share that a number stands for.
fn share(value: f32, kind: Kind) -> f32 {
    let share = value / largest(kind).unwrap_or(1.0);
    if share.is_nan() { 1.0 } else { share.clamp(0.0, 1.0) }
}

fn read_vertices(element: &Element, values: &mut impl Values, mesh: &mut MeshData) -> Result<(), FileError> {
    let position = element
        .scalars(["x", "y", "z"])
        .ok_or_else(|| FileError::new("vertices have no numbers `x`, `y` and `z`").at(At::Line(element.line)))?;
    let normal = element.scalars(["nx", "ny", "nz"]);
    let uv = UV.iter().find_map(|names| element.scalars(*names));
    let uv_1 = element.scalars(["u1", "v1"]);
    let tangent = element.scalars(["tx", "ty", "tz", "tw"]).filter(|_| normal.is_some());
    let color = COLOR.iter().find_map(|names| element.scalars(*names));
    let alpha = element.scalars(["alpha"]);
    mesh.vertices.reserve_exact(element.count);
    let count = |is_there: bool| if is_there { element.count } else { 0 };
    mesh.normals.reserve_exact(count(normal.is_some()));
    mesh.uvs.reserve_exact(count(uv.is_some()));
    mesh.uvs_1.reserve_exact(count(uv_1.is_some()));
    mesh.tangents.reserve_exact(count(tangent.is_some()));
    mesh.colors.reserve_exact(count(color.is_some()));
    mesh.alphas.reserve_exact(count(alpha.is_some()));
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
        mesh.vertices.push(p);
        mesh.normals.extend(normal.map(|n| finite(n.map(|k| row[k]))));
        mesh.uvs.extend(uv.map(|uv| finite(uv.map(|k| row[k]))));
        mesh.uvs_1.extend(uv_1.map(|uv| finite(uv.map(|k| row[k]))));
        mesh.tangents.extend(tangent.map(|t| finite(t.map(|k| row[k]))));
        mesh.alphas.extend(alpha.map(|[k]| share(row[k], element.properties[k].kind)));
        mesh.colors.extend(color.map(|color| color.map(|k| light(row[k], element.properties[k].kind))));
    }
    Ok(())
}

/// Zero if one of them is not.
fn finite<const N: usize>(v: [f32; N]) -> [f32; N] {
    if v.iter().all(|c| c.is_finite()) { v } else { [0.0; N] }
}

fn read_faces(
    element: &Element,
    values: &mut impl Values,
    vertices: u32,
    triangles: &mut Vec<[u32; 3]>,
    are_strips: bool,
) -> Result<(), FileError> {
    let corners = element.list(["vertex_indices", "vertex_index"]).ok_or_else(|| {
        let message = format!("the element `{}` has no list `vertex_indices`", element.name);
        FileError::new(message).at(At::Line(element.line))
    })?;
    triangles.reserve(element.count);
    let mut indices = Vec::new();
    for _ in 0..element.count {
        for (k, property) in element.properties.iter().enumerate() {
            match property.kind {
                Kind::List(count, item) if k == corners => {
                    read_indices(values, count, item, vertices, are_strips, &mut indices)?;
                }
                kind => skip_property(values, kind)?,
            }
        }
        if are_strips {
            indices.split(|&index| index == END_OF_STRIP).for_each(|strip| triangles.extend(triangles_of_strip(strip)));
        } else {
            triangles.extend(triangles_of_polygon(&indices));
        }
    }
    Ok(())
}

/// Stands for -1.
const END_OF_STRIP: u32 = u32::MAX;

fn read_indices(
    values: &mut impl Values,
    count: Scalar,
    item: Scalar,
    vertices: u32,
    are_strips: bool,
    indices: &mut Vec<u32>,
) -> Result<(), FileError> {
    indices.clear();
    for _ in 0..read_count(values, count)? {
        let at = values.at();
        let index = values.next(item)?;
        if (0.0..f64::from(vertices)).contains(&index) && index.fract() == 0.0 {
            indices.push(index as u32);
        } else if are_strips && index == -1.0 {
            indices.push(END_OF_STRIP);
        } else {
            return Err(FileError::new(format!("there is no vertex {index}: the file has {vertices}")).at(at));
        }
    }
    Ok(())
}

/// The fan of a polygon.
fn triangles_of_polygon(corners: &[u32]) -> impl Iterator<Item = [u32; 3]> {
    corners.windows(2).skip(1).map(|edge| [corners[0], edge[0], edge[1]])
}

/// Every other triangle of a strip is turned over; those without area only join its parts.
fn triangles_of_strip(corners: &[u32]) -> impl Iterator<Item = [u32; 3]> {
    let triangles = corners.windows(3).zip([false, true].into_iter().cycle());
    let triangles = triangles.map(|(t, turned)| if turned { [t[1], t[0], t[2]] } else { [t[0], t[1], t[2]] });
    triangles.filter(|[a, b, c]| a != b && b != c && c != a)
}

fn read_count(values: &mut impl Values, scalar: Scalar) -> Result<usize, FileError> {
    let at = values.at();
    let count = values.next(scalar)?;
    if count >= 0.0 && count.fract() == 0.0 && count <= values.remaining() as f64 {
        Ok(count as usize)
    } else {
        Err(FileError::new(format!("a list cannot have {count} items here")).at(at))
    }
}

fn skip(values: &mut impl Values, element: &Element) -> Result<(), FileError> {
    element.properties.iter().try_for_each(|p| skip_property(values, p.kind))
}

fn skip_property(values: &mut impl Values, kind: Kind) -> Result<(), FileError> {
    match kind {
        Kind::Scalar(scalar) => values.next(scalar).map(drop),
        Kind::List(count, item) => {
            let count = read_count(values, count)?;
            (0..count).try_for_each(|_| values.next(item).map(drop))
        }
    }
}
