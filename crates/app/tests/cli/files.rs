//! Files that scenes name, and warnings.

use std::fs;

use crate::{Place, read_png};

const SKY: &str = "[environment.image]\nfile = \"sky.hdr\"\n[[shape.sphere]]\nradius = 1\n";
const DARK: &str = "[environment.none]\n[[shape.sphere]]\nradius = 1\n";

/// A panorama of two pixels, all of this exponent.
fn write_sky(place: &Place, exponent: u8) {
    let pixel = [200, 150, 100, exponent];
    let bytes = [b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n".as_slice(), &pixel, &pixel].concat();
    fs::write(place.path("sky.hdr"), bytes).unwrap();
}

#[test]
fn the_hash_is_of_their_contents() {
    let place = Place::new();
    place.write("sky.toml", SKY);
    let render = |exponent| {
        write_sky(&place, exponent);
        let run = place.run("render sky.toml -q -r 8x8 --spp 1 -o -").ends_with(0);
        let (_, _, pixels, said) = read_png(&run.stdout);
        (pixels, said["scene_hash"].clone())
    };
    let (first, second, third) = (render(128), render(127), render(128));
    assert!(first.0 != second.0 && first.1 != second.1);
    assert_eq!(first, third);
}

#[test]
fn scenes_from_standard_input_have_the_current_folder() {
    let place = Place::new();
    write_sky(&place, 128);
    place.run_with_input("check -", SKY).ends_with(0);
    place.run_with_input("check -", &SKY.replace("sky", "no")).ends_with(4);
    place.run("check scene.toml -D environment.image.file=sky.hdr").ends_with(0);
}

#[test]
fn exit_codes() {
    let place = Place::new();
    fs::create_dir(place.path("folder")).unwrap();
    place.write("empty.hdr", "");
    for (file, code) in [("no.hdr", 4), ("folder", 4), ("no/no.hdr", 4), ("empty.hdr", 3), ("scene.toml", 3)] {
        place.write("sky.toml", &SKY.replace("sky.hdr", file));
        for command in ["check", "render"] {
            let run = place.run(&format!("{command} sky.toml")).ends_with(code);
            assert!(run.stderr.starts_with(&format!("error: `{file}` ")), "{}", run.stderr);
            assert!(run.stderr.contains("\n  --> sky.toml:2:8"), "{}", run.stderr);
        }
        place.run("check sky.toml -D camera.vfov=0").ends_with(3);
    }
}

#[test]
fn warnings_are_told_once() {
    let place = Place::new();
    place.write("dark.toml", DARK);
    let said = "warning: nothing shines: the picture will be black\n  --> dark.toml:1:2\nhint: ";
    let told = |stderr: &str| stderr.matches("nothing shines").count();
    let run = place.run("check dark.toml").ends_with(0);
    assert!(run.stderr.starts_with(said) && told(&run.stderr) == 1, "{}", run.stderr);
    let render = "render dark.toml -r 8x8 --spp 1 -o a.png --stats a.json --progress none";
    let run = place.run(render).ends_with(0);
    assert!(run.stderr.starts_with(said) && told(&run.stderr) == 1, "{}", run.stderr);
    let warnings = &place.json("a.json")["warnings"];
    let message = "nothing shines: the picture will be black";
    assert_eq!((&warnings[0]["message"], &warnings[0]["count"]), (&message.into(), &1.into()));
    assert_eq!(warnings[0]["places"], serde_json::json!([{ "file": "dark.toml", "line": 1, "column": 2 }]));
    assert!(warnings[0]["hint"].is_string() && warnings[1].is_null(), "{warnings}");
    assert_eq!(place.run(&format!("{render} -q")).ends_with(0).stderr, "");
    place.run("render scene.toml -r 8x8 --spp 1 -o a.png --stats a.json").ends_with(0);
    assert_eq!(place.json("a.json")["warnings"], serde_json::json!([]));
}

#[test]
fn strict_takes_them_for_errors() {
    let place = Place::new();
    place.write("dark.toml", DARK);
    for command in ["check --strict dark.toml", "render -q dark.toml --strict"] {
        let run = place.run(command).ends_with(3);
        assert!(run.stderr.starts_with("error: nothing shines"), "{}", run.stderr);
    }
    assert!(!place.path("dark.png").exists());
    place.run("check scene.toml --strict").ends_with(0);
}

/// Which lights are found depends on the command line, too.
#[test]
fn weekend_does_not_find_lamps() {
    let place = Place::new();
    place.write("lamp.toml", &format!("{DARK}[[light.point]]\nposition = [0, 3, 0]\n"));
    let render = "render lamp.toml -r 8x8 --spp 1 -o a.png --strict";
    place.run(render).ends_with(0);
    let run = place.run(&format!("{render} --integrator weekend")).ends_with(3);
    assert!(run.stderr.starts_with("error: `weekend` does not find this light"), "{}", run.stderr);
    assert!(run.stderr.contains("\n  --> lamp.toml:4:1\n"), "{}", run.stderr);
    place.run(&format!("{render} --integrator path -D render.integrator=weekend")).ends_with(0);
}
