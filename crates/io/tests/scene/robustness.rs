//! Whatever the bytes: a scene or an error with a place, soon.

use std::time::{Duration, Instant};

use eyebeam_io::Error;
use eyebeam_io::scene::read_str;
use proptest::prelude::*;

use crate::places;

const SCENE: &str = r##"
[render]
width = 32
seed = 7
integrator = "weekend"
[camera]
look_from = [0, 1, 5.5e0]
look_at = [0, 0.5, 0]
[environment.gradient]
top = "#80b0ff"
[material."é 1".metal]
albedo = [0.9, 0.7, 0.3]
[material.glass.dielectric]
[[shape.sphere]]
center = [-1.1, 0.5, 0]
radius = 0.5
material = "é 1"
motion = [{ time = 0 }, { time = 1, offset = [1, 0, 0], rotation = { axis = [0, 1, 0], angle = 90 }, scale = 2 }]
[[shape.mesh]]
vertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]
triangles = [[0, 1, 2]]
"##;

/// Each mistake has a place in the text.
fn try_scene(text: &str) {
    let start = Instant::now();
    if let Err(error) = read_str("a.toml", text, &[]) {
        let said = error.to_string();
        let Error::Scene(mut found) = error else { panic!("{error}") };
        found.retain(|p| !p.message.starts_with("these are the first"));
        assert!(!found.is_empty());
        let lines: Vec<_> = text.split('\n').collect();
        for (line, column) in places(&found) {
            let there = lines.get(line.wrapping_sub(1)).is_some_and(|l| (1..=l.chars().count() + 1).contains(&column));
            assert!(there, "{line}:{column} of\n{text}\n{said}");
        }
    }
    assert!(start.elapsed() < Duration::from_secs(20), "{:?}", start.elapsed());
}

#[test]
fn truncated() {
    read_str("a.toml", SCENE, &[]).unwrap();
    for end in (0..SCENE.len()).filter(|&i| SCENE.is_char_boundary(i)) {
        try_scene(&SCENE[..end]);
    }
}

/// As many keys as one likes, if the shutter is not open for too many.
#[test]
fn thousands_of_keys() {
    let scene = |keys: u32| {
        let keys: Vec<_> = (0..keys).map(|i| format!("{{ time = {i}, offset = [0, {}, 0] }}", i % 2)).collect();
        format!("[render]\nshutter = [0, 1e9]\n[[shape.sphere]]\nradius = 1\nmotion = [{}]", keys.join(","))
    };
    read_str("a.toml", &scene(10_000), &[]).unwrap();
    let error = read_str("a.toml", &scene(10_002), &[]).unwrap_err().to_string();
    assert!(error.contains("10001 straight pieces") && error.contains("a.toml:5"), "{error}");
    read_str("a.toml", &scene(30_000).replace("1e9", "100"), &[]).unwrap();
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 3000,
        failure_persistence: None,
        rng_seed: prop::test_runner::RngSeed::Fixed(1),
        ..ProptestConfig::default()
    })]

    #[test]
    fn with_some_characters_changed(changes in prop::collection::vec((0..SCENE.len(), any::<u8>()), 1..6)) {
        let mut bytes = SCENE.as_bytes().to_vec();
        for (at, byte) in changes {
            bytes[at] = byte;
        }
        try_scene(&String::from_utf8_lossy(&bytes));
    }

    #[test]
    fn with_values_changed(line in 0..20_usize, value in "[\\[\\]{}\"'=.,#a1e+nif -]{0,12}") {
        let mut lines: Vec<_> = SCENE.lines().map(str::to_owned).collect();
        let key = lines[line].split('=').next().unwrap_or_default().to_owned();
        lines[line] = format!("{key}={value}");
        try_scene(&lines.join("\n"));
    }
}

#[test]
fn deep() {
    let n = 100_000;
    let keys = vec!["a"; n].join(".");
    for text in [
        format!("a = {}", "[".repeat(n)),
        format!("a = {}{}", "[".repeat(n), "]".repeat(n)),
        format!("a = {}", "{a=".repeat(n)),
        format!("{keys} = 1"),
        format!("[{keys}]"),
        format!("[[{keys}]]"),
        format!("[[{keys}]]\n{keys} = 1"),
        "[".repeat(n),
        "[[a]]\n".repeat(n),
    ] {
        try_scene(&text);
    }
    // As deep as the format goes: 79 tables of 79 keys each.
    let keys = vec!["a"; 79].join(".");
    for root in ["", "material.", "shape.", "camera."] {
        let text = (0..79).fold("1".to_owned(), |inner, _| format!("{{{keys}={inner}}}"));
        try_scene(&format!("{root}a={text}"));
    }
}

#[test]
fn long() {
    let n = 1_000_000;
    for text in [
        format!("{} = 1", "x".repeat(n)),
        format!("[material.{}.lambertain]", "x".repeat(n)),
        format!("[material.x.{}]", "x".repeat(n)),
        format!("[[shape.sphere]]\nradius = 1\nmaterial = \"{}\"", "é".repeat(n)),
        format!("[[shape.sphere]]\nradius = {}", "1".repeat(n)),
        format!("[[shape.sphere]]\nradius = 1.{}", "1".repeat(n)),
        format!("[render]\nspp = {}", "1".repeat(n)),
        format!("# {}", "é".repeat(n)),
        format!("a = [{}]", "1,".repeat(n)),
        "[[shape.sphere]]\nradius = true\n".repeat(10_000),
        "[[shape.sphere]]\nradius = -1\n".repeat(10_000),
    ] {
        try_scene(&text);
    }
}

#[test]
fn odd_numbers() {
    for number in [
        "1e400",
        "-1e400",
        "1e-400",
        "-0",
        "-0.0",
        "+nan",
        "-inf",
        "0x7fffffffffffffff",
        "1_0",
        "1e+3",
        "9223372036854775807",
        "9223372036854775808",
        "-9223372036854775809",
        "18446744073709551616",
        "1979-05-27",
    ] {
        for key in [
            "[render]\nseed",
            "[render]\nwidth",
            "[camera]\nvfov",
            "[camera]\naperture",
            "[[shape.sphere]]\nradius",
            "[material.m.lambertian]\nalbedo",
            "[material.m.dielectric]\neta",
        ] {
            try_scene(&format!("{key} = {number}"));
            try_scene(&format!("{key} = [{number}, {number}, {number}]"));
        }
    }
}
