//! glTF: files made here, each with one thing in it, and what is wrong with them.

use std::fs;

use eyebeam_core::color::LUMENS_PER_WATT;
use eyebeam_core::material::{MaterialDesc, Principled};
use eyebeam_core::setup::Given;
use eyebeam_core::shape::MeshData;
use eyebeam_core::texture::{Color, ImageTexture, Space, TextureDesc};
use eyebeam_io::Error;
use eyebeam_io::scene::{ReadOptions, SceneFile, read, read_with};
use serde_json::{Value, json};
use tempfile::TempDir;

use crate::models::glb;

/// A file of one upright triangle, with its numbers behind the JSON: indices at 0, positions at 8, uvs at 44, four joints a vertex at 68,
/// four weights at 80.
pub(super) fn triangle() -> Value {
    let view = |at: usize, length: usize| json!({ "buffer": 0, "byteOffset": at, "byteLength": length });
    json!({
        "asset": { "version": "2.0" },
        "scene": 0,
        "scenes": [{ "nodes": [0] }],
        "nodes": [{ "mesh": 0 }],
        "meshes": [{ "primitives": [{ "attributes": { "POSITION": 1, "TEXCOORD_0": 2 }, "indices": 0, "material": 0 }] }],
        "materials": [{ "name": "paint" }],
        "accessors": [
            { "bufferView": 0, "componentType": 5123, "count": 3, "type": "SCALAR" },
            { "bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC3" },
            { "bufferView": 2, "componentType": 5126, "count": 3, "type": "VEC2" },
            { "bufferView": 3, "componentType": 5121, "count": 3, "type": "VEC4" },
            { "bufferView": 4, "componentType": 5121, "normalized": true, "count": 3, "type": "VEC4" },
        ],
        "bufferViews": [view(0, 6), view(8, 36), view(44, 24), view(68, 12), view(80, 12)],
        "buffers": [{ "byteLength": 92 }],
    })
}

pub(super) fn glb(document: &Value) -> Vec<u8> {
    glb::glb(document, &glb::triangle())
}

pub(super) fn read_bytes(bytes: &[u8]) -> Result<SceneFile, Error> {
    read_as(bytes, &ReadOptions::default())
}

pub(super) fn read_as(bytes: &[u8], options: &ReadOptions<'_>) -> Result<SceneFile, Error> {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("a.glb");
    fs::write(&path, bytes).unwrap();
    read_with(&path, options)
}

pub(super) fn model(document: &Value) -> SceneFile {
    read_bytes(&glb(document)).unwrap()
}

pub(super) fn error(document: &Value) -> String {
    read_bytes(&glb(document)).unwrap_err().to_string().lines().next().unwrap().to_owned()
}

/// The same with other values, by JSON pointers.
pub(super) fn with(changes: &[(&str, Value)]) -> Value {
    let mut document = triangle();
    for (pointer, value) in changes {
        let (parent, key) = pointer.rsplit_once('/').unwrap();
        match document.pointer_mut(parent).unwrap() {
            Value::Array(list) => {
                let index: usize = key.parse().unwrap();
                list.resize(list.len().max(index + 1), Value::Null);
                list[index] = value.clone();
            }
            object => object[key] = value.clone(),
        }
    }
    document
}

pub(super) fn mesh(file: &SceneFile) -> &MeshData {
    file.desc.shape.mesh[0].data.as_ref().unwrap()
}

pub(super) fn principled(file: &SceneFile) -> &Principled {
    match &file.desc.material["paint"] {
        MaterialDesc::Principled(principled) => principled,
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_mesh_stands_where_its_nodes_say() {
    let file = model(&triangle());
    assert_eq!((file.given, &file.warnings), (Given::default(), &vec![]));
    assert_eq!(mesh(&file).vertices, [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 2.0, 0.0]]);
    assert_eq!(mesh(&file).triangles, [[0, 1, 2]]);
    // Pictures hang down from v = 0.
    assert_eq!(mesh(&file).uvs, [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]);
    let half_turn = json!([0.0, 0.0, 1.0, 0.0]);
    let nodes = json!([{ "children": [1], "rotation": half_turn }, { "mesh": 0, "translation": [1, 0, 3], "scale": [1, 2, 1] }]);
    let file = model(&with(&[("/nodes", nodes)]));
    assert_eq!(mesh(&file).vertices.map_near(), [[-1.0, 0.0, 3.0], [-2.0, 0.0, 3.0], [-1.0, -4.0, 3.0]]);
}

trait Near {
    fn map_near(&self) -> Vec<[f32; 3]>;
}

impl Near for Vec<[f32; 3]> {
    fn map_near(&self) -> Vec<[f32; 3]> {
        self.iter().map(|v| v.map(|c| (c * 1e4).round() / 1e4 + 0.0)).collect()
    }
}

#[test]
fn mirrored_triangles_are_turned_round() {
    let file = model(&with(&[("/nodes/0/scale", json!([-1, 1, 1]))]));
    assert_eq!(mesh(&file).triangles, [[0, 2, 1]]);
    assert_eq!(mesh(&file).vertices[1], [-1.0, 0.0, 0.0]);
}

#[test]
fn strips_fans_and_lists_without_indices() {
    let primitive = |mode: u32| json!({ "attributes": { "POSITION": 1 }, "mode": mode });
    for (mode, count) in [(4, 1), (5, 1), (6, 1)] {
        let file = model(&with(&[("/meshes/0/primitives/0", primitive(mode))]));
        assert_eq!(mesh(&file).triangles, vec![[0, 1, 2]; count]);
    }
    let file = model(&with(&[("/meshes/0/primitives/1", primitive(1))]));
    assert_eq!(file.desc.shape.mesh.len(), 1);
    assert_eq!(file.warnings[0].message, "points and lines are left out");
}

#[test]
fn joints_and_targets_pose_it() {
    let attributes = json!({ "POSITION": 1, "JOINTS_0": 3, "WEIGHTS_0": 4 });
    let skinned = [
        ("/meshes/0/primitives/0/attributes", attributes),
        ("/skins", json!([{ "joints": [1, 2] }])),
        ("/nodes", json!([{ "mesh": 0, "skin": 0, "translation": [9, 9, 9] }, {}, { "translation": [0, 0, 5] }])),
        ("/scenes/0/nodes", json!([0, 1, 2])),
    ];
    // The node of a skinned mesh does not move it: its joints do.
    assert_eq!(mesh(&model(&with(&skinned))).vertices, [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 2.0, 5.0]]);
    let targets = [("/meshes/0/primitives/0/targets", json!([{ "POSITION": 1 }])), ("/meshes/0/weights", json!([0.5]))];
    assert_eq!(mesh(&model(&with(&targets))).vertices[2], [0.0, 3.0, 0.0]);
}

/// Keys at 0, 1 and 2 seconds, whose numbers are those of the vertices: (0, 0, 0), (1, 0, 0), (0, 2, 0).
#[test]
fn animations_move_nodes() {
    let document = |interpolation: &str| {
        with(&[
            (
                "/animations",
                json!([{ "name": "walk", "samplers": [{ "input": 5, "output": 1, "interpolation": interpolation }],
                "channels": [{ "sampler": 0, "target": { "node": 0, "path": "translation" } }] }]),
            ),
            ("/accessors/5", json!({ "bufferView": 5, "componentType": 5123, "count": 3, "type": "SCALAR" })),
            ("/bufferViews/5", json!({ "buffer": 0, "byteOffset": 0, "byteLength": 6 })),
        ])
    };
    let place = |interpolation: &str, at: f32| {
        let options = ReadOptions { animation: Some("walk"), at, ..ReadOptions::default() };
        mesh(&read_as(&glb(&document(interpolation)), &options).unwrap()).vertices[0]
    };
    assert_eq!(place("LINEAR", 0.25), [0.25, 0.0, 0.0]);
    assert_eq!(place("LINEAR", 1.5), [0.5, 1.0, 0.0]);
    assert_eq!(place("STEP", 1.5), [1.0, 0.0, 0.0]);
    assert_eq!([place("LINEAR", -1.0), place("LINEAR", 9.0)], [[0.0, 0.0, 0.0], [0.0, 2.0, 0.0]]);
    let rests = model(&document("LINEAR"));
    assert_eq!(rests.warnings[0].message, "of 1 animations none is chosen: all is as it rests");
    let options = ReadOptions { animation: Some("run"), ..ReadOptions::default() };
    let error = read_as(&glb(&document("LINEAR")), &options).unwrap_err().to_string();
    assert!(error.contains("there is no animation `run`") && error.contains("it has 0 `walk`"), "{error}");
    let error = read_as(&glb(&document("CUBICSPLINE")), &ReadOptions { animation: Some("0"), ..options }).unwrap_err();
    assert!(error.to_string().contains("an animation moves nodes by what is no vector"), "{error}");
}

#[test]
fn instances_are_copies() {
    let extension = json!({ "EXT_mesh_gpu_instancing": { "attributes": { "TRANSLATION": 1 } } });
    let file =
        model(&with(&[("/nodes/0/extensions", extension), ("/extensionsUsed", json!(["EXT_mesh_gpu_instancing"]))]));
    assert_eq!((file.desc.shape.mesh.len(), file.warnings.len()), (3, 0));
    assert_eq!(file.desc.shape.mesh[2].data.as_ref().unwrap().vertices[0], [0.0, 2.0, 0.0]);
}

/// Seventy thousand in one place.
#[test]
fn many_instances_share_a_mesh() {
    let extension = json!({ "EXT_mesh_gpu_instancing": { "attributes": { "TRANSLATION": 5 } } });
    let file = model(&with(&[
        ("/nodes/0/extensions", extension),
        ("/nodes/0/translation", json!([1, 2, 3])),
        ("/accessors/5", json!({ "bufferView": 5, "componentType": 5126, "count": 70_000, "type": "VEC3" })),
        ("/bufferViews/5", json!({ "buffer": 1, "byteLength": 840_000 })),
        ("/buffers/1", json!({ "byteLength": 840_000, "uri": format!("data:;base64,{}", "A".repeat(1_120_000)) })),
    ]));
    let [mesh] = &file.desc.shape.mesh[..] else { panic!("one mesh") };
    assert_eq!((mesh.instances.len(), mesh.triangle_count()), (70_000, 1));
    assert_eq!(mesh.instances[7], [1.0, 0.0, 0.0, 1.0, 0.0, 1.0, 0.0, 2.0, 0.0, 0.0, 1.0, 3.0]);
    assert!(file.desc.check().is_empty());
}

#[test]
fn cameras_and_lights_are_given() {
    let lights = json!({ "KHR_lights_punctual": { "lights": [{ "type": "point", "intensity": LUMENS_PER_WATT, "color": [1, 0.5, 0] }] } });
    let file = model(&with(&[
        ("/nodes/1", json!({ "camera": 0, "translation": [0, 1, 5] })),
        ("/nodes/2", json!({ "translation": [0, 3, 0], "extensions": { "KHR_lights_punctual": { "light": 0 } } })),
        ("/scenes/0/nodes", json!([0, 1, 2])),
        ("/cameras", json!([{ "type": "perspective", "perspective": { "yfov": 0.5, "znear": 0.1 } }])),
        ("/extensions", lights),
    ]));
    assert_eq!(file.given, Given { camera: true, light: false });
    let camera = &file.desc.camera;
    assert_eq!(
        (camera.look_from, camera.look_at, camera.vfov),
        ([0.0, 1.0, 5.0], [0.0, 1.0, 0.0], Some(0.5_f32.to_degrees()))
    );
    let light = &file.desc.light.point[0];
    assert_eq!((light.position, light.intensity.0), ([0.0, 3.0, 0.0], [1.0, 0.5, 0.0]));
}

#[test]
fn materials_become_principled() {
    let file = model(&with(&[(
        "/materials/0",
        json!({ "name": "paint", "emissiveFactor": [1, 0.5, 0],
            "pbrMetallicRoughness": { "baseColorFactor": [0.5, 0.25, 1, 1], "metallicFactor": 0.25, "roughnessFactor": 0.75 },
            "extensions": {
                "KHR_materials_clearcoat": { "clearcoatFactor": 0.5, "clearcoatRoughnessFactor": 0.125 },
                "KHR_materials_emissive_strength": { "emissiveStrength": 2 },
                "KHR_materials_ior": { "ior": 1.75 },
                "KHR_materials_iridescence": { "iridescenceFactor": 1, "iridescenceThicknessMaximum": 500 },
                "KHR_materials_sheen": { "sheenColorFactor": [0.5, 0.25, 0], "sheenRoughnessFactor": 0.5 },
                "KHR_materials_transmission": { "transmissionFactor": 0.5 },
                "KHR_materials_volume": { "thicknessFactor": 1, "attenuationDistance": 3, "attenuationColor": [1, 0.5, 0.25] } } }),
    )]));
    let p = principled(&file);
    let rgb = |color: &Color| color.rgb().unwrap().0;
    assert_eq!((rgb(&p.base_color), p.specular_ior), ([0.5, 0.25, 1.0], 1.75));
    assert_eq!((p.base_metalness.number(), p.specular_roughness.number()), (Some(0.25), Some(0.75)));
    assert_eq!((p.coat_weight.number(), p.coat_roughness.number()), (Some(0.5), Some(0.125)));
    assert_eq!((p.emission_luminance, rgb(&p.emission_color)), (2.0 * LUMENS_PER_WATT, [1.0, 0.5, 0.0]));
    assert_eq!((p.thin_film_weight.number(), p.thin_film_thickness.number()), (Some(1.0), Some(0.5)));
    assert_eq!((p.fuzz_weight.number(), rgb(&p.fuzz_color)), (Some(0.5), [1.0, 0.5, 0.0]));
    assert_eq!((p.transmission_weight.number(), p.transmission_depth, p.geometry_thin_walled), (Some(0.5), 3.0, false));
    // In 3 metres, of which each has the base colour, besides that of the volume.
    assert_eq!(rgb(&p.transmission_color), [0.125, 0.5 / 64.0, 0.25]);
}

#[test]
fn alpha_is_a_mask_and_unlit_a_lamp() {
    let paint = |mode: &str| json!({ "name": "paint", "alphaMode": mode, "pbrMetallicRoughness": { "baseColorFactor": [1, 1, 1, 0.25] } });
    for (mode, opacity) in [("OPAQUE", None), ("BLEND", Some(0.25)), ("MASK", Some(0.0))] {
        let file = model(&with(&[("/materials/0", paint(mode))]));
        match (&file.desc.material["paint"], opacity) {
            (MaterialDesc::Principled(_), None) => {}
            (MaterialDesc::Mask(mask), Some(_)) => {
                assert_eq!((mask.of.name(), mask.opacity.number()), ("paint.opaque", opacity));
            }
            other => panic!("{mode}: {other:?}"),
        }
    }
    let leaf = json!({ "name": "paint", "extensions": { "KHR_materials_diffuse_transmission": { "diffuseTransmissionFactor": 0.25 } } });
    let file = model(&with(&[("/materials/0", leaf)]));
    assert!(matches!(&file.desc.material["paint"], MaterialDesc::Mix(mix) if mix.share.number() == Some(0.25)));
    let unlit = json!({ "name": "paint", "extensions": { "KHR_materials_unlit": {} } });
    assert!(matches!(model(&with(&[("/materials/0", unlit)])).desc.material["paint"], MaterialDesc::Emissive(_)));
}

#[test]
fn pictures_are_read_from_data_and_missing_ones_told_of() {
    let changes = |uri: String| {
        with(&[
            ("/images", json!([{ "uri": uri }])),
            ("/textures", json!([{ "source": 0 }])),
            (
                "/materials/0/pbrMetallicRoughness",
                json!({ "baseColorTexture": { "index": 0 }, "metallicRoughnessTexture": { "index": 0 } }),
            ),
        ])
    };
    let file = model(&changes(PNG.to_owned()));
    assert_eq!(file.warnings, []);
    let p = principled(&file);
    let Color::Texture(name) = &p.base_color else { panic!("{:?}", p.base_color) };
    assert!(matches!(&file.desc.texture[name.name()], TextureDesc::Image(image) if image.pixels.is_some()));
    assert_eq!(p.specular_roughness.number(), None);
    let file = model(&changes("nowhere%20at%20all.png".to_owned()));
    assert!(file.warnings[0].message.contains("`nowhere%20at%20all.png` is not read: "), "{}", file.warnings[0]);
    assert_eq!(principled(&file).base_color.rgb().unwrap().0, [1.0; 3]);
    let file = model(&changes("../../etc/passwd".to_owned()));
    assert!(file.warnings[0].message.contains("leads out of the folder of the model"), "{}", file.warnings[0]);
}

/// A picture of an extension comes before the one for those who do not know it.
#[test]
fn pictures_of_extensions_are_read() {
    let base64 = |bytes: &[u8]| base64::Engine::encode(&base64::engine::general_purpose::STANDARD, bytes);
    let ktx2 = crate::pictures::ktx2();
    let images = json!([
        { "uri": "nowhere.png" },
        { "uri": format!("data:image/webp;base64,{}", base64(&crate::pictures::lossy_webp())) },
        { "uri": format!("data:image/ktx2;base64,{}", base64(&ktx2)) },
        { "uri": format!("data:image/ktx2;base64,{}", base64(&ktx2[..15])) },
    ]);
    let changes = |texture: Value| {
        with(&[
            ("/extensionsUsed", json!(["EXT_texture_webp", "KHR_texture_basisu"])),
            ("/extensionsRequired", json!(["EXT_texture_webp"])),
            ("/images", images.clone()),
            ("/textures", json!([texture])),
            ("/materials/0/pbrMetallicRoughness", json!({ "baseColorTexture": { "index": 0 } })),
        ])
    };
    let size = |texture: Value| {
        let file = model(&changes(texture));
        assert_eq!(file.warnings, []);
        let Color::Texture(name) = &principled(&file).base_color else { panic!() };
        let TextureDesc::Image(image) = &file.desc.texture[name.name()] else { panic!() };
        let pixels = image.pixels.as_ref().unwrap();
        (pixels.width(), pixels.height(), pixels.channels())
    };
    assert_eq!(size(json!({ "source": 0, "extensions": { "EXT_texture_webp": { "source": 1 } } })), (8, 8, 4));
    assert_eq!(size(json!({ "source": 0, "extensions": { "KHR_texture_basisu": { "source": 2 } } })), (5, 3, 3));
    let file = model(&changes(json!({ "source": 1, "extensions": { "KHR_texture_basisu": { "source": 3 } } })));
    let warning = file.warnings[0].to_string();
    assert!(
        warning.contains("the picture is left out: the KTX2 ends too early") && warning.contains(", picture 3"),
        "{warning}"
    );
}

/// One red pixel.
pub(super) const PNG: &str = "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAADElEQVR4nGP4z8AAAAMBAQDJ/pLvAAAAAElFTkSuQmCC";

/// The same, with the red picture as texture 0.
pub(super) fn with_picture(changes: &[(&str, Value)]) -> Value {
    let picture = [("/images", json!([{ "uri": PNG }])), ("/textures", json!([{ "source": 0 }]))];
    with(&[&picture, changes].concat())
}

pub(super) fn picture<'f>(file: &'f SceneFile, name: &str) -> &'f ImageTexture {
    match &file.desc.texture[name] {
        TextureDesc::Image(image) => image,
        other => panic!("{name}: {other:?}"),
    }
}

#[test]
fn a_texture_lies_by_the_second_coordinates() {
    let painted = |set: u32| {
        with_picture(&[
            ("/meshes/0/primitives/0/attributes", json!({ "POSITION": 1, "TEXCOORD_0": 2, "TEXCOORD_1": 2 })),
            ("/materials/0/pbrMetallicRoughness", json!({ "baseColorTexture": { "index": 0, "texCoord": set } })),
        ])
    };
    let [first, second, third] = [0, 1, 2].map(|set| model(&painted(set)));
    let spaces = [&first, &second, &third].map(|file| picture(file, "paint.base-color.picture").mapping.space);
    assert_eq!(spaces, [None, Some(Space::Uv1), None]);
    assert_eq!(mesh(&second).uvs_1, [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]);
    assert_eq!((&first.warnings, &second.warnings), (&vec![], &vec![]));
    let said = third.warnings[0].to_string();
    assert!(said.starts_with("warning: the texture lies as TEXCOORD_0 says, not as TEXCOORD_2 does\n"), "{said}");
    assert!(said.contains("a.glb, texture 0\nhint: two sets of coordinates are read"), "{said}");
}

#[test]
fn what_is_wrong_is_said() {
    let cases: &[(&str, Value, &str)] = &[
        ("/asset/version", json!("1.0"), "this is glTF of version `1.0`"),
        ("/extensionsRequired", json!(["ACME_x"]), "the model needs the extension ACME_x, which is not read"),
        ("/nodes/0/children", json!([0]), "node 0 is in more than one place, or within itself"),
        ("/nodes/0/mesh", json!(7), "there is no mesh 7"),
        ("/scenes/0/nodes", json!([3]), "there is no node 3"),
        ("/nodes/0/translation", json!([1e300, 0, 0]), "vertex 0 is"),
        ("/accessors/0/count", json!(4), "accessor 0 of 4 elements reaches beyond buffer view 0"),
        ("/accessors/0/byteOffset", json!(2), "accessor 0 of 3 elements reaches beyond buffer view 0"),
        ("/accessors/1/count", json!(2), "there are 3 TEXCOORD_0 for 2 vertices"),
        ("/accessors/1/type", json!("VEC9"), "accessor 1 is of the type `VEC9`, which does not exist"),
        ("/accessors/1/componentType", json!(1), "accessor 1 has numbers of the type 1, which does not exist"),
        ("/bufferViews/1/byteOffset", json!(80), "buffer view 1 reaches beyond the 92 bytes of buffer 0"),
        ("/bufferViews/1/buffer", json!(2), "there is no buffer 2"),
        ("/buffers/0/byteLength", json!(1000), "buffer 0 has 92 of 1000 bytes"),
        ("/buffers/0/uri", json!("../x.bin"), "`../x.bin` is not read: its name leads out of the folder of the model"),
        ("/meshes/0/primitives/0/mode", json!(9), "the mode 9 of a mesh does not exist"),
    ];
    for (pointer, value, expected) in cases {
        let error = error(&with(&[(pointer, value.clone())]));
        assert!(error.contains(expected), "{pointer}: {error}");
    }
}

#[test]
fn pieces_and_flipped_bytes_do_no_harm() {
    let whole = glb(&triangle());
    for length in 0..whole.len() {
        let _ = read_bytes(&whole[..length]).is_ok();
    }
    flip(&whole, 2000);
    assert!(read_bytes(&whole).is_ok());
}

/// Reads files with four wrong bytes each.
pub(super) fn flip(whole: &[u8], times: usize) {
    let mut state = 1_u64;
    for _ in 0..times {
        let mut bytes = whole.to_vec();
        for _ in 0..4 {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            let at = (state >> 33) as usize % bytes.len();
            bytes[at] ^= (state >> 20) as u8;
        }
        let _ = read_bytes(&bytes).is_ok();
    }
}

/// Six times the volume inside, the middle of the corners of triangles, and how many triangles there are.
fn measure(file: &SceneFile) -> (f64, usize) {
    let data = mesh(file);
    let corner = |i: u32| data.vertices[i as usize].map(f64::from);
    let volume = |[a, b, c]: [[f64; 3]; 3]| {
        a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0])
    };
    (data.triangles.iter().map(|t| volume(t.map(corner))).sum(), data.triangles.len())
}

/// A box and a pirate of closed parts, from numbers that were compressed, are whole.
#[test]
fn compressed_numbers_are_decoded() {
    let files = super::corpus::corpus("gltf", &["glb"]);
    let file = |name: &str| files.iter().find(|path| path.ends_with(name));
    let [Some(packed_file), Some(plain), Some(pirate)] = ["BoxMeshopt.glb", "Box.glb", "pirate.glb"].map(file) else {
        return;
    };
    let [packed, plain] = [packed_file, plain].map(|path| read(path, &[]).unwrap());
    let (expected, triangles) = measure(&plain);
    assert_eq!((expected, triangles), (6.0, 12));
    flip(&fs::read(packed_file).unwrap(), 2000);
    assert!((measure(&packed).0 - 6.0).abs() < 1e-3, "{:?}", measure(&packed));
    assert_eq!(measure(&packed).1, 12);
    let lengths =
        |file: &SceneFile| mesh(file).normals.iter().map(|n| n.map(|c| c * c).iter().sum::<f32>()).collect::<Vec<_>>();
    assert!(lengths(&packed).iter().all(|l| (l - 1.0).abs() < 0.02), "{:?}", lengths(&packed));
    let pirate = read(pirate, &[]).unwrap();
    let [least, most] =
        [f32::min, f32::max].map(|f| mesh(&pirate).vertices.iter().flatten().copied().reduce(f).unwrap());
    assert!(measure(&pirate).0 > 0.0 && most - least < 10.0, "{:?} {least} {most}", measure(&pirate));
}

/// Every file of the corpus is read; of those that are meant to be wrong, a sentence says why not.
#[test]
fn the_corpus_is_read_or_refused_with_a_reason() {
    let [models, bad] = ["gltf", "bad"].map(|folder| super::corpus::corpus(folder, &["gltf", "glb"]));
    assert!(models.is_empty() || models.len() > 40 && bad.len() > 20);
    for path in models {
        let file = read(&path, &[]).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
        assert!(!file.desc.shape.mesh.is_empty(), "{}", path.display());
    }
    for path in bad {
        if let Err(e) = read(&path, &[]) {
            assert!(e.to_string().starts_with("error: "), "{}: {e}", path.display());
        }
    }
}
