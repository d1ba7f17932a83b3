//! The bytes of a file that a scene refers to.

use std::fs::{self, File};
use std::io::{self, Read};
use std::path::Path;

use crate::error::{Error, FileError};

/// Longer files are refused.
const MAX_BYTES: u64 = 2 << 30;

/// All of a file.
///
/// # Errors
/// If the file system refuses, it is a folder or a device, or it is longer than 2 GiB.
pub(crate) fn read(path: &Path) -> Result<Vec<u8>, Error> {
    let bytes = read_all(path).map_err(|e| Error::read(path, e))?;
    let too_long = || FileError::new(format!("the file is longer than {} GiB", MAX_BYTES >> 30));
    bytes.ok_or_else(|| too_long().of(&path.display().to_string()))
}

/// None if there are more than [`MAX_BYTES`].
fn read_all(path: &Path) -> io::Result<Option<Vec<u8>>> {
    // Looked at before it is opened: that would wait for whoever writes into a pipe.
    let kind = fs::metadata(path)?;
    if !kind.is_file() {
        return Err(io::Error::other(if kind.is_dir() { "it is a folder" } else { "it is no regular file" }));
    }
    let file = File::open(path)?;
    let length = file.metadata()?.len();
    if length > MAX_BYTES {
        return Ok(None);
    }
    let mut bytes = Vec::with_capacity(length as usize + 1);
    file.take(MAX_BYTES + 1).read_to_end(&mut bytes)?;
    Ok((bytes.len() as u64 <= MAX_BYTES).then_some(bytes))
}
