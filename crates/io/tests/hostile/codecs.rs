//! Small files of compressed meshes and pictures.

use draco_core::{
    DataType, EncoderBuffer, EncoderOptions, GeometryAttributeType, Mesh, MeshEncoder, PointAttribute, PointIndex,
};
use image::ExtendedColorType;
use image::codecs::webp::WebPEncoder;
use serde_json::{Value, json};

use crate::glb::glb;

/// A strip of triangles that Draco has compressed: as a walk over its edges, or one after the other.
pub(crate) fn draco(method: i32) -> Vec<u8> {
    const TRIANGLES: u32 = 30;
    let count = TRIANGLES as usize + 2;
    let numbers: Vec<u8> =
        (0..count).flat_map(|i| [i as f32, (i % 2) as f32, (i % 5) as f32]).flat_map(f32::to_le_bytes).collect();
    let mut positions = PointAttribute::new();
    positions.init(GeometryAttributeType::Position, 3, DataType::Float32, false, count);
    assert!(positions.buffer_mut().try_write(0, &numbers));
    let mut mesh = Mesh::new();
    mesh.set_num_points(count);
    mesh.add_attribute(positions);
    (0..TRIANGLES).for_each(|i| mesh.add_face([i, i + 1 + i % 2, i + 2 - i % 2].map(PointIndex)));
    let mut options = EncoderOptions::new();
    options.set_encoding_method(method);
    options.set_attribute_int(0, "quantization_bits", 12);
    let (mut encoder, mut code) = (MeshEncoder::new(), EncoderBuffer::new());
    encoder.set_mesh(mesh);
    encoder.encode(&options, &mut code).unwrap();
    let code = code.data();
    glb(&document(code.len(), TRIANGLES), code)
}

fn document(length: usize, triangles: u32) -> Value {
    let compressed = json!({ "bufferView": 0, "attributes": { "POSITION": 0 } });
    json!({
        "asset": { "version": "2.0" },
        "extensionsRequired": ["KHR_draco_mesh_compression"],
        "nodes": [{ "mesh": 0 }],
        "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 }, "indices": 1,
            "extensions": { "KHR_draco_mesh_compression": compressed } }] }],
        "accessors": [
            { "componentType": 5126, "count": triangles + 2, "type": "VEC3" },
            { "componentType": 5123, "count": triangles * 3, "type": "SCALAR" },
        ],
        "bufferViews": [{ "buffer": 0, "byteLength": length }],
        "buffers": [{ "byteLength": length }],
    })
}

pub(crate) fn webp() -> Vec<u8> {
    let pixels: Vec<u8> = (0..20 * 7).flat_map(|i| [i as u8, (i * i) as u8, 90, 255 - i as u8]).collect();
    let mut bytes = Vec::new();
    WebPEncoder::new_lossless(&mut bytes).encode(&pixels, 20, 7, ExtendedColorType::Rgba8).unwrap();
    bytes
}
