//! The pictures that a library of materials names.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use eyebeam_core::texture::Pixels;

use crate::error::{Error, FileError};
use crate::file;
use crate::image::{pixels_size, read_pixels_bytes};
use crate::scene::assets::MAX_BYTES;
use crate::scene::model::folder::Folder;
use crate::warning::Warning;

/// Pictures that were read, each once; none of those that could not be.
pub(super) struct Pictures {
    folder: Folder,
    known: BTreeMap<PathBuf, Option<Arc<Pixels>>>,
    bytes: u64,
}

impl Pictures {
    pub(super) fn new(folder: &Folder) -> Self {
        Self { folder: folder.clone(), known: BTreeMap::new(), bytes: 0 }
    }

    /// The picture of that name, and its path; none, and a warning, if it cannot be had. Warnings are told once for each file.
    pub(super) fn get(
        &mut self,
        below: &Path,
        name: &str,
        warnings: &mut Vec<Warning>,
    ) -> Option<(PathBuf, Arc<Pixels>)> {
        let refused = |e: &FileError| Warning {
            hint: e.hint.clone(),
            ..Warning::new(format!("the picture `{name}` is not read: {}", e.message))
        };
        let path = match self.folder.find(&below.join(name)) {
            Ok(path) => path,
            Err(e) => {
                warnings.push(refused(&e));
                return None;
            }
        };
        if !self.known.contains_key(&path) {
            let picture = self.read(&path, warnings).map_err(FileError::from);
            warnings.extend(picture.as_ref().err().map(refused));
            self.known.insert(path.clone(), picture.ok());
        }
        let pixels = self.known.get(&path)?.clone()?;
        Some((path, pixels))
    }

    fn read(&mut self, path: &Path, warnings: &mut Vec<Warning>) -> Result<Arc<Pixels>, Error> {
        let name = path.display().to_string();
        let bytes = file::read(path)?;
        self.bytes = self.bytes.saturating_add(pixels_size(&name, &bytes)?);
        if self.bytes > MAX_BYTES {
            return Err(FileError::new(format!("pictures take more than {} GiB", MAX_BYTES >> 30)).of(&name));
        }
        let (pixels, more) = read_pixels_bytes(&name, &bytes)?;
        warnings.extend(more);
        Ok(Arc::new(pixels))
    }
}
