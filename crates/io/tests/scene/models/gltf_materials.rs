//! glTF: what its materials, lights and cameras become, of files made here.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use eyebeam_core::color::LUMENS_PER_WATT;
use eyebeam_core::light::EnvironmentDesc;
use eyebeam_core::material::{MaterialDesc, Principled};
use eyebeam_core::setup::Given;
use eyebeam_core::texture::{Color, Interpolation, Mapping, Scalar, Space, TextureDesc};
use eyebeam_io::scene::{ReadOptions, SceneFile};
use eyebeam_io::{At, Warning};
use serde_json::{Value, json};

use super::gltf::{error, flip, glb, mesh, model, picture, principled, read_as, with, with_picture};

const ATTRIBUTES: &str = "/meshes/0/primitives/0/attributes";

/// Adds numbers, `size` in each element; the index of their accessor.
fn add(document: &mut Value, size: usize, numbers: &[f32]) -> usize {
    let bytes: Vec<u8> = numbers.iter().flat_map(|n| n.to_le_bytes()).collect();
    let mut push = |list: &str, value: Value| {
        let list = document[list].as_array_mut().unwrap();
        list.push(value);
        list.len() - 1
    };
    let uri = format!("data:application/octet-stream;base64,{}", STANDARD.encode(&bytes));
    let buffer = push("buffers", json!({ "byteLength": bytes.len(), "uri": uri }));
    let view = push("bufferViews", json!({ "buffer": buffer, "byteLength": bytes.len() }));
    let kind = ["SCALAR", "VEC2", "VEC3", "VEC4"][size - 1];
    let count = numbers.len() / size;
    push("accessors", json!({ "bufferView": view, "componentType": 5126, "count": count, "type": kind }))
}

/// Gives the triangle more numbers at its vertices.
fn attribute(document: &mut Value, name: &str, size: usize, numbers: &[f32]) {
    let index = add(document, size, numbers);
    document.pointer_mut(ATTRIBUTES).unwrap()[name] = json!(index);
}

/// The material of the triangle with an extension.
fn painted(extension: &str, value: Value) -> (&'static str, Value) {
    ("/materials/0", json!({ "name": "paint", "extensions": { extension: value } }))
}

fn texture(file: &SceneFile, name: &str) -> TextureDesc {
    file.desc.texture[name].clone()
}

const UP: [f32; 9] = [0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0];

#[test]
fn tangents_are_read_or_made_where_they_are_needed() {
    let bumpy = || {
        let mut document =
            with_picture(&[("/materials/0", json!({ "name": "paint", "normalTexture": { "index": 0 } }))]);
        attribute(&mut document, "NORMAL", 3, &UP);
        document
    };
    assert_eq!(mesh(&model(&bumpy())).tangents, [[1.0, 0.0, 0.0, 1.0]; 3]);
    let mut said = bumpy();
    attribute(&mut said, "TANGENT", 4, &[0.6, 0.8, 0.0, -1.0].repeat(3));
    assert_eq!(mesh(&model(&said)).tangents, [[0.6, 0.8, 0.0, -1.0]; 3]);
    // A mirror changes sides.
    said["nodes"][0]["scale"] = json!([-1, 1, 1]);
    assert_eq!(mesh(&model(&said)).tangents, [[-0.6, 0.8, 0.0, 1.0]; 3]);
    said["materials"][0] = json!({ "name": "paint" });
    assert_eq!(mesh(&model(&said)).tangents, [[0.0; 4]; 0], "nothing asks for them");
    let mut flat = bumpy();
    flat.pointer_mut(ATTRIBUTES).unwrap().as_object_mut().unwrap().remove("NORMAL");
    assert_eq!(mesh(&model(&flat)).tangents, [[0.0; 4]; 0]);
    // Of a texture that lies by other coordinates and is turned.
    let mut turned = bumpy();
    attribute(&mut turned, "TEXCOORD_1", 2, &[0.0, 0.0, 0.0, 1.0, 1.0, 0.0]);
    turned["materials"][0]["normalTexture"]["texCoord"] = json!(1);
    assert_eq!(mesh(&model(&turned)).tangents, [[0.0, 1.0, 0.0, 1.0]; 3]);
    flip(&glb(&bumpy()), 1000);
}

#[test]
fn transforms_of_textures_are_kept() {
    let transform =
        json!({ "offset": [0.5, 0.25], "rotation": std::f32::consts::FRAC_PI_2, "scale": [2, 3], "texCoord": 1 });
    let info = json!({ "index": 0, "extensions": { "KHR_texture_transform": transform } });
    let file = model(&with_picture(&[("/materials/0/pbrMetallicRoughness", json!({ "baseColorTexture": info }))]));
    let Mapping { space, rotation, scale, rotation_after, offset } = picture(&file, "paint.base-color.picture").mapping;
    assert_eq!((space, rotation, scale, rotation_after), (Some(Space::Uv1), 0.0, [2.0, 3.0, 1.0], 90.0));
    assert!((offset[0] - 3.5).abs() < 1e-5 && (offset[1] - 0.75).abs() < 1e-5, "{offset:?}");
    assert_eq!(file.warnings, []);
}

#[test]
fn anisotropy_is_a_stretched_and_turned_highlight() {
    let long = |roughness: f32, more: Value| {
        let mut extension = json!({ "anisotropyStrength": 0.5, "anisotropyRotation": std::f32::consts::FRAC_PI_4 });
        extension.as_object_mut().unwrap().extend(more.as_object().unwrap().clone());
        let paint = json!({ "name": "paint", "pbrMetallicRoughness": { "roughnessFactor": roughness },
            "extensions": { "KHR_materials_anisotropy": extension } });
        model(&with_picture(&[("/materials/0", paint)]))
    };
    // α is 0.25 across and 0.4375 along.
    let file = long(0.5, json!({}));
    let p = principled(&file);
    let narrow = 0.25 / 0.4375_f32;
    let roughness = (0.4375 * (0.5 * (1.0 + narrow * narrow)).sqrt()).sqrt();
    assert!((p.specular_roughness_anisotropy.number().unwrap() - (1.0 - narrow)).abs() < 1e-6);
    assert!((p.specular_roughness.number().unwrap() - roughness).abs() < 1e-6);
    assert!((p.specular_rotation - 45.0).abs() < 1e-5 && p.geometry_tangent.is_none());
    assert_eq!(file.warnings, []);
    // Red and green are the direction, blue the strength.
    let file = long(0.5, json!({ "anisotropyTexture": { "index": 0 } }));
    let p = principled(&file);
    assert!(
        matches!(&p.geometry_tangent, Some(Color::Texture(name)) if name.name() == "paint.anisotropy-direction.picture")
    );
    let Scalar::Texture(name) = &p.specular_roughness_anisotropy else { panic!() };
    let TextureDesc::Ramp(ramp) = texture(&file, name.name()) else { panic!() };
    assert_eq!((ramp.stops.len(), ramp.interpolation, ramp.stops[0].color.0), (33, Interpolation::Linear, [0.0; 3]));
    assert!((ramp.stops[16].color.0[0] - (1.0 - narrow)).abs() < 1e-6, "half of the texture's strength is 0.5");
    assert_eq!(file.warnings, []);
    let packed = json!({ "name": "paint", "pbrMetallicRoughness": { "metallicRoughnessTexture": { "index": 0 } },
        "extensions": { "KHR_materials_anisotropy": { "anisotropyStrength": 1, "anisotropyTexture": { "index": 0 } } } });
    let file = model(&with_picture(&[("/materials/0", packed)]));
    assert!(
        file.warnings[0].message.contains("highlights are as long as at a roughness of 0.4"),
        "{:?}",
        file.warnings
    );
}

/// 20 over Abbe's number, of what has an inside.
#[test]
fn volumes_disperse() {
    let glass = |dispersion: f32, thickness: f32| {
        let extensions = json!({
            "KHR_materials_transmission": { "transmissionFactor": 1 },
            "KHR_materials_volume": { "thicknessFactor": thickness },
            "KHR_materials_dispersion": { "dispersion": dispersion },
        });
        let file = model(&with(&[
            ("/extensionsUsed", json!(extensions.as_object().unwrap().keys().collect::<Vec<_>>())),
            ("/materials/0", json!({ "name": "paint", "extensions": extensions })),
        ]));
        assert_eq!(file.warnings, []);
        let p = principled(&file);
        p.transmission_dispersion_scale / p.transmission_dispersion_abbe_number
    };
    for (dispersion, thickness, expected) in
        [(0.1, 1.0, 0.005), (1.0, 1.0, 0.05), (4.0, 1.0, 0.2), (0.5, 0.0, 0.0), (1e9, 1.0, 1.0), (-1.0, 1.0, 0.0)]
    {
        assert!((glass(dispersion, thickness) - expected).abs() < 1e-6, "{dispersion} in {thickness}");
    }
}

/// Of a material, an extension that makes no sense is told of; elsewhere it is an error.
#[test]
fn extensions_that_make_no_sense() {
    for name in ["KHR_materials_clearcoat", "KHR_materials_anisotropy", "KHR_materials_unlit"] {
        let file = model(&with(&[painted(name, json!({ "clearcoatFactor": "much", "anisotropyStrength": [] }))]));
        let said = file.warnings.iter().map(ToString::to_string).collect::<String>();
        let is_read = name == "KHR_materials_unlit";
        assert_eq!(said.contains(&format!("{name} is ignored: invalid type")), !is_read, "{said}");
        assert_eq!(said.contains("a.glb, material `paint`"), !is_read, "{said}");
    }
    let wrong = json!({ "attributes": 1, "light": "sun" });
    for name in ["EXT_mesh_gpu_instancing", "KHR_lights_punctual"] {
        let message = error(&with(&[("/nodes/0/extensions", json!({ name: wrong }))]));
        assert!(message.starts_with(&format!("error: {name}: invalid type")), "{message}");
    }
}

#[test]
fn a_clear_coat_is_smooth_or_has_normals_of_its_own() {
    let coat = |more: Value, normal: Option<Value>| {
        let mut extension = json!({ "clearcoatFactor": 1 });
        extension.as_object_mut().unwrap().extend(more.as_object().unwrap().clone());
        let paint =
            json!({ "name": "paint", "normalTexture": normal, "extensions": { "KHR_materials_clearcoat": extension } });
        let file = model(&with_picture(&[("/materials/0", paint)]));
        let name = if normal.is_some() { "paint.surface" } else { "paint" };
        let MaterialDesc::Principled(p) = &file.desc.material[name] else { panic!() };
        assert_eq!(file.warnings, []);
        (p.geometry_coat_normal.clone(), p.geometry_coat_normal_strength)
    };
    let base = || Some(json!({ "index": 0 }));
    assert_eq!(coat(json!({}), None), (None, 1.0));
    let (smooth, _) = coat(json!({}), base());
    assert_eq!(smooth.and_then(|color| color.rgb()).unwrap().0, [0.5, 0.5, 1.0]);
    for base in [None, base()] {
        let (map, strength) = coat(json!({ "clearcoatNormalTexture": { "index": 0, "scale": 0.5 } }), base);
        assert!(matches!(map, Some(Color::Texture(name)) if name.name() == "paint.coat-normal.picture"));
        assert_eq!(strength, 0.5);
    }
}

#[test]
fn a_variant_is_chosen() {
    let mappings = json!([{ "material": 1, "variants": [0, 2] }, { "material": 2, "variants": [1] }]);
    let document = with(&[
        ("/materials", json!([{ "name": "paint" }, { "name": "red" }, { "name": "blue" }])),
        (
            "/extensions",
            json!({ "KHR_materials_variants": { "variants": [{ "name": "a" }, { "name": "b" }, {}, { "name": "0" }] } }),
        ),
        ("/meshes/0/primitives/0/extensions", json!({ "KHR_materials_variants": { "mappings": mappings } })),
        ("/extensionsUsed", json!(["KHR_materials_variants"])),
    ]);
    let chosen = |variant: Option<&str>| {
        let file = read_as(&glb(&document), &ReadOptions { variant, ..ReadOptions::default() });
        file.map(|file| file.desc.shape.mesh[0].material.clone().unwrap()).map_err(|e| e.to_string())
    };
    // The name that is a number is stronger than the number.
    for (variant, material) in [
        (None, "paint.front"),
        (Some("a"), "red.front"),
        (Some("b"), "blue.front"),
        (Some("2"), "red.front"),
        (Some("0"), "paint.front"),
    ] {
        assert_eq!(chosen(variant).as_deref(), Ok(material), "{variant:?}");
    }
    let error = chosen(Some("c")).unwrap_err();
    assert!(error.contains("there is no variant `c`") && error.contains("it has 0 `a`, 1 `b`, 2, 3 `0`"), "{error}");
}

#[test]
fn alphas_of_vertices_count_where_parts_can_be_missing() {
    let painted = |mode: &str| {
        let mut document = with(&[("/materials/0", json!({ "name": "paint", "alphaMode": mode }))]);
        attribute(&mut document, "COLOR_0", 4, &[1.0, 0.5, 0.25, 1.0, 1.0, 0.5, 0.25, 0.5, 1.0, 0.5, 0.25, 2.0]);
        model(&document)
    };
    let blended = painted("BLEND");
    assert_eq!(mesh(&blended).alphas, [1.0, 0.5, 1.0]);
    assert_eq!(mesh(&blended).colors, [[1.0, 0.5, 0.25]; 3]);
    let MaterialDesc::Mask(mask) = &blended.desc.material["paint"] else { panic!() };
    let Scalar::Texture(name) = &mask.opacity else { panic!() };
    assert!(matches!(texture(&blended, name.name()), TextureDesc::VertexColor(texture) if texture.alpha));
    assert_eq!(mesh(&painted("OPAQUE")).alphas, [0.0; 0]);
    assert!(matches!(painted("MASK").desc.material["paint"], MaterialDesc::Mask(_)));
}

#[test]
fn occlusion_is_told_of() {
    let paint = |name: &str| json!({ "name": name, "occlusionTexture": { "index": 0 } });
    let second = json!({ "attributes": { "POSITION": 1 }, "material": 1 });
    let file = model(&with(&[("/materials", json!([paint("paint"), paint("b")])), ("/meshes/0/primitives/1", second)]));
    let said = |w: &Warning| (w.message.clone(), w.place.as_ref().unwrap().at.clone());
    let expected = ["paint", "b"]
        .map(|name| ("occlusion is computed, not read".to_owned(), At::Part(format!("material `{name}`"))));
    assert_eq!(file.warnings.iter().map(said).collect::<Vec<_>>(), expected);
}

/// Of before metals: the reflectance straight on is that of an index, the gloss the opposite of the roughness.
#[test]
fn specular_and_glossiness() {
    let old =
        json!({ "diffuseFactor": [0.5, 0.25, 1, 1], "specularFactor": [0.04, 0.02, 0.01], "glossinessFactor": 0.75 });
    let file = model(&with(&[painted("KHR_materials_pbrSpecularGlossiness", old)]));
    let Principled { base_color, base_metalness, specular_ior, specular_color, specular_roughness, .. } =
        principled(&file);
    assert_eq!((base_color.rgb().unwrap().0, base_metalness.number()), ([0.5, 0.25, 1.0], Some(0.0)));
    assert!((specular_ior - 1.5).abs() < 1e-5 && specular_roughness.number() == Some(0.25));
    assert_eq!(specular_color.rgb().unwrap().0, [1.0, 0.5, 0.25]);
}

/// More than a quarter straight on is partly metal: 0.04 times 13 is 0.52.
#[test]
fn bright_reflections_are_partly_metal() {
    let bright = |factor: f32, more: Value| {
        let mut extensions = json!({ "KHR_materials_specular": { "specularColorFactor": [factor, 0.5 * factor, 0] } });
        extensions.as_object_mut().unwrap().extend(more.as_object().unwrap().clone());
        let pbr = json!({ "metallicFactor": 0 });
        let paint = json!({ "name": "paint", "pbrMetallicRoughness": pbr, "extensions": extensions });
        model(&with(&[("/materials/0", paint)]))
    };
    let file = bright(4.0, json!({}));
    let p = principled(&file);
    assert!((p.specular_ior - 1.4 / 0.6).abs() < 1e-5, "0.16 straight on: {}", p.specular_ior);
    assert_eq!(p.specular_color.rgb().unwrap().0, [1.0, 0.5, 0.0]);
    let file = bright(13.0, json!({}));
    let MaterialDesc::Mix(mix) = &file.desc.material["paint"] else { panic!() };
    assert!((mix.share.number().unwrap() - 0.27 / 0.75).abs() < 1e-5);
    let part = |name: &str| match &file.desc.material[name] {
        MaterialDesc::Principled(p) => {
            (p.specular_ior, p.base_metalness.number().unwrap(), p.base_color.rgb().unwrap().0)
        }
        other => panic!("{other:?}"),
    };
    assert_eq!(part(mix.a.name()), (3.0, 0.0, [1.0; 3]));
    assert_eq!(part(mix.b.name()), (3.0, 1.0, [1.0, 0.5, 0.0]));
    assert_eq!(file.warnings, []);
    let glass = bright(4.0, json!({ "KHR_materials_transmission": { "transmissionFactor": 1 } }));
    assert!(glass.warnings[0].message.contains("what is clear reflects no more"), "{:?}", glass.warnings);
    // Of metal it says nothing.
    let metal = json!({ "name": "paint", "extensions": { "KHR_materials_specular": { "specularFactor": 0 } } });
    assert_eq!(principled(&model(&with(&[("/materials/0", metal)]))).specular_weight.number(), Some(1.0));
    // A picture of reflectances is metal where it is bright.
    let old = json!({ "specularGlossinessTexture": { "index": 0 } });
    let file = model(&with_picture(&[painted("KHR_materials_pbrSpecularGlossiness", old)]));
    let MaterialDesc::Mix(mix) = &file.desc.material["paint"] else { panic!() };
    let Scalar::Texture(name) = &mix.share else { panic!() };
    let TextureDesc::Ramp(ramp) = texture(&file, name.name()) else { panic!() };
    assert_eq!(
        (ramp.stops[1].at, ramp.stops[1].color.0, ramp.interpolation),
        (0.25, [1.0; 3], Interpolation::Constant)
    );
}

#[test]
fn unlit_shines_as_it_is_coloured() {
    let paint = json!({ "name": "paint", "pbrMetallicRoughness": { "baseColorFactor": [0.5, 0.25, 1, 1] },
        "extensions": { "KHR_materials_unlit": {} } });
    let file = model(&with(&[("/materials/0", paint)]));
    let MaterialDesc::Emissive(lamp) = &file.desc.material["paint"] else { panic!() };
    assert_eq!((lamp.radiance.rgb().unwrap().0, lamp.albedo.rgb().unwrap().0), ([0.5, 0.25, 1.0], [0.0; 3]));
    assert!(lamp.two_sided);
}

/// The picture of an orthographic camera is twice `ymag` high.
#[test]
fn orthographic_cameras() {
    let file = model(&with(&[
        ("/nodes/1", json!({ "camera": 0, "translation": [0, 1, 5] })),
        ("/scenes/0/nodes", json!([0, 1])),
        (
            "/cameras",
            json!([{ "type": "orthographic", "orthographic": { "xmag": 3, "ymag": 2, "zfar": 9, "znear": 1 } }]),
        ),
    ]));
    assert_eq!((file.desc.camera.look_from, file.desc.camera.look_at), ([0.0, 1.0, 5.0], [0.0, 1.0, 0.0]));
    assert_eq!(file.desc.camera.orthographic.as_ref().unwrap().height, 4.0);
}

#[test]
fn spots_and_suns() {
    let lights = json!([
        { "type": "spot", "intensity": LUMENS_PER_WATT, "spot": { "innerConeAngle": 0.25, "outerConeAngle": 0.5 } },
        { "type": "directional", "intensity": 2.0 * LUMENS_PER_WATT, "color": [1, 0.5, 0] },
        { "type": "spot" },
    ]);
    // A quarter turn about x: what looked along −z looks down.
    let node = |light: u32| {
        let half = std::f64::consts::FRAC_1_SQRT_2;
        json!({ "translation": [1, 2, 3], "rotation": [-half, 0, 0, half], "extensions": { "KHR_lights_punctual": { "light": light } } })
    };
    let file = model(&with(&[
        ("/nodes/1", node(0)),
        ("/nodes/2", node(1)),
        ("/nodes/3", node(2)),
        ("/scenes/0/nodes", json!([0, 1, 2, 3])),
        ("/extensions", json!({ "KHR_lights_punctual": { "lights": lights } })),
    ]));
    let near = |a: [f32; 3], b: [f32; 3]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-5);
    let [spot, plain] = &file.desc.light.spot[..] else { panic!() };
    assert!(near(spot.position, [1.0, 2.0, 3.0]) && near(spot.look_at, [1.0, 1.0, 3.0]));
    assert!(near(
        [spot.inner.unwrap(), spot.outer, spot.intensity.0[0]],
        [0.25_f32.to_degrees(), 0.5_f32.to_degrees(), 1.0]
    ));
    assert!(near([plain.inner.unwrap(), plain.outer, LUMENS_PER_WATT * plain.intensity.0[0]], [0.0, 45.0, 1.0]));
    let sun = &file.desc.light.directional[0];
    assert!(near(sun.direction, [0.0, 1.0, 0.0]) && near(sun.irradiance.0, [2.0, 1.0, 0.0]) && sun.angle == 0.0);
}

/// Keys at 1 and 3 seconds: Hermite's cubic of values 0 and 4 and of the slopes 1 behind the first and −2 before the second.
#[test]
fn cubic_splines() {
    let mut document = with(&[]);
    let times = add(&mut document, 1, &[1.0, 3.0]);
    let keys = [[9.0, 0.0, 1.0], [-2.0, 4.0, 9.0]];
    let values: Vec<f32> = keys.iter().flatten().flat_map(|&x| [x, 2.0 * x, 0.0]).collect();
    let values = add(&mut document, 3, &values);
    document["animations"] = json!([{ "samplers": [{ "input": times, "output": values, "interpolation": "CUBICSPLINE" }],
        "channels": [{ "sampler": 0, "target": { "node": 0, "path": "translation" } }] }]);
    let place = |at: f32| {
        let options = ReadOptions { animation: Some("0"), at, ..ReadOptions::default() };
        mesh(&read_as(&glb(&document), &options).unwrap()).vertices[0]
    };
    for (at, expected) in [(0.0, 0.0), (1.0, 0.0), (3.0, 4.0), (9.0, 4.0)] {
        assert_eq!(place(at), [expected, 2.0 * expected, 0.0], "{at}");
    }
    for t in [0.25_f32, 0.5, 0.8] {
        let (t2, t3) = (t * t, t * t * t);
        let expected = 2.0 * (t3 - 2.0 * t2 + t) + 4.0 * (3.0 * t2 - 2.0 * t3) - 2.0 * 2.0 * (t3 - t2);
        let [x, y, z] = place(1.0 + 2.0 * t);
        assert!((x - expected).abs() < 1e-5 && (y - 2.0 * expected).abs() < 1e-5 && z == 0.0, "{x}, not {expected}");
    }
}

#[test]
fn surroundings_light_the_scene() {
    let light = json!({ "intensity": 2, "rotation": [0, 0, 0, 1], "specularImageSize": 1, "specularImages": [[0, 0, 0, 0, 0, 0]] });
    let lit = |light: Value| {
        with_picture(&[
            ("/extensions", json!({ "EXT_lights_image_based": { "lights": [light] } })),
            ("/scenes/0/extensions", json!({ "EXT_lights_image_based": { "light": 0 } })),
            ("/extensionsUsed", json!(["EXT_lights_image_based"])),
        ])
    };
    let file = model(&lit(light));
    assert_eq!((file.given, &file.warnings), (Given { camera: false, light: true }, &vec![]));
    let EnvironmentDesc::Image(image) = &file.desc.environment else { panic!() };
    let panorama = image.image.as_ref().unwrap();
    assert_eq!((image.scale, panorama.width(), panorama.height()), (2.0, 4, 2));
    assert!(panorama.pixels().iter().all(|pixel| *pixel == [1.0, 0.0, 0.0]));
    let none = super::gltf::error(&lit(json!({ "specularImages": [[0, 0, 0]] })));
    assert!(none.contains("the image-based light 0 has no six pictures"), "{none}");
    let missing = super::gltf::error(&lit(json!({ "specularImages": [[0, 0, 0, 0, 0, 7]] })));
    assert!(missing.contains("picture 7 of the surroundings: there is no picture 7"), "{missing}");
}
