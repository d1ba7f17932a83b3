//! STL: triangles for 3D printers, as text or binary; a mesh without normals, whose equal vertices are one.
//!
//! A file of the length that its binary count of triangles says is binary, even if it begins with `solid`. What is up is not
//! said; printers build along +Z. StereoLithography Interface Specification, 3D Systems, 1988.

use std::collections::HashMap;
use std::io::Read;
use std::sync::Arc;

use eyebeam_core::shape::{MeshData, MeshDesc};

use crate::error::{At, Error, FileError};
use crate::memory::Memory;
use crate::scene::ReadOptions;
use crate::scene::model::Model;
use crate::scene::model::files::Input;
use crate::scene::model::lines::Lines;
use crate::scene::model::skipped::Skipped;
use crate::warning::Warning;

/// Bytes before the triangles: a title and their number.
const HEADER: usize = 84;
/// Bytes of a triangle: a normal, three vertices, and two of colour.
const FACET: usize = 50;

pub(super) fn read(input: &Input<'_>, _: &ReadOptions<'_>, memory: &Memory) -> Result<Model, Error> {
    let name = input.name.clone();
    let mut model = Model::new();
    let mut mesh = Builder::new(memory);
    let (mut source, length) = input.open()?;
    let mut header = Vec::new();
    source.by_ref().take(HEADER as u64).read_to_end(&mut header).map_err(|e| input.unreadable(e))?;
    let count = header.last_chunk::<4>().filter(|_| header.len() == HEADER).map(|n| u32::from_le_bytes(*n));
    let expected = count.map(|count| HEADER as u64 + u64::from(count) * FACET as u64);
    let says_solid = header.trim_ascii_start().get(..5).is_some_and(|word| word.eq_ignore_ascii_case(b"solid"));
    match (count, expected) {
        (Some(count), Some(expected)) if expected == length || (!says_solid && expected <= length) => {
            let colored = binary(&mut source, count, &mut mesh).map_err(|e| e.or_read(input))?;
            if colored > 0 {
                model.warnings.push(Warning::new(format!("the colours of {colored} triangles are not read")));
            }
            if expected < length {
                let rest = length - expected;
                let warning = Warning::new(format!("{rest} bytes after the triangles are not read"));
                model.warnings.push(warning.at(At::Byte(expected as usize)));
            }
        }
        _ if says_solid => text(input, &mut mesh, &mut model.warnings)?,
        (Some(count), _) => {
            let error = FileError::new(format!("the file is too short for {count} triangles"));
            return Err(error.at(At::Byte(HEADER - 4)).hint("it is cut off, or no STL").of(&name));
        }
        (None, _) => {
            return Err(FileError::new("the file is no STL").hint("it is cut off, or of another kind").of(&name));
        }
    }
    memory.take(mesh.bytes()).map_err(|e| e.of(&name))?;
    let data = Some(Arc::new(mesh.data));
    model.desc.shape.mesh.push(MeshDesc { file: Some(name), data, ..MeshDesc::default() });
    Ok(model)
}

/// A mesh in the making.
struct Builder<'a> {
    data: MeshData,
    /// Vertices by their bits.
    vertices: HashMap<[u32; 3], u32>,
    memory: &'a Memory,
}

impl<'a> Builder<'a> {
    fn new(memory: &'a Memory) -> Self {
        Self { data: MeshData::default(), vertices: HashMap::new(), memory }
    }

    /// That it takes until now, about.
    fn bytes(&self) -> u64 {
        // A vertex is in a list and in a table that may be half empty.
        (12 * self.data.triangles.len() + 48 * self.data.vertices.len()) as u64
    }

    fn push(&mut self, corners: [[f32; 3]; 3]) -> Result<(), FileError> {
        const BETWEEN_CHECKS: usize = 1 << 16;
        if self.data.triangles.len().is_multiple_of(BETWEEN_CHECKS) {
            self.memory.check(self.bytes())?;
        }
        let mut triangle = [0; 3];
        for (index, corner) in triangle.iter_mut().zip(corners) {
            if corner.iter().any(|c| !c.is_finite()) {
                return Err(FileError::new(format!("a vertex is at {corner:?}, which is not finite")));
            }
            let count = self.data.vertices.len();
            let count = u32::try_from(count).map_err(|_| FileError::new("there are too many vertices"))?;
            *index = *self.vertices.entry(corner.map(f32::to_bits)).or_insert_with(|| {
                self.data.vertices.push(corner);
                count
            });
        }
        self.data.triangles.push(triangle);
        Ok(())
    }
}

enum Failure {
    Io(std::io::Error),
    File(FileError),
}

impl Failure {
    fn or_read(self, input: &Input<'_>) -> Error {
        match self {
            Self::Io(e) => input.unreadable(e),
            Self::File(e) => e.of(&input.name),
        }
    }
}

/// Reads triangles; how many have colours.
fn binary(source: &mut impl Read, count: u32, mesh: &mut Builder<'_>) -> Result<usize, Failure> {
    let mut colored = 0;
    let mut facet = [0; FACET];
    for i in 0..count as usize {
        source.read_exact(&mut facet).map_err(Failure::Io)?;
        let (words, _) = facet.as_chunks::<4>();
        let mut numbers = words.iter().skip(3).map(|word| f32::from_le_bytes(*word));
        let mut vertex = || [(); 3].map(|()| numbers.next().unwrap_or_default());
        let corners = [(); 3].map(|()| vertex());
        mesh.push(corners).map_err(|e| Failure::File(e.at(At::Byte(HEADER + i * FACET))))?;
        colored += usize::from(!facet.ends_with(&[0, 0]));
    }
    Ok(colored)
}

/// Reads a text: the vertices between `outer loop` and `endloop`.
fn text(input: &Input<'_>, mesh: &mut Builder<'_>, warnings: &mut Vec<Warning>) -> Result<(), Error> {
    let name = &input.name;
    let mut lines = Lines::new(input.open()?.0, name, false)?;
    let mut skipped = Skipped::default();
    let mut corners: Vec<[f32; 3]> = Vec::new();
    let mut last = 0;
    let mut ended = false;
    while let Some((number, line)) = lines.next()? {
        last = number;
        let wrong = |error: FileError| error.at(At::Line(number)).of(name);
        let mut words = line.split_ascii_whitespace();
        let Some(word) = words.next() else { continue };
        match word.to_ascii_lowercase().as_str() {
            "vertex" => {
                let mut vertex = [0.0; 3];
                for c in &mut vertex {
                    let word = words.next().ok_or_else(|| wrong(FileError::new("a vertex has three numbers")))?;
                    *c = word.parse().map_err(|_| wrong(FileError::new(format!("`{word}` is no number"))))?;
                }
                corners.push(vertex);
                if corners.len() > 3 {
                    return Err(wrong(FileError::new("a facet has more than three vertices")));
                }
            }
            "endloop" => match corners[..] {
                [a, b, c] => {
                    mesh.push([a, b, c]).map_err(wrong)?;
                    corners.clear();
                }
                _ => return Err(wrong(FileError::new(format!("a facet has {} vertices, and not 3", corners.len())))),
            },
            "endsolid" | "end" => ended = true,
            "solid" => ended = false,
            "facet" | "outer" | "endfacet" => {}
            other => skipped.note(&format!("`{other}` is not read"), number),
        }
    }
    if !corners.is_empty() || !ended {
        let error = FileError::new("the file ends within a solid").at(At::Line(last.max(1)));
        return Err(error.hint("it is cut off").of(name));
    }
    warnings.extend(skipped.warnings(name));
    Ok(())
}
