//! The numbers of a primitive: of the mesh that was compressed for it, and else of accessors.

use crate::error::FileError;
use crate::scene::model::gltf::accessor::Buffers;
use crate::scene::model::gltf::document::Primitive;
use crate::scene::model::gltf::draco::{Compressed, Stream};

pub(super) struct Attributes<'a> {
    buffers: &'a Buffers<'a>,
    primitive: &'a Primitive,
    compressed: Option<(&'a Stream, Compressed)>,
}

/// What vertices triangles have.
pub(super) struct Indices {
    pub(super) indices: Vec<u32>,
    /// 4: lists; 5: strips; 6: fans.
    pub(super) mode: u32,
}

impl<'a> Attributes<'a> {
    pub(super) fn new(buffers: &'a Buffers<'a>, primitive: &'a Primitive) -> Result<Self, FileError> {
        let stream = |compressed: Compressed| buffers.stream(compressed.buffer_view).map(|stream| (stream, compressed));
        let compressed = Compressed::of(primitive)?.map(stream).transpose()?;
        Ok(Self { buffers, primitive, compressed })
    }

    /// Elements of up to N numbers, one a vertex; what there is less of is `rest`.
    pub(super) fn floats<const N: usize>(&self, name: &str, rest: f32) -> Result<Option<Vec<[f32; N]>>, FileError> {
        let Some(&index) = self.primitive.attributes.get(name) else { return Ok(None) };
        let floats = match self.compressed(name) {
            Some((stream, id)) => stream.floats(id, self.buffers.accessor(index)?.normalized, rest),
            None => self.buffers.floats(index, rest),
        };
        floats.map(Some)
    }

    /// Elements of N whole numbers, one a vertex.
    pub(super) fn numbers<const N: usize>(&self, name: &str) -> Result<Option<Vec<[u32; N]>>, FileError> {
        let Some(&index) = self.primitive.attributes.get(name) else { return Ok(None) };
        let numbers = match self.compressed(name) {
            Some((stream, id)) => stream.numbers(id),
            None => self.buffers.numbers(index),
        };
        numbers.map(Some)
    }

    /// What of the compressed mesh stands for an attribute.
    fn compressed(&self, name: &str) -> Option<(&'a Stream, u32)> {
        let (stream, compressed) = self.compressed.as_ref()?;
        Some((stream, *compressed.attributes.get(name)?))
    }

    /// The vertices of triangles, of which there are `count`; what was compressed is a list, whatever the mode.
    pub(super) fn indices(&self, mode: u32, count: usize) -> Result<Indices, FileError> {
        if let Some((stream, _)) = &self.compressed {
            return Ok(Indices { indices: stream.indices(), mode: 4 });
        }
        let indices = match self.primitive.indices {
            Some(index) => self.buffers.numbers::<1>(index)?.into_iter().map(|[i]| i).collect(),
            None => {
                let count = u32::try_from(count);
                (0..count.map_err(|e| FileError::new(format!("there are too many vertices: {e}")))?).collect()
            }
        };
        Ok(Indices { indices, mode })
    }
}
