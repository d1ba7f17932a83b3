//! The command `eyebeam`.

fn main() -> std::process::ExitCode {
    eyebeam::run(std::env::args_os())
}
