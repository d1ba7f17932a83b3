//! Files that scenes name: what becomes of them, and what is said of those that cannot be had.

use std::fs;
use std::path::Path;
use std::sync::Arc;
use std::time::{Duration, Instant};

use exr::prelude::write_rgb_file;
use eyebeam_core::desc::SceneDesc;
use eyebeam_core::film::Image;
use eyebeam_core::light::EnvironmentDesc;
use eyebeam_core::render::{Monitor, Render, Settings};
use eyebeam_core::scene::Scene;
use eyebeam_io::scene::{SceneFile, read, read_str};
use eyebeam_io::{At, Error, Fault, Place};
use tempfile::TempDir;

use crate::{character, places, problems, setting, unmark};

/// A ball of eight triangles with normals, and the same in the words of a scene.
const PLY: &str = "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\nproperty float z
property float nx\nproperty float ny\nproperty float nz\nelement face 8\nproperty list uchar int vertex_indices\nend_header
1 0 0 1 0 0\n-1 0 0 -1 0 0\n0 1 0 0 1 0\n0 -1 0 0 -1 0\n0 0 1 0 0 1\n0 0 -1 0 0 -1
3 0 2 4\n3 2 1 4\n3 1 3 4\n3 3 0 4\n3 2 0 5\n3 1 2 5\n3 3 1 5\n3 0 3 5\n";
const INLINE: &str = "
vertices = [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]]
normals = [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]]
triangles = [[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]]
";
const IES: &str = "TILT=NONE\n1 1000 1 2 1 1 2 0 0 0\n1 1 10\n0 90\n0\n100 50\n";

/// A folder with a picture, a mesh and a profile.
fn folder() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    write_rgb_file(at("sky.exr"), 4, 2, |x, y| (x as f32, y as f32, 1.0)).unwrap();
    fs::write(at("ball.ply"), PLY).unwrap();
    fs::write(at("lamp.ies"), IES).unwrap();
    folder
}

fn write(folder: &TempDir, name: &str, text: &str) {
    let path = folder.path().join(name);
    fs::create_dir_all(path.parent().unwrap()).unwrap();
    fs::write(path, text).unwrap();
}

/// Reads this text as a file of the folder.
fn read_in(folder: &TempDir, text: &str) -> Result<SceneFile, Error> {
    write(folder, "a.toml", text);
    read(&folder.path().join("a.toml"), &[])
}

fn environment(desc: &SceneDesc) -> &Arc<Image> {
    let EnvironmentDesc::Image(map) = &desc.environment else { panic!("{:?}", desc.environment) };
    map.image.as_ref().unwrap()
}

#[test]
fn all_kinds() {
    let folder = folder();
    let text = "
[environment.image]
file = \"sky.exr\"
[[light.ies]]
file = \"lamp.ies\"
position = [0, 3, 0]
[[light.projector]]
file = \"./sky.exr\"
position = [0, 1, 3]
look_at = [0, 1, 0]
[[shape.mesh]]
file = \"ball.ply\"
[[shape.mesh]]
file = \"ball.ply\"
";
    let SceneFile { desc, warnings, .. } = read_in(&folder, text).unwrap();
    assert_eq!(warnings, []);
    let image = environment(&desc);
    assert_eq!((image.width(), image.height(), image.pixel(2, 1)), (4, 2, [2.0, 1.0, 1.0]));
    assert_eq!(desc.light.ies[0].profile.as_ref().unwrap().candela(), [100.0, 50.0]);
    // One file, whatever it is called, is there once.
    assert!(Arc::ptr_eq(image, desc.light.projector[0].image.as_ref().unwrap()));
    let [a, b] = [0, 1].map(|i| desc.shape.mesh[i].data.as_ref().unwrap());
    assert!(Arc::ptr_eq(a, b));
    assert_eq!((a.vertices.len(), a.normals.len(), desc.shape.mesh[0].triangle_count()), (6, 6, 8));
    Scene::build(&desc).unwrap();
}

#[test]
fn names_are_relative_to_the_file_that_says_them() {
    let folder = folder();
    let included = "[[shape.mesh]]\nfile = \"../ball.ply\"\n[[light.ies]]\nfile = \"l.ies\"\nposition = [0, 1, 0]";
    write(&folder, "lib/b.toml", included);
    write(&folder, "lib/l.ies", IES);
    let text = "include = [\"lib/b.toml\"]\n[[light.ies]]\nfile = \"lamp.ies\"\nposition = [0, 2, 0]";
    let desc = read_in(&folder, text).unwrap().desc;
    // Lights of both files are there.
    assert_eq!(desc.light.ies.iter().map(|l| l.position[1]).collect::<Vec<_>>(), [1.0, 2.0]);
    assert_eq!(desc.shape.mesh[0].triangle_count(), 8);

    // An absolute name is itself, also from the command line, which has the current folder.
    let file = folder.path().join("sky.exr").display().to_string();
    let scene = folder.path().join("a.toml");
    let desc = read(&scene, &[setting(&format!("environment.image.file={file}"))]).unwrap().desc;
    assert_eq!(environment(&desc).width(), 4);
    let error = read(&scene, &[setting("environment.image.file=sky.exr")]).unwrap_err();
    assert!(error.to_string().starts_with("error: `sky.exr` cannot be read: "), "{error}");

    // A text has no folder.
    for name in ["ball.ply", &file] {
        let error = read_str("b.toml", &format!("[[shape.mesh]]\nfile = '{name}'"), &[]).unwrap_err();
        let said =
            format!("error: `{name}` cannot be read: this scene has no folder, in a mesh\n  --> b.toml:2:8\nhint: ");
        assert!(error.to_string().starts_with(&said), "{error}");
    }
}

#[test]
fn a_mesh_from_a_file_is_the_same_picture() {
    let folder = folder();
    let picture = |mesh: &str| {
        let desc = read_in(&folder, &format!("[camera]\nlook_from = [2, 1, 3]\n[[shape.mesh]]\n{mesh}")).unwrap().desc;
        let settings = Settings { width: 32, height: 32, spp: 16, ..Settings::from(&desc.render) };
        let scene = Scene::build(&desc).unwrap();
        let mut render = Render::new(&scene, settings);
        while !render.is_done() {
            render.step(&Monitor::default());
        }
        render.film().develop()
    };
    let [from_file, inline] = [picture("file = \"ball.ply\""), picture(INLINE)];
    assert!(from_file == inline);
    // The ball is there.
    assert!(inline.pixel(16, 16) != inline.pixel(0, 0));
}

#[test]
fn what_is_wrong_has_its_place() {
    let folder = folder();
    write(&folder, "empty.ply", "");
    write(&folder, "cut.ply", &PLY[..PLY.len() - 20]);
    write(&folder, "huge.ply", &PLY.replace("\n-1 0 0 -1", "\n-1e30 0 0 -1"));
    write(&folder, "cut.exr", "\x76\x2f\x31\x01");
    fs::create_dir(folder.path().join("sub")).unwrap();
    let lamp = "position = [0, 1, 0]\n[[light.ies]]\nfile = ";
    let marked = format!(
        "[environment.image]\nfile = ▸\"nothing.hdr\"
[[light.projector]]\nfile = ▸\"cut.exr\"\nposition = [0, 0, 0]\nlook_at = [0, 0, 1]
[[light.ies]]\nfile = ▸\"sub\"\n{lamp}▸\"ball.ply\"\n{lamp}▸\"\"\n{lamp}▸\"a\\u0000b\"\nposition = [0, 1, 0]
[[shape.mesh]]\nfile = ▸\"empty.ply\"\n[[shape.mesh]]\nfile = ▸\"cut.ply\"\n[[shape.mesh]]\nfile = ▸\"cut.ply\"
[[shape.mesh]]\nfile = ▸\"lamp.ies/x\"\n[[shape.mesh]]\nfile = ▸\"huge.ply\"
▸[[shape.mesh]]\n[[shape.mesh]]\nfile = \"ball.ply\"\nvertices = ▸[[0, 0, 0]]\n[[shape.mesh]]\nfile = ▸3
[[shape.mesh]]\nvertices = [▸[0, 0], [0, 0, 0]]\ntriangles = [[0, 0, 1]]\n[[shape.sphere]]\nradius = ▸-1
"
    );
    let (text, expected) = unmark(&marked);
    let error = read_in(&folder, &text).unwrap_err();
    let said = error.to_string().replace(folder.path().to_str().unwrap(), "FOLDER");
    assert_eq!(places(&problems(error)), expected, "{said}");
    insta::assert_snapshot!(said);
}

/// Those that only the file system is to blame for.
#[test]
fn files_that_are_not_there() {
    let folder = folder();
    let unreadable =
        |text: &str| problems(read_in(&folder, text).unwrap_err()).iter().all(|p| p.fault == Fault::FileSystem);
    assert!(unreadable("include = [\"b.toml\"]"));
    assert!(unreadable("[[shape.mesh]]\nfile = \"b.ply\"\n[[shape.mesh]]\nfile = \".\""));
    assert!(!unreadable("[[shape.mesh]]\nfile = \"lamp.ies\""));
    assert!(!unreadable("[[shape.mesh]]\nfile = \"b.ply\"\n[camera]\nvfov = 0"));
    assert!(!unreadable("include = [\"../b.toml\"]"));
}

#[test]
fn what_never_ends() {
    let folder = folder();
    let start = Instant::now();
    let mut names = vec!["x".repeat(10_000), "x/".repeat(100_000), "../".repeat(10_000)];
    if cfg!(target_os = "linux") {
        names.extend(["/dev/zero", "/dev/full", "/dev/stdin", "/proc/self/mem"].map(str::to_owned));
        let fifo = folder.path().join("pipe");
        assert!(std::process::Command::new("mkfifo").arg(&fifo).status().unwrap().success());
        std::os::unix::fs::symlink("round", folder.path().join("round")).unwrap();
        names.extend(["pipe", "round"].map(str::to_owned));
    }
    for name in names {
        for text in [
            format!("[environment.image]\nfile = \"{name}\""),
            format!("[[light.ies]]\nfile = \"{name}\"\nposition = [0, 0, 0]"),
            format!("[[shape.mesh]]\nfile = \"{name}\""),
        ] {
            let error = read_in(&folder, &text).unwrap_err();
            assert!(error.to_string().len() < 2000, "{error}");
            assert_eq!(places(&problems(error)).len(), 1);
        }
    }
    // One that is longer than is allowed.
    let long = fs::File::create(folder.path().join("long.hdr")).unwrap();
    if long.set_len(3 << 30).is_ok() {
        let error = read_in(&folder, "[environment.image]\nfile = \"long.hdr\"").unwrap_err();
        assert!(error.to_string().contains("the file is longer than 2 GiB"), "{error}");
    }
    assert!(start.elapsed() < Duration::from_secs(5), "{:?}", start.elapsed());
}

/// A file that is wrong is not read again for each of its names.
#[test]
fn many_names_of_one_file() {
    let folder = folder();
    write(&folder, "big.ply", &format!("{}{}", PLY.replace("face 8", "face 100000"), "3 0 1 2\n".repeat(99_991)));
    let start = Instant::now();
    let error = read_in(&folder, &"[[shape.mesh]]\nfile = \"big.ply\"\n".repeat(500)).unwrap_err();
    assert!(problems(error).len() >= 500);
    assert!(start.elapsed() < Duration::from_secs(10), "{:?}", start.elapsed());
}

#[test]
fn a_picture_of_one_pixel() {
    let folder = folder();
    write_rgb_file(folder.path().join("one.exr"), 1, 1, |_, _| (3.0_f32, 2.0_f32, 1.0_f32)).unwrap();
    let slide = "[[light.projector]]\nfile = \"one.exr\"\nposition = [0, 3, 3]\nlook_at = [0, 0, 0]";
    let text = format!("[environment.image]\nfile = \"one.exr\"\n{slide}\n[[shape.sphere]]\nradius = 1");
    let SceneFile { desc, warnings, .. } = read_in(&folder, &text).unwrap();
    assert_eq!(warnings, []);
    let settings = Settings { width: 16, height: 16, spp: 16, ..Settings::from(&desc.render) };
    let scene = Scene::build(&desc).unwrap();
    let mut render = Render::new(&scene, settings);
    while !render.is_done() {
        render.step(&Monitor::default());
    }
    assert_eq!(render.film().sample_counts().dropped, 0);
    let corner = render.film().develop().pixel(0, 0);
    assert!(corner.iter().zip([3.0, 2.0, 1.0]).all(|(c, expected)| (c - expected).abs() < 1e-5), "{corner:?}");
}

#[test]
fn warnings_have_their_place() {
    let folder = folder();
    write_rgb_file(folder.path().join("nan.exr"), 4, 2, |x, _| (if x > 2 { f32::NAN } else { 1.0 }, 1.0_f32, 1.0_f32))
        .unwrap();
    write(&folder, "tilted.ies", &IES.replace("NONE", "a.tlt"));
    let marked = "
[render]
integrator = \"weekend\"
[environment.image]
file = ▸\"nan.exr\"
[material.off.emissive]
radiance = ▸0
▸[[light.point]]
position = [0, 0, 0]
▸[[light.spot]]
position = [0, 0, 0]
look_at = [0, 1, 0]
intensity = 0
▸[[light.ies]]
file = ▸\"tilted.ies\"
position = [0, 0, 0]
▸[[shape.mesh]]
vertices = [[0, 0, 0], [1, 1, 1]]
triangles = [[0, 0, 1]]
material = \"lamp\"
[material.lamp.emissive]
";
    let (text, expected) = unmark(marked);
    let warnings = read_in(&folder, &text).unwrap().warnings;
    let found = warnings.iter().map(|w| character(w.place.as_ref().unwrap()));
    let said = warnings.iter().map(|w| format!("{w}\n")).collect::<String>();
    assert_eq!(found.collect::<Vec<_>>(), expected, "{said}");
    insta::assert_snapshot!(said.replace(folder.path().to_str().unwrap(), "FOLDER"));

    let dark = read_str("a.toml", "[environment.none]\n[[shape.sphere]]\nradius = 1", &[]).unwrap().warnings;
    assert!(dark[0].to_string().starts_with("warning: nothing shines: the picture will be black\n"), "{dark:?}");
    let night = read_str("a.toml", "[environment.sky]\nsun_elevation = -30", &[]).unwrap().warnings;
    assert_eq!(
        night[0].place,
        Some(Place { file: "a.toml".to_owned(), at: At::Character { line: 1, column: 1 } }),
        "{night:?}"
    );
}

#[test]
fn a_scene_of_the_repository_has_no_warnings() {
    for entry in fs::read_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes")).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|e| e == "toml") {
            assert_eq!(read(&path, &[]).unwrap().warnings, [], "{}", path.display());
        }
    }
}
