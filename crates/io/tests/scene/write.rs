//! Scenes that are written read back the same.

use std::fs;
use std::path::Path;

use eyebeam_core::desc::SceneDesc;
use eyebeam_core::light::EnvironmentDesc;
use eyebeam_core::texture::TextureDesc;
use eyebeam_io::Error;
use eyebeam_io::scene::{WriteOptions, read, read_str, write};
use tempfile::TempDir;

/// The same without names of files.
fn nameless(mut desc: SceneDesc) -> SceneDesc {
    desc.include.clear();
    desc.shape.mesh.iter_mut().filter(|mesh| mesh.data.is_some()).for_each(|mesh| mesh.file = None);
    for texture in desc.texture.values_mut() {
        if let TextureDesc::Image(image) = texture {
            image.file.clear();
        }
    }
    if let EnvironmentDesc::Image(map) = &mut desc.environment {
        map.file.clear();
    }
    desc.light.projector.iter_mut().for_each(|light| light.file.clear());
    desc.light.ies.iter_mut().for_each(|light| light.file.clear());
    desc
}

/// What a scene is after it was written and read, and the text.
fn again(desc: &SceneDesc) -> (SceneDesc, String) {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("again.toml");
    write(desc, &path, &WriteOptions { comment: "A test", ..WriteOptions::default() }).unwrap();
    let text = fs::read_to_string(&path).unwrap();
    let read = read(&path, &[]).unwrap_or_else(|e| panic!("{e}\n{text}"));
    (read.desc, text)
}

#[test]
fn every_scene_of_the_repository_is_the_same() {
    let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    let mut count = 0;
    for entry in fs::read_dir(scenes).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_none_or(|ending| ending != "toml") {
            continue;
        }
        let desc = read(&path, &[]).unwrap().desc;
        let (again, text) = again(&desc);
        assert!(nameless(again) == nameless(desc), "{} is not what is written:\n{text}", path.display());
        count += 1;
    }
    assert!(count > 10, "{count}");
}

#[test]
fn what_is_written_is_short() {
    let text = r##"
[render]
spp = 7
[camera]
look_from = [0, 1.5, 0.1]
[environment.none]
[texture."tiles \"blue\"\\ ä".checker]
odd = "#0000ff"
mapping = { scale = [2, 2, 1] }
[material."a . b".lambertian]
albedo = 'tiles "blue"\ ä'
[material.nothing.null]
[[shape.sphere]]
radius = 0.3
material = "a . b"
[[shape.mesh]]
vertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 1.25]]
triangles = [[0, 1, 2]]
motion = [{ time = 0 }, { time = 1, offset = [1, 0, 0] }]
"##;
    let desc = read_str("a.toml", text, &[]).unwrap().desc;
    let (again, text) = again(&desc);
    assert!(again == desc, "{text}");
    insta::assert_snapshot!("short", text);
}

#[test]
fn nothing_is_replaced_unless_it_may_be() {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("a.toml");
    let desc = SceneDesc::default();
    let written = write(&desc, &path, &WriteOptions::default()).unwrap();
    assert_eq!((written.files, written.folder.exists()), (0, false));
    let error = write(&desc, &path, &WriteOptions::default()).unwrap_err();
    assert!(matches!(&error, Error::Io { .. }) && error.to_string().contains("--force"), "{error}");
    write(&desc, &path, &WriteOptions { force: true, ..WriteOptions::default() }).unwrap();
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1, "nothing else is left");
}
