//! A studio: three softboxes around the model, a pale backdrop, and a ground of the same brightness that fades into it.
//!
//! The light is a picture of the surroundings, so that it is as good for a watch as for a house. The key light stands at the left
//! behind the eye, the fill light at its right, the rim light high behind the model.

use std::f32::consts::{PI, TAU};
use std::sync::Arc;

use glam::Vec3;

use crate::color::Rgb;
use crate::desc::SceneDesc;
use crate::film::Image;
use crate::light::{EnvironmentDesc, ImageEnvironment};
use crate::material::{Mask, MaterialDesc, Principled};
use crate::names::Name;
use crate::setup::extent::Extent;
use crate::setup::unused;
use crate::shape::QuadDesc;
use crate::texture::{Color, Gradient, Interpolation, Mapping, Ramp, Scalar, Space, Stop, TextureDesc};

const WIDTH: u32 = 512;

/// A lamp behind a cloth, as seen from the model.
struct Softbox {
    /// Of its middle, to the right of the eye and upwards, degrees.
    at: [f32; 2],
    /// Half of its width and height, degrees.
    half: [f32; 2],
    /// Radiance in its middle.
    radiance: f32,
}

const SOFTBOXES: [Softbox; 3] = [
    Softbox { at: [-55.0, 48.0], half: [34.0, 24.0], radiance: 7.0 },
    Softbox { at: [70.0, 22.0], half: [22.0, 30.0], radiance: 1.1 },
    Softbox { at: [165.0, 58.0], half: [40.0, 12.0], radiance: 5.0 },
];

/// On all of it, so that white paper is a little darker than the picture's white.
const SCALE: f32 = 0.4;

/// Share of the light that the ground scatters, under the model and far from it.
const GROUND: [f32; 2] = [0.45, 0.2];

/// Radiance without softboxes, by the height of the direction as its sine.
fn backdrop(height: f32, ground: f32) -> f32 {
    /// From straight above.
    const ABOVE: f32 = 0.4;
    // Below the horizon it is the ground, above it brightens slowly.
    ground + (ABOVE - ground) * height.clamp(0.0, 1.0)
}

/// How much of a softbox is at an angle from its middle, over half its width: soft at the edges.
fn edge(over: f32) -> f32 {
    const SOFT: f32 = 0.25;
    let t = ((1.0 + SOFT - over.abs()) / (2.0 * SOFT)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// Its light, for an eye at a place that looks at another one.
pub(super) fn environment(look_from: [f32; 3], look_at: [f32; 3]) -> EnvironmentDesc {
    let back = Vec3::from(look_from) - Vec3::from(look_at);
    // The picture's left edge is behind the model as seen from an eye at +z.
    let rotation = libm::atan2f(back.x, back.z).to_degrees();
    let boxes = softboxes();
    // The horizon is as bright as the ground, which the horizon lights.
    let mut ground = 0.5;
    for _ in 0..4 {
        ground = GROUND[1] * irradiance(&boxes, ground) / PI;
    }
    let mut image = Image::new(WIDTH, WIDTH / 2);
    for (pixel, (softbox, height)) in image.pixels_mut().iter_mut().zip(boxes) {
        *pixel = [softbox + backdrop(height, ground); 3];
    }
    EnvironmentDesc::Image(ImageEnvironment {
        file: "studio".to_owned(),
        rotation,
        scale: SCALE,
        image: Some(Arc::new(image)),
    })
}

/// Light of the softboxes, and the sine of the height, of each pixel.
fn softboxes() -> Vec<(f32, f32)> {
    let places = (0..WIDTH / 2).flat_map(|y| (0..WIDTH).map(move |x| (x, y)));
    let light = |(x, y): (u32, u32)| {
        // As seen from the model: 0 is towards the eye, and to its right is positive.
        let azimuth = 180.0 - (x as f32 + 0.5) / WIDTH as f32 * 360.0;
        let elevation = 90.0 - (y as f32 + 0.5) / WIDTH as f32 * 360.0;
        let sum: f32 = SOFTBOXES.iter().map(|softbox| softbox.at(azimuth, elevation)).sum();
        (sum, libm::sinf(elevation.to_radians()))
    };
    places.map(light).collect()
}

impl Softbox {
    fn at(&self, azimuth: f32, elevation: f32) -> f32 {
        let across = (azimuth - self.at[0] + 540.0).rem_euclid(360.0) - 180.0;
        let along = across * libm::cosf(self.at[1].to_radians()).max(0.2);
        self.radiance * edge(along / self.half[0]) * edge((elevation - self.at[1]) / self.half[1])
    }
}

/// Of a ground under the sky of the studio, whose horizon has this radiance.
fn irradiance(boxes: &[(f32, f32)], ground: f32) -> f32 {
    let pixel = TAU / WIDTH as f32 * (TAU / WIDTH as f32);
    let of = |&(softbox, height): &(f32, f32)| {
        let cos = height.max(0.0);
        (softbox + backdrop(height, ground)) * cos * (1.0 - height * height).max(0.0).sqrt() * pixel
    };
    boxes.iter().map(of).sum()
}

/// A round ground under what there is: brightest there, and fading out where nothing is near.
pub(super) fn add_ground(desc: &mut SceneDesc, extent: &Extent) {
    /// Half its width, and where it begins to fade, in sizes of what stands on it.
    const HALF: f32 = 6.0;
    const FADES: f32 = 2.0;
    /// Where it begins to darken, and where it is dark.
    const DARKENS: [f32; 2] = [0.6, 2.8];
    let size = extent.size().max(1e-6);
    let center = extent.center();
    let y = extent.min.y - 1e-4 * size;
    let half = HALF * size;
    let names = ["ground", "ground.surface", "ground.distance", "ground.color"];
    let [name, surface, distance, color] = names.map(|name| unused(desc, name));
    // On the quad, so that it is the same for all units.
    let mapping =
        Mapping { space: Some(Space::Uv), scale: [2.0, 2.0, 0.0], offset: [-1.0, -1.0, 0.0], ..Mapping::default() };
    let radial = Gradient { radial: true, mapping, ..Gradient::default() };
    desc.texture.insert(distance.clone(), TextureDesc::Gradient(radial));
    let ramp = |stops: [(f32, f32); 2]| {
        let stops = stops.map(|(at, grey)| Stop { at: at / HALF, color: Rgb::grey(grey) }).into();
        let input = Scalar::Texture(Name::new(&distance));
        TextureDesc::Ramp(Ramp { input, stops, interpolation: Interpolation::Smooth })
    };
    desc.texture.insert(name.clone(), ramp([(FADES, 1.0), (HALF, 0.0)]));
    desc.texture.insert(color.clone(), ramp([(DARKENS[0], GROUND[0]), (DARKENS[1], GROUND[1])]));
    let matte = Principled {
        base_color: Color::Texture(Name::new(&color)),
        specular_roughness: 0.4.into(),
        specular_weight: 0.5.into(),
        ..Principled::default()
    };
    desc.material.insert(surface.clone(), MaterialDesc::Principled(Box::new(matte)));
    let mask = Mask::new(Name::new(&surface), Scalar::Texture(Name::new(&name)));
    desc.material.insert(name.clone(), MaterialDesc::Mask(mask));
    desc.shape.quad.push(QuadDesc {
        corner: [center.x - half, y, center.z + half],
        u: [2.0 * half, 0.0, 0.0],
        v: [0.0, 0.0, -2.0 * half],
        material: Some(name),
        ..QuadDesc::default()
    });
}
