//! Files: whole or not at all, and refused before the work.

use std::fs;
use std::time::Duration;

use crate::{Place, read_png};

/// Would take days.
const LONG: &str = "render scene.toml --spp 16777216 -r 4000x4000";

#[test]
fn what_cannot_be_written_is_found_before_rendering() {
    let place = Place::new();
    fs::create_dir(place.path("folder.png")).unwrap();
    place.write("old.png", "old");
    let before = place.files();
    let long_name = "a".repeat(300);
    for args in [
        "-o missing/a.png",
        "-o folder.png",
        "-o scene.toml/a.png",
        &format!("-o {long_name}.png"),
        "--stats missing/a.json",
        "--stats folder.png",
        "-o old.png --stats missing/a.json",
    ] {
        let run = place.run_within(Duration::from_secs(20), &format!("{LONG} {args}")).ends_with(4);
        assert!(run.stderr.starts_with("error: cannot write `"), "{}", run.stderr);
    }
    assert!(place.files() == before, "something was written");
}

#[cfg(unix)]
#[test]
fn a_folder_that_takes_no_files() {
    use std::os::unix::fs::PermissionsExt;
    let place = Place::new();
    let folder = place.path("closed");
    fs::create_dir(&folder).unwrap();
    fs::set_permissions(&folder, fs::Permissions::from_mode(0o555)).unwrap();
    if fs::write(folder.join("probe"), "").is_ok() {
        return; // This user may write everywhere.
    }
    let run = place.run_within(Duration::from_secs(20), &format!("{LONG} -o closed/a.png")).ends_with(4);
    assert_eq!(run.stderr, "error: cannot write `closed/a.png`: permission denied\n");
}

#[test]
fn scenes_that_cannot_be_read_end_with_4() {
    let place = Place::new();
    let before = place.files();
    for args in ["render missing.toml", "check missing.toml", "render .", "check scene.toml/a"] {
        let run = place.run(args).ends_with(4);
        assert!(run.stderr.starts_with("error: cannot read `"), "{}", run.stderr);
    }
    assert!(place.files() == before, "something was written");
}

#[test]
fn an_old_picture_survives_a_failure() {
    let place = Place::new();
    place.write("old.png", "old");
    place.write("bad.toml", "x = 1");
    for args in [
        "render bad.toml -o old.png",
        "render missing.toml -o old.png",
        "render scene.toml -o old.png -r 9999x9999 --memory 1M",
    ] {
        assert_ne!(place.run(args).code, Some(0));
        assert_eq!(place.read("old.png"), b"old");
    }
    place.run("render scene.toml -o old.png -r 32x18 --spp 1").ends_with(0);
    read_png(&place.read("old.png"));
    assert_eq!(place.files().len(), 3, "nothing is left beside");
}

/// The file under the name is another one, not the same with other bytes.
#[cfg(unix)]
#[test]
fn a_picture_is_replaced_at_once() {
    let place = Place::new();
    place.write("a.png", "old");
    fs::hard_link(place.path("a.png"), place.path("other name")).unwrap();
    place.run("render scene.toml -o a.png -r 32x18 --spp 1").ends_with(0);
    assert_eq!(place.read("other name"), b"old");
}

#[test]
fn names() {
    let place = Place::new();
    fs::create_dir(place.path("Größe 𝄞")).unwrap();
    for (scene, output, expected) in [
        ("scene.toml", None, "scene.png"),
        ("a.b.toml", None, "a.b.png"),
        ("my scene.toml", None, "my scene.png"),
        ("Größe 𝄞/scène.toml", Some("Größe 𝄞/b d.PNG"), "Größe 𝄞/b d.PNG"),
        ("noending", None, "noending.png"),
    ] {
        place.write(scene, crate::SCENE);
        let mut command = place.command("render -q -r 8x8 --spp 1");
        command.arg(scene).args(output.map(|o| format!("--output={o}")));
        assert!(command.status().unwrap().success());
        let (.., provenance) = read_png(&place.read(expected));
        assert_eq!(provenance["scene"], scene);
    }
    place.run_with_input("render - -q -r 8x8 --spp 1", crate::SCENE).ends_with(0);
    assert!(place.path("out.png").exists());
}

#[cfg(target_os = "linux")]
#[test]
fn devices_stay_devices() {
    let place = Place::new();
    std::os::unix::fs::symlink("/dev/null", place.path("null.png")).unwrap();
    place.run("render scene.toml -q -r 8x8 --spp 1 -o null.png --stats null.png").ends_with(2);
    place.run("render scene.toml -q -r 8x8 --spp 1 -o null.png").ends_with(0);
    assert!(fs::symlink_metadata(place.path("null.png")).unwrap().is_symlink());
    std::os::unix::fs::symlink("/dev/full", place.path("full.png")).unwrap();
    place.run("render scene.toml -q -r 8x8 --spp 1 -o full.png").ends_with(4);
}
