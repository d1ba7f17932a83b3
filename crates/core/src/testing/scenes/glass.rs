//! Glass: nothing is lost in it, Fresnel's shares add up, and colours go where Snell sends them.

use super::KnownScene;
use super::build::*;
use crate::color::{Rgb, Wavelength, luminance};
use crate::light::{EnvironmentDesc, Gradient};
use crate::material::{Dielectric, MaterialDesc, Principled};

pub(super) fn scenes() -> Vec<KnownScene> {
    let furnaces = [ball(1.5), ball(0.8), hollow_ball(), inside(1.5), inside(2.42)];
    let spectra =
        [40.0, 70.0].into_iter().flat_map(|degrees| [false, true].map(|layers| half_a_spectrum(degrees, layers)));
    furnaces.into_iter().chain([0.0, 45.0, 75.0].map(slab)).chain(spectra).collect()
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

/// The edge of a lamp below flint glass, seen at an angle from above: where the middle of the spectrum would meet it. Blue light is bent
/// more, and misses the lamp. Within layers it is bent so, but all colours are reflected alike.
fn half_a_spectrum(degrees: f64, layers: bool) -> KnownScene {
    const N: u32 = 1 << 16;
    const DEPTH: f64 = 0.5;
    const RADIANCE: f32 = 2.0;
    let (index, abbe_number) = (1.6_f32, 8.0_f32);
    let (sin, cos) = degrees.to_radians().sin_cos();
    let glass = if layers {
        MaterialDesc::Principled(Box::new(Principled {
            transmission_weight: 1.0.into(),
            specular_roughness: 0.0.into(),
            specular_ior: index,
            transmission_dispersion_scale: 0.5,
            transmission_dispersion_abbe_number: 0.5 * abbe_number,
            ..Principled::default()
        }))
    } else {
        MaterialDesc::Dielectric(Dielectric { eta: index, abbe_number: Some(abbe_number), ..Dielectric::default() })
    };
    // Where it goes below, to the left of the point that is looked at.
    let meets = |n: f64| DEPTH * (sin / n) / (1.0 - (sin / n).powi(2)).sqrt();
    let edge = meets(f64::from(index)) as f32;
    let mut desc = empty(DARK, stare([sin as f32, cos as f32, 0.0], [0.0; 3]));
    add_quad(&mut desc, floor(0.0), "glass", glass);
    let below = -DEPTH as f32;
    add_quad(&mut desc, [[-9.0, below, -9.0], [0.0, 0.0, 18.0], [9.0 - edge, 0.0, 0.0]], "lamp", lamp(RADIANCE));
    let inverse_square = |nm: f64| nm.powi(-2);
    let expected = |i: u32| {
        let Wavelength { nm, color } = Wavelength::sample((i as f32 + 0.5) / N as f32);
        let change =
            (inverse_square(nm.into()) - inverse_square(587.56)) / (inverse_square(486.13) - inverse_square(656.27));
        let n = f64::from(index) + f64::from(index - 1.0) / f64::from(abbe_number) * change;
        let reflected = reflectance(cos, if layers { index.into() } else { n });
        let seen = if meets(n) > f64::from(edge) { f64::from(RADIANCE) } else { 0.0 };
        seen * (1.0 - reflected) * luminance(color.to_rgb().map(f64::from)) / (n * n)
    };
    let expected = (0..N).map(expected).sum::<f64>() / f64::from(N);
    let kind = if layers { "layers" } else { "glass" };
    KnownScene::new(format!("half a spectrum in {kind} at {degrees} degrees"), desc, 2, expected)
}

/// Fresnel's share for unpolarised light, by the sines of both angles and what Snell's law says of them.
pub(super) fn reflectance(cos_i: f64, eta: f64) -> f64 {
    let cos_t = (1.0 - (1.0 - cos_i * cos_i) / (eta * eta)).sqrt();
    let perpendicular = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
    let parallel = (cos_t - eta * cos_i) / (cos_t + eta * cos_i);
    0.5 * (perpendicular.powi(2) + parallel.powi(2))
}
