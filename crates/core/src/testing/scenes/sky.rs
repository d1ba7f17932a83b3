//! The computed sky over a floor.

use std::f64::consts::PI;

use glam::DVec3;

use super::KnownScene;
use super::build::*;
use crate::color::luminance;
use crate::light::sky::SkyDesc;
use crate::light::{EnvironmentDesc, EnvironmentSampling};

pub(super) fn scenes() -> Vec<KnownScene> {
    let [sky, sun] = irradiance();
    vec![
        under("floor under a sky without its sun", SkyDesc { sun: 0.0, ..description() }, sky),
        under("floor under a sky and its sun", description(), sky + sun).hidden(),
    ]
}

fn description() -> SkyDesc {
    SkyDesc { sun_elevation: Some(35.0), sun_azimuth: Some(120.0), turbidity: 3.0, scale: 3.0, ..SkyDesc::default() }
}

fn under(name: &str, sky: SkyDesc, irradiance: f64) -> KnownScene {
    KnownScene::new(name, lit_floor(EnvironmentDesc::Sky(sky)), 2, floor_at(irradiance))
}

/// Of the sky ∫ L cos θ dω, by midpoints of a fine grid; of a disk of half angle α at the zenith angle θ, all above the
/// horizon, L π sin² α cos θ.
fn irradiance() -> [f64; 2] {
    const FINE: u32 = 1024;
    let desc = description();
    let (sky, sun) = EnvironmentDesc::Sky(desc.clone()).compile(EnvironmentSampling::default());
    let middle = |i: u32| (f64::from(i) + 0.5) / f64::from(FINE);
    let at = |i: u32, j: u32| {
        let ((sin, cos), (sin_phi, cos_phi)) = ((0.5 * PI * middle(i)).sin_cos(), (2.0 * PI * middle(j)).sin_cos());
        let w = DVec3::new(sin * cos_phi, cos, sin * sin_phi).as_vec3();
        luminance(sky.le(w).to_rgb().map(f64::from)) * cos * sin
    };
    let sum: f64 = (0..FINE).map(|i| (0..FINE).map(|j| at(i, j)).sum::<f64>()).sum();
    let to_sun = desc.direction_to_sun();
    let radiance = sun.map_or(0.0, |sun| luminance(sun.le(to_sun).to_rgb().map(f64::from)));
    let sin = (0.5 * f64::from(desc.sun_size)).to_radians().sin();
    [sum * PI * PI / f64::from(FINE * FINE), radiance * PI * sin * sin * f64::from(to_sun.y)]
}
