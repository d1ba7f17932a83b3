//! The file of a model, and those that it names: on a disk or in memory.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::io::{BufRead, BufReader, Cursor};
use std::path::{Path, PathBuf};

use crate::error::{Error, FileError};
use crate::file;
use crate::scene::model::folder;

/// Where the files are that a scene or a model names.
#[derive(Clone, Copy, Debug, Default)]
pub enum Files<'a> {
    /// Nowhere: it can name none.
    #[default]
    None,
    /// In a folder or below.
    In(&'a Path),
    /// Anywhere: relative names begin at a folder.
    Anywhere(&'a Path),
    /// In memory, by their names; scene files cannot name these.
    Given(&'a BTreeMap<String, Vec<u8>>),
}

impl Files<'_> {
    /// Where a file is, a name for [`read`](Self::read).
    ///
    /// # Errors
    /// If there is none, or it is not to be read.
    pub(super) fn find(self, name: &Path) -> Result<PathBuf, FileError> {
        match self {
            Self::None => Err(FileError::new("the model has no folder").hint("save it as a file")),
            Self::In(folder) => folder::find(folder, name, false),
            Self::Anywhere(folder) => folder::find(folder, name, true),
            Self::Given(files) => {
                let path = folder::plain(name);
                let is_there = path.to_str().is_some_and(|name| files.contains_key(name));
                if is_there { Ok(path) } else { Err(FileError::new("it is not given")) }
            }
        }
    }

    /// All of a file that was found.
    ///
    /// # Errors
    /// If it cannot be read.
    pub(super) fn read(self, path: &Path) -> Result<Vec<u8>, Error> {
        match self {
            Self::Given(files) => {
                let bytes = path.to_str().and_then(|name| files.get(name));
                bytes.cloned().ok_or_else(|| FileError::new("it is not given").of(&path.display().to_string()))
            }
            Self::None | Self::In(_) | Self::Anywhere(_) => file::read(path),
        }
    }
}

/// The file of a model.
pub(in crate::scene) struct Input<'a> {
    /// As the user named it.
    pub(super) name: String,
    source: Source<'a>,
    /// Those that it names.
    pub(super) files: Files<'a>,
}

enum Source<'a> {
    File(&'a Path),
    Bytes(&'a [u8]),
}

impl<'a> Input<'a> {
    /// A file, with those beside it, or those everywhere.
    pub(in crate::scene) fn file(path: &'a Path, allow_outside: bool) -> Self {
        let folder = folder::of(path);
        let files = if allow_outside { Files::Anywhere(folder) } else { Files::In(folder) };
        Self { name: path.display().to_string(), source: Source::File(path), files }
    }

    /// Bytes; `name` stands for them in errors.
    pub(in crate::scene) fn given(name: &str, bytes: &'a [u8], files: Files<'a>) -> Self {
        Self { name: name.to_owned(), source: Source::Bytes(bytes), files }
    }

    /// All of it.
    ///
    /// # Errors
    /// If it cannot be read.
    pub(super) fn bytes(&self) -> Result<Cow<'a, [u8]>, Error> {
        match self.source {
            Source::File(path) => file::read(path).map(Cow::Owned),
            Source::Bytes(bytes) => Ok(Cow::Borrowed(bytes)),
        }
    }

    /// For reading piece by piece, and its length.
    ///
    /// # Errors
    /// If it cannot be opened.
    pub(super) fn open(&self) -> Result<(Box<dyn BufRead + 'a>, u64), Error> {
        match self.source {
            Source::File(path) => {
                let file = file::open(path)?;
                let length = file.metadata().map_err(|e| self.unreadable(e))?.len();
                Ok((Box::new(BufReader::new(file)), length))
            }
            Source::Bytes(bytes) => Ok((Box::new(Cursor::new(bytes)), bytes.len() as u64)),
        }
    }

    /// The file system's error.
    pub(super) fn unreadable(&self, e: std::io::Error) -> Error {
        Error::read(Path::new(&self.name), e)
    }
}
