//! What a model lacks to make a picture.

use std::sync::Arc;

use eyebeam_core::light::ImageEnvironment;
use eyebeam_core::look::{Exposure, Look, View};
use eyebeam_core::setup::{Assumed, Given, Setup, Surroundings};
use eyebeam_io::image::read_image;
use eyebeam_io::scene::SceneFile;

use crate::args::{CameraArg, EnvironmentArg, SetupArgs};
use crate::error::Error;
use crate::progress::say;

/// Adds it, as the command line says; what could not be kept of a picture goes to the warnings.
pub(super) fn complete(
    SceneFile { desc, warnings, given, memory, .. }: &mut SceneFile,
    args: &SetupArgs,
) -> Result<Assumed, Error> {
    let surroundings = match &args.env {
        None => Surroundings::Auto,
        Some(EnvironmentArg::Studio) => Surroundings::Studio,
        Some(EnvironmentArg::Sky) => Surroundings::Sky,
        Some(EnvironmentArg::None) => Surroundings::None,
        Some(EnvironmentArg::Picture(path)) => {
            let (image, more) = read_image(path)?;
            warnings.extend(more);
            *memory += size_of_val(image.pixels()) as u64;
            let (file, image) = (path.display().to_string(), Some(Arc::new(image)));
            Surroundings::Image(ImageEnvironment { file, rotation: 0.0, scale: 1.0, image })
        }
    };
    let setup = Setup { own_camera: args.camera == Some(CameraArg::Auto), surroundings, ground: args.wants_ground() };
    Ok(setup.complete(desc, *given))
}

/// Says what was made up.
pub(super) fn say_of(Assumed { what, .. }: &Assumed) {
    if !what.is_empty() {
        say(&format!("made up: {}", what.join(", ")));
    }
}

/// What a picture of a model looks like if nobody says, unless it is as pictures of scene files are: in the studio colours are as they are;
/// nobody knows how bright other light is.
pub(super) fn look_of(look: Look, given: Given, assumed: &Assumed) -> Look {
    match (assumed.is_studio, given == Given::ALL) {
        (true, _) => Look { view: View::FOR_MODELS, ..look },
        (false, true) => look,
        (false, false) => Look { exposure: Exposure::Auto, ..look },
    }
}
