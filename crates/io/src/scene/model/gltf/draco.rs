//! `KHR_draco_mesh_compression`: triangles as a walk over their edges, numbers of vertices as differences from a guess.
//!
//! Google, Draco Bitstream Specification 2.2, 2018; the walk is that of Rossignac, "Edgebreaker", 1999, doi:10.1109/2945.764870.
//! A stream says itself how large a mesh it holds, and may be short however large that is; so no more is decoded than the file's
//! accessors have room for.

use std::collections::BTreeMap;

use draco_core::{DataType, DecodeLimits, DecoderBuffer, Mesh, MeshDecoder, PointAttribute, PointIndex};
use rayon::prelude::*;
use serde::Deserialize;

use crate::error::FileError;
use crate::scene::model::gltf::accessor::{Buffers, Component, element};
use crate::scene::model::gltf::document::Primitive;
use crate::scene::model::gltf::extensions::get;

/// Triangles of all compressed meshes of a file. To decode one takes some 70 bytes besides its vertices.
const MOST_TRIANGLES: usize = 1 << 25;
/// Bytes that an attribute of a vertex can have: four numbers of four.
const MOST_BYTES: usize = 16;
/// The most triangles that a byte can stand for.
const MOST_IN_BYTE: usize = 1024;
/// Bytes that decoding takes for a triangle.
const TRIANGLE: u64 = 70;
/// Attributes that a stream may have besides those that are named.
const MORE_ATTRIBUTES: usize = 4;

/// What the extension says of a primitive.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(rename_all = "camelCase", default)]
pub(super) struct Compressed {
    pub(super) buffer_view: usize,
    /// What the attributes are called in the mesh.
    pub(super) attributes: BTreeMap<String, u32>,
}

impl Compressed {
    /// None if the primitive is not compressed.
    pub(super) fn of(primitive: &Primitive) -> Result<Option<Self>, FileError> {
        const NAME: &str = "KHR_draco_mesh_compression";
        get(&primitive.extensions, NAME)
    }
}

/// How large the accessors say a mesh is.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Size {
    triangles: usize,
    vertices: usize,
    attributes: usize,
}

impl Size {
    fn of(buffers: &Buffers<'_>, primitive: &Primitive, compressed: &Compressed) -> Result<Self, FileError> {
        let count = |index: usize| buffers.accessor(index).map(|accessor| accessor.count);
        let vertices = primitive.attributes.get("POSITION").map(|&index| count(index)).transpose()?.unwrap_or_default();
        let corners = primitive.indices.map(count).transpose()?.unwrap_or(vertices);
        // A strip has nearly as many triangles as indices.
        let triangles = if primitive.mode.unwrap_or(4) == 4 { corners / 3 } else { corners };
        // Where attributes change across an edge the decoder makes more vertices than there were, but no more than corners.
        let vertices = vertices.max(triangles.saturating_mul(3));
        Ok(Self { triangles, vertices, attributes: compressed.attributes.len() })
    }

    /// Enough for both.
    fn max(self, other: Self) -> Self {
        Self {
            triangles: self.triangles.max(other.triangles),
            vertices: self.vertices.max(other.vertices),
            attributes: self.attributes.max(other.attributes),
        }
    }

    /// Of vertices, at most.
    fn bytes(self) -> u64 {
        (self.vertices as u64).saturating_mul((MOST_BYTES * (self.attributes + MORE_ATTRIBUTES)) as u64)
    }

    fn limits(self) -> DecodeLimits {
        DecodeLimits::default()
            .with_max_faces(self.triangles as u64)
            .with_max_points(self.vertices as u64)
            .with_max_decoded_bytes(self.bytes())
    }
}

/// The compressed meshes of all primitives, by their buffer views; all are decoded at the same time.
pub(super) fn decode(buffers: &Buffers<'_>) -> Result<BTreeMap<usize, Stream>, FileError> {
    let mut sizes = BTreeMap::<usize, Size>::new();
    // Points and lines are left out.
    let primitives = buffers.document.meshes.iter().flat_map(|mesh| &mesh.primitives);
    for primitive in primitives.filter(|primitive| primitive.mode.unwrap_or(4) >= 4) {
        let Some(compressed) = Compressed::of(primitive)? else { continue };
        let size = sizes.entry(compressed.buffer_view).or_default();
        *size = size.max(Size::of(buffers, primitive, &compressed)?);
    }
    let triangles = sizes.values().fold(0_usize, |sum, size| sum.saturating_add(size.triangles));
    if triangles > MOST_TRIANGLES {
        let message = format!("the compressed meshes have {triangles} triangles, and {MOST_TRIANGLES} are allowed");
        return Err(FileError::new(message).hint("export the model without mesh compression"));
    }
    for (view, size) in &sizes {
        let length = buffers.view(*view)?.len();
        if size.triangles > length.saturating_mul(MOST_IN_BYTE) {
            let message = format!("buffer view {view} is too short for a mesh of {} triangles", size.triangles);
            return Err(FileError::new(message));
        }
        buffers.memory.take(size.bytes().saturating_add(TRIANGLE * size.triangles as u64))?;
    }
    let of = |view: usize| move |e: FileError| FileError { message: format!("buffer view {view}: {}", e.message), ..e };
    let stream = |(view, size): (usize, Size)| Ok((view, Stream::decode(buffers.view(view)?, size).map_err(of(view))?));
    sizes.into_par_iter().map(stream).collect()
}

/// A mesh that was compressed.
pub(super) struct Stream(Mesh);

impl Stream {
    fn decode(code: &[u8], size: Size) -> Result<Self, FileError> {
        let mut mesh = Mesh::new();
        let mut buffer = DecoderBuffer::new(code).with_limits(size.limits());
        let decoded = MeshDecoder::new().decode(&mut buffer, &mut mesh);
        decoded.map_err(|e| FileError::new(format!("the compressed mesh is damaged: {}", e.message())))?;
        Ok(Self(mesh))
    }

    pub(super) fn floats<const N: usize>(
        &self,
        id: u32,
        normalized: bool,
        rest: f32,
    ) -> Result<Vec<[f32; N]>, FileError> {
        let (attribute, component) = self.attribute(id)?;
        self.elements(attribute, component, rest, |bytes| component.float(bytes, normalized))
    }

    pub(super) fn numbers<const N: usize>(&self, id: u32) -> Result<Vec<[u32; N]>, FileError> {
        let (attribute, component) = self.attribute(id)?;
        if component == Component::Float {
            return Err(FileError::new(format!("attribute {id} of a compressed mesh holds no whole numbers")));
        }
        self.elements(attribute, component, 0, Component::raw)
    }

    /// Three a triangle.
    pub(super) fn indices(&self) -> Vec<u32> {
        self.0.faces().as_flattened().iter().map(|point| point.0).collect()
    }

    fn attribute(&self, id: u32) -> Result<(&PointAttribute, Component), FileError> {
        let attribute = self.0.attribute_by_unique_id(id);
        let attribute = attribute.ok_or_else(|| FileError::new(format!("a compressed mesh has no attribute {id}")))?;
        let component = match attribute.data_type() {
            DataType::Int8 => Component::I8,
            DataType::Uint8 | DataType::Bool => Component::U8,
            DataType::Int16 => Component::I16,
            DataType::Uint16 => Component::U16,
            DataType::Uint32 => Component::U32,
            DataType::Float32 => Component::Float,
            other => {
                let message = format!("attribute {id} of a compressed mesh has numbers of the type {other:?}");
                return Err(FileError::new(message));
            }
        };
        Ok((attribute, component))
    }

    fn elements<T: Copy, const N: usize>(
        &self,
        attribute: &PointAttribute,
        component: Component,
        rest: T,
        number: impl Fn(&[u8]) -> T,
    ) -> Result<Vec<[T; N]>, FileError> {
        let (size, count) = (usize::from(attribute.num_components()), self.0.num_points());
        let (bytes, stride) = (attribute.buffer().data(), component.size() * size);
        let point = |point: usize| {
            let value = attribute.mapped_index(PointIndex(point as u32)).0 as usize;
            let bytes = value.checked_mul(stride).and_then(|at| bytes.get(at..)?.get(..stride));
            let bytes =
                bytes.ok_or_else(|| FileError::new(format!("a compressed mesh lacks numbers of vertex {point}")))?;
            Ok(element(bytes, component.size(), size, rest, &number))
        };
        (0..count).map(point).collect()
    }
}
