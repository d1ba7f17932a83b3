//! What a model lacks to make a picture: where the eye is, and light.

/// What a file says.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Given {
    /// Where the eye is.
    pub camera: bool,
    /// Light, from wherever.
    pub light: bool,
}

impl Given {
    /// Everything.
    pub const ALL: Self = Self { camera: true, light: true };
}
