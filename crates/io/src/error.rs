//! Errors, sorted by who must act.

use std::fmt;
use std::path::{Path, PathBuf};

use serde::ser::SerializeMap;
use serde::{Serialize, Serializer};

/// Why a file could not be read or written.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The scene says something wrong; all that was found.
    #[error("{}", .0.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n"))]
    Scene(Vec<Diagnostic>),
    /// A file that the scene refers to is wrong, or has something that is not read.
    #[error("{0}")]
    File(FileError),
    /// The file name has an ending that no format has.
    #[error("error: cannot tell the image format of `{}`\nhint: end its name in {known}", .path.display())]
    UnknownFormat {
        /// The file.
        path: PathBuf,
        /// The endings there are.
        known: String,
    },
    /// The file system refused.
    #[error("error: cannot {action} `{}`: {source}", .path.display())]
    Io {
        /// `read` or `write`.
        action: &'static str,
        /// The file.
        path: PathBuf,
        /// Its reason.
        source: std::io::Error,
    },
    /// The picture could not be encoded.
    #[error("error: cannot encode the picture: {0}")]
    Encode(String),
}

impl Error {
    pub(crate) fn read(path: &Path, source: std::io::Error) -> Self {
        Self::Io { action: "read", path: path.to_owned(), source }
    }

    pub(crate) fn write(path: &Path, source: std::io::Error) -> Self {
        Self::Io { action: "write", path: path.to_owned(), source }
    }
}

/// What is wrong with a picture, a mesh or a profile, where, and what to do about it.
#[derive(Clone, Debug, PartialEq)]
pub struct FileError {
    /// The file, as the user named it.
    pub file: String,
    /// What is wrong.
    pub message: String,
    /// Where.
    pub at: At,
    /// What to do about it.
    pub hint: Option<String>,
    /// Whose fault it is.
    pub fault: Fault,
}

/// Whose fault an error is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Fault {
    /// The file's.
    #[default]
    File,
    /// The file may be right: the file system does not give it.
    FileSystem,
    /// The file may be right: it takes more memory than is allowed.
    Memory,
}

/// Where in a file.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum At {
    /// Anywhere.
    File,
    /// In this line of a text, from 1.
    Line(usize),
    /// At this character of a text.
    Character {
        /// From 1.
        line: usize,
        /// From 1.
        column: usize,
    },
    /// At this byte, from 0.
    Byte(usize),
    /// In a part that has a name, as in "material `Glass`".
    Part(String),
}

/// A place in a file.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Place {
    /// The file, as the user named it.
    pub file: String,
    /// Where in it.
    pub at: At,
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", visible(&self.file))?;
        match &self.at {
            At::File => Ok(()),
            At::Line(line) => write!(f, ":{line}"),
            At::Character { line, column } => write!(f, ":{line}:{column}"),
            At::Byte(byte) => write!(f, ", byte {byte}"),
            At::Part(part) => write!(f, ", {}", visible(part)),
        }
    }
}

/// As `file` and what else is known of `line`, `column`, `byte` and `part`.
impl Serialize for Place {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        map.serialize_entry("file", &self.file)?;
        match &self.at {
            At::File => {}
            At::Line(line) => map.serialize_entry("line", line)?,
            At::Character { line, column } => {
                map.serialize_entry("line", line)?;
                map.serialize_entry("column", column)?;
            }
            At::Byte(byte) => map.serialize_entry("byte", byte)?,
            At::Part(part) => map.serialize_entry("part", part)?,
        }
        map.end()
    }
}

impl FileError {
    /// Of a file that has no name yet: [`Self::of`] gives it.
    pub(crate) fn new(message: impl Into<String>) -> Self {
        Self { file: String::new(), message: message.into(), at: At::File, hint: None, fault: Fault::File }
    }

    pub(crate) fn at(self, at: At) -> Self {
        Self { at, ..self }
    }

    pub(crate) fn hint(self, hint: impl Into<String>) -> Self {
        Self { hint: Some(hint.into()), ..self }
    }

    pub(crate) fn of(self, file: &str) -> Error {
        Error::File(Self { file: file.to_owned(), ..self })
    }
}

/// The reason alone.
impl From<Error> for FileError {
    fn from(error: Error) -> Self {
        match error {
            Error::File(error) => error,
            Error::Io { source, .. } => Self::new(source.to_string()),
            other => Self::new(other.to_string()),
        }
    }
}

impl fmt::Display for FileError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let place = Place { file: self.file.clone(), at: self.at.clone() };
        f.write_str(&report("error", &self.message, [&place], self.hint.as_deref()))
    }
}

/// One thing that is wrong, where, and what to do about it.
#[derive(Clone, Debug, PartialEq)]
pub struct Diagnostic {
    /// What is wrong.
    pub message: String,
    /// Where.
    pub place: Option<Place>,
    /// What to do about it.
    pub hint: Option<String>,
    /// Whose fault it is; the scene may be right, and a file that it names not be had.
    pub fault: Fault,
}

impl fmt::Display for Diagnostic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&report("error", &self.message, &self.place, self.hint.as_deref()))
    }
}

/// What is said of something, with its places and what to do about it.
pub fn report<'p>(
    kind: &str,
    message: &str,
    places: impl IntoIterator<Item = &'p Place>,
    hint: Option<&str>,
) -> String {
    /// The most places that are shown.
    const PLACES: usize = 10;
    let mut lines = vec![format!("{kind}: {}", visible(message))];
    let mut places = places.into_iter();
    lines.extend(places.by_ref().take(PLACES).map(|place| format!("  --> {place}")));
    let rest = places.count();
    if rest > 0 {
        lines.push(format!("  --> and {rest} more places"));
    }
    lines.extend(hint.map(|hint| format!("hint: {}", visible(hint))));
    lines.join("\n")
}

/// Names come from files: a line stays a line, no longer than one can read, and a terminal is told nothing.
pub fn visible(text: &str) -> String {
    const LONGEST: usize = 500;
    let mut line = String::new();
    for c in text.chars().take(LONGEST) {
        if c.is_control() { line.extend(c.escape_default()) } else { line.push(c) }
    }
    if text.chars().nth(LONGEST).is_some() {
        line.push('…');
    }
    line
}
