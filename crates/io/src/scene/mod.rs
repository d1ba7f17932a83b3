//! Scene files.

mod assets;
mod explain;
mod merge;
mod nesting;
pub mod ply;
mod source;
mod textures;
mod toml;

use std::path::Path;

use eyebeam_core::desc::SceneDesc;

use crate::error::Error;
use crate::warning::Warning;

/// A scene as it was read, with all the files that it names.
#[derive(Clone, Debug)]
pub struct SceneFile {
    /// The scene.
    pub desc: SceneDesc,
    /// What is worth a word, in the order of the text.
    pub warnings: Vec<Warning>,
}

/// A setting from outside the file, `key.key=value`: stronger than what the file says.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Override {
    /// Keys, from the root, between dots; elements of lists by their index.
    pub path: String,
    /// A TOML value; what is none is a string.
    pub value: String,
}

/// Reads and checks a scene file and all files that it names; `-` is standard input.
///
/// Relative names are looked for beside the scene file that says them, and those in `overrides` or standard input in the
/// current folder.
///
/// # Errors
/// Everything that is wrong with it, or why it cannot be read.
pub fn read(path: &Path, overrides: &[Override]) -> Result<SceneFile, Error> {
    toml::read(source::Sources::load(path)?, overrides)
}

/// Reads and checks a scene from text; `name` stands for the file in errors. It has no folder: it can
/// neither include nor name files.
///
/// # Errors
/// Everything that is wrong with it.
pub fn read_str(name: &str, text: &str, overrides: &[Override]) -> Result<SceneFile, Error> {
    toml::read(source::Sources::from_text(name, text)?, overrides)
}

/// The JSON Schema of scene files.
pub fn schema() -> serde_json::Value {
    let mut schema = schemars::schema_for!(SceneDesc).to_value();
    schema["title"] = "Eyebeam scene".into();
    schema
}
