//! `EXT_lights_image_based`: a cube of six pictures all around a scene, as a panorama.
//!
//! Pictures with an alpha are divided by it (RGBD), others are plain. Each is seen from inside, upright on the four sides. The further
//! pictures of the extension, which are blurred, and its coefficients of diffuse light are what light itself computes.

use std::sync::Arc;

use eyebeam_core::film::{Image, Wrap};
use eyebeam_core::light::{EnvironmentDesc, ImageEnvironment};
use eyebeam_core::texture::Samples;
use glam::{Quat, Vec2, Vec3};
use serde::Deserialize;

use crate::error::FileError;
use crate::image::{image_size, read_pixels_bytes};
use crate::scene::model::Model;
use crate::scene::model::files::Files;
use crate::scene::model::gltf::accessor::{Buffers, missing};
use crate::scene::model::gltf::extensions::get;
use crate::scene::model::gltf::texture;
use crate::warning::Warning;

const NAME: &str = "EXT_lights_image_based";

#[derive(Debug, Default, Deserialize)]
#[serde(default)]
struct Lights {
    lights: Vec<Light>,
}

#[derive(Debug, Default, Deserialize)]
#[serde(rename_all = "camelCase", default)]
struct Light {
    rotation: Option<[f32; 4]>,
    intensity: Option<f32>,
    /// Six pictures each: sharp ones, then more and more blurred ones.
    specular_images: Vec<Vec<usize>>,
}

#[derive(Debug, Deserialize)]
struct Named {
    light: usize,
}

/// The surroundings of the scene that is shown, if it has any.
pub(super) fn read(buffers: &Buffers<'_>, scene: usize, files: Files<'_>, model: &mut Model) -> Result<(), FileError> {
    let document = buffers.document;
    let Some(scene) = document.scenes.get(scene) else { return Ok(()) };
    let Some(Named { light: index }) = get(&scene.extensions, NAME)? else { return Ok(()) };
    let Lights { lights } = get(&document.extensions, NAME)?.unwrap_or_default();
    let light = lights.get(index).ok_or_else(|| missing("image-based light", index))?;
    let sides: &[usize; 6] = light
        .specular_images
        .first()
        .and_then(|sides| sides.as_slice().try_into().ok())
        .ok_or_else(|| FileError::new(format!("the image-based light {index} has no six pictures")))?;
    let mut cube = Vec::new();
    for &side in sides {
        cube.push(
            picture(buffers, files, side, &mut model.warnings).map_err(|e| FileError {
                message: format!("picture {side} of the surroundings: {}", e.message),
                ..e
            })?,
        );
    }
    let turn = Quat::from_array(light.rotation.unwrap_or([0.0, 0.0, 0.0, 1.0]));
    let turn = if turn.length_squared() > 0.0 && turn.is_finite() { turn.normalize() } else { Quat::IDENTITY };
    let intensity = light.intensity.unwrap_or(1.0);
    model.desc.environment = EnvironmentDesc::Image(ImageEnvironment {
        file: "surroundings".to_owned(),
        rotation: 0.0,
        scale: if intensity.is_nan() { 1.0 } else { intensity.clamp(0.0, 1e9) },
        image: Some(Arc::new(panorama(&cube, turn))),
    });
    model.given.light = true;
    Ok(())
}

/// Linear light.
fn picture(
    buffers: &Buffers<'_>,
    files: Files<'_>,
    index: usize,
    warnings: &mut Vec<Warning>,
) -> Result<Image, FileError> {
    let bytes = texture::bytes(buffers, files, index)?;
    // As it is, as light, and as a part of the panorama.
    buffers.memory.take(3 * image_size("", &bytes)?)?;
    let (pixels, more) = read_pixels_bytes("", &bytes)?;
    warnings.extend(more.into_iter().map(|warning| warning.part(texture::part(index))));
    let mut image = pixels.to_image();
    let channels = pixels.channels();
    let last = |i: usize| i * channels + channels - 1;
    let alpha = |i: usize| match pixels.samples() {
        Samples::Byte(s) => s.get(last(i)).map(|&a| f32::from(a) / 255.0),
        Samples::Word(s) => s.get(last(i)).map(|&a| f32::from(a) / 65535.0),
        Samples::Half(_) | Samples::Float(_) => None,
    };
    if channels % 2 == 0 {
        for (i, pixel) in image.pixels_mut().iter_mut().enumerate() {
            let divisor = alpha(i).unwrap_or(1.0).max(1.0 / 255.0);
            *pixel = pixel.map(|c| c / divisor);
        }
    }
    Ok(image)
}

/// What a cube shows all around: as many pixels along the horizon as on its four sides, up to 4096.
fn panorama(cube: &[Image], turn: Quat) -> Image {
    let side = cube.iter().map(Image::width).max().unwrap_or(1).clamp(1, 1024);
    let mut panorama = Image::new(4 * side, 2 * side);
    let (width, height) = (4.0 * side as f32, 2.0 * side as f32);
    for (i, pixel) in panorama.pixels_mut().iter_mut().enumerate() {
        let (x, y) = (i as u32 % (4 * side), i as u32 / (4 * side));
        let (sin, cos) = libm::sincosf(std::f32::consts::TAU * (x as f32 + 0.5) / width);
        let (sin_down, cos_down) = libm::sincosf(std::f32::consts::PI * (y as f32 + 0.5) / height);
        let w = turn.inverse() * Vec3::new(sin_down * sin, cos_down, -sin_down * cos);
        let (side, place) = place(w);
        *pixel = cube.get(side).map_or([0.0; 3], |image| image.bilinear(place, Wrap::Clamp).to_rgb());
    }
    panorama
}

/// The side of the cube, +x, −x, +y, −y, +z or −z, that a direction meets, and where, from 0 to 1 to the right and down.
fn place(w: Vec3) -> (usize, Vec2) {
    let a = w.abs();
    let (side, depth, right, down) = match w {
        Vec3 { x, y, z } if a.x >= a.y && a.x >= a.z => {
            if x > 0.0 {
                (0, x, z, -y)
            } else {
                (1, -x, -z, -y)
            }
        }
        Vec3 { x, y, z } if a.y >= a.z => {
            if y > 0.0 {
                (2, y, -x, z)
            } else {
                (3, -y, -x, -z)
            }
        }
        Vec3 { x, y, z } => {
            if z > 0.0 {
                (4, z, -x, -y)
            } else {
                (5, -z, x, -y)
            }
        }
    };
    (side, 0.5 * (Vec2::new(right, down) / depth.max(f32::MIN_POSITIVE) + 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Towards each side is its middle; on the four at the horizon the next is to the right, seen from inside, and up is up.
    #[test]
    fn sides_are_seen_from_inside() {
        for (side, w) in [Vec3::X, Vec3::NEG_X, Vec3::Y, Vec3::NEG_Y, Vec3::Z, Vec3::NEG_Z].into_iter().enumerate() {
            assert_eq!(place(w), (side, Vec2::splat(0.5)));
            if side / 2 != 1 {
                let right = place(w + 0.5 * w.cross(Vec3::Y)).1;
                assert!((right - Vec2::new(0.75, 0.5)).length() < 1e-6, "{w}: {right}");
                assert!((place(w + 0.5 * Vec3::Y).1 - Vec2::new(0.5, 0.25)).length() < 1e-6);
            }
        }
        // Above and below go on where the side towards +z ends.
        assert_eq!(place(Vec3::new(0.0, 1.0, 0.5)), (2, Vec2::new(0.5, 0.75)));
        assert_eq!(place(Vec3::new(0.0, -1.0, 0.5)), (3, Vec2::new(0.5, 0.25)));
        assert_eq!(place(Vec3::new(0.5, 1.0, 0.0)), (2, Vec2::new(0.25, 0.5)));
    }

    /// The panorama shows −z at its left edge and +x a quarter to the right, turned if the cube is.
    #[test]
    fn a_cube_is_a_panorama() {
        let one = |value: f32| {
            let mut image = Image::new(4, 4);
            image.pixels_mut().fill([value; 3]);
            image
        };
        let cube: Vec<_> = (0..6_u8).map(|i| one(f32::from(i))).collect();
        let at = |turn: Quat, x: u32, y: u32| panorama(&cube, turn).pixel(x, y)[0];
        let plain = |x, y| at(Quat::IDENTITY, x, y);
        assert_eq!([plain(0, 4), plain(4, 4), plain(8, 4), plain(12, 4)], [5.0, 0.0, 4.0, 1.0]);
        assert_eq!([plain(0, 0), plain(0, 7)], [2.0, 3.0]);
        // What was ahead, at −z, is now to the left, at −x.
        assert_eq!(at(Quat::from_rotation_y(std::f32::consts::FRAC_PI_2), 12, 4), 5.0);
    }
}
