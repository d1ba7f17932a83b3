//! Local coordinates at a surface.
//!
//! Duff et al. 2017, "Building an Orthonormal Basis, Revisited", Journal of Computer Graphics Techniques 6(1).

use glam::Vec3;

/// Three unit vectors at right angles; `z` is the surface normal.
#[derive(Clone, Copy, Debug)]
pub struct Frame {
    x: Vec3,
    y: Vec3,
    z: Vec3,
}

impl Frame {
    /// The frame around a unit normal.
    #[inline]
    pub fn from_z(z: Vec3) -> Self {
        let sign = 1.0_f32.copysign(z.z);
        let a = -1.0 / (sign + z.z);
        let b = z.x * z.y * a;
        Self {
            x: Vec3::new(1.0 + sign * z.x * z.x * a, sign * b, -sign * z.x),
            y: Vec3::new(b, sign + z.y * z.y * a, -z.y),
            z,
        }
    }

    /// The frame around a unit normal whose x axis is as near to a direction as it can be; any frame if that is none.
    pub fn from_zx(z: Vec3, x: Vec3) -> Self {
        let Some(x) = x.try_normalize().and_then(|x| (x - z * x.dot(z)).try_normalize()) else {
            return Self::from_z(z);
        };
        Self { x, y: z.cross(x), z }
    }

    /// The same with its y axis turned round.
    pub fn mirrored(self) -> Self {
        Self { y: -self.y, ..self }
    }

    /// World to local.
    #[inline]
    pub fn to_local(&self, v: Vec3) -> Vec3 {
        Vec3::new(v.dot(self.x), v.dot(self.y), v.dot(self.z))
    }

    /// Local to world.
    #[inline]
    pub fn to_world(&self, v: Vec3) -> Vec3 {
        self.x * v.x + self.y * v.y + self.z * v.z
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use proptest::test_runner::RngSeed;

    proptest! {
        #![proptest_config(ProptestConfig { rng_seed: RngSeed::Fixed(1), failure_persistence: None, ..Default::default() })]

        #[test]
        fn is_orthonormal_and_round_trips(x in -1.0f32..1.0, y in -1.0f32..1.0, z in -1.0f32..1.0) {
            let n = Vec3::new(x, y, z);
            prop_assume!(n.length() > 1e-3);
            for frame in [Frame::from_z(n.normalize()), Frame::from_zx(n.normalize(), Vec3::new(0.1, 0.7, z))] {
            let v = Vec3::new(0.3, -0.5, 0.7);
            prop_assert!((frame.to_world(frame.to_local(v)) - v).length() < 1e-5);
            prop_assert!((frame.to_local(n.normalize()) - Vec3::Z).length() < 1e-5);
            prop_assert!((frame.x.cross(frame.y) - frame.z).length() < 1e-5);
            }
        }

        /// The x axis is in the plane of the normal and the direction that it shall follow.
        #[test]
        fn follows_a_direction(x in -1.0f32..1.0, y in -1.0f32..1.0, z in -1.0f32..1.0) {
            let n = Vec3::new(x, y, z);
            prop_assume!(n.length() > 1e-3 && n.normalize().y.abs() < 0.99);
            let frame = Frame::from_zx(n.normalize(), 5.0 * Vec3::Y);
            prop_assert!(frame.x.y > 0.0 && frame.x.dot(n.cross(Vec3::Y)).abs() < 1e-5);
        }
    }
}
