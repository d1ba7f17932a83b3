//! `KHR_lights_punctual`: points, spots and suns, in candela and lux.
//!
//! Photometric numbers become radiometric ones as those of luminaires do, by the efficacy of light that is even over the visible. What is around is still missing: a file has no surroundings.

use eyebeam_core::color::{LUMENS_PER_WATT, Rgb};
use eyebeam_core::light::{DirectionalLight, PointLight, SpotLight};
use glam::{DAffine3, DVec3};
use serde::Deserialize;

use crate::error::FileError;
use crate::scene::model::Model;
use crate::scene::model::gltf::accessor::missing;
use crate::scene::model::gltf::document::{Document, Node, PunctualLights};
use crate::scene::model::gltf::extensions::get;

const NAME: &str = "KHR_lights_punctual";

/// Those of a file.
pub(super) fn all(document: &Document) -> Result<PunctualLights, FileError> {
    Ok(get(&document.extensions, NAME)?.unwrap_or_default())
}

/// What a node says.
#[derive(Debug, Deserialize)]
struct Reference {
    light: usize,
}

/// Adds that of a node.
pub(super) fn read(
    lights: &PunctualLights,
    node: &Node,
    to_world: &DAffine3,
    model: &mut Model,
) -> Result<(), FileError> {
    let Some(Reference { light: index }) = get(&node.extensions, NAME)? else { return Ok(()) };
    let light = lights.lights.get(index).ok_or_else(|| missing("light", index))?;
    let intensity = light.intensity.unwrap_or(1.0) / LUMENS_PER_WATT;
    let amount = Rgb(light.color.unwrap_or([1.0; 3]).map(|c| c * intensity));
    let position = to_world.translation.as_vec3().into();
    let ahead = (to_world.matrix3 * DVec3::NEG_Z).normalize_or(DVec3::NEG_Z);
    let lights = &mut model.desc.light;
    match light.kind.as_str() {
        "point" => lights.point.push(PointLight { position, intensity: amount }),
        "spot" => {
            let cone = light.spot.as_ref();
            let outer = cone.and_then(|c| c.outer_cone_angle).unwrap_or(std::f32::consts::FRAC_PI_4);
            lights.spot.push(SpotLight {
                position,
                look_at: (to_world.translation + ahead).as_vec3().into(),
                intensity: amount,
                inner: Some(cone.map_or(0.0, |c| c.inner_cone_angle).to_degrees()),
                outer: outer.to_degrees(),
            });
        }
        "directional" => lights.directional.push(DirectionalLight {
            direction: (-ahead).as_vec3().into(),
            irradiance: amount,
            angle: 0.0,
        }),
        other => return Err(FileError::new(format!("light {index} is of the type `{other}`, which does not exist"))),
    }
    Ok(())
}
