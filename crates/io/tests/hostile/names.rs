//! What files name: nothing outside their folder is read, and nothing that names itself.

use std::fs;
use std::path::Path;

use eyebeam_io::scene::{Files, ReadOptions, read, read_bytes};
use serde_json::json;
use tempfile::TempDir;

use crate::{alone, samples, watched};

/// Names of files that must not be read from a model.
const OUTSIDE: [&str; 10] = [
    "../../etc/passwd",
    "../secret",
    "/etc/passwd",
    "a/../../secret",
    "file:///etc/passwd",
    "http://example.com/a",
    "https://example.com/a",
    "C:\\a",
    "..\\secret",
    "\\\\server\\a",
];

/// A folder in a folder, beside a secret; names and contents.
fn folder(files: &[(&str, &[u8])]) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("secret"), "newmtl secret\nKd 1 0 0\n").unwrap();
    fs::create_dir(folder.path().join("in")).unwrap();
    for (name, bytes) in files {
        fs::write(folder.path().join("in").join(name), bytes).unwrap();
    }
    folder
}

/// All that is said about a file in it, without the name of the folder.
fn said(folder: &TempDir, name: &str) -> String {
    let path = folder.path().join("in").join(name);
    let (result, _) = watched(name, || read(&path, &[]));
    let text = match result {
        Ok(file) => file.warnings.iter().map(|warning| format!("{warning}\n")).collect(),
        Err(error) => error.to_string(),
    };
    text.replace(&folder.path().display().to_string(), "FOLDER")
}

#[test]
fn nothing_outside_its_folder() {
    let _alone = alone();
    for name in OUTSIDE {
        let refused = |text: String| {
            let is_named = text.contains(&name.escape_default().to_string()) || text.contains(name);
            let is_refused =
                ["leads out of the folder", "No such file", "it is not a file"].iter().any(|why| text.contains(why));
            assert!(is_named && is_refused && !text.contains("root:"), "{name}: {text}");
        };
        let buffer = samples::changed(&[("/buffers/0", json!({ "uri": name, "byteLength": 92 }))]);
        refused(said(&folder(&[("a.glb", &buffer)]), "a.glb"));
        let picture = samples::changed(&[("/images/0/uri", json!(name))]);
        refused(said(&folder(&[("a.glb", &picture)]), "a.glb"));
        let library = format!("mtllib {name}\nv 0 0 0\nusemtl secret\nf 1 1 1\n");
        refused(said(&folder(&[("a.obj", library.as_bytes())]), "a.obj"));
        let map = format!("newmtl a\nmap_Kd {name}\n");
        let obj = b"mtllib a.mtl\nv 0 0 0\nusemtl a\nf 1 1 1\n";
        refused(said(&folder(&[("a.obj", obj), ("a.mtl", map.as_bytes())]), "a.obj"));
    }
    // Of included scenes, too; the rest of a scene is a person's own, who may name any file.
    for name in ["../../etc/passwd", "/etc/passwd", "../secret"] {
        let text = said(&folder(&[("a.toml", format!("include = [\"{name}\"]").as_bytes())]), "a.toml");
        assert!(text.contains(name) && text.contains("is outside the scene's folder"), "{text}");
    }
}

#[cfg(unix)]
#[test]
fn no_link_that_leads_out() {
    let _alone = alone();
    use std::os::unix::fs::symlink;
    let buffer = samples::changed(&[("/buffers/0", json!({ "uri": "link", "byteLength": 92 }))]);
    let picture = samples::changed(&[("/images/0/uri", json!("link"))]);
    let obj = b"mtllib link\nmtllib a.mtl\nv 0 0 0\nusemtl a\nf 1 1 1\n";
    let files: [(&str, &[u8]); 5] = [
        ("buffer.glb", &buffer),
        ("picture.glb", &picture),
        ("a.obj", obj),
        ("a.mtl", b"newmtl a\nmap_Kd link\n"),
        ("a.toml", b"include = [\"link\"]"),
    ];
    let folder = folder(&files);
    symlink(folder.path().join("secret"), folder.path().join("in/link")).unwrap();
    for name in ["buffer.glb", "picture.glb", "a.obj"] {
        let text = said(&folder, name);
        assert!(text.contains("`link` is not read: it is a link that leads out of the folder"), "{name}: {text}");
    }
    assert!(said(&folder, "a.obj").contains("the picture `link` is not read"));
    assert!(said(&folder, "a.toml").contains("`link` is outside the scene's folder"));
    // One that leads to itself, and one to a device.
    for target in ["link", "/dev/zero"] {
        fs::remove_file(folder.path().join("in/link")).unwrap();
        symlink(target, folder.path().join("in/link")).unwrap();
        for name in ["buffer.glb", "picture.glb", "a.obj", "a.toml"] {
            let text = said(&folder, name);
            assert!(text.contains("link"), "{name}: {text}");
        }
    }
}

#[test]
fn circles_end() {
    let _alone = alone();
    for (changes, said_of) in [
        (json!([{ "children": [0] }]), "node 0"),
        (json!([{ "children": [1] }, { "children": [2] }, { "children": [0] }]), "node 0"),
        (json!([{ "children": [1, 1] }, {}]), "node 1"),
    ] {
        let text = said(
            &folder(&[("a.glb", &samples::changed(&[("/nodes", changes), ("/scenes/0/nodes", json!([0]))]))]),
            "a.glb",
        );
        assert!(text.contains(said_of) && text.contains("within itself"), "{text}");
    }
    let deep: Vec<_> = (1..20_000).map(|i| json!({ "children": [i] })).chain([json!({})]).collect();
    let text = said(&folder(&[("a.glb", &samples::changed(&[("/nodes", deep.into())]))]), "a.glb");
    assert!(text.contains("is within more than 1000 others"), "{text}");
    let files: [(&str, &[u8]); 3] = [
        ("a.toml", b"include = [\"b.toml\"]"),
        ("b.toml", b"include = [\"c.toml\"]\n[[shape.sphere]]\nradius = 1"),
        ("c.toml", b"include = [\"b.toml\"]\n[[shape.sphere]]\nradius = 1"),
    ];
    let text = said(&folder(&files), "a.toml");
    assert!(text.contains("`b.toml` includes itself"), "{text}");
    let twice: [(&str, &[u8]); 1] = [("a.toml", b"include = [\"./a.toml\"]\n[[shape.sphere]]\nradius = 1")];
    assert!(said(&folder(&twice), "a.toml").contains("includes itself"));
}

/// A library that is named many times, in many ways, is read once.
#[test]
fn the_same_library_again_and_again() {
    let _alone = alone();
    let names: String = (0..5000).map(|i| format!("{}a.mtl ", "./".repeat(i % 50))).collect();
    let obj = format!("{}v 0 0 0\nf 1 1 1\n", format!("mtllib {names}\n").repeat(5));
    let library = "newmtl a\nunknown 1\n".repeat(2000);
    let folder = folder(&[("a.obj", obj.as_bytes()), ("a.mtl", library.as_bytes())]);
    let text = said(&folder, "a.obj");
    assert_eq!(text.matches("`unknown` is not read").count(), 1, "{text}");
}

#[test]
fn files_that_are_given_are_all_there_is() {
    let _alone = alone();
    let buffer = samples::changed(&[("/buffers/0", json!({ "uri": "x/b%20c.bin", "byteLength": 92 }))]);
    let mut bytes = samples::numbers();
    let files = |name: &str, bytes: &[u8]| [(name.to_owned(), bytes.to_vec())].into();
    let read = |files: Files<'_>| read_bytes("a.glb", &buffer, files, &ReadOptions::default());
    assert!(read(Files::Given(&files("./x/b c.bin", &bytes))).is_err());
    assert_eq!(read(Files::Given(&files("x/b c.bin", &bytes))).unwrap().desc.shape.mesh.len(), 4);
    bytes.truncate(50);
    let error = read(Files::Given(&files("x/b c.bin", &bytes))).unwrap_err().to_string();
    assert!(error.contains("buffer 0 has 50 of 92 bytes"), "{error}");
    for (files, said) in [(Files::None, "the model has no folder"), (Files::In(Path::new(".")), "No such file")] {
        let error = read(files).unwrap_err().to_string();
        assert!(error.contains(said) && error.contains("a.glb"), "{error}");
    }
}
