//! `eyebeam convert`: any scene or model to a scene file that makes the same picture.

use std::path::Path;

use eyebeam_core::look::{Exposure, Look, View};
use eyebeam_io::scene::{WriteOptions, Written, check_unwritten, read_with, write};

use crate::args::ConvertArgs;
use crate::command::report::{self, Talk};
use crate::command::{is_standard, setup};
use crate::error::Error;
use crate::progress::say;

pub(super) fn run(args: &ConvertArgs) -> Result<(), Error> {
    let is_toml = args.output.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("toml"));
    if !is_toml || is_standard(&args.output) {
        let named = args.output.display();
        return Err(Error::Usage(format!("`{named}` is no scene file\nhint: end its name in .toml")));
    }
    check_unwritten(&args.output, args.force)?;
    let mut file = read_with(&args.scene, &args.setup.options(&args.model, &args.set))?;
    let render = &mut file.desc.render;
    (render.width, render.height) = args.resolution.unwrap_or((render.width, render.height));
    let assumed = setup::complete(&mut file, &args.setup)?;
    let file = report::say_of(file, args.strict, Talk::new(args.quiet, args.verbose))?;
    let name = Path::new(args.scene.file_name().unwrap_or_default());
    let comment = format!("Converted from {} by Eyebeam {}", name.display(), env!("CARGO_PKG_VERSION"));
    let options = WriteOptions { force: args.force, comment: &comment };
    let Written { folder, files } = write(&file.desc, &args.output, &options)?;
    if args.quiet {
        return Ok(());
    }
    setup::say_of(&assumed);
    let beside = if files == 0 { String::new() } else { format!(" · {files} files in {}", folder.display()) };
    say(&format!("{}{beside}", args.output.display()));
    let look = setup::look_of(Look { view: View::FOR_PICTURES, ..Look::default() }, file.given, &assumed);
    if look.view != View::FOR_PICTURES {
        say(&format!("render it with `--view {}`, as the model would be", look.view.name()));
    }
    if look.exposure == Exposure::Auto {
        say("its light is of any brightness: render it with `--exposure auto`, as the model would be");
    }
    Ok(())
}
