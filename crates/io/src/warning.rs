//! What is allowed and yet worth a word.

use std::fmt;

use serde::Serialize;

use crate::error::{Diagnostic, Place, fmt_report};

/// Something that was not kept as it is in a file, or that has no effect in a scene; the rest is fine.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Warning {
    /// What, and what came of it.
    pub message: String,
    /// Where in the scene.
    pub place: Option<Place>,
    /// What to do about it.
    pub hint: Option<String>,
}

impl Warning {
    pub(crate) fn new(message: impl Into<String>) -> Self {
        Self { message: message.into(), place: None, hint: None }
    }
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt_report(f, "warning", &self.message, self.place.as_ref(), self.hint.as_deref())
    }
}

/// For those who want no warnings.
impl From<Warning> for Diagnostic {
    fn from(Warning { message, place, hint }: Warning) -> Self {
        Self { message, place, hint, unreadable: false }
    }
}
