//! glTF: corners of its specification, of files made here.

use eyebeam_core::color::Rgb;
use eyebeam_core::material::{MaterialDesc, Mix, Principled};
use eyebeam_core::texture::Scalar;
use eyebeam_io::scene::SceneFile;
use serde_json::{Value, json};

use super::gltf::{error, mesh, model, principled, read_bytes, with, with_picture};

/// What was told, a line each.
fn said(file: &SceneFile) -> String {
    file.warnings.iter().map(|w| format!("{w}\n")).collect()
}

fn parts<'f>(file: &'f SceneFile, name: &str) -> &'f Mix {
    match &file.desc.material[name] {
        MaterialDesc::Mix(mix) => mix,
        other => panic!("{other:?}"),
    }
}

fn layers<'f>(file: &'f SceneFile, name: &str) -> &'f Principled {
    match &file.desc.material[name] {
        MaterialDesc::Principled(layers) => layers,
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_mark_of_the_encoding_and_padding_are_no_matter() {
    let text = serde_json::to_string(&with(&[(
        "/buffers/0/uri",
        json!(format!(
            "data:;base64,{}",
            base64::Engine::encode(&base64::engine::general_purpose::STANDARD_NO_PAD, super::glb::triangle())
        )),
    )]));
    let bytes = [b"\xef\xbb\xbf", text.unwrap().as_bytes()].concat();
    assert_eq!(mesh(&read_bytes(&bytes).unwrap()).triangles, [[0, 1, 2]]);
}

#[test]
fn what_does_not_exist() {
    assert_eq!(error(&with(&[("/scene", json!(9))])), "error: there is no scene 9");
    let file = model(&with(&[("/meshes/0/primitives/0/material", json!(7))]));
    assert!(said(&file).contains("there is no such material\n  --> ") && said(&file).contains(", material 7\n"));
    let painted = json!({ "name": "paint", "pbrMetallicRoughness": { "baseColorTexture": { "index": 5 } } });
    let file = model(&with(&[("/materials/0", painted)]));
    assert!(said(&file).contains("there is no such texture\n  --> ") && said(&file).contains(", texture 5\n"));
    let file = model(&with(&[
        ("/nodes/0/camera", json!(0)),
        ("/cameras", json!([{ "type": "perspective", "perspective": { "znear": 1 } }])),
    ]));
    assert!(said(&file).contains("the camera is left out: it has no angle"), "{}", said(&file));
    let target = json!([{ "POSITION": 1, "TEXCOORD_0": 2 }]);
    let file = model(&with(&[("/meshes/0/primitives/0/targets", target), ("/meshes/0/weights", json!([0.5]))]));
    assert!(said(&file).contains("of what morph targets change, places, normals and tangents are read"));
}

/// Joints that mirror do so to triangles.
#[test]
fn skins_can_be_mirrored() {
    let skinned = |scale: [f32; 3]| {
        let attributes = json!({ "POSITION": 1, "TEXCOORD_0": 2, "JOINTS_0": 3, "WEIGHTS_0": 4 });
        model(&with(&[
            ("/meshes/0/primitives/0/attributes", attributes),
            ("/nodes", json!([{ "mesh": 0, "skin": 0 }, { "scale": scale, "children": [2] }, {}])),
            ("/scenes/0/nodes", json!([0, 1])),
            ("/skins", json!([{ "joints": [1, 2, 2, 2] }])),
        ]))
    };
    assert_eq!(mesh(&skinned([1.0; 3])).triangles, [[0, 1, 2]]);
    assert_eq!(mesh(&skinned([-1.0, 1.0, 1.0])).triangles, [[0, 2, 1]]);
    assert_eq!(mesh(&skinned([-1.0, -1.0, 1.0])).triangles, [[0, 1, 2]]);
}

/// A joint moves the skin from outside of the scene, too.
#[test]
fn joints_may_be_elsewhere() {
    let attributes = json!({ "POSITION": 1, "JOINTS_0": 3, "WEIGHTS_0": 4 });
    let file = model(&with(&[
        ("/meshes/0/primitives/0/attributes", attributes),
        ("/nodes", json!([{ "mesh": 0, "skin": 0 }, { "translation": [0, 0, 5] }])),
        ("/scenes/0/nodes", json!([0])),
        ("/skins", json!([{ "joints": [1, 1, 1, 1] }])),
    ]));
    assert_eq!(mesh(&file).vertices, [[0.0, 0.0, 5.0], [1.0, 0.0, 5.0], [0.0, 2.0, 5.0]]);
}

/// `specular` is for what is not metal.
#[test]
fn metal_does_not_heed_specular() {
    let dull = |pbr: Value| {
        let specular = json!({ "KHR_materials_specular": { "specularFactor": 0, "specularColorFactor": [1, 0.5, 0] } });
        let paint = json!({ "name": "paint", "pbrMetallicRoughness": pbr, "extensions": specular });
        model(&with_picture(&[("/materials/0", paint)]))
    };
    let file = dull(json!({ "metallicFactor": 0.5 }));
    let mix = parts(&file, "paint");
    assert_eq!(mix.share.number(), Some(0.5));
    let [other, metal] = [layers(&file, mix.a.name()), layers(&file, mix.b.name())];
    assert_eq!((other.base_metalness.number(), other.specular_weight.number()), (Some(0.0), Some(0.0)));
    assert_eq!((metal.base_metalness.number(), metal.specular_weight.number()), (Some(1.0), Some(1.0)));
    assert_eq!([&other.specular_color, &metal.specular_color].map(|c| c.rgb().unwrap().0), [[1.0, 0.5, 0.0], [1.0; 3]]);
    let file = dull(json!({ "metallicRoughnessTexture": { "index": 0 } }));
    assert!(matches!(parts(&file, "paint").share, Scalar::Texture(_)));
    assert_eq!(layers(&dull(json!({ "metallicFactor": 0 })), "paint").specular_weight.number(), Some(0.0));
}

/// The base colour over the thickness, and the colour of the volume over its distance.
#[test]
fn base_colors_tint_volumes() {
    let glass = |base: Value| {
        let extensions = json!({
            "KHR_materials_transmission": { "transmissionFactor": 1 },
            "KHR_materials_volume": {
                "thicknessFactor": 0.5, "attenuationDistance": 1, "attenuationColor": [0.5, 1, 1]
            },
        });
        model(&with_picture(&[(
            "/materials/0",
            json!({ "name": "paint", "pbrMetallicRoughness": base, "extensions": extensions }),
        )]))
    };
    let file = glass(json!({ "baseColorFactor": [1, 0.5, 1, 1] }));
    assert_eq!(
        (principled(&file).transmission_color.rgb(), principled(&file).transmission_depth),
        (Some(Rgb([0.5, 0.25, 1.0])), 1.0)
    );
    assert!(said(&file).contains("its base colour is taken for that of what is inside"));
    assert_eq!(said(&glass(json!({}))), "");
    let file = glass(json!({ "baseColorTexture": { "index": 0 } }));
    assert!(said(&file).contains("the texture of its base colour does not tint what goes through it"));
}

/// An open mesh that has two sides shines on both.
#[test]
fn both_sides_shine() {
    for both in [false, true] {
        let lamp = json!({ "name": "paint", "emissiveFactor": [1, 1, 1], "doubleSided": both });
        let file = model(&with(&[("/materials/0", lamp)]));
        assert_eq!(layers(&file, "paint").emission_two_sided, both);
    }
}

/// Materials that are called like parts of others keep their own.
#[test]
fn names_of_parts_are_free() {
    let red = json!({ "baseColorFactor": [1, 0, 0, 1] });
    let primitive = |material: u32| json!({ "attributes": { "POSITION": 1, "TEXCOORD_0": 2 }, "material": material });
    let bumpy = json!({ "index": 0 });
    let file = model(&with_picture(&[
        (
            "/materials",
            json!([
                { "name": "door.front", "pbrMetallicRoughness": red, "doubleSided": true },
                { "name": "door.surface", "pbrMetallicRoughness": red, "doubleSided": true },
                { "name": "door", "normalTexture": bumpy },
            ]),
        ),
        ("/meshes/0/primitives", json!([primitive(0), primitive(1), primitive(2)])),
    ]));
    let names: Vec<_> = file.desc.shape.mesh.iter().map(|mesh| mesh.material.clone().unwrap()).collect();
    assert_eq!(names, ["door.front", "door.surface", "door.front'"]);
    for name in &names[..2] {
        assert_eq!(layers(&file, name).base_color.rgb(), Some(Rgb([1.0, 0.0, 0.0])));
    }
    let MaterialDesc::Mask(front) = &file.desc.material["door.front'"] else { panic!() };
    let MaterialDesc::NormalMap(map) = &file.desc.material[front.of.name()] else { panic!() };
    assert_eq!(layers(&file, map.of.name()).base_color.rgb(), Some(Rgb([1.0; 3])));
}
