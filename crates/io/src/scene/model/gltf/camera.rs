//! Cameras: they look along −z, with +y upwards.

use eyebeam_core::camera::{CameraDesc, OrthographicDesc};
use glam::{DAffine3, DVec3};

use crate::error::FileError;
use crate::scene::NamedCamera;
use crate::scene::model::Model;
use crate::scene::model::gltf::accessor::missing;
use crate::scene::model::gltf::document::{Document, Node};
use crate::warning::Warning;

/// Adds a node's camera to those of the model; of one that is wrong there is a warning.
pub(super) fn read(document: &Document, node: &Node, to_world: &DAffine3, model: &mut Model) {
    let Some(index) = node.camera else { return };
    match find(document, index, node, to_world) {
        Ok(camera) => model.contents.cameras.push(camera),
        Err(e) => {
            let warning = Warning::new(format!("the camera is left out: {}", e.message));
            model.warnings.push(warning.part(format!("camera {index}")));
        }
    }
}

fn find(document: &Document, index: usize, node: &Node, to_world: &DAffine3) -> Result<NamedCamera, FileError> {
    let camera = document.cameras.get(index).ok_or_else(|| missing("camera", index))?;
    let from = to_world.translation;
    let direction = |axis: DVec3| (to_world.matrix3 * axis).normalize_or_zero();
    let (ahead, up) = (direction(DVec3::NEG_Z), direction(DVec3::Y));
    if ahead == DVec3::ZERO || up == DVec3::ZERO {
        return Err(FileError::new(format!("camera {index} looks nowhere: its node has no size")));
    }
    let mut desc = CameraDesc {
        look_from: from.as_vec3().into(),
        look_at: (from + ahead * from.abs().max_element().max(1.0)).as_vec3().into(),
        up: up.as_vec3().into(),
        ..CameraDesc::default()
    };
    match (&camera.perspective, &camera.orthographic) {
        (Some(perspective), _) if perspective.yfov > 0.0 && perspective.yfov.to_degrees() < 179.0 => {
            desc.vfov = Some(perspective.yfov.to_degrees());
        }
        (None, Some(orthographic)) if orthographic.ymag.is_finite() && orthographic.ymag != 0.0 => {
            desc.orthographic = Some(OrthographicDesc { height: 2.0 * orthographic.ymag.abs() });
        }
        (Some(_), _) | (None, Some(_)) => return Err(FileError::new("it has no angle and no height of view")),
        (None, None) => return Err(FileError::new(format!("camera {index} is of no kind"))),
    }
    let lens = camera.name.clone();
    let name = if node.name.is_empty() { lens.clone() } else { node.name.clone() };
    Ok(NamedCamera { name, lens, desc })
}
