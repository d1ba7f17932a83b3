//! Ray origins that do not hit the surface they start on.
//!
//! Pharr, Jakob & Humphreys, Physically Based Rendering, 4th ed. 2023, §6.8.6: the origin moves along the normal, to the side
//! that the ray leaves to, by as much as the point's rounding error reaches in that direction, and no farther, at every scale.

use glam::Vec3;

/// How far a ray must start from a surface point `p` with normal `n`, along this, if the point's coordinates are off by at most
/// `p_error`.
#[inline]
pub fn clearance(p: Vec3, p_error: Vec3, n: Vec3) -> f32 {
    // The sum of this and the point is rounded, too, by at most half of this.
    let rounding = p.abs() * f32::EPSILON;
    n.abs().dot(p_error + rounding)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use proptest::test_runner::RngSeed;

    proptest! {
        #![proptest_config(ProptestConfig { rng_seed: RngSeed::Fixed(1), failure_persistence: None, ..Default::default() })]

        /// The origin is on the side of `w`, farther from the surface than the point may be off, whatever was rounded.
        #[test]
        fn leaves_the_error_behind(
            p in prop::array::uniform3(-1.0f32..1.0),
            n in prop::array::uniform3(-1.0f32..1.0),
            w in prop::array::uniform3(-1.0f32..1.0),
            scale in prop::sample::select(vec![1e-6f32, 1.0, 1e6]),
        ) {
            let (p, n, w) = (Vec3::from(p) * scale, Vec3::from(n).normalize_or(Vec3::Y), Vec3::from(w));
            let p_error = p.abs() * f32::EPSILON;
            let origin = p + n * clearance(p, p_error, n).copysign(w.dot(n));
            let moved = (origin.as_dvec3() - p.as_dvec3()).dot(n.as_dvec3());
            let needed = p_error.as_dvec3().dot(n.abs().as_dvec3());
            prop_assert!(moved.abs() >= needed && (moved > 0.0) == (w.dot(n) >= 0.0), "{moved} of {needed}");
        }
    }
}
