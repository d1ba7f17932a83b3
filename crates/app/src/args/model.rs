//! How models are read and shown: what their files do not say.

use std::convert::Infallible;
use std::path::PathBuf;
use std::str::FromStr;

use clap::Args as ClapArgs;
use eyebeam_io::scene::{Override, ReadOptions, Up};

/// How a model is read.
#[derive(Clone, Debug, ClapArgs)]
#[command(next_help_heading = "Models (.gltf, .glb, .obj, .ply, .stl)")]
pub(crate) struct ModelArgs {
    /// Axis that is upwards in the file: +X, +Y, +Z, -X, -Y or -Z
    #[arg(long, value_name = "AXIS", allow_hyphen_values = true)]
    pub(crate) up: Option<Up>,
    /// Animation that poses the model, by its name or number
    #[arg(long, value_name = "NAME")]
    pub(crate) animation: Option<String>,
    /// When in the animation, seconds
    #[arg(long, value_name = "SECONDS", default_value_t = 0.0, allow_negative_numbers = true, requires = "animation")]
    pub(crate) at: f32,
    /// Variant of the model's materials, by its name or number [default: those of the file]
    #[arg(long, value_name = "NAME")]
    pub(crate) variant: Option<String>,
    /// Scene of a .gltf or .glb that has several, by its name or number [default: the one that it says]
    #[arg(long = "scene", id = "which_scene", value_name = "NAME")]
    pub(crate) scene: Option<String>,
    /// Let a model name files outside of its folder
    #[arg(long)]
    pub(crate) allow_outside: bool,
}

impl ModelArgs {
    pub(crate) fn options<'a>(&'a self, overrides: &'a [Override]) -> ReadOptions<'a> {
        let Self { up, at, allow_outside, .. } = *self;
        let [animation, scene, variant] = [&self.animation, &self.scene, &self.variant].map(Option::as_deref);
        ReadOptions { overrides, up, animation, at, variant, scene, allow_outside, ..ReadOptions::default() }
    }
}

/// How a model is shown.
#[derive(Clone, Debug, ClapArgs)]
#[command(next_help_heading = "Models (.gltf, .glb, .obj, .ply, .stl)")]
pub(crate) struct SetupArgs {
    /// Camera of the file, by its name or number; auto is one in front of the model [default: the file's first, or auto]
    #[arg(long, value_name = "NAME")]
    pub(crate) camera: Option<CameraArg>,
    /// Light from outside: studio, sky, none, or a picture (.hdr, .exr) [default: studio, unless the file has light]
    #[arg(long, value_name = "ENV")]
    pub(crate) env: Option<EnvironmentArg>,
    /// Let the model stand on a ground [default: in a studio and under a sky]
    #[arg(long, overrides_with = "no_ground")]
    pub(crate) ground: bool,
    /// Let it stand on nothing
    #[arg(long, overrides_with = "ground")]
    pub(crate) no_ground: bool,
}

impl SetupArgs {
    /// How the file is read, with the camera that is chosen in it.
    pub(crate) fn options<'a>(&'a self, model: &'a ModelArgs, overrides: &'a [Override]) -> ReadOptions<'a> {
        let camera = match &self.camera {
            Some(CameraArg::Named(name)) => Some(name.as_str()),
            Some(CameraArg::Auto) | None => None,
        };
        ReadOptions { camera, ..model.options(overrides) }
    }

    /// Whether there is a ground, if that was said.
    pub(crate) fn wants_ground(&self) -> Option<bool> {
        match (self.ground, self.no_ground) {
            (true, _) => Some(true),
            (_, true) => Some(false),
            _ => None,
        }
    }
}

/// Where the eye is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum CameraArg {
    /// In front of the model.
    Auto,
    /// That of the file of such a name or number.
    Named(String),
}

impl FromStr for CameraArg {
    type Err = Infallible;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        Ok(if text == "auto" { Self::Auto } else { Self::Named(text.to_owned()) })
    }
}

/// Light from outside.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum EnvironmentArg {
    Studio,
    Sky,
    None,
    Picture(PathBuf),
}

impl FromStr for EnvironmentArg {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        match text {
            "studio" => Ok(Self::Studio),
            "sky" => Ok(Self::Sky),
            "none" => Ok(Self::None),
            file if file.contains('.') => Ok(Self::Picture(file.into())),
            _ => Err("use studio, sky, none, or the name of a picture"),
        }
    }
}
