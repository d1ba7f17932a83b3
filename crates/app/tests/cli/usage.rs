//! Command lines, right and wrong.

use crate::Place;

#[test]
fn help() {
    let place = Place::new();
    insta::assert_snapshot!("help", place.run("--help").ends_with(0).text());
    insta::assert_snapshot!("help_render", place.run("render --help").ends_with(0).text());
    insta::assert_snapshot!("help_develop", place.run("develop --help").ends_with(0).text());
    assert_eq!(place.run("--version").ends_with(0).text(), concat!("eyebeam ", env!("CARGO_PKG_VERSION"), "\n"));
}

#[test]
fn wrong_command_lines_end_with_2() {
    let place = Place::new();
    let before = place.files();
    for args in [
        "",
        "paint",
        "render",
        "render scene.toml --foo",
        "render scene.toml --spp 0",
        "render scene.toml --spp -1",
        "render scene.toml --spp 16777217",
        "render scene.toml --spp many",
        "render scene.toml --max-depth -1",
        "render scene.toml --max-depth 1000001",
        "render scene.toml --seed -1",
        "render scene.toml --seed 1.5",
        "render scene.toml -r 0x0",
        "render scene.toml -r 10",
        "render scene.toml -r 99999999x1",
        "render scene.toml --threads 0",
        "render scene.toml --memory lots",
        "render scene.toml --integrator magic",
        "render scene.toml --progress loud",
        "render scene.toml -D camera.vfov",
        "render scene.toml -o a.png -o b.png",
        "render scene.toml -o a.gif",
        "render scene.toml --view kodak",
        "render scene.toml --exposure bright",
        "render scene.toml --exposure 33",
        "render scene.toml --white-balance 500",
        "render scene.toml --contrast 0",
        "render scene.toml --saturation -1",
        "render scene.toml --bits 12",
        "render scene.toml --quality 0",
        "render scene.toml -o a.jpg --bits 16",
        "render scene.toml -o a.png --half",
        "render scene.toml -o a.jpg -r 65536x1",
        "render scene.toml -o a.jpg --aov depth",
        "develop",
        "develop a.exr",
        "develop a.exr -o a.gif",
        "develop a.exr -o a.hdr --half",
        "develop a.exr -o a.png --spp 4",
        "render scene.toml -o a",
        "render scene.toml -q -v",
        "render scene.toml -o a.png --stats a.png",
        "render scene.toml -o - --stats -",
        "render scene.toml --stats scene.toml",
        "render scene.toml other.toml",
    ] {
        let run = place.run(args).ends_with(2);
        assert!(
            run.stdout.is_empty() && run.stderr.contains("rror") | run.stderr.contains("Usage"),
            "{args}: {}",
            run.stderr
        );
    }
    assert!(place.files() == before, "something was written");
}

#[test]
fn wrong_scenes_end_with_3() {
    let place = Place::new();
    place.write("bad.toml", "[camera]\nvfow = 30\n");
    place.write("empty.toml", "");
    let before = place.files();
    for args in [
        "render bad.toml",
        "check bad.toml",
        "render empty.toml",
        "render scene.toml -D camera.vfow=3",
        "check scene.toml -D camera.vfov=0",
        "render scene.toml -D render.spp=0",
    ] {
        let run = place.run(args).ends_with(3);
        assert!(run.stdout.is_empty() && run.stderr.contains("\n  --> "), "{args}: {}", run.stderr);
    }
    assert!(place.files() == before, "something was written");
    let said = place.run("check bad.toml").stderr;
    assert_eq!(said, "error: unknown field `vfow` in camera\n  --> bad.toml:2:1\nhint: did you mean `vfov`?\n");
    assert_eq!(place.run_with_input("check -", "\nx = 1").ends_with(3).stderr.lines().nth(1), Some("  --> -:2:1"));
}

#[test]
fn too_large_pictures_end_with_5() {
    let place = Place::new();
    let run = place.run("render scene.toml -r 16777216x16777216").ends_with(5);
    assert!(
        run.stderr.starts_with("error: the picture would need 31.0 PiB, and 8.0 GiB are allowed\nhint: "),
        "{}",
        run.stderr
    );
    place.run("render scene.toml -r 100x100 --memory 1M").ends_with(5);
    place.run("render scene.toml -r 32x18 --spp 1 --memory 1M").ends_with(0);
}

#[test]
fn the_order_of_options_does_not_matter() {
    let place = Place::new();
    for args in [
        "render scene.toml -o a.png --spp 2 -r 32x18 --seed 3 --max-depth 4 -D camera.vfov=50",
        "render -D camera.vfov=50 --seed=3 -r32x18 --max-depth=4 --output=a.png scene.toml --spp=2",
        "render --resolution=32X18 --max-depth=4 -oa.png --seed=3 --spp=2 -Dcamera.vfov=50 -- scene.toml",
    ] {
        place.run(args).ends_with(0);
        std::fs::rename(place.path("a.png"), place.path(&format!("{}.png", args.len()))).unwrap();
    }
    let pictures: Vec<_> = place.files().into_iter().filter(|(name, _)| name.ends_with("png")).collect();
    assert_eq!(pictures.len(), 3);
    assert!(pictures.iter().all(|(_, bytes)| *bytes == pictures[0].1));
}

#[test]
fn check_and_schema() {
    let place = Place::new();
    let run = place.run("check scene.toml").ends_with(0);
    assert!(run.stdout.is_empty());
    assert_eq!(run.stderr, "scene.toml: fine (1 spheres, 0 quads, 0 triangles, 1 materials)\n");
    let run = place.run("schema").ends_with(0);
    let schema: serde_json::Value = serde_json::from_slice(&run.stdout).unwrap();
    assert_eq!(schema["title"], "Eyebeam scene");
    assert!(schema["properties"]["camera"].is_object() && run.stderr.is_empty());
}
