//! The same command makes the same bits.

use std::fs;

use crate::{Place, read_png, scenes};

#[test]
fn files_do_not_depend_on_threads_or_time() {
    let place = Place::new();
    let looks = [
        ("png", ""),
        ("png", "--view agx --exposure auto --white-balance 4000 --dither"),
        ("png", "--view aces --contrast 1.2 --saturation 0.8 --bits 16"),
        ("jpg", "--view filmic --dither"),
        ("exr", ""),
        ("exr", "--half"),
        ("hdr", ""),
    ];
    for (format, look) in looks {
        let render = |name: &str, args: &str| {
            let command = format!("render scene.toml -q -r 70x40 --spp 20 -o {name}.{format} {look} {args}");
            place.run(&command).ends_with(0);
            place.read(&format!("{name}.{format}"))
        };
        let first = render("a", "--threads 1");
        for args in
            ["--threads 1", "--threads 2", "--threads 7", "", "--threads 100000", "--progress json --stats s.json"]
        {
            assert!(render("b", args) == first, "{format} {look} {args}");
        }
        assert!(render("c", "--seed 1") != first, "{format} {look}: another seed is another picture");
    }
}

#[test]
fn another_seed_is_other_noise() {
    let place = Place::new();
    let pixels = |seed: &str| {
        let run = place.run(&format!("render scene.toml -q -r 70x40 --spp 2 -o - --seed {seed}")).ends_with(0);
        read_png(&run.stdout).2
    };
    assert!(pixels("0") == pixels("0") && pixels("0") != pixels("1"));
    assert!(pixels("0") != pixels("18446744073709551615"));
}

#[test]
fn every_scene_of_the_repository_renders() {
    let place = Place::new();
    let mut count = 0;
    for entry in fs::read_dir(scenes()).unwrap() {
        let scene = entry.unwrap().path();
        if scene.extension().is_none_or(|e| e != "toml") {
            continue;
        }
        count += 1;
        let mut command = place.command("render -q -r 32x18 --spp 4 -o a.png");
        let run = crate::Run::from(command.arg(&scene).output().unwrap()).ends_with(0);
        assert!(run.stderr.is_empty());
        let (.., pixels, _) = read_png(&place.read("a.png"));
        assert!(pixels.iter().any(|&p| p > 10), "{} is black", scene.display());
    }
    assert!(count > 0);
}
