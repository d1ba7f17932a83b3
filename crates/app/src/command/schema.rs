//! `eyebeam schema`: the JSON Schema of scene files.

use std::path::Path;

use crate::error::Error;

pub(super) fn run() -> Result<(), Error> {
    super::write(Path::new("-"), format!("{:#}\n", eyebeam_io::scene::schema()).as_bytes())
}
