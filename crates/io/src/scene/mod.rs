//! Scene files.

mod assets;
mod contents;
mod explain;
mod merge;
mod model;
mod nesting;
pub mod ply;
mod polygon;
mod source;
mod textures;
mod toml;
mod write;

use std::path::Path;

use eyebeam_core::desc::SceneDesc;
use eyebeam_core::setup::Given;

use crate::error::{Diagnostic, Error, Fault};
use crate::warning::Warning;

pub use contents::{Animation, Contents, NamedCamera};
pub use model::{Files, MODEL_FORMATS, ModelFormat, Up};
pub use write::{WriteOptions, Written, check_unwritten, write};

/// A scene as it was read, with all the files that it names.
#[derive(Clone, Debug)]
pub struct SceneFile {
    /// The scene.
    pub desc: SceneDesc,
    /// What is worth a word, in the order of the text.
    pub warnings: Vec<Warning>,
    /// What it says of camera and light; a scene file says everything.
    pub given: Given,
    /// About the memory that its meshes and pictures take, bytes.
    pub memory: u64,
    /// What else there is in the file.
    pub contents: Contents,
}

/// How scenes are read.
#[derive(Clone, Copy, Debug, Default)]
pub struct ReadOptions<'a> {
    /// Settings from outside the file.
    pub overrides: &'a [Override],
    /// What is up in models that do not say.
    pub up: Option<Up>,
    /// The animation that poses a model, by its name or its number from 0; it is as it rests if none is said.
    pub animation: Option<&'a str>,
    /// When, seconds from its start.
    pub at: f32,
    /// The variant of a model's materials, by its name or its number from 0; those of the file if none is said.
    pub variant: Option<&'a str>,
    /// The most memory that its meshes and pictures may take, bytes; 16 GiB if none is said.
    pub memory: Option<u64>,
    /// The scene of a model, by its name or its number from 0; the one that the file says if none is said.
    pub scene: Option<&'a str>,
    /// The camera of a model, by its name or its number from 0; the first if none is said.
    pub camera: Option<&'a str>,
    /// Whether a model may name files outside of its folder.
    pub allow_outside: bool,
}

/// A setting from outside the file, `key.key=value`: stronger than what the file says.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Override {
    /// Keys, from the root, between dots; elements of lists by their index.
    pub path: String,
    /// A TOML value; what is none is a string.
    pub value: String,
}

/// Reads and checks a scene file or a [model](MODEL_FORMATS), and all files that it names; `-` is a scene file from standard input.
///
/// Relative names are looked for beside the scene file that says them, and those in settings or standard input in the
/// current folder.
///
/// # Errors
/// Everything that is wrong with it, or why it cannot be read.
pub fn read(path: &Path, overrides: &[Override]) -> Result<SceneFile, Error> {
    read_with(path, &ReadOptions { overrides, ..ReadOptions::default() })
}

/// As [`read`], with more to say.
///
/// # Errors
/// Everything that is wrong with it, or why it cannot be read.
pub fn read_with(path: &Path, options: &ReadOptions<'_>) -> Result<SceneFile, Error> {
    match model::format_of(path) {
        Some(format) => model::read(format, &model::Input::file(path, options.allow_outside), options),
        None => scene_file(source::Sources::load(path)?, options),
    }
}

/// As [`read_with`], from the bytes of a file, whose name tells what it is and stands for it in errors; where the files are that it
/// names is said.
///
/// # Errors
/// Everything that is wrong with it, or why it cannot be read.
pub fn read_bytes(name: &str, bytes: &[u8], files: Files<'_>, options: &ReadOptions<'_>) -> Result<SceneFile, Error> {
    match model::format_of(Path::new(name)) {
        Some(format) => model::read(format, &model::Input::given(name, bytes, files), options),
        None => scene_file(source::Sources::from_bytes(name, bytes, files)?, options),
    }
}

fn scene_file(sources: source::Sources, options: &ReadOptions<'_>) -> Result<SceneFile, Error> {
    refuse_choices(options)?;
    let mut file = toml::read(sources, options)?;
    if options.up.is_some() {
        file.warnings.push(Warning::new("scene files say what is up: `--up` is not used"));
    }
    Ok(file)
}

/// A scene file has nothing to choose.
fn refuse_choices(options: &ReadOptions<'_>) -> Result<(), Error> {
    let ReadOptions { scene, camera, animation, variant, .. } = *options;
    let choices = [("scene", scene), ("camera", camera), ("animation", animation), ("variant", variant)];
    let refused = choices.into_iter().filter_map(|(kind, wanted)| {
        let message =
            format!("there is no {kind} `{}`: this is a scene file, and `--{kind}` chooses in models", wanted?);
        Some(Diagnostic { message, place: None, hint: Some(format!("leave `--{kind}` out")), fault: Fault::File })
    });
    let refused: Vec<_> = refused.collect();
    if refused.is_empty() { Ok(()) } else { Err(Error::Scene(refused)) }
}

/// Reads and checks a scene from text; `name` stands for the file in errors. It has no folder: it can
/// neither include nor name files.
///
/// # Errors
/// Everything that is wrong with it.
pub fn read_str(name: &str, text: &str, overrides: &[Override]) -> Result<SceneFile, Error> {
    toml::read(source::Sources::from_text(name, text)?, &ReadOptions { overrides, ..ReadOptions::default() })
}

/// The JSON Schema of scene files.
pub fn schema() -> serde_json::Value {
    let mut schema = schemars::schema_for!(SceneDesc).to_value();
    schema["title"] = "Eyebeam scene".into();
    schema
}
