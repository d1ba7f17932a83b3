//! `eyebeam info`.

use serde_json::{Value, json};

use crate::Place;
use crate::made::write_gltf;

#[test]
fn a_model_is_told_for_people_and_for_programs() {
    let place = Place::new();
    write_gltf(&place);
    let run = place.run("info model.gltf").ends_with(0);
    assert_eq!(run.stderr, "");
    insta::assert_snapshot!("info_model", run.text());
    let run = place.run("info model.gltf --json").ends_with(0);
    let info: Value = serde_json::from_slice(&run.stdout).unwrap();
    assert_eq!(info["schema"], "eyebeam-info-1");
    let numbers = ["meshes", "triangles", "vertices", "spheres", "quads"].map(|key| info[key].as_u64().unwrap());
    assert_eq!(numbers, [1, 2, 4, 0, 0]);
    assert_eq!(info["bounds"], json!({ "min": [-0.5, 0.0, 0.0], "max": [0.5, 1.0, 0.0], "size": [1.0, 1.0, 0.0] }));
    assert_eq!(info["cameras"][0]["name"], "front door");
    assert_eq!((&info["scenes"], &info["scene"]), (&json!(["whole", "bare"]), &json!(0)));
    assert_eq!(info["animations"], json!([{ "name": "lift", "seconds": 1.5 }]));
    assert_eq!(info["textures"][0]["picture"]["width"], 5);
    assert_eq!(info["warnings"].as_array().unwrap().len(), 2);
    place.run("info missing.glb").ends_with(4);
}

#[test]
fn a_scene_file_is_told_too() {
    let place = Place::new();
    let text = place.run("info scene.toml -D environment.sky={}").ends_with(0);
    insta::assert_snapshot!("info_scene", text.text());
}
