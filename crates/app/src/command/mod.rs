//! The commands, each a file.

mod check;
mod develop;
mod figures;
mod render;
mod schema;
mod selftest;
mod setup;
mod target;

use std::io::{Write, stdout};
use std::path::Path;

use eyebeam_io::scene::SceneFile;

use crate::args::{Args, Command};
use crate::error::Error;
use crate::progress::say;

pub(crate) fn run(args: Args) -> Result<(), Error> {
    match args.command {
        Command::Render(args) => render::run(&args),
        Command::Develop(args) => develop::run(&args),
        Command::Check(args) => check::run(&args),
        Command::Schema => schema::run(),
        Command::Figures(args) => figures::run(&args),
        Command::Selftest => selftest::run(),
    }
}

/// Says of a scene, if asked to, what is worth a word; if `strict`, that is an error.
fn told(file: SceneFile, strict: bool, quiet: bool) -> Result<SceneFile, Error> {
    if strict && !file.warnings.is_empty() {
        let errors = file.warnings.into_iter().map(Into::into).collect();
        return Err(eyebeam_io::Error::Scene(errors).into());
    }
    file.warnings.iter().filter(|_| !quiet).for_each(|warning| say(&warning.to_string()));
    Ok(file)
}

/// Whether a name stands for standard input or output.
fn is_standard(path: &Path) -> bool {
    path == Path::new("-")
}

/// Writes bytes to a file, or to standard output for `-`.
fn write(path: &Path, bytes: &[u8]) -> Result<(), Error> {
    if is_standard(path) {
        let mut out = stdout().lock();
        return out.write_all(bytes).and_then(|()| out.flush()).map_err(Error::Stdout);
    }
    Ok(eyebeam_io::output::write_atomic(path, bytes)?)
}
