//! A model with one of everything, made here.

use serde_json::{Value, json};

use crate::Place;

/// Writes `model.gltf` with its buffer and two pictures: an upright square of a metre with a picture, a normal map and colours at its
/// vertices; two scenes, two cameras, an animation that lifts it.
pub(crate) fn write_gltf(place: &Place) {
    write_changed(place, |_| {});
}

/// As [`write_gltf`], with changes.
pub(crate) fn write_changed(place: &Place, change: impl FnOnce(&mut Value)) {
    let mut document = document();
    change(&mut document);
    place.write("model.gltf", &document.to_string());
    std::fs::write(place.path("numbers.bin"), numbers()).unwrap();
    std::fs::write(place.path("color.png"), png(|x, y| [40 * x as u8, 200, 50 * y as u8])).unwrap();
    std::fs::write(place.path("normal.png"), png(|x, y| [100 + 10 * x as u8, 120 + 5 * y as u8, 240])).unwrap();
}

/// Byte offsets: indices 0, positions 12, normals 60, uvs 108, colours 140, times 188, places 196.
fn numbers() -> Vec<u8> {
    let indices = [0_u16, 1, 2, 0, 2, 3];
    let floats = [
        &[-0.5_f32, 0.0, 0.0, 0.5, 0.0, 0.0, 0.5, 1.0, 0.0, -0.5, 1.0, 0.0][..],
        &[0.0, 0.0, 1.0].repeat(4),
        &[0.0, 1.0, 1.0, 1.0, 1.0, 0.0, 0.0, 0.0],
        &[1.0, 1.0, 1.0, 1.0, 0.5, 0.5, 0.5, 1.0, 0.5, 0.1, 0.2, 0.3],
        &[0.0, 1.5],
        &[0.0, 0.0, 0.0, 0.0, 2.0, 0.0],
    ];
    let floats = floats.concat();
    indices.iter().flat_map(|i| i.to_le_bytes()).chain(floats.iter().flat_map(|f| f.to_le_bytes())).collect()
}

fn document() -> Value {
    let view = |at: usize, length: usize| json!({ "buffer": 0, "byteOffset": at, "byteLength": length });
    let floats = |view: usize, count: usize, kind: &str| json!({ "bufferView": view, "componentType": 5126, "count": count, "type": kind });
    json!({
        "asset": { "version": "2.0", "generator": "a test" },
        "scene": 0,
        "scenes": [{ "name": "whole", "nodes": [0, 1, 2] }, { "name": "bare", "nodes": [0] }],
        "nodes": [
            { "mesh": 0 },
            { "name": "front door", "camera": 0, "translation": [0.0, 0.5, 3.0] },
            { "camera": 0, "translation": [0.0, 0.5, 2.0] },
        ],
        "cameras": [{ "name": "lens", "type": "perspective", "perspective": { "yfov": 0.7, "znear": 0.1 } }],
        "meshes": [{ "primitives": [{
            "attributes": { "POSITION": 1, "NORMAL": 2, "TEXCOORD_0": 3, "COLOR_0": 4 }, "indices": 0, "material": 0
        }] }],
        "materials": [{
            "name": "painted \"wood\"  ä",
            "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 }, "roughnessFactor": 0.3, "metallicFactor": 0.0 },
            "normalTexture": { "index": 1 }
        }],
        "textures": [{ "source": 0 }, { "source": 1 }],
        "images": [{ "uri": "color.png" }, { "uri": "normal.png" }],
        "animations": [{
            "name": "lift",
            "channels": [{ "sampler": 0, "target": { "node": 0, "path": "translation" } }],
            "samplers": [{ "input": 5, "output": 6 }]
        }],
        "accessors": [
            { "bufferView": 0, "componentType": 5123, "count": 6, "type": "SCALAR" },
            floats(1, 4, "VEC3"), floats(2, 4, "VEC3"), floats(3, 4, "VEC2"), floats(4, 4, "VEC3"),
            floats(5, 2, "SCALAR"), floats(6, 2, "VEC3"),
        ],
        "bufferViews": [view(0, 12), view(12, 48), view(60, 48), view(108, 32), view(140, 48), view(188, 8), view(196, 24)],
        "buffers": [{ "uri": "numbers.bin", "byteLength": 220 }],
    })
}

/// A picture of 5 x 4 pixels.
pub(crate) fn png(color: impl Fn(u32, u32) -> [u8; 3]) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, 5, 4);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    let pixels: Vec<u8> = (0..20).flat_map(|i| color(i % 5, i / 5)).collect();
    encoder.write_header().unwrap().write_image_data(&pixels).unwrap();
    bytes
}
