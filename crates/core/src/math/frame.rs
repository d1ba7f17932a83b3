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
            let frame = Frame::from_z(n.normalize());
            let v = Vec3::new(0.3, -0.5, 0.7);
            prop_assert!((frame.to_world(frame.to_local(v)) - v).length() < 1e-5);
            prop_assert!((frame.to_local(n.normalize()) - Vec3::Z).length() < 1e-5);
            prop_assert!((frame.x.cross(frame.y) - frame.z).length() < 1e-5);
        }
    }
}
