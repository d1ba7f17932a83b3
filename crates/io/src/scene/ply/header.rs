//! The header of a PLY file: its elements, their number, and the properties of each.

use crate::error::{At, FileError};

/// How numbers are stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Format {
    Ascii,
    LittleEndian,
    BigEndian,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Scalar {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

impl Scalar {
    fn parse(name: &str) -> Option<Self> {
        Some(match name {
            "char" | "int8" => Self::I8,
            "uchar" | "uint8" => Self::U8,
            "short" | "int16" => Self::I16,
            "ushort" | "uint16" => Self::U16,
            "int" | "int32" => Self::I32,
            "uint" | "uint32" => Self::U32,
            "float" | "float32" => Self::F32,
            "double" | "float64" => Self::F64,
            _ => return None,
        })
    }

    /// Bytes.
    pub(super) fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::F64 => 8,
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Scalar(Scalar),
    /// The number of items, and the items.
    List(Scalar, Scalar),
}

#[derive(Debug)]
pub(super) struct Property {
    pub(super) name: String,
    pub(super) kind: Kind,
}

#[derive(Debug)]
pub(super) struct Element {
    pub(super) name: String,
    pub(super) count: usize,
    pub(super) properties: Vec<Property>,
    /// Where it is declared, from 1.
    pub(super) line: usize,
}

impl Element {
    /// Indices of properties that are single numbers, if all are there.
    pub(super) fn scalars<const N: usize>(&self, names: [&str; N]) -> Option<[usize; N]> {
        let mut indices = [0; N];
        for (index, name) in indices.iter_mut().zip(names) {
            *index = self.properties.iter().position(|p| p.name == name && matches!(p.kind, Kind::Scalar(_)))?;
        }
        Some(indices)
    }

    /// Index of the list of the corners of faces.
    pub(super) fn corners(&self) -> Option<usize> {
        let names = ["vertex_indices", "vertex_index"];
        let is_it = |p: &Property| names.contains(&p.name.as_str()) && matches!(p.kind, Kind::List(..));
        self.properties.iter().position(is_it)
    }
}

/// Whether it is one that meshes are made of.
pub(super) fn is_read(element: &Element) -> bool {
    matches!(element.name.as_str(), "vertex" | "face" | "tristrips")
}

#[derive(Debug)]
pub(super) struct Header {
    pub(super) format: Format,
    pub(super) elements: Vec<Element>,
    /// Pictures that comments name, as MeshLab and others write them, each with its line.
    pub(super) pictures: Vec<(String, usize)>,
    /// Bytes up to the first value.
    pub(super) length: usize,
    /// Lines of these.
    pub(super) lines: usize,
}

/// Longer headers are refused.
const MAX_BYTES: usize = 1 << 20;

impl Header {
    pub(super) fn parse(bytes: &[u8]) -> Result<Self, FileError> {
        let text = &bytes[..bytes.len().min(MAX_BYTES)];
        let no_ply = || FileError::new("this is no PLY file").at(At::Line(1)).hint("its first line must be `ply`");
        // Lines end as the first one does: in a line feed, or, by old Macintoshes, in a carriage return alone.
        let end = text.iter().position(|b| b"\r\n".contains(b)).ok_or_else(no_ply)?;
        let separator = if text[end] == b'\r' && text.get(end + 1) != Some(&b'\n') { b'\r' } else { b'\n' };
        if text[..end].trim_ascii() != b"ply" {
            return Err(no_ply());
        }
        let (mut format, mut elements, mut length) = (None, Vec::<Element>::new(), 0);
        let mut pictures = Vec::new();
        for (lines, line) in (1..).zip(text.split_inclusive(|&b| b == separator)) {
            length += line.len();
            let line = std::str::from_utf8(line).unwrap_or("?");
            pictures.extend(picture(line).map(|name| (name.to_owned(), lines)));
            let is_end = parse_line(line, lines, &mut format, &mut elements).map_err(|e| e.at(At::Line(lines)))?;
            if is_end {
                let no_format = || FileError::new("the header has no format").hint("add `format ascii 1.0`");
                return Ok(Self { format: format.ok_or_else(no_format)?, elements, pictures, length, lines });
            }
        }
        Err(FileError::new("the header has no `end_header`").hint("the file is cut off, or no PLY file"))
    }

    /// The element of this name.
    pub(super) fn only(&self, name: &str) -> Result<Option<&Element>, FileError> {
        let mut found = self.elements.iter().filter(|e| e.name == name);
        let first = found.next();
        match found.next() {
            None => Ok(first),
            Some(second) => Err(FileError::new(format!("two elements are named `{name}`")).at(At::Line(second.line))),
        }
    }
}

/// The name after `comment TextureFile`, if the line is that.
fn picture(line: &str) -> Option<&str> {
    let name = line.trim().strip_prefix("comment")?.trim_start().strip_prefix("TextureFile")?;
    Some(name.trim()).filter(|trimmed| !trimmed.is_empty() && name.starts_with(|c: char| c.is_ascii_whitespace()))
}

/// Whether it was the last one.
fn parse_line(
    text: &str,
    line: usize,
    format: &mut Option<Format>,
    elements: &mut Vec<Element>,
) -> Result<bool, FileError> {
    let words: Vec<_> = text.split_ascii_whitespace().collect();
    match words.as_slice() {
        [] | ["ply" | "comment" | "obj_info", ..] => {}
        ["end_header"] => return Ok(true),
        ["format", name, ..] => {
            *format = Some(match *name {
                "ascii" => Format::Ascii,
                "binary_little_endian" => Format::LittleEndian,
                "binary_big_endian" => Format::BigEndian,
                _ => {
                    return Err(FileError::new(format!("unknown format `{name}`"))
                        .hint("`ascii`, `binary_little_endian` and `binary_big_endian` are known"));
                }
            });
        }
        ["element", name, count] => {
            let count = count.parse().map_err(|_| FileError::new(format!("`{count}` is no number of elements")))?;
            elements.push(Element { name: (*name).to_owned(), count, properties: Vec::new(), line });
        }
        ["property", declaration @ ..] => {
            let element = elements.last_mut().ok_or_else(|| FileError::new("a property comes before its element"))?;
            element.properties.push(parse_property(declaration)?);
        }
        [keyword, ..] => return Err(FileError::new(format!("`{keyword}` in the header is not understood"))),
    }
    Ok(false)
}

fn parse_property(words: &[&str]) -> Result<Property, FileError> {
    let scalar = |name: &str| {
        Scalar::parse(name).ok_or_else(|| {
            FileError::new(format!("unknown type `{name}`"))
                .hint("char, uchar, short, ushort, int, uint, float and double are known")
        })
    };
    let (name, kind) = match *words {
        ["list", count, item, name] => (name, Kind::List(scalar(count)?, scalar(item)?)),
        [item, name] => (name, Kind::Scalar(scalar(item)?)),
        _ => return Err(FileError::new("a property must have a type and a name").hint("like `property float x`")),
    };
    Ok(Property { name: name.to_owned(), kind })
}
