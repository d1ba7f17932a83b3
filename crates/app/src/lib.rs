//! What talks to a person: the command line, progress, reports.
#![forbid(unsafe_code)]

mod args;
mod command;
mod error;
mod limits;
mod progress;
mod signals;

use std::ffi::OsString;
use std::io::Write;
use std::process::ExitCode;

use clap::Parser;

/// Runs the command line `args`, the program's name first; returns its exit code.
///
/// 0 done · 1 internal · 2 usage · 3 scene invalid · 4 file missing, unreadable, unwritable · 5 memory ·
/// 130 SIGINT · 143 SIGTERM.
pub fn run(args: impl IntoIterator<Item = OsString>) -> ExitCode {
    let args = match args::Args::try_parse_from(args) {
        Ok(args) => args,
        Err(e) => {
            // Help goes to standard output, mistakes to standard error; nothing helps if that is closed.
            let _ = e.print();
            return ExitCode::from(e.exit_code().clamp(0, 255) as u8);
        }
    };
    // A bug has printed its message by then.
    match std::panic::catch_unwind(|| command::run(args)) {
        Ok(Ok(())) => ExitCode::SUCCESS,
        Ok(Err(error)) => {
            if let Some(message) = error.message() {
                let _ = writeln!(std::io::stderr(), "{message}");
            }
            ExitCode::from(error.exit_code())
        }
        Err(_) => ExitCode::from(error::INTERNAL),
    }
}
