//! Models: what other programs write.

#[path = "../../shared/corpus.rs"]
mod corpus;
mod draco;
#[path = "../../shared/glb.rs"]
mod glb;
mod gltf;
mod gltf_corners;
mod gltf_materials;
mod mtl;
mod obj;
mod ply;
mod stl;

use std::fs;
use std::path::Path;

use eyebeam_core::material::MaterialDesc;
use eyebeam_core::setup::Given;
use eyebeam_io::scene::{ReadOptions, SceneFile, Up, read, read_with};
use tempfile::TempDir;

use crate::setting;

/// A triangle whose corners are red, upright in +Z.
const TRIANGLE: &str = "ply
format ascii 1.0
element vertex 3
property float x
property float y
property float z
property uchar red
property uchar green
property uchar blue
element face 1
property list uchar int vertex_indices
end_header
0 0 0 255 0 0
1 0 0 255 0 0
0 0 2 255 0 0
3 0 1 2
";

fn model(name: &str, text: &str, up: Option<Up>) -> SceneFile {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join(name);
    fs::write(&path, text).unwrap();
    read_with(&path, &ReadOptions { up, ..ReadOptions::default() }).unwrap()
}

#[test]
fn a_mesh_is_a_model_without_camera_and_light() {
    let SceneFile { desc, warnings, given, .. } = model("t.PLY", TRIANGLE, None);
    assert_eq!((given, warnings), (Given::default(), vec![]));
    assert_eq!(desc.shape.mesh[0].data.as_ref().unwrap().vertices[2], [0.0, 0.0, 2.0]);
    let material = &desc.material[desc.shape.mesh[0].material.as_ref().unwrap()];
    assert!(matches!(material, MaterialDesc::Lambertian(matte) if matte.albedo.rgb().is_none()));
}

/// A metre of a map: single precision has steps of a quarter of one there.
#[test]
fn what_is_far_from_the_origin_is_told_of() {
    let at = |x: f64| format!("v {x} 0 0\nv {} 0 0\nv {x} 1 0\nf 1 2 3\n", x + 1.0);
    let said = |x| model("t.obj", &at(x), None).warnings.iter().map(ToString::to_string).collect::<String>();
    assert_eq!((said(0.0), said(500.0)), (String::new(), String::new()));
    let far = said(4_000_000.0);
    assert!(far.contains("places are rounded to 1/2 of its size\n  --> "), "{far}");
}

#[test]
fn what_is_up_is_turned_upwards() {
    let desc = model("t.ply", TRIANGLE, Some(Up::Z)).desc;
    assert_eq!(desc.shape.mesh[0].data.as_ref().unwrap().vertices[2], [0.0, 2.0, 0.0]);
}

#[test]
fn of_models_only_the_picture_can_be_changed() {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("t.ply");
    fs::write(&path, TRIANGLE).unwrap();
    assert_eq!(read(&path, &[setting("render.spp=7")]).unwrap().desc.render.spp, 7);
    let error = read(&path, &[setting("camera.vfov=7")]).unwrap_err().to_string();
    assert!(error.contains("`-D camera.vfov` changes a scene file, and this is a model"), "{error}");
}

/// What a format has not cannot be chosen.
#[test]
fn other_formats_have_nothing_to_choose() {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("t.ply");
    fs::write(&path, TRIANGLE).unwrap();
    let nothing = ReadOptions::default();
    for (kind, options) in [
        ("animation", ReadOptions { animation: Some("it"), ..nothing }),
        ("variant", ReadOptions { variant: Some("it"), ..nothing }),
        ("camera", ReadOptions { camera: Some("it"), ..nothing }),
        ("scene", ReadOptions { scene: Some("it"), ..nothing }),
    ] {
        let error = read_with(&path, &options).unwrap_err().to_string();
        assert!(error.contains(&format!("there is no {kind} `it`")) && error.contains("it has none"), "{error}");
    }
}

#[test]
fn a_model_that_is_missing_is_said() {
    assert!(read(Path::new("nowhere.ply"), &[]).unwrap_err().to_string().contains("cannot read `nowhere.ply`"));
}
