//! Asked to stop, a render writes what it has; asked twice, it leaves.

use std::io::{BufRead, BufReader, Read};
use std::process::{Child, ChildStderr, Command};
use std::thread::sleep;
use std::time::{Duration, Instant};

use crate::aov::{names, read_exr};
use crate::{Place, read_png};

/// Would take days.
const LONG: &str = "render scene.toml -q --progress json -o a.png -r 64x36 --spp 16777216";

/// A render that has begun.
struct Running {
    child: Child,
    stderr: BufReader<ChildStderr>,
}

impl Running {
    /// Waits for the first line of progress: from then on, signals are listened to.
    fn start(place: &Place, args: &str) -> Self {
        let mut child = place.command(args).spawn().unwrap();
        let mut stderr = BufReader::new(child.stderr.take().unwrap());
        let mut line = String::new();
        stderr.read_line(&mut line).unwrap();
        assert!(line.starts_with('{'), "{line}");
        Self { child, stderr }
    }

    fn send(&self, signal: &str) {
        let status = Command::new("sh").arg("-c").arg(format!("kill -{signal} {}", self.child.id())).status();
        assert!(status.unwrap().success());
    }

    fn is_running(&mut self) -> bool {
        self.child.try_wait().unwrap().is_none()
    }

    /// Waits for the end; returns what was said.
    fn ends_with(mut self, code: i32) -> String {
        let (start, mut said) = (Instant::now(), String::new());
        while self.is_running() && start.elapsed() < Duration::from_secs(30) {
            sleep(Duration::from_millis(10));
        }
        let _ = self.child.kill();
        self.stderr.read_to_string(&mut said).unwrap();
        assert_eq!(self.child.wait().unwrap().code(), Some(code), "{said}");
        said
    }
}

#[test]
fn stop_leaves_a_picture() {
    for (signal, code) in [("INT", 130), ("TERM", 143)] {
        let place = Place::new();
        let render = Running::start(&place, &format!("{LONG} --stats a.json"));
        render.send(signal);
        render.ends_with(code);
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
fn stop_leaves_channels() {
    let place = Place::new();
    let render = Running::start(&place, &format!("{LONG} --aov depth").replace("a.png", "a.exr"));
    render.send("INT");
    render.ends_with(130);
    assert_eq!(names(&read_exr(&place.read("a.exr"))), ["A", "B", "G", "R", "Z"]);
}

#[test]
fn a_second_signal_leaves_at_once() {
    let place = Place::new();
    // Light that never gets out: one block of this takes hours.
    place.write(
        "scene.toml",
        "[material.white.lambertian]\nalbedo = 1\n[[shape.sphere]]\nradius = 100\nmaterial = \"white\"",
    );
    let mut render = Running::start(&place, &format!("{LONG} --max-depth 1000000"));
    render.send("INT");
    sleep(Duration::from_millis(300));
    assert!(render.is_running(), "the block was finished: the test is too easy");
    render.send("INT");
    render.ends_with(130);
    assert_eq!(place.files().len(), 1, "no picture, and nothing beside");
}

#[test]
fn a_look_at_it_does_not_stop_it() {
    let place = Place::new();
    let mut render = Running::start(&place, LONG);
    let mut last = 0;
    for signal in ["USR1", "HUP"] {
        render.send(signal);
        let start = Instant::now();
        while !place.path("a.png").exists() {
            assert!(start.elapsed() < Duration::from_secs(30), "no picture came");
            sleep(Duration::from_millis(20));
        }
        let (.., provenance) = read_png(&place.read("a.png"));
        let spp = provenance["spp"]["max"].as_u64().unwrap();
        assert!(spp > last, "{spp} samples after {last}");
        assert!(provenance["error"]["mean"].as_f64().unwrap() > 0.0);
        last = spp;
        std::fs::remove_file(place.path("a.png")).unwrap();
        assert!(render.is_running(), "it ended");
        sleep(Duration::from_millis(100));
    }
    render.send("TERM");
    render.ends_with(143);
    assert!(place.path("a.png").exists());
}

#[test]
fn a_look_that_cannot_be_written_does_not_stop_it() {
    let place = Place::new();
    let folder = place.path("folder");
    std::fs::create_dir(&folder).unwrap();
    let render = Running::start(&place, &LONG.replace("a.png", "folder/a.png"));
    std::fs::remove_dir(&folder).unwrap();
    render.send("USR1");
    sleep(Duration::from_millis(300));
    std::fs::create_dir(&folder).unwrap();
    render.send("INT");
    let said = render.ends_with(130);
    assert!(said.contains("error: cannot write `folder/a.png`"), "{said}");
    assert!(folder.join("a.png").exists());
}
