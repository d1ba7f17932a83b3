//! Asked to stop, a render writes what it has; asked twice, it leaves.

use std::process::{Child, Command};
use std::thread::sleep;
use std::time::{Duration, Instant};

use crate::{Place, Run, read_png};

/// Would take days.
const LONG: &str = "render scene.toml -q --progress json -o a.png -r 64x36 --spp 16777216";

fn send(signal: &str, child: &Child) {
    let status = Command::new("sh").arg("-c").arg(format!("kill -{signal} {}", child.id())).status();
    assert!(status.unwrap().success());
}

/// A render that has begun: it waits for the signals' handlers, which nothing shows, and for samples.
fn begin(place: &Place, args: &str) -> Child {
    let child = place.command(args).spawn().unwrap();
    sleep(Duration::from_millis(700));
    child
}

fn end(child: Child) -> Run {
    let start = Instant::now();
    let run = Run::from(child.wait_with_output().unwrap());
    assert!(start.elapsed() < Duration::from_secs(10), "it took {:?} to end", start.elapsed());
    run
}

#[test]
fn stop_leaves_a_picture() {
    for (signal, code) in [("INT", 130), ("TERM", 143)] {
        let place = Place::new();
        let child = begin(&place, &format!("{LONG} --stats a.json"));
        send(signal, &child);
        end(child).ends_with(code);
        let (width, height, pixels, provenance) = read_png(&place.read("a.png"));
        assert_eq!((width, height), (64, 36));
        assert!(pixels.iter().any(|&p| p > 0));
        let stats = place.json("a.json");
        assert_eq!(stats["stop_reason"], "signal");
        assert_eq!(stats["spp"], provenance["spp"]);
        let (min, max) = (stats["spp"]["min"].as_u64().unwrap(), stats["spp"]["max"].as_u64().unwrap());
        assert!(min > 0 && max < 16_777_216 && max - min <= 16, "{min} to {max}");
        assert_eq!(place.files().len(), 3, "nothing is left beside");
    }
}

#[test]
fn a_second_signal_leaves_at_once() {
    let place = Place::new();
    // Light that never gets out: one block of this takes hours.
    place.write(
        "scene.toml",
        "[material.white.lambertian]\nalbedo = 1\n[[shape.sphere]]\nradius = 100\nmaterial = \"white\"",
    );
    let mut child = begin(&place, &format!("{LONG} --max-depth 1000000"));
    send("INT", &child);
    sleep(Duration::from_millis(300));
    assert!(child.try_wait().unwrap().is_none(), "the block was finished: the test is too easy");
    send("INT", &child);
    end(child).ends_with(130);
    assert_eq!(place.files().len(), 1, "no picture, and nothing beside");
}

#[test]
fn a_look_at_it_does_not_stop_it() {
    let place = Place::new();
    let mut child = begin(&place, LONG);
    let mut last = 0;
    for signal in ["USR1", "HUP"] {
        send(signal, &child);
        let start = Instant::now();
        while !place.path("a.png").exists() {
            assert!(start.elapsed() < Duration::from_secs(10), "no picture came");
            sleep(Duration::from_millis(20));
        }
        let (.., provenance) = read_png(&place.read("a.png"));
        let spp = provenance["spp"]["max"].as_u64().unwrap();
        assert!(spp > last, "{spp} samples after {last}");
        assert!(provenance["error"]["mean"].as_f64().unwrap() > 0.0);
        last = spp;
        std::fs::remove_file(place.path("a.png")).unwrap();
        assert!(child.try_wait().unwrap().is_none(), "it ended");
        sleep(Duration::from_millis(100));
    }
    send("TERM", &child);
    end(child).ends_with(143);
    assert!(place.path("a.png").exists());
}

#[test]
fn a_look_that_cannot_be_written_does_not_stop_it() {
    let place = Place::new();
    let folder = place.path("folder");
    std::fs::create_dir(&folder).unwrap();
    let child = begin(&place, &LONG.replace("a.png", "folder/a.png"));
    std::fs::remove_dir(&folder).unwrap();
    send("USR1", &child);
    sleep(Duration::from_millis(300));
    std::fs::create_dir(&folder).unwrap();
    send("INT", &child);
    let run = end(child).ends_with(130);
    assert!(run.stderr.contains("error: cannot write `folder/a.png`"), "{}", run.stderr);
    assert!(folder.join("a.png").exists());
}
