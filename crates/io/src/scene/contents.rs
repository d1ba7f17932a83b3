//! What a file says of itself, and what there is to choose in it.

use eyebeam_core::camera::CameraDesc;

/// What a file holds besides the scene that is read of it; empty but for its format where that knows no such things.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Contents {
    /// The kind of the file.
    pub format: &'static str,
    /// What wrote it.
    pub generator: Option<String>,
    /// Names of all scenes, which may be empty.
    pub scenes: Vec<String>,
    /// Which of them is read.
    pub scene: Option<usize>,
    /// The cameras of the scene that is read.
    pub cameras: Vec<NamedCamera>,
    /// All animations.
    pub animations: Vec<Animation>,
    /// Names of the variants of its materials.
    pub variants: Vec<String>,
}

/// A camera that can be chosen.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedCamera {
    /// The name of the place where it stands, or else its own; it may be empty.
    pub name: String,
    /// Its own name.
    pub lens: String,
    /// The camera.
    pub desc: CameraDesc,
}

/// An animation that can be chosen.
#[derive(Clone, Debug, PartialEq)]
pub struct Animation {
    /// Its name, which may be empty.
    pub name: String,
    /// Up to its last key.
    pub seconds: f32,
}
