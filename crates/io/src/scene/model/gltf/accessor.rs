//! Numbers in buffers: interleaved, normalised, sparse.
//!
//! Khronos, glTF 2.0 Specification, 2021, §3.6. Signed normalised integers c become max(c / (2ᵇ⁻¹ − 1), −1), unsigned ones c / (2ᵇ − 1).

use std::collections::BTreeMap;

use crate::error::FileError;
use crate::memory::Memory;
use crate::scene::model::gltf::document::{Accessor, Document, SparsePart};
use crate::scene::model::gltf::draco::{self, Stream};
use crate::scene::model::gltf::extensions::get;
use crate::scene::model::gltf::meshopt::Compressed;

/// Without a buffer an accessor is all zeros: of no more than these, or than the bytes of the file.
const MOST_ZEROS: usize = 1 << 16;

/// The bytes that a file's JSON speaks of.
pub(super) struct Bytes {
    /// Of each buffer.
    buffers: Vec<Vec<u8>>,
    /// Of the buffer views that were compressed.
    decoded: BTreeMap<usize, Vec<u8>>,
    /// The meshes in buffer views.
    streams: BTreeMap<usize, Stream>,
}

impl Bytes {
    /// Decodes all buffer views that are compressed, and all meshes in them.
    pub(super) fn new(document: &Document, buffers: Vec<Vec<u8>>, memory: &Memory) -> Result<Self, FileError> {
        let mut compressed = Vec::new();
        for (index, view) in document.buffer_views.iter().enumerate() {
            let part: Option<Compressed> = get(&view.extensions, "EXT_meshopt_compression")?;
            compressed.extend(part.map(|part| (index, part)));
        }
        let mut left = buffers.iter().map(Vec::len).sum::<usize>();
        let decode = |(index, part): (usize, Compressed)| {
            // What is told once is not decoded many times.
            left =
                left.checked_sub(part.byte_length).ok_or_else(|| FileError::new("compressed buffer views overlap"))?;
            memory.take(part.most_bytes())?;
            let code =
                buffers.get(part.buffer).and_then(|bytes| bytes.get(part.byte_offset..)?.get(..part.byte_length));
            let code = code.ok_or_else(|| FileError::new("it reaches beyond its buffer"));
            let decoded = code.and_then(|code| part.decode(code));
            let of = |e: FileError| FileError { message: format!("buffer view {index}: {}", e.message), ..e };
            Ok((index, decoded.map_err(of)?))
        };
        let decoded = compressed.into_iter().map(decode).collect::<Result<_, FileError>>()?;
        let bytes = Self { buffers, decoded, streams: BTreeMap::new() };
        let streams = draco::decode(&Buffers { document, bytes: &bytes, memory })?;
        Ok(Self { streams, ..bytes })
    }

    /// Of all.
    fn length(&self) -> usize {
        self.buffers.iter().chain(self.decoded.values()).map(Vec::len).sum()
    }
}

/// A file's JSON and all that it names.
pub(super) struct Buffers<'a> {
    pub(super) document: &'a Document,
    pub(super) bytes: &'a Bytes,
    pub(super) memory: &'a Memory,
}

impl Buffers<'_> {
    /// Bytes of a buffer view.
    pub(super) fn view(&self, index: usize) -> Result<&[u8], FileError> {
        let view = self.document.buffer_views.get(index).ok_or_else(|| missing("buffer view", index))?;
        if let Some(decoded) = self.bytes.decoded.get(&index) {
            return Ok(decoded);
        }
        let bytes = self.bytes.buffers.get(view.buffer).ok_or_else(|| missing("buffer", view.buffer))?;
        let range = bytes.get(view.byte_offset..).and_then(|rest| rest.get(..view.byte_length));
        range.ok_or_else(|| {
            let length = bytes.len();
            FileError::new(format!("buffer view {index} reaches beyond the {length} bytes of buffer {}", view.buffer))
        })
    }

    /// The mesh in a buffer view.
    pub(super) fn stream(&self, index: usize) -> Result<&Stream, FileError> {
        self.bytes.streams.get(&index).ok_or_else(|| missing("mesh in buffer view", index))
    }

    pub(super) fn accessor(&self, index: usize) -> Result<&Accessor, FileError> {
        self.document.accessors.get(index).ok_or_else(|| missing("accessor", index))
    }

    /// Elements of up to N numbers; what there is less of is `rest`.
    pub(super) fn floats<const N: usize>(&self, index: usize, rest: f32) -> Result<Vec<[f32; N]>, FileError> {
        let accessor = self.accessor(index)?;
        let component = Component::of(accessor.component_type, index)?;
        let float = |bytes: &[u8]| component.float(bytes, accessor.normalized);
        self.elements(index, rest, float)
    }

    /// All numbers, one after the other.
    pub(super) fn flat(&self, index: usize) -> Result<Vec<f32>, FileError> {
        Ok(match components(&self.accessor(index)?.kind, index)? {
            1 => self.floats::<1>(index, 0.0)?.into_flattened(),
            2 => self.floats::<2>(index, 0.0)?.into_flattened(),
            3 => self.floats::<3>(index, 0.0)?.into_flattened(),
            4 => self.floats::<4>(index, 0.0)?.into_flattened(),
            9 => self.floats::<9>(index, 0.0)?.into_flattened(),
            _ => self.floats::<16>(index, 0.0)?.into_flattened(),
        })
    }

    /// Elements of N whole numbers.
    pub(super) fn numbers<const N: usize>(&self, index: usize) -> Result<Vec<[u32; N]>, FileError> {
        let component = Component::of(self.accessor(index)?.component_type, index)?;
        if component == Component::Float {
            return Err(FileError::new(format!("accessor {index} holds no whole numbers")));
        }
        self.elements(index, 0, Component::raw)
    }

    fn elements<T: Copy, const N: usize>(
        &self,
        index: usize,
        rest: T,
        number: impl Fn(&[u8]) -> T,
    ) -> Result<Vec<[T; N]>, FileError> {
        let accessor = self.accessor(index)?;
        let component = Component::of(accessor.component_type, index)?.size();
        let (size, count) = (components(&accessor.kind, index)?, accessor.count);
        let bytes_of_all = (count as u64).saturating_mul(size_of::<[T; N]>() as u64);
        let element = |bytes: &[u8]| element(bytes, component, size, rest, &number);
        let mut elements = match accessor.buffer_view {
            Some(view) => {
                let stride = self.document.buffer_views.get(view).and_then(|v| v.byte_stride).filter(|&s| s > 0);
                let bytes = self.view(view)?.get(accessor.byte_offset..).unwrap_or_default();
                let tight = component * size;
                let chunks = strided(bytes, stride.unwrap_or(tight), tight, count).ok_or_else(|| {
                    FileError::new(format!("accessor {index} of {count} elements reaches beyond buffer view {view}"))
                })?;
                self.memory.check(bytes_of_all)?;
                chunks.map(element).collect()
            }
            None if count > MOST_ZEROS.max(self.bytes.length()) => {
                return Err(FileError::new(format!("accessor {index} has {count} elements and no buffer")));
            }
            None => {
                self.memory.check(bytes_of_all)?;
                vec![element(&vec![0; component * size]); count]
            }
        };
        if let Some(sparse) = &accessor.sparse {
            let places = self.sparse(&sparse.indices, sparse.count, None, index)?;
            let values = self.sparse(&sparse.values, sparse.count, Some(component * size), index)?;
            for (place, value) in places.zip(values) {
                let place = Component::raw(place) as usize;
                let slot = elements.get_mut(place);
                *slot
                    .ok_or_else(|| FileError::new(format!("accessor {index} replaces element {place} of {count}")))? =
                    element(value);
            }
        }
        Ok(elements)
    }

    /// The parts of `size` bytes of a sparse accessor; of the size of its numbers if none is given.
    fn sparse(
        &self,
        part: &SparsePart,
        count: usize,
        size: Option<usize>,
        index: usize,
    ) -> Result<impl Iterator<Item = &[u8]>, FileError> {
        let size = match size {
            Some(size) => size,
            None => Component::of(part.component_type, index)?.size(),
        };
        let bytes = self.view(part.buffer_view)?.get(part.byte_offset..).unwrap_or_default();
        strided(bytes, size, size, count).ok_or_else(|| {
            FileError::new(format!("accessor {index} replaces {count} elements of which not all are there"))
        })
    }
}

/// What an index leads to that is not there.
pub(super) fn missing(what: &str, index: usize) -> FileError {
    FileError::new(format!("there is no {what} {index}"))
}

/// `count` pieces of `size` bytes, one every `stride` bytes; none if they are not all there.
fn strided(bytes: &[u8], stride: usize, size: usize, count: usize) -> Option<impl Iterator<Item = &[u8]>> {
    let length = count.checked_sub(1).map_or(Some(0), |n| n.checked_mul(stride)?.checked_add(size))?;
    (length <= bytes.len() && size > 0)
        .then(|| (0..count).filter_map(move |i| bytes.get(i * stride..i * stride + size)))
}

/// Up to N of the first `size` numbers of so many bytes each; what there is less of is `rest`.
pub(super) fn element<T: Copy, const N: usize>(
    bytes: &[u8],
    component: usize,
    size: usize,
    rest: T,
    number: impl Fn(&[u8]) -> T,
) -> [T; N] {
    let mut element = [rest; N];
    for (slot, bytes) in element.iter_mut().zip(bytes.chunks_exact(component).take(size)) {
        *slot = number(bytes);
    }
    element
}

fn components(kind: &str, index: usize) -> Result<usize, FileError> {
    match kind {
        "SCALAR" => Ok(1),
        "VEC2" => Ok(2),
        "VEC3" => Ok(3),
        "VEC4" | "MAT2" => Ok(4),
        "MAT3" => Ok(9),
        "MAT4" => Ok(16),
        _ => Err(FileError::new(format!("accessor {index} is of the type `{kind}`, which does not exist"))),
    }
}

/// The kind of a number.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Component {
    I8,
    U8,
    I16,
    U16,
    U32,
    Float,
}

impl Component {
    fn of(code: u32, index: usize) -> Result<Self, FileError> {
        match code {
            5120 => Ok(Self::I8),
            5121 => Ok(Self::U8),
            5122 => Ok(Self::I16),
            5123 => Ok(Self::U16),
            5125 => Ok(Self::U32),
            5126 => Ok(Self::Float),
            _ => Err(FileError::new(format!("accessor {index} has numbers of the type {code}, which does not exist"))),
        }
    }

    /// In bytes.
    pub(super) fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::U32 | Self::Float => 4,
        }
    }

    /// As many bytes as the number has.
    pub(super) fn raw(bytes: &[u8]) -> u32 {
        let mut word = [0; 4];
        word.iter_mut().zip(bytes).for_each(|(to, from)| *to = *from);
        u32::from_le_bytes(word)
    }

    pub(super) fn float(self, bytes: &[u8], normalized: bool) -> f32 {
        let raw = Self::raw(bytes);
        let (value, most) = match self {
            Self::Float => return f32::from_bits(raw),
            Self::I8 => (f32::from(raw as u8 as i8), 127.0),
            Self::U8 => (f32::from(raw as u8), 255.0),
            Self::I16 => (f32::from(raw as u16 as i16), 32767.0),
            Self::U16 => (f32::from(raw as u16), 65535.0),
            Self::U32 => (raw as f32, u32::MAX as f32),
        };
        if normalized { (value / most).max(-1.0) } else { value }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read<const N: usize>(json: &str, bytes: &[u8]) -> Result<Vec<[f32; N]>, FileError> {
        let document: Document = serde_json::from_str(json).unwrap();
        let memory = Memory::new(None);
        let bytes = Bytes::new(&document, vec![bytes.to_vec()], &memory).unwrap();
        Buffers { document: &document, bytes: &bytes, memory: &memory }.floats(0, 9.0)
    }

    #[test]
    fn normalised_interleaved_and_padded() {
        let json = r#"{ "accessors": [{ "bufferView": 0, "byteOffset": 1, "componentType": 5120, "normalized": true,
            "count": 2, "type": "VEC2" }], "bufferViews": [{ "byteLength": 7, "byteStride": 4 }] }"#;
        assert_eq!(read(json, &[0, 127, 128, 0, 0, 0, 1]).unwrap(), [[1.0, -1.0, 9.0], [0.0, 1.0 / 127.0, 9.0]]);
        let short = read::<3>(json, &[0; 6]).unwrap_err();
        assert_eq!(short.message, "buffer view 0 reaches beyond the 6 bytes of buffer 0");
        let more = json.replace("\"count\": 2", "\"count\": 3");
        assert_eq!(
            read::<3>(&more, &[0; 7]).unwrap_err().message,
            "accessor 0 of 3 elements reaches beyond buffer view 0"
        );
        let most = json.replace("\"count\": 2", "\"count\": 18446744073709551615");
        assert!(read::<3>(&most, &[0; 7]).is_err());
    }

    #[test]
    fn sparse_replaces() {
        let json = r#"{ "accessors": [{ "componentType": 5121, "count": 3, "type": "SCALAR", "sparse": { "count": 1,
            "indices": { "bufferView": 0, "componentType": 5121 }, "values": { "bufferView": 0, "byteOffset": 1 } } }],
            "bufferViews": [{ "byteLength": 2 }] }"#;
        assert_eq!(read(json, &[2, 7]).unwrap(), [[0.0], [0.0], [7.0]]);
        assert_eq!(read::<1>(json, &[3, 7]).unwrap_err().message, "accessor 0 replaces element 3 of 3");
        let many = json.replace("\"count\": 3", "\"count\": 3000000000");
        assert_eq!(read::<1>(&many, &[2, 7]).unwrap_err().message, "accessor 0 has 3000000000 elements and no buffer");
    }
}
