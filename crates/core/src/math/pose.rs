//! Where something stands that looks somewhere, and how it is turned.

use glam::{DVec3, Vec3};

/// The eye and three unit vectors at right angles: the picture's right, its bottom, and the direction of view. Local
/// coordinates count along them, from the eye.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pose {
    pub(crate) eye: Vec3,
    right: Vec3,
    down: Vec3,
    pub(crate) forward: Vec3,
}

impl Pose {
    /// Looks somewhere, also if that is nowhere. Right angles hold in double precision, even where `up` points almost along the line of sight.
    pub(crate) fn new(eye: [f32; 3], at: [f32; 3], up: [f32; 3]) -> Self {
        let [eye, at, up] = [eye, at, up].map(|v| Vec3::from(v).as_dvec3());
        let forward = (at - eye).normalize_or(DVec3::NEG_Z);
        let right = forward.cross(up.normalize_or(DVec3::Y)).try_normalize();
        let right = right.unwrap_or_else(|| forward.any_orthonormal_vector());
        let down = forward.cross(right);
        let [eye, right, down, forward] = [eye, right, down, forward].map(|v: DVec3| v.as_vec3());
        Self { eye, right, down, forward }
    }

    /// A local direction in the world.
    #[inline]
    pub(crate) fn to_world(self, v: Vec3) -> Vec3 {
        v.x * self.right + v.y * self.down + v.z * self.forward
    }

    /// A point of the world in local coordinates.
    #[inline]
    pub(crate) fn to_local(self, p: Vec3) -> Vec3 {
        self.direction_to_local(p - self.eye)
    }

    /// A direction of the world in local coordinates.
    #[inline]
    pub(crate) fn direction_to_local(self, w: Vec3) -> Vec3 {
        Vec3::new(w.dot(self.right), w.dot(self.down), w.dot(self.forward))
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
                let pose = Pose::new([0.0; 3], look_at, up);
                let Pose { right, down, forward, .. } = pose;
                assert!((right.cross(down) - forward).length() < 1e-6, "{up:?} {look_at:?}: {pose:?}");
                assert!([right, down, forward].iter().all(|v| (v.length() - 1.0).abs() < 1e-6));
                let up = Vec3::from(up).as_dvec3().normalize().as_vec3();
                assert!(up.dot(right).abs() < 1e-6 && up.dot(down) < 0.0, "{up:?} {look_at:?}: {pose:?}");
            }
        }
    }
}
