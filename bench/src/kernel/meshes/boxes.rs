//! Two boxes in a box that is open to the front: the smallest mesh, for trying.

use glam::Vec3;

use super::{Model, View};

pub(super) fn model() -> Model {
    let mut model = Model {
        view: View { eye: Vec3::new(0.0, 1.0, 3.8), look_at: Vec3::Y, vfov_deg: 40.0 },
        lights: vec![[Vec3::new(-0.24, 1.98, -0.22), Vec3::X * 0.47, Vec3::Z * 0.38]],
        ..Model::default()
    };
    let (x, y, z) = (Vec3::X * 2.0, Vec3::Y * 2.0, Vec3::Z * 2.0);
    let corner = Vec3::new(-1.0, 0.0, -1.0);
    for wall in [[corner, z, x], [corner + y, x, z], [corner, x, y], [corner, y, z], [corner + x, z, y]] {
        model.patch(wall);
    }
    for (center, half_height, turn) in
        [(Vec3::new(-0.35, 0.6, -0.3), 0.6, 0.1), (Vec3::new(0.35, 0.3, 0.35), 0.3, -0.1)]
    {
        let half = [Vec3::new(0.28, 0.0, turn), Vec3::Y * half_height, Vec3::new(-turn, 0.0, 0.28)];
        model.cuboid(center, half);
    }
    model
}
