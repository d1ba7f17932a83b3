//! The pictures that a library of materials names.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use eyebeam_core::texture::Pixels;

use crate::error::{Error, FileError};
use crate::image::{pixels_size, read_pixels_bytes};
use crate::memory::Memory;
use crate::scene::model::files::Files;
use crate::warning::Warning;

/// Pictures that were read, each once; none of those that could not be.
pub(super) struct Pictures<'a> {
    files: Files<'a>,
    known: BTreeMap<PathBuf, Option<Arc<Pixels>>>,
    memory: &'a Memory,
}

impl<'a> Pictures<'a> {
    pub(super) fn new(files: Files<'a>, memory: &'a Memory) -> Self {
        Self { files, known: BTreeMap::new(), memory }
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
        let path = match self.files.find(&below.join(name)) {
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
        let bytes = self.files.read(path)?;
        self.memory.take(pixels_size(&name, &bytes)?).map_err(|e| e.of(&name))?;
        let (pixels, more) = read_pixels_bytes(&name, &bytes)?;
        warnings.extend(more);
        Ok(Arc::new(pixels))
    }
}
