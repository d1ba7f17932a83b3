//! Where a camera stands and how it is turned.

use glam::{DVec3, Vec3};

use crate::camera::CameraDesc;

/// The eye and three unit vectors at right angles: the picture's right, its bottom, and the direction of view. Local
/// coordinates count along them, from the eye.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pose {
    pub(super) eye: Vec3,
    right: Vec3,
    down: Vec3,
    pub(super) forward: Vec3,
}

impl Pose {
    /// Right angles hold in double precision, even where `up` points almost along the line of sight.
    pub(super) fn new(desc: &CameraDesc) -> Self {
        let [eye, at, up] = [desc.look_from, desc.look_at, desc.up].map(|v| Vec3::from(v).as_dvec3());
        let forward = (at - eye).normalize();
        let right = forward.cross(up.normalize()).normalize();
        let down = forward.cross(right);
        let [eye, right, down, forward] = [eye, right, down, forward].map(|v: DVec3| v.as_vec3());
        Self { eye, right, down, forward }
    }

    /// A local direction in the world.
    #[inline]
    pub(super) fn to_world(self, v: Vec3) -> Vec3 {
        v.x * self.right + v.y * self.down + v.z * self.forward
    }

    /// A point of the world in local coordinates.
    #[inline]
    pub(super) fn to_local(self, p: Vec3) -> Vec3 {
        let v = p - self.eye;
        Vec3::new(v.dot(self.right), v.dot(self.down), v.dot(self.forward))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Also where single precision would have no idea of what is to the right.
    #[test]
    fn is_orthonormal() {
        for up in [[0.0, 1.0, 0.0], [1e-5, 0.0, 1.0], [1e-30, 2e-30, 0.0], [3e14, 1e15, 0.0]] {
            for look_at in [[1.0, 2.0, 9.0], [1e-30, 2e-30, 3e-30], [1e15, -1e15, 1e15], [0.0, 0.0, -1.0]] {
                let pose = Pose::new(&CameraDesc { look_from: [0.0; 3], look_at, up, ..CameraDesc::default() });
                let Pose { right, down, forward, .. } = pose;
                assert!((right.cross(down) - forward).length() < 1e-6, "{up:?} {look_at:?}: {pose:?}");
                assert!([right, down, forward].iter().all(|v| (v.length() - 1.0).abs() < 1e-6));
                let up = Vec3::from(up).as_dvec3().normalize().as_vec3();
                assert!(up.dot(right).abs() < 1e-6 && up.dot(down) < 0.0, "{up:?} {look_at:?}: {pose:?}");
            }
        }
    }
}
