//! What a model lacks to make a picture.

use std::sync::Arc;

use eyebeam_core::desc::SceneDesc;
use eyebeam_core::light::{EnvironmentDesc, ImageEnvironment};
use eyebeam_core::setup::{Assumed, Given, Setup, Surroundings};
use eyebeam_io::image::read_image;

use crate::args::{EnvironmentArg, SetupArgs};
use crate::error::Error;

/// Adds it, as the command line says.
pub(super) fn complete(desc: &mut SceneDesc, given: Given, args: &SetupArgs) -> Result<Assumed, Error> {
    let surroundings = match &args.env {
        None => Surroundings::Auto,
        Some(EnvironmentArg::Studio) => Surroundings::Studio,
        Some(EnvironmentArg::Sky) => Surroundings::Sky,
        Some(EnvironmentArg::None) => Surroundings::None,
        Some(EnvironmentArg::Picture(path)) => {
            let image = Some(Arc::new(read_image(path)?.0));
            let map = ImageEnvironment { file: path.display().to_string(), rotation: 0.0, scale: 1.0, image };
            Surroundings::Image(Box::new(EnvironmentDesc::Image(map)))
        }
    };
    let setup = Setup { own_camera: args.camera.is_some(), surroundings, ground: args.wants_ground() };
    Ok(setup.complete(desc, given))
}
