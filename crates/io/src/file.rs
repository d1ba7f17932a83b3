//! The bytes of a file that a scene or a person refers to.

use std::fs::{self, File};
use std::io::{self, Read};
use std::path::Path;

use crate::error::{Error, FileError};

/// Longer files are refused.
const MAX_BYTES: u64 = 2 << 30;

/// All of standard input.
///
/// # Errors
/// If it cannot be read, or is longer than 2 GiB.
pub(crate) fn read_standard_input() -> Result<Vec<u8>, Error> {
    let bytes = read_to_end(io::stdin().lock(), 0).map_err(|e| Error::read(Path::new("-"), e))?;
    bytes.ok_or_else(|| too_long().of("-"))
}

/// All of a file.
///
/// # Errors
/// If the file system refuses, it is a folder or a device, or it is longer than 2 GiB.
pub(crate) fn read(path: &Path) -> Result<Vec<u8>, Error> {
    let bytes = read_all(path).map_err(|e| Error::read(path, e))?;
    bytes.ok_or_else(|| too_long().of(&path.display().to_string()))
}

fn too_long() -> FileError {
    FileError::new(format!("the file is longer than {} GiB", MAX_BYTES >> 30))
}

/// A file that is read piece by piece.
///
/// # Errors
/// If the file system refuses, or it is a folder or a device.
pub(crate) fn open(path: &Path) -> Result<File, Error> {
    open_regular(path).map_err(|e| Error::read(path, e))
}

fn open_regular(path: &Path) -> io::Result<File> {
    // Looked at before it is opened: that would wait for whoever writes into a pipe.
    let kind = fs::metadata(path)?;
    if !kind.is_file() {
        return Err(io::Error::other(if kind.is_dir() { "it is a folder" } else { "it is no regular file" }));
    }
    File::open(path)
}

/// None if there are more than [`MAX_BYTES`].
fn read_all(path: &Path) -> io::Result<Option<Vec<u8>>> {
    let file = open_regular(path)?;
    let length = file.metadata()?.len();
    if length > MAX_BYTES {
        return Ok(None);
    }
    read_to_end(file, length as usize)
}

/// None if there are more than [`MAX_BYTES`]; about `length` are expected.
fn read_to_end(source: impl Read, length: usize) -> io::Result<Option<Vec<u8>>> {
    let mut bytes = Vec::with_capacity(length + 1);
    source.take(MAX_BYTES + 1).read_to_end(&mut bytes)?;
    Ok((bytes.len() as u64 <= MAX_BYTES).then_some(bytes))
}
