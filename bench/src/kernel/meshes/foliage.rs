//! Leaves of two triangles, turned anyhow, in clumps above a terrain: their boxes overlap more than any tree can part.

use glam::Vec3;

use super::noise::fractal_noise;
use super::{Model, View, random_direction, random_point};
use crate::kernel::random::Random;

/// With as many leaves.
pub(super) fn model(leaves: usize) -> Model {
    const CLUMPS: usize = 220;
    let mut model = Model {
        view: View { eye: Vec3::new(-9.0, 2.6, -9.0), look_at: Vec3::new(0.0, 1.3, 0.0), vfov_deg: 60.0 },
        lights: vec![[Vec3::new(-6.0, 9.0, -6.0), Vec3::X * 12.0, Vec3::Z * 12.0]],
        ..Model::default()
    };
    let mut random = Random(11);
    model.grid(256, 256, |u, v| {
        let p = Vec3::new(u * 20.0 - 10.0, 0.0, v * 20.0 - 10.0);
        p.with_y(0.5 * fractal_noise(p * 0.4, 5))
    });
    let clumps = [(); CLUMPS].map(|()| random_point(&mut random, [-9.5, 9.5], [1.0, 2.6], [-9.5, 9.5]));
    for clump in clumps.iter().cycle().take(leaves) {
        leaf(&mut model, *clump, &mut random);
    }
    model
}

fn leaf(model: &mut Model, clump: Vec3, random: &mut Random) {
    let outward = random_direction(random);
    let radius = 0.9 * random.unit().powf(0.4);
    let p = clump + Vec3::new(outward.x * radius, outward.y * radius * 1.2, outward.z * radius);
    let along = random_direction(random);
    let across = along.cross(outward).normalize();
    let size = random.range(0.008, 0.025);
    model.patch([p, along * (size * 2.0), across * size]);
}
