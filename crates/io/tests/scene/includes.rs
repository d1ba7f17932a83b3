//! Scenes of more than one file.

use std::fs;
use std::path::Path;

use eyebeam_io::scene::read;
use tempfile::TempDir;

use crate::{character, problems, setting, unmark};

/// A folder with these files; marks in them are left out.
fn folder(files: &[(&str, &str)]) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in files {
        let path = folder.path().join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, unmark(text).0).unwrap();
    }
    folder
}

/// What is said about the first file, without the name of the folder.
fn said(folder: &Path, name: &str) -> String {
    let error = read(&folder.join(name), &[]).unwrap_err();
    let text = error.to_string();
    problems(error);
    text.replace(folder.to_str().unwrap(), "FOLDER")
}

#[test]
fn add_up_and_the_including_file_wins() {
    let folder = folder(&[
        (
            "a.toml",
            "include = [\"lib/b.toml\", \"lib/c.toml\"]\n[camera]\nvfov = 30\n[material.x.metal]\n[[shape.sphere]]\nradius = 3",
        ),
        ("lib/b.toml", "include = [\"d.toml\"]\n[camera]\nvfov = 10\naperture = 0.5\n[[shape.sphere]]\nradius = 1"),
        ("lib/c.toml", "[material.x.lambertian]\n[environment.none]\n[[shape.sphere]]\nradius = 2"),
        ("lib/d.toml", "[[shape.sphere]]\nradius = 0.5\nmaterial = \"x\""),
    ]);
    let desc = read(&folder.path().join("a.toml"), &[setting("shape.sphere.0.radius=9")]).unwrap().desc;
    assert_eq!((desc.camera.vfov, desc.camera.aperture), (Some(30.0), Some(0.5)));
    assert_eq!(desc.shape.sphere.iter().map(|s| s.radius).collect::<Vec<_>>(), [9.0, 1.0, 2.0, 3.0]);
    assert!(matches!(desc.material["x"], eyebeam_core::material::MaterialDesc::Metal(_)));
}

#[test]
fn mistakes_name_their_file() {
    let files = [
        ("a.toml", "include = [\"lib/é.toml\", \"c.toml\"]\n[[shape.sphere]]\nradius = ▸-1\n▸x = 1"),
        ("lib/é.toml", "# ü\n[[shape.sphere]]\nradius = ▸-2\n[camera]\nlook_at = [0, ▸\"ö\", 0]"),
        ("c.toml", "[[shape.sphere]]\nmaterial = ▸\"m\"\nradius = 1\n[▸foo]"),
    ];
    let folder = folder(&files);
    let error = read(&folder.path().join("a.toml"), &[setting("camera.vfov=-1")]).unwrap_err();
    let found: Vec<_> = problems(error).into_iter().map(|p| p.place.unwrap()).collect();
    for (name, text) in files {
        let file = folder.path().join(name).display().to_string();
        let here: Vec<_> = found.iter().filter(|p| p.file == file).map(character).collect();
        assert_eq!(here, unmark(text).1, "{name}");
    }
    let last = found.last().unwrap();
    assert_eq!((last.file.as_str(), character(last).1), ("-D", 13));
}

#[test]
fn refusals() {
    let folder = folder(&[
        ("lib/outside.toml", "include = [\"▸../a.toml\"]"),
        ("circle.toml", "include = [\"lib/../circle.toml\", \"./circle.toml\"]"),
        ("a.toml", "include = [\"b.toml\"]"),
        ("b.toml", "include = [\"a.toml\"]"),
        ("missing.toml", "x = 1\ninclude = [\"nothing.toml\", \"lib\", \"\", 3]"),
        ("absolute.toml", "include = [\"/etc/hostname\"]"),
        ("up.toml", "include = [\"../a.toml\"]"),
        ("below.toml", "include = [\"lib/outside.toml\"]"),
        ("bytes.toml", "include = [\"lib/bytes.toml\"]"),
        ("syntax.toml", "include = [\"lib/syntax.toml\"]"),
        ("lib/syntax.toml", "\n[camera"),
    ]);
    fs::write(folder.path().join("lib/bytes.toml"), b"# \xc3\xa9\n  \xff").unwrap();
    let mut report = String::new();
    for name in ["circle", "a", "missing", "absolute", "up", "below", "bytes", "syntax"] {
        report += &format!("{name}\n{}\n\n", said(folder.path(), &format!("{name}.toml")));
    }
    insta::assert_snapshot!(report);
}

#[cfg(unix)]
#[test]
fn links_may_not_lead_out() {
    let (outside, folder) =
        (folder(&[("secret.toml", "")]), folder(&[("a.toml", "include = [\"link.toml\"]"), ("b.toml", "# b")]));
    let link = folder.path().join("link.toml");
    std::os::unix::fs::symlink(outside.path().join("secret.toml"), &link).unwrap();
    assert!(said(folder.path(), "a.toml").contains("is outside the scene's folder"));
    fs::remove_file(&link).unwrap();
    std::os::unix::fs::symlink("b.toml", &link).unwrap();
    read(&folder.path().join("a.toml"), &[]).unwrap();
}

#[test]
fn chains_are_short() {
    let link = |i: usize| format!("include = [\"{}.toml\"]", i + 1);
    let texts: Vec<_> = (0..20).map(|i| (format!("{i}.toml"), link(i))).collect();
    let files: Vec<_> = texts.iter().map(|(name, text)| (name.as_str(), text.as_str())).collect();
    assert!(said(folder(&files).path(), "0.toml").contains("`16.toml` is at the end of a chain of 16 files"));
}

#[test]
fn a_few_files_do_not_become_a_million() {
    let double = |i: usize| format!("include = [{}]", format!("\"{}.toml\", ", i + 1).repeat(10));
    let mut texts: Vec<_> = (0..8).map(|i| (format!("{i}.toml"), double(i))).collect();
    texts.push(("8.toml".to_owned(), "[[shape.sphere]]\nradius = 1".to_owned()));
    let files: Vec<_> = texts.iter().map(|(name, text)| (name.as_str(), text.as_str())).collect();
    assert!(said(folder(&files).path(), "0.toml").contains("more than 1000 files"));
}

#[test]
fn a_text_has_no_folder() {
    let error = eyebeam_io::scene::read_str("a.toml", "include = [\"b.toml\"]", &[]).unwrap_err();
    assert!(error.to_string().contains("cannot include `b.toml`: this scene has no folder\n  --> a.toml:1:12"));
}
