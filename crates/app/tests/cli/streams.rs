//! Standard output is data, standard error is talk.

use std::fs::File;
use std::process::Stdio;

use serde_json::Value;

use crate::{Place, Run, SCENE, read_png};

#[test]
fn picture_on_standard_output() {
    let place = Place::new();
    let before = place.files();
    let run = place.run_with_input("render - -o - -r 32x18 --spp 1", SCENE).ends_with(0);
    let (width, height, ..) = read_png(&run.stdout);
    assert_eq!((width, height), (32, 18));
    assert!(run.stdout.ends_with(b"IEND\xaeB`\x82"), "something follows the picture");
    assert!(place.files() == before);
}

#[test]
fn quiet_says_nothing() {
    let place = Place::new();
    let run = place.run("render scene.toml -q -r 32x18 --spp 1").ends_with(0);
    assert!(run.stdout.is_empty() && run.stderr.is_empty(), "{}", run.stderr);
    let run = place.run("render scene.toml -r 32x18 --spp 1").ends_with(0);
    assert!(run.stdout.is_empty() && run.stderr.starts_with("scene.png: 32 x 18 · 1 spp · "), "{}", run.stderr);
    let run = place.run("render scene.toml -v -r 32x18 --spp 1 --threads 3").ends_with(0);
    assert!(run.stderr.starts_with("1 primitives · 32 x 18 · 1 spp · 3 threads\n"), "{}", run.stderr);
}

#[test]
fn a_pipe_gets_no_escape_codes() {
    let place = Place::new();
    for args in
        ["render scene.toml -r 32x18 --progress bar", "render scene.toml --foo", "--help", "render missing.toml"]
    {
        let run = place.run(args);
        assert!(!run.stderr.contains('\x1b') && !run.stdout.contains(&0x1b), "{args}: {}", run.stderr);
    }
}

#[test]
fn progress_for_programs() {
    let place = Place::new();
    let run = place.run("render scene.toml -q --progress json -r 32x18 --spp 40").ends_with(0);
    let lines: Vec<Value> = run.stderr.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    for line in &lines {
        assert!(line["t"].is_f64() && line["spp"].is_u64() && line["phase"] == "render", "{line}");
        assert!(line["eta_s"].is_f64() && line["of"] == 40 && line.get("error").is_some(), "{line}");
    }
    let last = lines.last().unwrap();
    assert_eq!((&last["spp"], &last["eta_s"]), (&40.into(), &0.0.into()));
}

#[test]
fn stats() {
    let place = Place::new();
    let run = place.run("render scene.toml -r 32x18 --spp 20 --seed 5 --threads 2 --stats -").ends_with(0);
    let stats: Value = serde_json::from_slice(&run.stdout).unwrap();
    assert_eq!(stats["schema"], "eyebeam-render-1");
    assert_eq!(stats["version"], env!("CARGO_PKG_VERSION"));
    assert_eq!(stats["scene"], "scene.toml");
    assert_eq!(stats["scene_hash"].as_str().unwrap().len(), 64);
    let settings = serde_json::json!({
        "width": 32, "height": 18, "spp": 20, "max_depth": 50, "seed": 5, "integrator": "path", "sampler": "sobol",
        "filter": {"blackman-harris": {"radius": 1.5}}, "light_selection": "tree", "transparent": false, "clamp": 0.0,
        "shutter": [0.0, 1.0]
    });
    assert_eq!(stats["settings"], settings);
    let look = serde_json::json!({
        "view": "agx", "bloom": 0.0, "vignette": 0.0, "exposure": 0.0, "white_balance": 6500.0, "contrast": 1.0,
        "saturation": 1.0, "dither": false
    });
    assert_eq!(stats["look"], look);
    assert_eq!(stats["spp"], serde_json::json!({"min": 20, "mean": 20.0, "max": 20}));
    assert_eq!(stats["stop_reason"], "spp");
    assert!((0.0..1.0).contains(&stats["error"]["mean"].as_f64().unwrap()));
    assert!(stats["error"]["p95"].as_f64() > stats["error"]["mean"].as_f64());
    assert_eq!((&stats["nan_count"], &stats["clamped_energy"], &stats["threads"]), (&0.into(), &0.0.into(), &2.into()));
    assert_eq!(stats["aov"], serde_json::json!({"names": [], "through": false, "spp": 0}));
    for phase in ["load", "build", "aov", "render", "write"] {
        assert!(stats["seconds"][phase].as_f64().unwrap() >= 0.0);
    }
    assert!(stats["rays"].as_u64().unwrap() >= 32 * 18 * 20 && stats["rays_per_s"].as_f64().unwrap() > 0.0);
    assert!(!cfg!(target_os = "linux") || stats["peak_rss_bytes"].as_u64().unwrap() > 1 << 20);
    assert_eq!(stats["warnings"], serde_json::json!([]));
}

#[test]
fn memory_that_was_asked_for_is_enough() {
    let place = Place::new();
    let peak = |args: &str| {
        let run = place.run(&format!("render scene.toml -q --spp 2 --max-depth 3 --stats - {args}")).ends_with(0);
        serde_json::from_slice::<Value>(&run.stdout).unwrap()["peak_rss_bytes"].as_u64().unwrap_or(0)
    };
    let least = peak("-r 1x1");
    for output in ["a.png", "a.png --bits 16 --exposure auto", "a.jpg", "a.exr", "a.exr --half", "a.hdr"] {
        let used = peak(&format!("-r 1000x1000 -o {output}")).saturating_sub(least);
        assert!(used <= 124_000_000, "{output}: {used} bytes, and 124 a pixel were foreseen");
    }
    place.run("render scene.toml -r 1000x1000 --memory 123999999").ends_with(5);
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_device_ends_with_4() {
    let place = Place::new();
    for args in
        ["render scene.toml -q -r 32x18 --spp 1 -o -", "render scene.toml -q -r 32x18 --spp 1 --stats -", "schema"]
    {
        let full = File::options().write(true).open("/dev/full").unwrap();
        let run = Run::from(place.command(args).stdout(full).output().unwrap()).ends_with(4);
        assert!(run.stderr.starts_with("error: cannot write to standard output: "), "{}", run.stderr);
    }
}

#[test]
fn closed_streams_are_no_panic() {
    let place = Place::new();
    let mut child = place.command("schema").spawn().unwrap();
    drop(child.stdout.take());
    assert!(matches!(child.wait().unwrap().code(), Some(0 | 4)));
    let mut child = place.command("render scene.toml -v -r 32x18 --spp 1").spawn().unwrap();
    drop(child.stderr.take());
    assert_eq!(child.wait().unwrap().code(), Some(0), "nobody listens, and the picture is there");
    assert!(place.path("scene.png").exists());
    place.command("render scene.toml").stderr(Stdio::null()).arg("--spp=0").status().unwrap();
}
