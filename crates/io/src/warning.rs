//! What a reader could not keep.

use std::fmt;

/// Something in a file that was not read as it is; the rest was.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Warning {
    /// What, and what came of it.
    pub message: String,
}

impl Warning {
    pub(crate) fn new(message: impl Into<String>) -> Self {
        Self { message: message.into() }
    }
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}
