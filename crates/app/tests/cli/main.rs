//! The command as a user meets it: what it prints, writes and returns.

mod aov;
mod convert;
mod corpus;
mod determinism;
mod develop;
mod examples;
mod files;
mod gallery;
mod info;
mod made;
mod models;
mod output;
mod pictures;
mod report;
mod selftest;
#[cfg(unix)]
mod signals;
mod streams;
mod turntable;
mod usage;

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use serde_json::Value;
use tempfile::TempDir;

/// A scene that is neither dark nor uniform.
const SCENE: &str = "
[material.gold.metal]
roughness = 0.2
[[shape.sphere]]
radius = 1
material = \"gold\"
";

/// A folder with a scene in it, where commands run.
struct Place(TempDir);

impl Place {
    fn new() -> Self {
        let place = Self(tempfile::tempdir().unwrap());
        place.write("scene.toml", SCENE);
        place
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn write(&self, name: &str, text: &str) {
        fs::write(self.path(name), text).unwrap();
    }

    fn read(&self, name: &str) -> Vec<u8> {
        fs::read(self.path(name)).unwrap()
    }

    fn json(&self, name: &str) -> Value {
        serde_json::from_slice(&self.read(name)).unwrap()
    }

    /// Names and contents of all files.
    fn files(&self) -> Vec<(String, Vec<u8>)> {
        let mut files: Vec<_> = fs::read_dir(self.0.path())
            .unwrap()
            .map(|entry| entry.unwrap().path())
            .map(|path| (path.file_name().unwrap().to_string_lossy().into_owned(), fs::read(&path).unwrap_or_default()))
            .collect();
        files.sort();
        files
    }

    fn command(&self, args: &str) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_eyebeam"));
        command.current_dir(&self.0).args(args.split_whitespace());
        command.env_remove("COLUMNS").stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
        command
    }

    fn run(&self, args: &str) -> Run {
        Run::from(self.command(args).output().unwrap())
    }

    /// As [`run`](Self::run), for commands that say little; one that is not done in time is ended.
    fn run_within(&self, limit: Duration, args: &str) -> Run {
        let start = Instant::now();
        let mut child = self.command(args).spawn().unwrap();
        while child.try_wait().unwrap().is_none() {
            if start.elapsed() > limit {
                child.kill().unwrap();
                panic!("{args} still runs after {limit:?}");
            }
            sleep(Duration::from_millis(10));
        }
        Run::from(child.wait_with_output().unwrap())
    }

    fn run_with_input(&self, args: &str, input: &str) -> Run {
        let mut child = self.command(args).stdin(Stdio::piped()).spawn().unwrap();
        child.stdin.take().unwrap().write_all(input.as_bytes()).unwrap();
        Run::from(child.wait_with_output().unwrap())
    }
}

/// What a command did.
struct Run {
    code: Option<i32>,
    stdout: Vec<u8>,
    stderr: String,
}

impl From<Output> for Run {
    fn from(output: Output) -> Self {
        let stderr = String::from_utf8(output.stderr).unwrap();
        Self { code: output.status.code(), stdout: output.stdout, stderr }
    }
}

impl Run {
    #[track_caller]
    fn ends_with(self, code: i32) -> Self {
        assert_eq!(self.code, Some(code), "{}", self.stderr);
        assert!(!self.stderr.contains("panicked"), "{}", self.stderr);
        self
    }

    fn text(&self) -> &str {
        std::str::from_utf8(&self.stdout).unwrap()
    }
}

/// A PNG's size, bytes and provenance.
fn read_png(bytes: &[u8]) -> (u32, u32, Vec<u8>, Value) {
    let mut reader = png::Decoder::new(std::io::Cursor::new(bytes)).read_info().unwrap();
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    reader.next_frame(&mut pixels).unwrap();
    let info = reader.info();
    assert_eq!(info.srgb, Some(png::SrgbRenderingIntent::Perceptual));
    let text = info.utf8_text.iter().find(|t| t.keyword == "eyebeam").unwrap().get_text().unwrap();
    (info.width, info.height, pixels, serde_json::from_str(&text).unwrap())
}

fn scenes() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes")
}
