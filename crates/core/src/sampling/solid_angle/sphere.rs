//! The cone of directions in which a sphere is seen.
//!
//! With distance D to the centre and radius r, the cone's half angle has cos² θₘ = (D² − r²) / D². A uniform point d of
//! the unit disk, ρ = |d|, becomes the direction with
//!
//! 1 − cos θ = ρ² (1 − cos θₘ) and azimuth of d,
//!
//! the equal-area map of disk and cap (Lambert 1772), so directions are uniform, with density 1 / (2π (1 − cos θₘ)).
//! Pharr, Jakob & Humphreys, Physically Based Rendering, 4th ed. 2023, §6.2.4.
//!
//! Written with 1 − cos θₘ = sin² θₘ / (1 + cos θₘ) and ρ² beside 1 − ρ², everything is a sum or product of positive
//! numbers: nothing cancels, neither for far spheres nor near to the surface. No function but square roots is needed.

use std::f32::consts::TAU;

use glam::{Vec2, Vec3};

use crate::math::Frame;
use crate::sampling::uniform_disk;

/// A sphere seen from a point outside of it.
#[derive(Clone, Copy, Debug)]
pub struct SphereCone {
    /// Around the direction to the centre.
    frame: Frame,
    /// To the centre.
    distance: f32,
    /// Of the cone's half angle.
    cos_max: f32,
    one_minus_cos_max: f32,
}

/// A direction to a point of a sphere.
#[derive(Clone, Copy, Debug)]
pub struct SphereSample {
    /// Unit direction from the reference point.
    pub wi: Vec3,
    /// From the reference point to the first point of the sphere in this direction.
    pub distance: f32,
}

impl SphereCone {
    /// The sphere seen from `p`; none from inside, from its surface, or if it is too small for single precision to hold
    /// the density.
    #[inline]
    pub fn new(center: Vec3, radius: f32, p: Vec3) -> Option<Self> {
        // The squares' difference near the surface needs double precision.
        let to_center = center.as_dvec3() - p.as_dvec3();
        let (distance_sq, radius_sq) = (to_center.length_squared(), f64::from(radius) * f64::from(radius));
        let cos_max_sq = (distance_sq - radius_sq) / distance_sq;
        let cos_max = cos_max_sq.sqrt();
        let one_minus_cos_max = (radius_sq / (distance_sq * (1.0 + cos_max))) as f32;
        let distance = distance_sq.sqrt();
        (cos_max_sq > 0.0 && one_minus_cos_max >= f32::MIN_POSITIVE).then(|| Self {
            frame: Frame::from_z((to_center / distance).as_vec3()),
            distance: distance as f32,
            cos_max: cos_max as f32,
            one_minus_cos_max,
        })
    }

    /// A direction of the cone. One at its very rim may pass by the sphere for rounding.
    #[inline]
    pub fn sample(&self, u: Vec2) -> SphereSample {
        let d = uniform_disk(u);
        let rho_sq = d.length_squared().min(1.0);
        let rest = 1.0 - rho_sq;
        let cos = rest + rho_sq * self.cos_max;
        let local = (d * (self.one_minus_cos_max * (1.0 + cos)).sqrt()).extend(cos);
        // The near one of the ray's two meetings with the sphere; their product is D² − r².
        let half_chord = (self.one_minus_cos_max * rest * (cos + self.cos_max)).sqrt();
        let distance = self.distance * self.cos_max * (self.cos_max / (cos + half_chord));
        SphereSample { wi: self.frame.to_world(local).normalize(), distance }
    }

    /// The density of every direction that meets the sphere, 1/sr.
    #[inline]
    pub fn pdf(&self) -> f32 {
        1.0 / self.solid_angle()
    }

    /// The cone's solid angle, sr.
    #[inline]
    pub fn solid_angle(&self) -> f32 {
        TAU * self.one_minus_cos_max
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use proptest::test_runner::RngSeed;

    use super::super::tests::{SAMPLES, check_uniform, numbers};
    use super::*;
    use crate::testing::chi2_counts;

    #[test]
    fn directions_are_uniform_in_the_cone() {
        let p = Vec3::new(0.3, -2.0, 5.0);
        for (offset, radius) in
            [(Vec3::new(1.0, 2.0, -2.0), 1.0), (Vec3::new(-3.0, 0.1, 4.0), 4.9), (Vec3::new(0.5, -0.4, -7.0), 3.0)]
        {
            let center = p + offset;
            let cone = SphereCone::new(center, radius, p).unwrap();
            let to_center = center.as_dvec3() - p.as_dvec3();
            let tangent = (to_center.length_squared() - f64::from(radius * radius)).sqrt();
            let meets = |w: glam::DVec3| w.dot(to_center) > tangent;
            check_uniform(f64::from(cone.solid_angle()), |u| cone.sample(u).wi, meets);
            assert_eq!(cone.pdf(), 1.0 / cone.solid_angle());
        }
    }

    /// Tiny, huge, far, near to the surface: the share of the cap within θ and the azimuth are uniform, with sizes in
    /// double precision from the textbook's formulas.
    #[test]
    fn caps_are_uniform_at_every_scale() {
        const BINS: usize = 20;
        for (radius, distance) in
            [(1e-6, 1.0), (1e-6, 1e9), (1e5, 1e5 + 0.05), (1.0, 1.000_001), (1e-3, 2e-3), (1.0, 1e4)]
        {
            let cone = SphereCone::new(Vec3::Z * distance, radius, Vec3::ZERO).unwrap();
            let sin_max = f64::from(radius) / f64::from(distance);
            let versine = |sin_sq: f64, cos: f64| if cos > 0.5 { sin_sq / (1.0 + cos) } else { 1.0 - cos };
            let cap = versine(sin_max * sin_max, (1.0 - sin_max * sin_max).sqrt());
            assert!((f64::from(cone.solid_angle()) / (std::f64::consts::TAU * cap) - 1.0).abs() < 1e-6);
            let mut counts = [0; BINS * BINS];
            for s in (0..SAMPLES).map(|i| cone.sample(numbers(i))) {
                let w = s.wi.as_dvec3();
                let share = versine(w.x * w.x + w.y * w.y, w.z) / cap;
                let turn = (w.y.atan2(w.x) / std::f64::consts::TAU).rem_euclid(1.0);
                assert!(share <= 1.0 + 1e-6);
                let part = |t: f64| ((t * BINS as f64) as usize).min(BINS - 1);
                counts[part(share) * BINS + part(turn)] += 1;
            }
            let expected = f64::from(SAMPLES) / counts.len() as f64;
            chi2_counts(&counts, &vec![expected; counts.len()]).unwrap();
        }
    }

    #[test]
    fn distances_end_on_the_near_side() {
        let (center, p) = (Vec3::new(4.0, -1.0, 2.0), Vec3::new(1.0, 1.0, 1.0));
        for radius in [1e-3, 0.5, 3.0, 3.74] {
            let cone = SphereCone::new(center, radius, p).unwrap();
            for s in (0..10_000).map(|i| cone.sample(numbers(i))) {
                let out = p.as_dvec3() + s.wi.as_dvec3() * f64::from(s.distance) - center.as_dvec3();
                assert!((out.length() - f64::from(radius)).abs() < 2e-6, "{s:?}");
                assert!(out.dot(s.wi.as_dvec3()) < 1e-3 * f64::from(radius), "{s:?} is on the far side");
            }
        }
    }

    #[test]
    fn known_values() {
        // Seen at a half angle of 60 degrees: half of a hemisphere.
        let cone = SphereCone::new(Vec3::X, 0.75_f32.sqrt(), Vec3::ZERO).unwrap();
        assert!((cone.solid_angle() / std::f32::consts::PI - 1.0).abs() < 1e-6);
        assert!((cone.sample(Vec2::splat(0.5)).distance - (1.0 - 0.75_f32.sqrt())).abs() < 1e-6);
        for inside in [Vec3::ZERO, Vec3::Y, Vec3::new(0.1, 0.2, 0.3)] {
            assert!(SphereCone::new(Vec3::ZERO, 1.0, inside).is_none());
        }
        assert!(SphereCone::new(Vec3::ZERO, 0.0, Vec3::X).is_none());
    }

    proptest! {
        #![proptest_config(ProptestConfig { rng_seed: RngSeed::Fixed(1), failure_persistence: None, ..Default::default() })]

        #[test]
        fn numbers_stay_numbers(
            center in prop::array::uniform3(-1.0f32..1.0),
            scales in prop::array::uniform2(-15.0f32..15.0),
            p in prop::array::uniform3(-1.0f32..1.0),
            u in prop::array::uniform2(0.0f32..1.0),
        ) {
            let [size, radius] = scales.map(|s| 10.0_f32.powf(s));
            if let Some(cone) = SphereCone::new(Vec3::from(center) * size, radius, Vec3::from(p) * size) {
                let s = cone.sample(Vec2::from(u));
                prop_assert!(cone.pdf() > 0.0 && cone.pdf().is_finite());
                prop_assert!((s.wi.length() - 1.0).abs() < 1e-6 && s.distance >= 0.0 && s.distance.is_finite());
            }
        }
    }
}
