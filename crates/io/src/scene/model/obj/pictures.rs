//! The files that a model names, which lie below its folder.

use std::collections::BTreeMap;
use std::path::{Component, Path, PathBuf};
use std::sync::Arc;

use eyebeam_core::texture::Pixels;

use crate::error::{Error, FileError};
use crate::file;
use crate::image::{pixels_size, read_pixels_bytes};
use crate::warning::Warning;

/// No more pictures are read once those before take so much memory.
const MAX_BYTES: u64 = 16 << 30;

/// Pictures that were read, each once.
pub(super) struct Pictures {
    folder: PathBuf,
    known: BTreeMap<PathBuf, Result<Arc<Pixels>, String>>,
    bytes: u64,
}

impl Pictures {
    pub(super) fn new(folder: &Path) -> Self {
        Self { folder: folder.to_owned(), known: BTreeMap::new(), bytes: 0 }
    }

    /// Where the file is that is named in a library in a folder below that of the model; else why it is not read.
    pub(super) fn find(&self, below: &Path, name: &str) -> Result<PathBuf, String> {
        let name = name.replace('\\', "/");
        let relative = below.join(&name);
        let leads_out = |c: Component<'_>| !matches!(c, Component::Normal(_) | Component::CurDir);
        let is_drive = name.get(1..2) == Some(":");
        if name.is_empty() {
            return Err("it has no name".to_owned());
        }
        if is_drive || relative.components().any(leads_out) {
            return Err("its name leads out of the folder of the model".to_owned());
        }
        let real = |path: &Path| path.canonicalize().map_err(|e| e.to_string());
        if real(&self.folder.join(&relative))?.starts_with(real(&self.folder)?) {
            Ok(self.folder.join(relative))
        } else {
            Err("it is a link that leads out of the folder of the model".to_owned())
        }
    }

    /// The picture of that name, and its path; none, and a warning, if it cannot be had. Warnings are told once for each file.
    pub(super) fn get(
        &mut self,
        below: &Path,
        name: &str,
        warnings: &mut Vec<Warning>,
    ) -> Option<(PathBuf, Arc<Pixels>)> {
        let path = match self.find(below, name) {
            Ok(path) => path,
            Err(why) => {
                warnings.push(Warning::new(format!("the picture `{name}` is not read: {why}")));
                return None;
            }
        };
        if !self.known.contains_key(&path) {
            let outcome = self.read(&path, warnings).map_err(|e| match e {
                Error::File(FileError { message, .. }) => message,
                Error::Io { source, .. } => source.to_string(),
                other => other.to_string(),
            });
            if let Err(why) = &outcome {
                warnings.push(Warning::new(format!("the picture `{name}` is not read: {why}")));
            }
            self.known.insert(path.clone(), outcome);
        }
        let pixels = self.known.get(&path)?.as_ref().ok()?.clone();
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
