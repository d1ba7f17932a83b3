//! The pictures of textures. Each file is read once and shared, however it is looked up, and all are decoded at the same
//! time.
//!
//! Files are read, and their headers looked at, one after the other, so that the same ones are refused for want of memory every
//! time, and before anything is decoded.

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use eyebeam_core::texture::{Pixels, TextureDesc};
use rayon::prelude::*;

use crate::file;
use crate::image::{pixels_size, read_pixels_bytes};
use crate::scene::assets::{Failure, Found, Loader, path};
use crate::warning::Warning;

/// A file that is read and not decoded.
struct Encoded {
    name: String,
    bytes: Vec<u8>,
}

/// Reads all pictures that textures name.
pub(super) fn load<'a>(
    loader: &mut Loader<'_, impl Fn(&[String]) -> Option<&'a Path>>,
    textures: &mut BTreeMap<String, TextureDesc>,
) {
    let mut files: BTreeMap<PathBuf, Result<Encoded, Failure>> = BTreeMap::new();
    let mut wanted = Vec::new();
    for (name, texture) in textures {
        let TextureDesc::Image(texture) = texture else { continue };
        let path = path(&["texture", name, "image"], None);
        match loader.find(&path, &texture.file) {
            Ok(Found { file, real }) => {
                if let Entry::Vacant(entry) = files.entry(real.clone()) {
                    entry.insert(read(loader, &file));
                }
                wanted.push((path, texture, real));
            }
            Err(failure) => drop(loader.or_note::<()>(path, &texture.file, Err(failure))),
        }
    }
    let mut pictures: BTreeMap<_, _> = files.into_par_iter().map(|(real, file)| (real, decode(file))).collect();
    for (path, texture, real) in wanted {
        let Some(picture) = pictures.get_mut(&real) else { continue };
        // Of what could not be kept is told once.
        let warnings = picture.as_mut().map_or_else(|_| Vec::new(), |(_, warnings)| std::mem::take(warnings));
        loader.warn(&path, &texture.file, warnings);
        let pixels = picture.as_ref().map(|(pixels, _)| pixels.clone()).map_err(Clone::clone);
        texture.pixels = loader.or_note(path, &texture.file, pixels);
    }
}

/// The bytes of a file, if there is memory for them and for the picture.
fn read<'a>(loader: &mut Loader<'_, impl Fn(&[String]) -> Option<&'a Path>>, file: &Path) -> Result<Encoded, Failure> {
    let (name, bytes) = (file.display().to_string(), file::read(file)?);
    loader.take(bytes.len() as u64 + pixels_size(&name, &bytes)?)?;
    Ok(Encoded { name, bytes })
}

fn decode(file: Result<Encoded, Failure>) -> Result<(Arc<Pixels>, Vec<Warning>), Failure> {
    let Encoded { name, bytes } = file?;
    let (pixels, warnings) = read_pixels_bytes(&name, &bytes)?;
    Ok((Arc::new(pixels), warnings))
}
