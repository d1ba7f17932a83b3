//! `eyebeam figures`: the pictures and numbers of a study, from scenes and code alone.
//!
//! Each figure is a file here: it renders, measures, and writes a PNG and the numbers in it as CSV.

mod complexity;
mod depth;
mod fit;
mod page;
mod plot;
mod probe;
mod roughness;
mod samples;
mod sheet;
mod table;
mod timing;

use std::fs::create_dir_all;
use std::path::Path;

use eyebeam_core::desc::SceneDesc;
use eyebeam_core::film::Image;
use eyebeam_core::render::{Monitor, Render, Settings};
use eyebeam_core::scene::Scene;
use eyebeam_core::validate::Problem;
use eyebeam_io::Error::Io;
use eyebeam_io::output::{check_writable, write_atomic};
use table::Table;

use crate::args::{FiguresArgs, Study as StudyName};
use crate::error::Error;
use crate::progress::say;

/// Makes one figure.
type Figure = fn(&Study<'_>) -> Result<(), Error>;

/// The figures of the paper, by the names of their files.
const PAPER: [(&str, Figure); 4] = [
    (samples::NAME, samples::make),
    (depth::NAME, depth::make),
    (roughness::NAME, roughness::make),
    (complexity::NAME, complexity::make),
];

pub(super) fn run(args: &FiguresArgs) -> Result<(), Error> {
    let study = Study { output: &args.output, quick: args.quick, quiet: args.quiet };
    let figures = match args.study {
        StudyName::Paper => PAPER,
    };
    create_dir_all(study.output).map_err(|source| Io { action: "write", path: study.output.to_owned(), source })?;
    for (name, _) in figures {
        check_writable(&study.output.join(name).with_extension("png"))?;
    }
    figures.iter().try_for_each(|(_, make)| make(&study))
}

/// Where the figures go, and how large they are.
struct Study<'a> {
    output: &'a Path,
    quick: bool,
    quiet: bool,
}

impl Study<'_> {
    /// The first for the real figures, the second for quick ones.
    fn pick<T>(&self, full: T, quick: T) -> T {
        if self.quick { quick } else { full }
    }

    fn say(&self, line: &str) {
        if !self.quiet {
            say(line);
        }
    }

    /// Writes a figure and its numbers.
    fn write(&self, name: &str, png: &[u8], table: &Table) -> Result<(), Error> {
        for (ending, bytes) in [("png", png), ("csv", table.to_csv().as_bytes())] {
            let path = self.output.join(name).with_extension(ending);
            write_atomic(&path, bytes)?;
            self.say(&format!("{}", path.display()));
        }
        Ok(())
    }
}

/// A scene of the repository.
fn scene(name: &str, text: &str) -> Result<SceneDesc, Error> {
    Ok(eyebeam_io::scene::read_str(name, text, &[])?.desc)
}

fn build(desc: &SceneDesc) -> Result<Scene, Error> {
    Scene::build(desc).map_err(refused)
}

fn refused(mut problems: Vec<Problem>) -> Error {
    Error::Scene(problems.remove(0))
}

/// Renders to the end, watched by `monitor`.
fn finished<'s>(scene: &'s Scene, settings: Settings, monitor: &Monitor) -> Render<'s> {
    let mut render = Render::new(scene, settings);
    render.finish(monitor);
    render
}

fn render(scene: &Scene, settings: Settings) -> Image {
    finished(scene, settings, &Monitor::default()).film().develop()
}
