//! The scripts beside the scenes: the gallery is rendered, meshes are what is written, and every scene is told of.

use std::fs;
use std::path::Path;
use std::process::Command;

use crate::{Place, Run, scenes};

/// Runs a script of the folder of scenes; none without Python.
fn script(args: &[&str]) -> Option<Run> {
    let (name, args) = args.split_first()?;
    let mut command = Command::new("python3");
    command.arg(scenes().join(name)).args(args).env("PYTHONDONTWRITEBYTECODE", "1");
    match command.output() {
        Ok(output) => Some(Run::from(output)),
        Err(error) => {
            eprintln!("python3 cannot be run, so {name} is not tested: {error}");
            None
        }
    }
}

#[test]
fn meshes_are_what_the_generator_writes() {
    if let Some(run) = script(&["generate.py", "--check"]) {
        run.ends_with(0);
    }
}

/// That pictures name their scenes without a folder of the machine that made them.
fn names_no_place(folder: &Path) {
    let absolute = b"\"scene\":\"/";
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.extension() == Some("jpg".as_ref()) {
            let bytes = fs::read(&path).unwrap();
            assert!(!bytes.windows(absolute.len()).any(|bytes| bytes == absolute), "{}", path.display());
        }
    }
}

#[test]
fn pictures_of_the_documentation_name_no_place() {
    for folder in ["gallery", "materials", "textures"] {
        names_no_place(&scenes().join("../docs").join(folder));
    }
}

#[test]
fn the_gallery_renders() {
    let place = Place::new();
    let folder = place.path("gallery");
    let eyebeam = env!("CARGO_BIN_EXE_eyebeam");
    if let Some(run) = script(&["gallery.py", "--quick", "--eyebeam", eyebeam, "--output", &folder.to_string_lossy()]) {
        run.ends_with(0);
        let page = fs::read_to_string(folder.join("index.md")).unwrap();
        let pictures = page.lines().filter(|line| line.starts_with("![")).count();
        let files =
            fs::read_dir(&folder).unwrap().filter(|f| f.as_ref().unwrap().path().extension() == Some("jpg".as_ref()));
        assert!(pictures > 10);
        names_no_place(&folder);
        assert_eq!(files.count(), pictures);
    }
}

#[test]
fn every_figure_of_the_pages_about_materials_and_textures_renders() {
    let place = Place::new();
    let folder = place.path("figures");
    let eyebeam = env!("CARGO_BIN_EXE_eyebeam");
    let figures = "../docs/materials/figures.py";
    if let Some(run) = script(&[figures, "--quick", "--eyebeam", eyebeam, "--output", &folder.to_string_lossy()]) {
        run.ends_with(0);
        for kind in ["materials", "textures"] {
            for entry in fs::read_dir(scenes().join("../docs").join(kind)).unwrap() {
                let page = entry.unwrap().path();
                if page.extension() != Some("md".as_ref()) {
                    continue;
                }
                let text = fs::read_to_string(&page).unwrap();
                let pictures = text.lines().filter(|line| line.starts_with("!["));
                for name in pictures.filter_map(|line| line.split_once("](")?.1.strip_suffix(')')) {
                    assert!(folder.join(kind).join(name).is_file(), "{} shows {name}", page.display());
                }
            }
        }
    }
}

#[test]
fn every_material_has_its_page_with_a_figure_and_an_example() {
    let docs = scenes().join("../docs");
    let schema = fs::read_to_string(docs.join("formats/scene.schema.json")).unwrap();
    let schema: serde_json::Value = serde_json::from_str(&schema).unwrap();
    let kinds = schema["$defs"]["MaterialDesc"]["oneOf"].as_array().unwrap();
    assert!(kinds.len() > 10);
    let index = fs::read_to_string(docs.join("materials/index.md")).unwrap();
    for kind in kinds.iter().map(|kind| kind["required"][0].as_str().unwrap()) {
        let page = fs::read_to_string(docs.join(format!("materials/{kind}.md"))).expect(kind);
        assert!(page.contains("\n![") && page.contains("```toml\n"), "the page of {kind} shows nothing");
        assert!(index.contains(&format!("({kind}.md)")), "the index of materials does not lead to {kind}");
    }
}

#[test]
fn every_scene_is_in_the_table() {
    let table = fs::read_to_string(scenes().join("README.md")).unwrap();
    for entry in fs::read_dir(scenes()).unwrap() {
        let name = entry.unwrap().file_name().to_string_lossy().into_owned();
        if name.ends_with(".toml") {
            assert!(table.contains(&format!("[{name}]({name}) | ")), "scenes/README.md does not tell of {name}");
        }
    }
}
