//! The picture file that a command writes: its name, its format, and how that is used.

use std::path::PathBuf;

use eyebeam_io::image::{Bits, Encoding, ImageFormat};
use eyebeam_io::output::check_writable;

use crate::command::is_standard;
use crate::error::Error;

/// Where a picture goes.
pub(super) struct Target {
    pub(super) path: PathBuf,
    pub(super) format: ImageFormat,
    pub(super) encoding: Encoding,
}

impl Target {
    /// The file of this name, or standard output, which gets a PNG.
    pub(super) fn new(path: PathBuf, encoding: Encoding) -> Result<Self, Error> {
        let format = if is_standard(&path) { ImageFormat::Png } else { ImageFormat::from_path(&path)? };
        let target = Self { path, format, encoding };
        if target.encoding.bits == Bits::Sixteen && format != ImageFormat::Png {
            return Err(target.unfit("--bits 16 needs a PNG", "is not", ".png"));
        }
        if target.encoding.half && format != ImageFormat::Exr {
            return Err(target.unfit("--half needs an OpenEXR picture", "is not", ".exr"));
        }
        Ok(target)
    }

    /// That the format takes a picture of this size, with alpha if it is transparent.
    pub(super) fn check_picture(&self, width: u32, height: u32, transparent: bool) -> Result<(), Error> {
        if transparent && self.format == ImageFormat::Hdr {
            return Err(self.unfit("a transparent picture needs alpha", "cannot hold", ".png or .exr"));
        }
        if width.max(height) > self.format.max_side() {
            let why = format!("a picture of {width} x {height} needs longer sides");
            return Err(self.unfit(&why, "cannot have", ".png or .exr"));
        }
        Ok(())
    }

    /// The memory that the look's lens takes for each pixel, bytes.
    pub(super) fn lens_bytes(&self) -> u64 {
        if self.format.is_for_screens() { self.encoding.look.lens_bytes() } else { 0 }
    }

    /// That a file of this name can be written.
    pub(super) fn check_writable(&self) -> Result<(), Error> {
        if is_standard(&self.path) { Ok(()) } else { Ok(check_writable(&self.path)?) }
    }

    /// Why the file is the wrong one, and the ending that helps.
    pub(super) fn unfit(&self, why: &str, what: &str, ending: &str) -> Error {
        let path = self.path.display();
        Error::Usage(format!("{why}, which `{path}` {what}\nhint: name it in {ending} (-o)"))
    }
}
