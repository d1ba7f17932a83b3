//! The pictures that a library of materials names.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use eyebeam_core::texture::{Pixels, Samples};

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

/// Whether a picture looks like one of normals: coloured, and in the mean about straight up.
pub(super) fn are_normals(pixels: &Pixels) -> bool {
    /// So many pixels tell of all.
    const PLACES: usize = 1 << 16;
    let channels = pixels.channels();
    let count = pixels.samples().len() / channels.max(1);
    let mean = |channel: usize| {
        let places = (0..count).step_by((count / PLACES).max(1)).map(|i| i * channels + channel);
        let number = places.clone().count() as f64;
        let sum: f64 = match pixels.samples() {
            Samples::Byte(s) => places.filter_map(|i| s.get(i)).map(|&c| f64::from(c) / 255.0).sum(),
            Samples::Word(s) => places.filter_map(|i| s.get(i)).map(|&c| f64::from(c) / 65535.0).sum(),
            Samples::Float(s) => places.filter_map(|i| s.get(i)).map(|&c| f64::from(c)).sum(),
            Samples::Half(_) => return f64::NAN,
        };
        sum / number
    };
    let is_middle = |c: f64| (0.4..0.6).contains(&c);
    channels >= 3 && is_middle(mean(0)) && is_middle(mean(1)) && (0.75..=1.0).contains(&mean(2))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normals_are_told_from_heights() {
        let of =
            |channels, pixel: &[u8]| are_normals(&Pixels::new(2, 1, channels, Samples::Byte(pixel.repeat(2))).unwrap());
        assert!(of(3, &[128, 128, 255]) && of(4, &[120, 135, 230, 0]));
        for heights in [[128, 128, 128], [255, 128, 0], [128, 128, 150], [60, 60, 255], [255, 255, 255]] {
            assert!(!of(3, &heights), "{heights:?}");
        }
        assert!(!of(1, &[128]) && !of(2, &[128, 255]));
        let words = Samples::Word([32768, 32768, 65000].repeat(200_000));
        assert!(are_normals(&Pixels::new(200_000, 1, 3, words).unwrap()));
        assert!(!are_normals(&Pixels::new(0, 0, 3, Samples::Float(vec![])).unwrap()));
    }
}
