//! Small files that ask for much memory: they are refused before they get it.

use exr::prelude::Compression;
use eyebeam_core::film::Image;
use eyebeam_io::image::{Encoding, ImageFormat};
use eyebeam_io::scene::{Files, ReadOptions, read_bytes};
use eyebeam_io::{Error, Fault};
use serde_json::json;

use crate::glb::glb;
use crate::{alone, read_as, samples, watched};

/// What may be allocated for a file that is refused: so much for each byte, as for JSON that is all empty objects, and some.
const FOR_EACH_BYTE: usize = 2000;
const IN_ANY_CASE: usize = 8 << 20;

/// What is said of bytes that are refused before they take memory out of proportion.
fn refused(name: &str, bytes: &[u8]) -> String {
    let (result, peak) = watched(name, || read_as(name, bytes, &ReadOptions::default()));
    let error = result.expect_err(name).to_string();
    assert!(error.contains(name), "{error}");
    let most = IN_ANY_CASE + FOR_EACH_BYTE * bytes.len();
    assert!(peak <= most, "{name} of {} bytes takes {} KiB: {error}", bytes.len(), peak >> 10);
    error
}

#[test]
fn numbers_that_are_not_there() {
    let _alone = alone();
    let many = json!(4_000_000_000_u32);
    let sparse = json!({ "componentType": 5126, "count": 4_000_000_000_u32, "type": "MAT4", "sparse": { "count": 1,
        "indices": { "bufferView": 0, "componentType": 5123 }, "values": { "bufferView": 1 } } });
    let zeros = json!({ "componentType": 5126, "count": 10_000_000, "type": "VEC3" });
    for (changes, said) in [
        (vec![("/accessors/1/count", many.clone())], "MiB of memory"),
        (vec![("/accessors/0/count", many.clone())], "triangles, more than"),
        (vec![("/accessors/3/count", many.clone())], "accessor 3 of 4000000000 elements reaches beyond"),
        (vec![("/accessors/5", sparse)], "accessor 5 has 4000000000 elements and no buffer"),
        (vec![("/accessors/5", zeros.clone())], "accessor 5 has 10000000 elements and no buffer"),
        // Ten million copies, all at the same place.
        (vec![("/accessors/1", zeros)], "accessor 1 has 10000000 elements and no buffer"),
        (vec![("/bufferViews/5/extensions/EXT_meshopt_compression/count", many)], "buffer view 5"),
        (vec![("/bufferViews/5/extensions/EXT_meshopt_compression/count", json!(u64::MAX))], "buffer view 5"),
        (vec![("/buffers/0/byteLength", json!(u64::MAX))], "buffer 0 has"),
    ] {
        let error = refused("model.glb", &samples::changed(&changes));
        assert!(error.contains(said), "{error}\nnot: {said}");
    }
}

/// Meshes that stand in many places, each in a pose of its own, and vertices of many meshes.
#[test]
fn a_model_that_is_larger_than_its_file() {
    let _alone = alone();
    let count = 50_000;
    let nodes: Vec<_> = (0..count).map(|_| json!({ "mesh": 0, "weights": [0] })).collect();
    let primitive = json!({ "attributes": { "POSITION": 0 } });
    let document = json!({
        "asset": { "version": "2.0" },
        "scenes": [{ "nodes": (0..count).collect::<Vec<_>>() }],
        "nodes": nodes,
        "meshes": [{ "primitives": [primitive.clone()] }],
        "accessors": [{ "bufferView": 0, "componentType": 5126, "count": count, "type": "VEC3" }],
        "bufferViews": [{ "buffer": 0, "byteLength": 12 * count }],
        "buffers": [{ "byteLength": 12 * count }],
    });
    let error = refused("model.glb", &glb(&document, &vec![0; 12 * count]));
    assert!(error.contains("triangles, more than 100000000"), "{error}");
    let mut shared = document.clone();
    shared["meshes"][0]["primitives"] = vec![json!({ "attributes": { "POSITION": 0 }, "indices": 0 }); count].into();
    shared["nodes"] = json!([{ "mesh": 0 }]);
    shared["scenes"][0]["nodes"] = json!([0]);
    let error = refused("model.glb", &glb(&shared, &vec![0; 12 * count]));
    assert!(error.contains("more than"), "{error}");
}

/// Compressed bytes that many views share.
#[test]
fn bytes_that_are_decoded_again_and_again() {
    let _alone = alone();
    let view = samples::document()["bufferViews"][5].clone();
    let mut views = samples::document()["bufferViews"].as_array().unwrap().clone();
    views.extend(vec![view; 1000]);
    let error = refused("model.glb", &samples::changed(&[("/bufferViews", views.into())]));
    assert!(error.contains("compressed buffer views overlap"), "{error}");
}

#[test]
fn json_that_is_deep_or_empty() {
    let _alone = alone();
    let n = 200_000;
    let deep = format!("{{\"asset\":{{\"version\":\"2.0\"}},\"extensions\":{}", "{\"a\":".repeat(n));
    refused("model.gltf", deep.as_bytes());
    refused("model.gltf", format!("{{\"extras\":{}", "[".repeat(n)).as_bytes());
    refused("model.gltf", format!("{{\"nodes\":[{}", "{},".repeat(n)).as_bytes());
    refused("model.gltf", format!("{{\"materials\":[{}", "{},".repeat(n)).as_bytes());
    // Where less is allowed, it is not even begun.
    let bytes = format!("{{\"asset\":{{\"version\":\"2.0\"}},\"nodes\":[{}{{}}]}}", "{},".repeat(n));
    let options = ReadOptions { memory: Some(64 << 20), ..ReadOptions::default() };
    let (result, peak) = watched("nodes", || read_bytes("model.gltf", bytes.as_bytes(), Files::None, &options));
    assert!(matches!(result, Err(Error::File(e)) if e.fault == Fault::Memory) && peak < 1 << 20, "{peak}");
}

#[test]
fn headers_that_promise_anything() {
    let _alone = alone();
    let mut pictures: Vec<_> = [ImageFormat::Png, ImageFormat::Exr, ImageFormat::Jpeg]
        .map(|format| format.encode(&Image::new(20, 7), "{}", &Encoding::default()).unwrap())
        .into();
    // Two billion, a hundred thousand and sixteen thousand pixels a side.
    for side in [i32::MAX, 100_000, 16_000] {
        let [png, exr, jpeg] = &mut pictures[..] else { unreachable!() };
        png[16..20].copy_from_slice(&side.to_be_bytes());
        png[20..24].copy_from_slice(&side.to_be_bytes());
        let sum = crc(&png[12..29]);
        png[29..33].copy_from_slice(&sum.to_be_bytes());
        refused("picture.png", png);
        let window = exr.windows(11).position(|w| w == b"dataWindow\0").unwrap() + "dataWindow\0box2i\0".len() + 4;
        exr[window + 8..window + 12].copy_from_slice(&side.to_le_bytes());
        exr[window + 12..window + 16].copy_from_slice(&side.to_le_bytes());
        refused("picture.exr", exr);
        let frame = jpeg.windows(2).position(|w| w == [0xff, 0xc0]).unwrap() + 5;
        let short = side.min(60_000) as u16;
        jpeg[frame..frame + 2].copy_from_slice(&short.to_be_bytes());
        jpeg[frame + 2..frame + 4].copy_from_slice(&short.to_be_bytes());
        refused("picture.jpg", jpeg);
        refused("picture.hdr", format!("#?RADIANCE\n\n-Y {side} +X {side}\n").as_bytes());
    }
    for count in ["4294967295", "100000000", "18446744073709551615"] {
        for format in ["ascii", "binary_little_endian", "binary_big_endian"] {
            let of = |vertices: &str, faces: &str| {
                format!(
                    "ply\nformat {format} 1.0\nelement vertex {vertices}\nproperty float x\nproperty float y\nproperty float z\n\
                    element face {faces}\nproperty list uint int vertex_indices\nend_header\n0 0 0 0 0 0 0 0 0 0 0 0 0 0"
                )
            };
            refused("mesh.ply", of(count, "1").as_bytes());
            refused("mesh.ply", of("1", count).as_bytes());
        }
    }
    let mut stl = vec![0; 200];
    stl[80..84].copy_from_slice(&u32::MAX.to_le_bytes());
    refused("mesh.stl", &stl);
    refused("lamp.ies", b"TILT=NONE\n1 1 1 1000 1000 1 1 0 0 0 1 1 1\n0 0");
    refused("lamp.ies", b"TILT=INCLUDE\n1 1000000 1");
}

/// Tiles of one pixel, and lines or tiles of as many as can be, whose number is not told.
#[test]
fn openexr_that_promises_many_blocks() {
    let _alone = alone();
    for compression in
        [Compression::Uncompressed, Compression::RLE, Compression::ZIP16, Compression::PIZ, Compression::B44]
    {
        for (side, tile) in [(16_000_u32, 1_u32), (16_000, 16_000), (100_000, 1), (100_000, 64), (4_000_000, 4_000_000)]
        {
            let mut bytes = samples::exr(compression);
            let find =
                |bytes: &[u8], name: &[u8]| bytes.windows(name.len()).position(|w| w == name).map(|at| at + name.len());
            if let Some(end) = find(&bytes, b"chunkCount\0") {
                bytes[end - 2] = b'x';
            }
            let window = find(&bytes, b"dataWindow\0box2i\0").unwrap() + 4;
            bytes[window + 8..window + 12].copy_from_slice(&(side - 1).to_le_bytes());
            bytes[window + 12..window + 16].copy_from_slice(&(side - 1).to_le_bytes());
            let tiles = find(&bytes, b"tiles\0tiledesc\0").unwrap() + 4;
            bytes[tiles..tiles + 4].copy_from_slice(&tile.to_le_bytes());
            bytes[tiles + 4..tiles + 8].copy_from_slice(&tile.to_le_bytes());
            refused("picture.exr", &bytes);
        }
    }
}

/// The sum of a PNG's chunk. ISO/IEC 15948:2004, annex D.
fn crc(bytes: &[u8]) -> u32 {
    let bit = |c: u32| if c & 1 == 1 { 0xedb8_8320 ^ (c >> 1) } else { c >> 1 };
    !bytes.iter().fold(u32::MAX, |c, &byte| (0..8).fold(c ^ u32::from(byte), |c, _| bit(c)))
}

#[test]
fn lines_and_words_without_end() {
    let _alone = alone();
    let n = 30_000_000;
    for name in ["model.obj", "mesh.stl"] {
        let bytes = [b"solid ".to_vec(), vec![b'v'; n]].concat();
        let error = refused(name, &bytes);
        assert!(error.contains("the line is longer than 1048576 bytes"), "{error}");
    }
    refused("model.obj", format!("f{}", " 1\\\n".repeat(n / 10)).as_bytes());
    refused("mesh.ply", &[b"ply\n".to_vec(), vec![b'c'; n]].concat());
    refused("lamp.ies", &[b"TILT=NONE\n".to_vec(), vec![b'9'; n / 10]].concat());
    refused("picture.hdr", &[b"#?RADIANCE\n".to_vec(), vec![b'E'; n]].concat());
}

/// A small limit is kept by every reader that is given one.
#[test]
fn no_more_than_is_allowed() {
    let _alone = alone();
    let grid = |side: u32, line: &dyn Fn(u32, u32) -> String| {
        (0..side).flat_map(|y| (0..side).map(move |x| (x, y))).map(|(x, y)| line(x, y)).collect::<String>()
    };
    let side = 300;
    let obj =
        grid(side, &|x, y| format!("v {x} {y} 0\n")) + &grid(side, &|x, y| format!("f {} 1 2\n", y * side + x + 1));
    let facet =
        |x, y| format!("facet\nouter loop\nvertex {x} {y} 0\nvertex {x} {y} 1\nvertex 0 0 1\nendloop\nendfacet\n");
    let stl = format!("solid\n{}endsolid\n", grid(side, &facet));
    let count = side * side;
    let ply = format!(
        "ply\nformat ascii 1.0\nelement vertex {count}\nproperty float x\nproperty float y\nproperty float z\n\
        element face {count}\nproperty list uchar int vertex_indices\nend_header\n{}{}",
        grid(side, &|x, y| format!("{x} {y} 0\n")),
        grid(side, &|x, y| format!("3 {} 1 2\n", y * side + x)),
    );
    let numbers = vec![0; 12 * count as usize];
    let document = json!({
        "asset": { "version": "2.0" },
        "scenes": [{ "nodes": [0] }],
        "nodes": [{ "mesh": 0 }],
        "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 } }] }],
        "accessors": [{ "bufferView": 0, "componentType": 5126, "count": count, "type": "VEC3" }],
        "bufferViews": [{ "buffer": 0, "byteLength": numbers.len() }],
        "buffers": [{ "byteLength": numbers.len() }],
    });
    let models = [
        ("model.obj", obj.into_bytes()),
        ("mesh.stl", stl.into_bytes()),
        ("mesh.ply", ply.into_bytes()),
        ("model.glb", glb(&document, &numbers)),
    ];
    for (name, bytes) in models {
        let read = |memory| {
            let options = ReadOptions { memory, ..ReadOptions::default() };
            watched(name, || read_bytes(name, &bytes, Files::None, &options))
        };
        let (file, peak) = read(None);
        let told = file.unwrap_or_else(|e| panic!("{e}")).memory as usize;
        assert!(told > 1 << 20 && peak < 4 * told + bytes.len(), "{name}: {told} are told, {peak} used");
        let (result, peak) = read(Some(1 << 20));
        let Err(Error::File(error)) = result else { panic!("{name} is read") };
        assert!(error.fault == Fault::Memory && error.file == name, "{error}");
        // What is read piece by piece has been read to some point.
        assert!(peak < 12 << 20, "{name}: {peak} bytes, {error}");
    }
}
