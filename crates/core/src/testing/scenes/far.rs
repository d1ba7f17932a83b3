//! Light from infinitely far away.

use std::f64::consts::PI;
use std::sync::Arc;

use super::KnownScene;
use super::build::*;
use crate::color::Rgb;
use crate::film::Image;
use crate::light::{DirectionalLight, EnvironmentDesc, Gradient, ImageEnvironment};

pub(super) fn scenes() -> Vec<KnownScene> {
    vec![gradient(), sun(0.0).hidden(), sun(5.0), sun(40.0), in_the_sun(), even_picture(), spotted_picture()]
}

/// ∫ lerp(bottom, top, (1 + cos θ) / 2) cos θ dω = π (bottom + top) / 2 + π (top − bottom) / 3.
fn gradient() -> KnownScene {
    let (bottom, top) = (0.2, 1.7);
    let sky = Gradient { bottom: Rgb::grey(bottom), top: Rgb::grey(top) };
    let (bottom, top) = (f64::from(bottom), f64::from(top));
    let expected = floor_at(PI * ((bottom + top) / 2.0 + (top - bottom) / 3.0));
    KnownScene::new("floor under a gradient", lit_floor(EnvironmentDesc::Gradient(sky)), 2, expected)
}

const TO_SUN: [f32; 3] = [0.6, 0.7, 0.45];

fn sunlight(angle: f32) -> DirectionalLight {
    DirectionalLight { direction: TO_SUN, irradiance: Rgb::grey(2.0), angle }
}

/// Above the horizon the irradiance is that of a point in the middle.
fn sun(angle: f32) -> KnownScene {
    let mut desc = lit_floor(DARK);
    desc.light.directional.push(sunlight(angle));
    let [x, y, z] = TO_SUN.map(f64::from);
    let cos = y / (x * x + y * y + z * z).sqrt();
    KnownScene::new(format!("floor under a sun of {angle} degrees"), desc, 2, floor_at(2.0 * cos))
}

/// A disk of half angle α that brings the irradiance E has the radiance E / (π sin² α).
fn in_the_sun() -> KnownScene {
    let mut desc = empty(DARK, stare([0.0; 3], TO_SUN));
    desc.light.directional.push(sunlight(0.53));
    let sin = (0.5 * 0.53_f64).to_radians().sin();
    KnownScene::new("disk of the sun", desc, 1, 2.0 / (PI * sin * sin))
}

fn picture(image: Image) -> EnvironmentDesc {
    let file = "sky".to_owned();
    EnvironmentDesc::Image(ImageEnvironment { file, rotation: 25.0, scale: 1.0, image: Some(Arc::new(image)) })
}

/// An even picture is an even sky.
fn even_picture() -> KnownScene {
    let mut image = Image::new(8, 4);
    (0..32).for_each(|i| image.set_pixel(i % 8, i / 8, [0.6; 3]));
    KnownScene::new("floor under an even picture", lit_floor(picture(image)), 2, floor_at(PI * f64::from(0.6_f32)))
}

/// A picture with bright spots. Its irradiance is ∫ L(φ, θ) cos θ sin θ dθ dφ, and as L is linear between the pixels' centres
/// the mean over φ is that of a row, linear between rows: midpoints of a fine grid of θ.
fn spotted_picture() -> KnownScene {
    const SIZE: [u32; 2] = [32, 16];
    const FINE: u32 = 100_000;
    let mut image = Image::new(SIZE[0], SIZE[1]);
    for (x, y) in (0..SIZE[1]).flat_map(|y| (0..SIZE[0]).map(move |x| (x, y))) {
        let spot = match (x, y) {
            (4, 3) => 90.0,
            (20..23, 5..7) => 12.0,
            _ => 0.0,
        };
        image.set_pixel(x, y, [0.3 + 0.01 * y as f32 + spot; 3]);
    }
    let row = |y: u32| (0..SIZE[0]).map(|x| f64::from(image.pixel(x, y)[0])).sum::<f64>() / f64::from(SIZE[0]);
    let rows: Vec<f64> = (0..SIZE[1]).map(row).collect();
    let at = |v: f64| {
        let y = (v * f64::from(SIZE[1]) - 0.5).max(0.0);
        let k = y as usize;
        rows[k] + (rows[(k + 1).min(rows.len() - 1)] - rows[k]) * y.fract()
    };
    let ring = |i: u32| {
        let v = 0.5 * (f64::from(i) + 0.5) / f64::from(FINE);
        let (sin, cos) = (PI * v).sin_cos();
        at(v) * cos * sin
    };
    let irradiance = 2.0 * PI * PI * 0.5 / f64::from(FINE) * (0..FINE).map(ring).sum::<f64>();
    KnownScene::new("floor under a picture with bright spots", lit_floor(picture(image)), 2, floor_at(irradiance))
}
