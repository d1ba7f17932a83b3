//! What is allowed and yet worth a word.

use std::fmt;

use serde::Serialize;

use crate::error::{At, Diagnostic, Fault, Place, report};

/// Something that was not kept as it is in a file, or that has no effect in a scene; the rest is fine.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Warning {
    /// What, and what came of it.
    pub message: String,
    /// Where.
    pub place: Option<Place>,
    /// What to do about it.
    pub hint: Option<String>,
}

impl Warning {
    pub(crate) fn new(message: impl Into<String>) -> Self {
        Self { message: message.into(), place: None, hint: None }
    }

    /// Something that was met so often.
    pub(crate) fn counted(message: &str, count: usize) -> Self {
        if count == 1 { Self::new(message) } else { Self::new(format!("{message} ({count} times)")) }
    }

    /// In a file that has no name yet: [`Self::of`] gives it.
    pub(crate) fn at(self, at: At) -> Self {
        Self { place: Some(Place { file: String::new(), at }), ..self }
    }

    /// In a part of it.
    pub(crate) fn part(self, part: impl Into<String>) -> Self {
        self.at(At::Part(part.into()))
    }

    pub(crate) fn hint(self, hint: impl Into<String>) -> Self {
        Self { hint: Some(hint.into()), ..self }
    }

    /// In a file, unless it is in another.
    pub(crate) fn of(self, file: &str) -> Self {
        let at = match self.place {
            Some(Place { ref file, .. }) if !file.is_empty() => return self,
            Some(Place { at, .. }) => at,
            None => At::File,
        };
        Self { place: Some(Place { file: file.to_owned(), at }), ..self }
    }
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&report("warning", &self.message, &self.place, self.hint.as_deref()))
    }
}

/// For those who want no warnings.
impl From<Warning> for Diagnostic {
    fn from(Warning { message, place, hint }: Warning) -> Self {
        Self { message, place, hint, fault: Fault::File }
    }
}
