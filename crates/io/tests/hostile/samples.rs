//! Small files, one of each kind, with something of all that is read of it.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use exr::prelude::{
    AnyChannel, AnyChannels, Blocks, Compression, Encoding as ExrEncoding, FlatSamples, Image as ExrImage, Layer,
    LayerAttributes, LineOrder, Vec2, WritableImage,
};
use eyebeam_core::film::Image;
use eyebeam_io::image::{Encoding, ImageFormat};
use serde_json::{Value, json};

use crate::codecs;
use crate::glb::{glb, triangle};

pub(crate) const OBJ: &str = "# a wall\nmtllib a.mtl\nv 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 1 1 0 0 0 1\nv 0 1 0 1 1 1\nv 0.5 0.2 0\n\
    vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 0 1\no wall\ng part\nusemtl paint\ns 1\nf 1/1 2/2 3/3 4/4\nf 1//1 2//1 3//1\n\
    s off\nf -5 -1 -4 -3 \\\n -2\nusemtl glass\nf 1/1/1 2/2/1 3/3/1\n";

const MTL: &str = "newmtl paint\nKd 0.5 0.4 0.3\nKs 0.1 0.1 0.1\nNs 100\nNi 1.4\nd 0.5\nillum 2\nmap_Kd -s 2 2 -clamp on a b.png\n\
    bump -bm 0.5 c.png\nnewmtl glass\nKe 1 1 1\nTf 0.9 0.9 0.9\nTr 0.1\nPr 0.2\nPm 0.5\nnorm d.png\n";

const TOML: &str = "[render]\nwidth = 32\nseed = 7\n[camera]\nlook_from = [0, 1, 5.5e0]\n[environment.gradient]\ntop = \"#80b0ff\"\n\
    [material.\"é 1\".metal]\nalbedo = [0.9, 0.7, 0.3]\n[texture.t.checker]\neven = \"#ffffff\"\n[[shape.sphere]]\nradius = 0.5\n\
    material = \"é 1\"\nmotion = [{ time = 0 }, { time = 1, offset = [1, 0, 0], rotation = { axis = [0, 1, 0], angle = 90 } }]\n\
    [[shape.mesh]]\nvertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]\ntriangles = [[0, 1, 2]]\n[[light.point]]\n\
    position = [0, 1, 2]\nintensity = [1, 1, 1]\n";

const IES: &str = "IESNA:LM-63-2002\n[TEST] a\nTILT=INCLUDE\n1\n2\n0 90\n1 0.5\n1 -1 1.5 3 2 1 2 0.1 0.2 0 1 1 10\n0 45 90\n0 90\n\
    1 2 3\n4 5 6\n";

const STL: &str = "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n\
    endsolid a\n";

/// Names and bytes; all can be read.
pub(crate) fn all() -> Vec<(String, Vec<u8>)> {
    let mut all: Vec<(String, Vec<u8>)> = [
        ("model.glb", glb(&document(), &numbers())),
        ("model.gltf", gltf()),
        ("model.obj", OBJ.as_bytes().to_vec()),
        ("a.mtl", MTL.as_bytes().to_vec()),
        ("ascii.ply", ply(None)),
        ("little.ply", ply(Some(false))),
        ("big.ply", ply(Some(true))),
        ("ascii.stl", STL.as_bytes().to_vec()),
        ("binary.stl", stl()),
        ("scene.toml", TOML.as_bytes().to_vec()),
        ("lamp.ies", IES.as_bytes().to_vec()),
    ]
    .map(|(name, bytes)| (name.to_owned(), bytes))
    .into();
    all.push(("walk.glb".to_owned(), codecs::draco(1)));
    all.push(("list.glb".to_owned(), codecs::draco(0)));
    all.push(("picture.webp".to_owned(), codecs::webp()));
    all.push(("lossy.webp".to_owned(), crate::pictures::lossy_webp()));
    all.push(("picture.ktx2".to_owned(), crate::pictures::ktx2()));
    for (ending, format) in
        [("exr", ImageFormat::Exr), ("hdr", ImageFormat::Hdr), ("png", ImageFormat::Png), ("jpg", ImageFormat::Jpeg)]
    {
        all.push((format!("picture.{ending}"), format.encode(&picture(), "{}", &Encoding::default()).unwrap()));
    }
    let compressions = [
        Compression::Uncompressed,
        Compression::RLE,
        Compression::ZIP1,
        Compression::ZIP16,
        Compression::PIZ,
        Compression::PXR24,
        Compression::B44,
        Compression::B44A,
    ];
    all.extend(compressions.map(|compression| (format!("{compression:?}.exr").to_lowercase(), exr(compression))));
    all
}

fn picture() -> Image {
    let mut image = Image::new(20, 7);
    for (y, x) in (0..7).flat_map(|y| (0..20).map(move |x| (y, x))) {
        image.set_pixel(x, y, [x as f32 * 0.05, y as f32 * 0.1, (x * y) as f32 * 0.01]);
    }
    image
}

/// Tiles of three channels.
pub(crate) fn exr(compression: Compression) -> Vec<u8> {
    let samples = |factor: f32| FlatSamples::F32((0..140).map(|i| (i % 20) as f32 * factor).collect());
    let channels = [("R", 0.1), ("G", 0.2), ("B", 0.3)].map(|(name, factor)| AnyChannel::new(name, samples(factor)));
    let channels = AnyChannels::sort(channels.into_iter().collect());
    let encoding = ExrEncoding { compression, blocks: Blocks::Tiles(Vec2(8, 8)), line_order: LineOrder::Increasing };
    let layer = Layer::new((20, 7), LayerAttributes::named("a"), encoding, channels);
    let mut bytes = Vec::new();
    ExrImage::from_layer(layer).write().non_parallel().to_buffered(std::io::Cursor::new(&mut bytes)).unwrap();
    bytes
}

/// Text, or numbers whose highest byte comes first or last.
fn ply(big_endian: Option<bool>) -> Vec<u8> {
    let format = match big_endian {
        None => "ascii",
        Some(false) => "binary_little_endian",
        Some(true) => "binary_big_endian",
    };
    let header = format!(
        "ply\nformat {format} 1.0\ncomment a\nelement vertex 4\nproperty float x\nproperty float y\nproperty double z\n\
        property short nx\nproperty short ny\nproperty short nz\nproperty float s\nproperty float t\nproperty uchar red\n\
        property uchar green\nproperty uchar blue\nproperty list uchar int more\nelement face 2\n\
        property list uchar int vertex_indices\nelement tristrips 1\nproperty list int int vertex_indices\nend_header\n"
    );
    if big_endian.is_none() {
        let vertices =
            "0 0 0 0 0 1 0 0 255 0 0 1 7\n1 0 0 0 0 1 1 0 9 9 9 0\n1 1 0 0 0 1 1 1 0 0 9 0\n0 1 0 0 0 1 0 1 0 0 0 0\n";
        return format!("{header}{vertices}3 0 1 2\n4 0 1 2 3\n5 0 1 2 -1 3\n").into_bytes();
    }
    let is_big = big_endian == Some(true);
    let mut bytes = header.into_bytes();
    let mut put = |mut number: Vec<u8>| {
        if is_big {
            number.reverse();
        }
        bytes.extend(number);
    };
    for [x, y] in [[0.0_f32, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]] {
        [x, y].iter().for_each(|c| put(c.to_le_bytes().into()));
        put(0.5_f64.to_le_bytes().into());
        [0_i16, 0, 1].iter().for_each(|c| put(c.to_le_bytes().into()));
        [x, y].iter().for_each(|c| put(c.to_le_bytes().into()));
        [255, 128, 0, 1].iter().for_each(|byte| put(vec![*byte]));
        put(7_i32.to_le_bytes().into());
    }
    for face in [&[0_i32, 1, 2][..], &[0, 1, 2, 3]] {
        put(vec![face.len() as u8]);
        face.iter().for_each(|index| put(index.to_le_bytes().into()));
    }
    [5_i32, 0, 1, 2, -1, 3].iter().for_each(|number| put(number.to_le_bytes().into()));
    bytes
}

fn stl() -> Vec<u8> {
    let facet = |z: f32| {
        let numbers = [0.0, 0.0, 1.0, 0.0, 0.0, z, 1.0, 0.0, z, 0.0, 1.0, z];
        numbers.into_iter().flat_map(f32::to_le_bytes).chain([0, 1]).collect::<Vec<u8>>()
    };
    [vec![b' '; 80], 2_u32.to_le_bytes().into(), facet(0.0), facet(1.0)].concat()
}

/// A mesh with coordinates, colours, a picture, joints, a target, an animation, copies and compressed numbers.
pub(crate) fn document() -> Value {
    let view = |at: usize, length: usize| json!({ "buffer": 0, "byteOffset": at, "byteLength": length });
    let packed = |at: usize, length: usize, count: usize, stride: usize, mode: &str| {
        let code = json!({ "buffer": 0, "byteOffset": at, "byteLength": length, "count": count, "byteStride": stride, "mode": mode });
        json!({ "buffer": 1, "byteLength": count * stride, "extensions": { "EXT_meshopt_compression": code } })
    };
    let png = STANDARD.encode(ImageFormat::Png.encode(&picture(), "{}", &Encoding::default()).unwrap());
    json!({
        "asset": { "version": "2.0" },
        "extensionsUsed": ["EXT_meshopt_compression", "EXT_mesh_gpu_instancing", "KHR_lights_punctual"],
        "extensions": { "KHR_lights_punctual": { "lights": [{ "type": "spot", "spot": {} }] } },
        "scene": 0,
        "scenes": [{ "nodes": [0, 3] }],
        "nodes": [
            { "mesh": 0, "skin": 0, "children": [1, 2] },
            { "translation": [1, 0, 3], "extensions": { "KHR_lights_punctual": { "light": 0 } } },
            { "rotation": [0, 0, 1, 0], "camera": 0 },
            { "mesh": 1, "extensions": { "EXT_mesh_gpu_instancing": { "attributes": { "TRANSLATION": 1 } } } },
        ],
        "cameras": [{ "perspective": { "yfov": 0.5 } }],
        "meshes": [
            { "weights": [0.5], "primitives": [{
                "attributes": { "POSITION": 1, "TEXCOORD_0": 2, "JOINTS_0": 3, "WEIGHTS_0": 4 },
                "targets": [{ "POSITION": 5 }], "indices": 0, "material": 0 }] },
            { "primitives": [{ "attributes": { "POSITION": 6, "COLOR_0": 1 }, "indices": 7, "mode": 5 }] },
        ],
        "skins": [{ "joints": [1, 2] }],
        "materials": [{ "name": "paint", "alphaMode": "BLEND", "normalTexture": { "index": 0 },
            "pbrMetallicRoughness": { "baseColorTexture": { "index": 0,
                "extensions": { "KHR_texture_transform": { "rotation": 0.5 } } }, "roughnessFactor": 0.5 },
            "extensions": { "KHR_materials_clearcoat": { "clearcoatFactor": 0.5 } } }],
        "textures": [{ "source": 0, "sampler": 0 }],
        "samplers": [{ "magFilter": 9728, "wrapS": 33071 }],
        "images": [{ "uri": format!("data:image/png;base64,{png}") }],
        "animations": [{ "name": "walk",
            "samplers": [{ "input": 8, "output": 1, "interpolation": "LINEAR" }],
            "channels": [{ "sampler": 0, "target": { "node": 1, "path": "translation" } }] }],
        "accessors": [
            { "bufferView": 0, "componentType": 5123, "count": 3, "type": "SCALAR" },
            { "bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC3" },
            { "bufferView": 2, "componentType": 5126, "count": 3, "type": "VEC2" },
            { "bufferView": 3, "componentType": 5121, "count": 3, "type": "VEC4" },
            { "bufferView": 4, "componentType": 5121, "normalized": true, "count": 3, "type": "VEC4" },
            { "componentType": 5126, "count": 3, "type": "VEC3", "sparse": { "count": 1,
                "indices": { "bufferView": 0, "componentType": 5123 }, "values": { "bufferView": 1 } } },
            { "bufferView": 5, "componentType": 5126, "count": 3, "type": "VEC3" },
            { "bufferView": 6, "componentType": 5123, "count": 3, "type": "SCALAR" },
            { "bufferView": 0, "componentType": 5123, "count": 3, "type": "SCALAR" },
        ],
        "bufferViews": [
            view(0, 6), view(8, 36), view(44, 24), view(68, 12), view(80, 12),
            packed(92, ATTRIBUTES, 3, 12, "ATTRIBUTES"), packed(92 + ATTRIBUTES, TRIANGLES, 3, 2, "TRIANGLES"),
        ],
        "buffers": [{ "byteLength": 92 + ATTRIBUTES + TRIANGLES }, { "byteLength": 42 }],
    })
}

/// Of three vertices of twelve bytes, all told in full, and a tail of zeros.
const ATTRIBUTES: usize = 1 + 12 * 17 + 32;
/// Of one triangle.
const TRIANGLES: usize = 2 + 16;

pub(crate) fn numbers() -> Vec<u8> {
    let mut bytes = triangle();
    bytes.push(0xa0);
    for byte in 0..12 {
        // Differences of whole bytes: 0, then 63 and back, for the highest byte of x and y.
        let differences = if byte == 3 { [0, 126, 125] } else { [0; 3] };
        bytes.push(3);
        bytes.extend(differences.into_iter().chain([0; 13]));
    }
    bytes.extend([0; 32]);
    bytes.extend([0xe1, 0xf0]);
    bytes.extend([0; 16]);
    bytes
}

/// The document with other values, by JSON pointers, as one file.
pub(crate) fn changed(changes: &[(&str, Value)]) -> Vec<u8> {
    let mut document = document();
    for (pointer, value) in changes {
        *document.pointer_mut(pointer).unwrap() = value.clone();
    }
    glb(&document, &numbers())
}

fn gltf() -> Vec<u8> {
    let mut document = document();
    let numbers = STANDARD.encode(numbers());
    document["buffers"][0]["uri"] = format!("data:application/octet-stream;base64,{numbers}").into();
    document.to_string().into_bytes()
}
