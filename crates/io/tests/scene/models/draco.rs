//! glTF with compressed meshes: those of others are what they were before, and one that is made here is whole.

use std::fs;
use std::path::Path;

use draco_core::{
    DataType, EncoderBuffer, EncoderOptions, GeometryAttributeType, Mesh, MeshEncoder, PointAttribute, PointIndex,
};
use eyebeam_core::shape::MeshData;
use eyebeam_io::Error;
use eyebeam_io::scene::{SceneFile, read};
use serde_json::{Value, json};
use tempfile::TempDir;

/// Squares along a side.
const SIDE: u32 = 8;

fn bytes<T: Copy, const N: usize>(numbers: &[T], of: impl Fn(T) -> [u8; N]) -> Vec<u8> {
    numbers.iter().flat_map(|n| of(*n)).collect()
}

fn attribute(
    kind: GeometryAttributeType,
    components: u8,
    data: DataType,
    count: usize,
    values: &[u8],
) -> PointAttribute {
    let mut attribute = PointAttribute::new();
    attribute.init(kind, components, data, false, count);
    assert!(attribute.buffer_mut().try_write(0, values));
    attribute
}

/// A hill over a square of length one: (x, y, xy), with a normal, coordinates (x, y), a colour in bytes, and joints that are numbers of
/// their rows.
fn hill(method: i32, speed: i32) -> Vec<u8> {
    let places: Vec<[u32; 2]> = (0..=SIDE).flat_map(|y| (0..=SIDE).map(move |x| [x, y])).collect();
    let count = places.len();
    let floats = |of: fn([f32; 2]) -> Vec<f32>| {
        let all: Vec<f32> = places.iter().flat_map(|p| of(p.map(|c| c as f32 / SIDE as f32))).collect();
        bytes(&all, f32::to_le_bytes)
    };
    let colors: Vec<u8> = places.iter().flat_map(|[x, _]| [*x as u8 * 16, 255, 0, 255]).collect();
    let joints: Vec<u16> = places.iter().flat_map(|[_, y]| [*y as u16, 0, 0, 0]).collect();
    let mut mesh = Mesh::new();
    mesh.set_num_points(count);
    mesh.add_attribute(attribute(
        GeometryAttributeType::Position,
        3,
        DataType::Float32,
        count,
        &floats(|[x, y]| vec![x, y, x * y]),
    ));
    mesh.add_attribute(attribute(
        GeometryAttributeType::Normal,
        3,
        DataType::Float32,
        count,
        &floats(|[x, y]| {
            let length = (1.0 + x * x + y * y).sqrt();
            vec![-y / length, -x / length, 1.0 / length]
        }),
    ));
    let uvs = floats(|[x, y]| vec![x, y]);
    mesh.add_attribute(attribute(GeometryAttributeType::TexCoord, 2, DataType::Float32, count, &uvs));
    mesh.add_attribute(attribute(GeometryAttributeType::Color, 4, DataType::Uint8, count, &colors));
    let joints = bytes(&joints, u16::to_le_bytes);
    mesh.add_attribute(attribute(GeometryAttributeType::Generic, 4, DataType::Uint16, count, &joints));
    for [x, y] in places.into_iter().filter(|[x, y]| *x < SIDE && *y < SIDE) {
        let corner = |x: u32, y: u32| PointIndex(y * (SIDE + 1) + x);
        mesh.add_face([corner(x, y), corner(x + 1, y), corner(x + 1, y + 1)]);
        mesh.add_face([corner(x, y), corner(x + 1, y + 1), corner(x, y + 1)]);
    }
    let mut options = EncoderOptions::new();
    options.set_encoding_method(method);
    options.set_global_int("encoding_speed", speed);
    options.set_global_int("decoding_speed", speed);
    for (id, bits) in [(0, 14), (1, 10), (2, 12)] {
        options.set_attribute_int(id, "quantization_bits", bits);
    }
    let (mut encoder, mut code) = (MeshEncoder::new(), EncoderBuffer::new());
    encoder.set_mesh(mesh);
    encoder.encode(&options, &mut code).unwrap();
    code.data().to_vec()
}

/// A file with that mesh, bound to joints of which the one of the last row is lifted by one.
fn document(code: &[u8]) -> Value {
    let (vertices, corners) = ((SIDE + 1).pow(2), SIDE * SIDE * 6);
    let accessor = |kind: &str, component: u32, normalized: bool| json!({ "componentType": component, "count": vertices, "type": kind, "normalized": normalized });
    let ones = bytes(&vec![1.0_f32; vertices as usize], f32::to_le_bytes);
    let joint = |row: u32| json!({ "translation": [0, 0, u32::from(row == SIDE)] });
    let nodes: Vec<Value> = (0..=SIDE).map(joint).chain([json!({ "mesh": 0, "skin": 0 })]).collect();
    json!({
        "asset": { "version": "2.0" },
        "extensionsUsed": ["KHR_draco_mesh_compression"],
        "extensionsRequired": ["KHR_draco_mesh_compression"],
        "nodes": nodes,
        "skins": [{ "joints": (0..=SIDE).collect::<Vec<_>>() }],
        "meshes": [{ "primitives": [{
            "attributes": { "POSITION": 1, "NORMAL": 2, "TEXCOORD_0": 3, "COLOR_0": 4, "JOINTS_0": 5, "WEIGHTS_0": 6 },
            "indices": 0,
            "extensions": { "KHR_draco_mesh_compression": { "bufferView": 0,
                "attributes": { "POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2, "COLOR_0": 3, "JOINTS_0": 4 } } },
        }] }],
        "accessors": [
            { "componentType": 5123, "count": corners, "type": "SCALAR" },
            accessor("VEC3", 5126, false),
            accessor("VEC3", 5126, false),
            accessor("VEC2", 5126, false),
            accessor("VEC4", 5121, true),
            accessor("VEC4", 5123, false),
            { "bufferView": 1, "componentType": 5126, "count": vertices, "type": "SCALAR" },
        ],
        "bufferViews": [
            { "buffer": 0, "byteLength": code.len() },
            { "buffer": 0, "byteOffset": code.len(), "byteLength": ones.len() },
        ],
        "buffers": [{ "uri": "a.bin", "byteLength": code.len() + ones.len() }],
    })
}

fn read_document(document: &Value, code: &[u8]) -> Result<SceneFile, Error> {
    let folder = TempDir::new().unwrap();
    let ones = bytes(&vec![1.0_f32; (SIDE + 1).pow(2) as usize], f32::to_le_bytes);
    fs::write(folder.path().join("a.bin"), [code, &ones].concat()).unwrap();
    fs::write(folder.path().join("a.gltf"), document.to_string()).unwrap();
    read(&folder.path().join("a.gltf"), &[])
}

/// The ways there are to walk over a mesh: one vertex after the other, by edges, and by edges and valences.
const WAYS: [(i32, i32); 3] = [(0, 5), (1, 7), (1, 0)];

#[test]
fn every_number_of_a_vertex_is_where_it_belongs() {
    for (method, speed) in WAYS {
        let code = hill(method, speed);
        let file = read_document(&document(&code), &code).unwrap();
        assert_eq!(file.warnings, []);
        let data = file.desc.shape.mesh[0].data.as_ref().unwrap();
        assert_eq!((data.vertices.len(), data.triangles.len()), (81, 128), "{method} {speed}");
        for (i, &[x, y, z]) in data.vertices.iter().enumerate() {
            let lift = if y > 0.99 { 1.0 } else { 0.0 };
            assert!((z - lift - x * y).abs() < 1e-3, "{x} {y} {z}");
            let [u, v] = data.uvs[i];
            assert!((u - x).abs() < 1e-3 && (1.0 - v - y).abs() < 1e-3);
            let [r, g, b] = data.colors[i];
            assert!((r * 255.0 - (x * SIDE as f32).round() * 16.0).abs() < 1e-3 && (g, b) == (1.0, 0.0), "{r} {g} {b}");
            let [nx, ny, nz] = data.normals[i];
            let cos = (nz - y * nx - x * ny) / (1.0 + x * x + y * y).sqrt();
            assert!(cos > 0.999, "{cos}");
        }
    }
}

#[test]
fn no_more_is_decoded_than_there_is_room_for() {
    let code = hill(1, 0);
    let with = |pointer: &str, value: Value| {
        let mut document = document(&code);
        *document.pointer_mut(pointer).unwrap() = value;
        read_document(&document, &code).map_or_else(|e| e.to_string(), |_| String::new())
    };
    let error = with("/accessors/0/count", json!(381));
    assert!(
        error.contains("buffer view 0: the compressed mesh is damaged: ") && error.contains("128 faces"),
        "{error}"
    );
    let error = with("/accessors/0/count", json!(u64::MAX));
    assert!(error.contains("triangles, and 33554432 are allowed"), "{error}");
    let extension = "/meshes/0/primitives/0/extensions/KHR_draco_mesh_compression";
    let error = with(&format!("{extension}/attributes/POSITION"), json!(9));
    assert!(error.contains("a compressed mesh has no attribute 9"), "{error}");
    let error = with(&format!("{extension}/attributes/JOINTS_0"), json!(0));
    assert!(error.contains("attribute 0 of a compressed mesh holds no whole numbers"), "{error}");
    let error = with(&format!("{extension}/attributes"), json!(7));
    assert!(error.contains("KHR_draco_mesh_compression: invalid type: integer `7`, expected a map"), "{error}");
    assert!(with(&format!("{extension}/bufferView"), json!(7)).contains("there is no buffer view 7"));
}

#[test]
fn damage_does_no_harm() {
    for (method, speed) in WAYS {
        let code = hill(method, speed);
        let document = document(&code);
        let mut state = 1_u64;
        for round in 0..200 {
            let mut bytes = code.clone();
            for _ in 0..1 + round % 4 {
                state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
                let at = (state >> 33) as usize % bytes.len();
                bytes[at] ^= (state >> 20) as u8;
            }
            let _ = read_document(&document, &bytes).is_ok();
        }
    }
}

fn area(data: &MeshData) -> f64 {
    let corner = |i: u32| data.vertices[i as usize].map(f64::from);
    let area = |[a, b, c]: [[f64; 3]; 3]| {
        let [u, v] = [[b[0] - a[0], b[1] - a[1], b[2] - a[2]], [c[0] - a[0], c[1] - a[1], c[2] - a[2]]];
        let cross = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
        cross.iter().map(|c| c * c).sum::<f64>().sqrt() / 2.0
    };
    data.triangles.iter().map(|t| area(t.map(corner))).sum()
}

/// Of a mesh: triangles, their area, and of each coordinate of a vertex, a normal and a uv the least and the most.
fn measure(data: &MeshData) -> (usize, f64, Vec<[f32; 2]>) {
    fn bounds<const N: usize>(list: &[[f32; N]]) -> Vec<[f32; 2]> {
        let most = |axis: usize, sign: f32| list.iter().map(|v| sign * v[axis]).fold(f32::NEG_INFINITY, f32::max);
        (0..N).map(|axis| [-most(axis, -1.0), most(axis, 1.0)]).collect()
    }
    (data.triangles.len(), area(data), [bounds(&data.vertices), bounds(&data.normals), bounds(&data.uvs)].concat())
}

/// The largest way from a vertex to the nearest of another mesh, along an axis.
fn gap(from: &MeshData, to: &MeshData) -> f32 {
    let far = |a: &[f32; 3], b: &[f32; 3]| a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
    let nearest = |a: &[f32; 3]| to.vertices.iter().map(|b| far(a, b)).fold(f32::INFINITY, f32::min);
    from.vertices.iter().map(nearest).fold(0.0, f32::max)
}

#[test]
fn what_others_compressed_is_what_it_was() {
    let files = super::corpus::corpus("gltf", &["gltf"]);
    for (name, steps) in [("Box", 1 << 11), ("Duck", 1 << 11), ("MorphPrimitivesTest", 1 << 10)] {
        let file =
            |kind: &str| files.iter().find(|p| p.ends_with(Path::new(name).join(kind).join(format!("{name}.gltf"))));
        let (Some(plain), Some(packed)) = (file("glTF"), file("glTF-Draco")) else { return };
        let [plain, packed] = [plain, packed].map(|path| read(path, &[]).unwrap().desc.shape.mesh);
        assert_eq!(plain.len(), packed.len());
        for (plain, packed) in plain.iter().zip(&packed) {
            let [plain, packed] = [plain, packed].map(|mesh| mesh.data.as_deref().unwrap());
            let ((count, size, bounds), (packed_count, packed_size, packed_bounds)) = (measure(plain), measure(packed));
            assert_eq!(count, packed_count, "{name}");
            assert!((size / packed_size - 1.0).abs() < 0.01, "{name}: {size} {packed_size}");
            for (a, b) in bounds.iter().flatten().zip(packed_bounds.iter().flatten()) {
                assert!((a - b).abs() <= (a.abs().max(1.0)) * 0.02, "{name}: {bounds:?} {packed_bounds:?}");
            }
            let side = bounds[..3].iter().map(|[least, most]| most - least).fold(0.0, f32::max);
            let most = gap(plain, packed).max(gap(packed, plain));
            assert!(most <= side / steps as f32, "{name}: {most} of {side}");
        }
    }
    for name in ["RiggedSimple.gltf", "DracoSparseMesh.gltf"] {
        for path in files.iter().filter(|path| path.ends_with(name) && path.to_string_lossy().contains("Draco")) {
            let file = read(path, &[]).unwrap();
            let data = file.desc.shape.mesh[0].data.as_ref().unwrap();
            assert!(data.triangles.len() > 100 && data.normals.len() == data.vertices.len(), "{name}");
        }
    }
}
