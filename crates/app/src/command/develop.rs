//! `eyebeam develop`: a picture of linear light to any other, with a look.

use eyebeam_io::image::{LinearPicture, read_linear};

use crate::args::DevelopArgs;
use crate::command::target::Target;
use crate::command::write;
use crate::error::Error;
use crate::progress::say;

pub(super) fn run(args: &DevelopArgs) -> Result<(), Error> {
    let target = Target::new(args.output.clone(), args.look.encoding())?;
    target.check_writable()?;
    let LinearPicture { image, provenance, warnings } = read_linear(&args.picture)?;
    target.check_picture(image.width(), image.height(), image.alpha().is_some())?;
    warnings.iter().filter(|_| !args.quiet).for_each(|warning| say(&warning.to_string()));
    let provenance = provenance.unwrap_or_else(|| of_unknown_origin(args));
    write(&target.path, &target.format.encode(&image, &provenance, &target.encoding)?)?;
    if !args.quiet {
        say(&format!("{}: {} x {}", target.path.display(), image.width(), image.height()));
    }
    Ok(())
}

/// What is known of a picture that does not say what made it.
fn of_unknown_origin(args: &DevelopArgs) -> String {
    let picture = args.picture.display().to_string();
    serde_json::json!({"schema": "eyebeam-develop-1", "version": env!("CARGO_PKG_VERSION"), "picture": picture})
        .to_string()
}
