//! Scene files.

mod explain;
mod merge;
mod nesting;
pub mod ply;
mod source;
mod toml;

use std::path::Path;

use eyebeam_core::desc::SceneDesc;

use crate::error::Error;

/// A setting from outside the file, `key.key=value`: stronger than what the file says.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Override {
    /// Keys, from the root, between dots; elements of lists by their index.
    pub path: String,
    /// A TOML value; what is none is a string.
    pub value: String,
}

/// Reads and checks a scene file; `-` is standard input.
///
/// # Errors
/// Everything that is wrong with it, or why it cannot be read.
pub fn read(path: &Path, overrides: &[Override]) -> Result<SceneDesc, Error> {
    toml::read(source::Sources::load(path)?, overrides)
}

/// Reads and checks a scene from text; `name` stands for the file in errors. It cannot include files.
///
/// # Errors
/// Everything that is wrong with it.
pub fn read_str(name: &str, text: &str, overrides: &[Override]) -> Result<SceneDesc, Error> {
    toml::read(source::Sources::from_text(name, text)?, overrides)
}

/// The JSON Schema of scene files.
pub fn schema() -> serde_json::Value {
    let mut schema = schemars::schema_for!(SceneDesc).to_value();
    schema["title"] = "Eyebeam scene".into();
    schema
}
