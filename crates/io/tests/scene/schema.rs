//! Every scene of the repository is one that the reader takes, and its schema knows.

use std::fs;
use std::path::{Path, PathBuf};

use eyebeam_io::Error;
use eyebeam_io::scene::{read, read_str, schema};
use serde_json::Value;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// All files below a folder with one of these endings.
fn files(folder: &Path, endings: &[&str], found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let path = entry.path();
        if path.is_dir() {
            files(&path, endings, found);
        } else if path.extension().is_some_and(|e| endings.iter().any(|&ending| e == ending)) {
            found.push(path);
        }
    }
}

/// The TOML in fences of a Markdown text, or of Rust's comments.
fn blocks(text: &str) -> Vec<String> {
    let (mut found, mut block) = (Vec::new(), None::<String>);
    for line in text.lines() {
        let line = line.trim_start();
        let line = ["//! ", "/// ", "//!"].iter().find_map(|comment| line.strip_prefix(comment)).unwrap_or(line);
        match &mut block {
            Some(_) if line.starts_with("```") => found.extend(block.take()),
            Some(block) => *block += &format!("{line}\n"),
            None if line.trim_end() == "```toml" => block = Some(String::new()),
            None => {}
        }
    }
    found
}

#[test]
fn scenes_are_read() {
    let mut scenes = Vec::new();
    files(&root().join("scenes"), &["toml"], &mut scenes);
    assert!(!scenes.is_empty());
    for scene in scenes {
        read(&scene, &[]).unwrap_or_else(|e| panic!("{e}"));
    }
}

#[test]
fn examples_are_read() {
    let mut sources = vec![root().join("README.md"), root().join("ARCHITECTURE.md"), root().join("CONTRIBUTING.md")];
    files(&root().join("docs"), &["md"], &mut sources);
    files(&root().join("crates"), &["rs"], &mut sources);
    let mut count = 0;
    for source in sources.iter().filter(|s| !s.components().any(|c| c.as_os_str() == "tests")) {
        for block in blocks(&fs::read_to_string(source).unwrap_or_default()) {
            count += 1;
            let Err(error) = read_str(&source.display().to_string(), &block, &[]) else { continue };
            // Part of a scene may name materials that stand elsewhere, and files that are not there.
            let Error::Scene(problems) = &error else { panic!("{error}") };
            let elsewhere = ["there is no material", "cannot include", "this scene has no folder"];
            let is_part = problems.iter().all(|p| elsewhere.iter().any(|e| p.message.contains(e)));
            assert!(is_part, "{error}\n{block}");
        }
    }
    assert!(count >= 5, "found only {count} examples");
}

/// Keys of a schema's objects, as far as one can follow them: `camera.vfov`.
fn keys(schema: &Value, node: &Value, path: &str, found: &mut Vec<String>) {
    let node = match node["$ref"].as_str() {
        Some(name) => schema.pointer(name.trim_start_matches('#')).unwrap(),
        None => node,
    };
    for (key, child) in node["properties"].as_object().into_iter().flatten() {
        let path = format!("{path}{key}");
        found.push(path.clone());
        keys(schema, child, &format!("{path}."), found);
    }
    let all = |name: &str| node[name].as_array().cloned().unwrap_or_default();
    for child in all("oneOf").iter().chain(&all("anyOf")).chain(&all("allOf")) {
        keys(schema, child, path, found);
    }
    for (name, step) in [("items", "0."), ("additionalProperties", "NAME.")] {
        if node[name].is_object() {
            keys(schema, &node[name], &format!("{path}{step}"), found);
        }
    }
}

#[test]
fn schema_has_the_keys_that_the_reader_knows() {
    let schema = schema();
    let mut known = Vec::new();
    keys(&schema, &schema, "", &mut known);
    for key in [
        "include",
        "render.spp",
        "camera.vfov",
        "environment.none",
        "environment.constant.radiance",
        "material.NAME.metal.roughness",
        "material.NAME.lambertian.albedo",
        "shape.sphere.0.radius",
        "shape.mesh.0.triangles",
        "shape.mesh.0.file",
        "environment.image.file",
        "light.ies.0.file",
        "light.projector.0.fov",
    ] {
        assert!(known.iter().any(|k| k == key), "{key} is not in {known:?}");
    }
    for key in known {
        // A value of a wrong type is another mistake than a wrong key.
        let text = key.split('.').rev().fold("{}".to_owned(), |inner, key| match key {
            "0" => format!("[{inner}]"),
            key => format!("{{ {key} = {inner} }}"),
        });
        let text = text.strip_prefix("{ ").and_then(|t| t.strip_suffix(" }")).unwrap_or_default();
        let said = read_str("a.toml", text, &[]).map_or_else(|e| e.to_string(), |_| String::new());
        assert!(!said.contains("unknown"), "{text}\n{said}");
    }
}

#[test]
fn the_schema_for_editors_is_up_to_date() {
    let text = fs::read_to_string(root().join("docs/formats/scene.schema.json")).unwrap();
    let written: Value = serde_json::from_str(&text).unwrap();
    // Read from its text, too: reading may round the last digit of a number.
    let current: Value = serde_json::from_str(&schema().to_string()).unwrap();
    assert_eq!(written, current, "run `make schema`");
}
