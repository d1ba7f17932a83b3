//! A planet: a cube's faces bent to a sphere, displaced by fractal noise, above a floor. All triangles are about as large.

use std::f32::consts::FRAC_PI_2;

use glam::Vec3;

use super::noise::{fractal_noise, value_noise};
use super::{Model, View};

/// Of 12 n² + 2 triangles.
pub(super) fn model(n: u32) -> Model {
    let mut model = Model {
        view: View { eye: Vec3::new(0.3, 0.7, 2.35), look_at: Vec3::new(0.0, -0.05, 0.0), vfov_deg: 45.0 },
        lights: vec![
            [Vec3::new(-3.0, 4.0, -1.0), Vec3::X * 3.0, Vec3::Z * 3.0],
            [Vec3::new(3.0, 1.0, 3.0), Vec3::Y * 2.0, Vec3::new(2.0, 0.0, -2.0)],
        ],
        ..Model::default()
    };
    for axis in 0..3 {
        for side in [1.0, -1.0] {
            model.grid(n, n, |u, v| surface(axis, side, u, v));
        }
    }
    model.patch([Vec3::new(-8.0, -1.25, -8.0), Vec3::Z * 16.0, Vec3::X * 16.0]);
    model
}

/// A point of the face of the cube that is on one side of one axis. The tangent spaces the points evenly.
fn surface(axis: usize, side: f32, u: f32, v: f32) -> Vec3 {
    let mut p = Vec3::ZERO;
    p[axis] = side;
    p[(axis + 1) % 3] = ((u - 0.5) * FRAC_PI_2).tan() * side;
    p[(axis + 2) % 3] = ((v - 0.5) * FRAC_PI_2).tan();
    let p = p.normalize();
    p * (1.0 + 0.16 * fractal_noise(p * 4.0, 8) + 0.02 * value_noise(p * 60.0))
}
