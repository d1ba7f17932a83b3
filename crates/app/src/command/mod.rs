//! The commands, each a file.

mod check;
mod convert;
mod develop;
mod figures;
mod info;
mod render;
mod report;
mod schema;
mod selftest;
mod setup;
mod target;
mod turntable;

use std::io::{Write, stdout};
use std::path::Path;

use crate::args::{Args, Command};
use crate::error::Error;

pub(crate) fn run(args: Args) -> Result<(), Error> {
    match args.command {
        Command::Render(args) => render::run(&args),
        Command::Turntable(args) => turntable::run(&args),
        Command::Develop(args) => develop::run(&args),
        Command::Check(args) => check::run(&args),
        Command::Convert(args) => convert::run(&args),
        Command::Info(args) => info::run(&args),
        Command::Schema => schema::run(),
        Command::Figures(args) => figures::run(&args),
        Command::Selftest => selftest::run(),
    }
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
