//! What is said of models that are not read wholly, and of what can be chosen in them.

use serde_json::json;

use crate::Place;
use crate::made::{write_changed, write_gltf};

/// Small and fast.
const RENDER: &str = "render model.gltf -r 8x8 --spp 1 -o a.png --progress none";

#[test]
fn what_is_ignored_is_told_in_five_lines_or_wholly() {
    let place = Place::new();
    write_changed(&place, |document| {
        document["extensionsUsed"] = json!(["EXT_a", "EXT_b", "EXT_c", "EXT_d"]);
    });
    let run = place.run(&format!("{RENDER} --stats a.json")).ends_with(0);
    let said: Vec<_> = run.stderr.lines().take(5).collect();
    assert_eq!(said[0], "warning: model.gltf: the extension EXT_a is ignored");
    assert_eq!(said[4], "and 2 more: -v shows them all", "{}", run.stderr);
    let stats = place.json("a.json");
    let told = stats["warnings"].as_array().unwrap();
    assert_eq!(told.len(), 6, "{told:?}");
    assert_eq!(
        told[1],
        json!({
            "message": "the extension EXT_b is ignored", "places": [{ "file": "model.gltf" }], "hint": null, "count": 1
        })
    );
    for command in [&format!("{RENDER} -v"), "check model.gltf", "info model.gltf"] {
        let run = place.run(command).ends_with(0);
        let said = format!("{}{}", run.stderr, run.text());
        assert!(said.contains("EXT_d is ignored") && said.contains("of 2 scenes"), "{command}: {said}");
        assert!(said.contains("hint: `--scene 1` reads another"), "{command}: {said}");
    }
    let run = place.run(&format!("{RENDER} --strict")).ends_with(3);
    assert_eq!(run.stderr.matches("error: ").count(), 6, "{}", run.stderr);
    let run = place.run(&format!("{RENDER} -q")).ends_with(0);
    assert_eq!(run.stderr, "");
}

#[test]
fn cameras_and_scenes_are_chosen() {
    let place = Place::new();
    write_gltf(&place);
    let pixels = |args: &[&str]| {
        let output = place.command(RENDER).args(args).output().unwrap();
        assert!(output.status.success(), "{args:?}: {}", String::from_utf8_lossy(&output.stderr));
        crate::read_png(&place.read("a.png")).2
    };
    let first = pixels(&[]);
    for same in ["front door", "0"] {
        assert!(pixels(&["--camera", same]) == first, "{same}");
    }
    let (second, auto) = (pixels(&["--camera", "1"]), pixels(&["--camera=auto"]));
    assert!(pixels(&["--camera", "lens"]) == second && second != first && auto != first && auto != second);
    assert!(pixels(&["--scene", "bare"]) == auto, "the other scene has no camera");
    assert!(pixels(&["--scene", "whole"]) == first && pixels(&["--scene", "0"]) == first);
    let run = place.run(&format!("{RENDER} --camera back")).ends_with(3);
    let said = "error: there is no camera `back`\n  --> model.gltf\nhint: it has 0 `front door`, 1 `lens`\n";
    assert_eq!(run.stderr, said);
    let run = place.run("check model.gltf --scene none").ends_with(3);
    assert!(run.stderr.contains("it has 0 `whole`, 1 `bare`"), "{}", run.stderr);
    for args in ["--camera 1", "--scene 0", "--animation walk"] {
        let run = place.run(&format!("render scene.toml {args} -r 8x8 --spp 1")).ends_with(3);
        assert!(run.stderr.contains("this is a scene file"), "{}", run.stderr);
    }
    place.run("render scene.toml --camera auto -r 8x8 --spp 1").ends_with(0);
}

#[test]
fn files_outside_are_read_if_allowed() {
    let place = Place::new();
    write_changed(&place, |document| document["images"][0]["uri"] = json!("../color.png"));
    std::fs::create_dir(place.path("in")).unwrap();
    for name in ["model.gltf", "numbers.bin", "normal.png"] {
        std::fs::rename(place.path(name), place.path(&format!("in/{name}"))).unwrap();
    }
    let run = place.run("check in/model.gltf").ends_with(0);
    assert!(run.stderr.contains("leads out of the folder of the model"), "{}", run.stderr);
    assert!(run.stderr.contains("`--allow-outside`"), "{}", run.stderr);
    for command in ["check", "info", "render -r 8x8 --spp 1 -o a.png"] {
        let run = place.run(&format!("{command} in/model.gltf --allow-outside")).ends_with(0);
        assert!(!run.stderr.contains("leads out") && !run.text().contains("leads out"), "{}", run.stderr);
    }
}
