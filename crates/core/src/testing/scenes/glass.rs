//! Glass: nothing is lost in it, and Fresnel's shares add up.

use super::KnownScene;
use super::build::*;
use crate::color::Rgb;
use crate::light::{EnvironmentDesc, Gradient};
use crate::material::{Dielectric, MaterialDesc};

pub(super) fn scenes() -> Vec<KnownScene> {
    let furnaces = [ball(1.5), ball(0.8), hollow_ball(), inside(1.5), inside(2.42)];
    furnaces.into_iter().chain([0.0, 45.0, 75.0].map(slab)).collect()
}

fn glass(eta: f32) -> MaterialDesc {
    MaterialDesc::Dielectric(Dielectric { eta, ..Dielectric::default() })
}

fn ball(eta: f32) -> KnownScene {
    let mut desc = empty(WHITE, stare([0.0, 0.0, 3.0], [0.5, 0.6, 0.0]));
    add_sphere(&mut desc, [0.0; 3], 1.0, "glass", glass(eta));
    KnownScene::new(format!("white furnace, glass of index {eta}"), desc, 10_000, 1.0)
}

fn hollow_ball() -> KnownScene {
    let mut scene = ball(1.5);
    add_sphere(&mut scene.desc, [0.0; 3], 0.9, "hollow", glass(1.0 / 1.5));
    KnownScene { name: "white furnace, hollow glass".to_owned(), ..scene }
}

/// Under water the sky is brighter by eta²: the same light comes from a smaller solid angle.
fn inside(eta: f32) -> KnownScene {
    let mut desc = empty(WHITE, stare([0.1, 0.0, 0.0], [0.0, 0.4, -1.0]));
    add_sphere(&mut desc, [0.0; 3], 1.0, "glass", glass(eta));
    KnownScene::new(format!("inside glass of index {eta}"), desc, 1000, f64::from(eta * eta))
}

/// A plate between a sky and darker ground, seen at an angle. Of light that meets it 2R / (1 + R) is reflected and
/// (1 − R) / (1 + R) goes through, all reflections within it added up.
fn slab(degrees: f64) -> KnownScene {
    let (sin, cos) = degrees.to_radians().sin_cos();
    let sky = Gradient { bottom: Rgb::grey(0.0), top: Rgb::grey(1.0) };
    let mut desc =
        empty(EnvironmentDesc::Gradient(sky), stare([0.3 + 2.0 * sin as f32, 2.0 * cos as f32, 0.1], [0.3, 0.0, 0.1]));
    let [[x, y, z], u, v] = floor(-0.2);
    add_quad(&mut desc, floor(0.0), "glass", glass(1.5));
    add_quad(&mut desc, [[x, y, -z], u, v.map(|x| -x)], "glass", glass(1.5));
    let r = reflectance(cos, 1.5);
    let [above, below] = [0.5 * (1.0 + cos), 0.5 * (1.0 - cos)];
    let expected = 2.0 * r / (1.0 + r) * above + (1.0 - r) / (1.0 + r) * below;
    KnownScene::new(format!("plate of glass at {degrees} degrees"), desc, 200, expected)
}

/// Fresnel's share for unpolarised light, by the sines of both angles and what Snell's law says of them.
pub(super) fn reflectance(cos_i: f64, eta: f64) -> f64 {
    let cos_t = (1.0 - (1.0 - cos_i * cos_i) / (eta * eta)).sqrt();
    let perpendicular = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
    let parallel = (cos_t - eta * cos_i) / (cos_t + eta * cos_i);
    0.5 * (perpendicular.powi(2) + parallel.powi(2))
}
