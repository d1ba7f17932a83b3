//! PLY: polygons as text or binary, with whatever else their maker wrote.
//!
//! Read are the element `vertex` with `x y z`, `nx ny nz`, `u v` (also `s t`, `texture_u texture_v`, `texture_s texture_t`),
//! `red green blue` (also `diffuse_red` and so on, `r g b`) and `alpha`, of `face` the list `vertex_indices` or `vertex_index`, of
//! `tristrips` the same list, where -1 ends a strip. Polygons become triangles, also concave ones; faces of fewer than three corners are
//! dropped. Colours of whole numbers are sRGB signals: from 0 to 255 or 65535 if they are bytes or words, and if they are of another type up to
//! the smaller of these that none exceeds. Others are linear light. Second coordinates `u1 v1` and tangents `tx ty tz tw` are ours. Everything else
//! is skipped, with a warning. Turk, "The PLY Polygon File Format", 1994.

mod faces;
mod header;
mod unread;
mod values;
mod vertices;
mod write;

use std::path::Path;

use eyebeam_core::shape::MeshData;

use crate::error::{Error, FileError};
use crate::file;
use crate::warning::Warning;
use faces::Faces;
use header::{Element, Format, Header, Kind, Scalar, is_read};
use values::{Binary, Text, Values};
use vertices::read_vertices;

pub use write::encode_ply;

/// Reads a mesh; with what of the file is not read.
///
/// # Errors
/// If the file cannot be read, is damaged, or has no faces.
pub fn read_ply(path: &Path) -> Result<(MeshData, Vec<Warning>), Error> {
    read_ply_bytes(&path.display().to_string(), &file::read(path)?)
}

/// As [`read_ply`], from the bytes of a file; `name` stands for it in errors.
///
/// # Errors
/// If the bytes are damaged, or have no faces.
pub fn read_ply_bytes(name: &str, bytes: &[u8]) -> Result<(MeshData, Vec<Warning>), Error> {
    let (mesh, warnings) = read(bytes).map_err(|e| e.of(name))?;
    Ok((mesh, warnings.into_iter().map(|warning| warning.of(name)).collect()))
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

fn read(bytes: &[u8]) -> Result<(MeshData, Vec<Warning>), FileError> {
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

fn read_body(header: &Header, mut values: impl Values) -> Result<(MeshData, Vec<Warning>), FileError> {
    let mut mesh = MeshData::default();
    let mut faces = Faces::default();
    let vertices = header.only("vertex")?.map_or(0, |e| e.count);
    let last = header.elements.iter().rposition(is_read).map_or(0, |last| last + 1);
    let (elements, others) = header.elements.split_at(last);
    // Faces that come before the vertices that they have.
    let mut early = Vec::new();
    for element in elements.iter().filter(|e| is_read(e) || !e.properties.is_empty()) {
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
            "face" | "tristrips" if mesh.vertices.len() == vertices => {
                faces.read(element, &mut values, &mesh.vertices)?
            }
            _ => {
                if is_read(element) {
                    Faces::corners(element)?;
                    early.push((element, values.clone()));
                }
                (0..element.count).try_for_each(|_| skip(&mut values, element))?
            }
        }
    }
    for (element, mut values) in early {
        faces.read(element, &mut values, &mesh.vertices)?;
    }
    let warnings = unread::warnings(header, &faces, &values, others);
    mesh.triangles = faces.triangles;
    Ok((mesh, warnings))
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
