//! Vectors that should have length 1 and are off by roundings.

use glam::Vec3;

/// The unit vector along one whose length is 1 but for roundings: a step of Newton's, without a root or a division. An error
/// of e becomes one of 1.5 e².
#[inline]
pub fn renormalize(v: Vec3) -> Vec3 {
    v * (1.5 - 0.5 * v.length_squared())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampler::Independent;
    use crate::sampling::uniform_sphere;
    use glam::UVec2;

    #[test]
    fn as_good_as_a_root() {
        for i in 0..1000 {
            let mut numbers = Independent::new(1, UVec2::ZERO, i);
            let w = uniform_sphere(numbers.get_2d());
            let off = w * (1.0 + 1e-4 * (numbers.get_1d() - 0.5));
            let length = renormalize(off).as_dvec3().length();
            assert!((length - 1.0).abs() < 2e-7, "{length}");
        }
    }
}
