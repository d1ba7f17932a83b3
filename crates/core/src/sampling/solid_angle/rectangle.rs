//! The spherical rectangle: a rectangle seen from a point.
//!
//! In coordinates along the edges, with the reference point at the origin and the plane at height h, the rectangle
//! spans x₀..x₁ × y₀..y₁. The angle γ of its image on the sphere at a corner has, by the normals of the planes through
//! its edges,
//!
//! cot γ = ∓ x y / (h √(x² + y² + h²)),
//!
//! and the solid angle is S = γ₀ + γ₁ + γ₂ + γ₃ − 2π. A share u of it lies left of the x whose two angles are
//! au = u S + k, k = 2π minus those at x₀. In a column of one x, the sine of the latitude, y / √(x² + y² + h²), is
//! uniform.
//! Ureña, Fajardo & King 2013, "An Area-Preserving Parametrization for Spherical Rectangles", doi:10.1111/cgf.12151.
//!
//! Angles are kept as complex numbers: four are added by multiplications, so one arc tangent gives S where the paper
//! takes four arc cosines, and none is needed to get sin(au) and cos(au). Those hold what is small as a small imaginary
//! part, without the paper's loss of digits at small solid angles.

use std::f32::consts::TAU;

use glam::{DVec2, DVec3, Vec2, Vec3};

use super::{FlatSample, SMALLEST};
use crate::math::sin_cos_turns;

/// A rectangle seen from a point off its plane.
#[derive(Clone, Copy, Debug)]
pub struct SphericalRectangle {
    /// From the reference point to the corner, and the edges.
    corner: DVec3,
    u: DVec3,
    v: DVec3,
    /// Coordinates of the corner along the edges, and the lengths of the edges.
    min: DVec2,
    size: DVec2,
    /// Of the reference point over the plane.
    height: f64,
    /// Complex, with the angle −k.
    left: DVec2,
    solid_angle: f32,
}

impl SphericalRectangle {
    /// The rectangle `corner` + s `u` + t `v` for s and t in 0..1, where `u` ⟂ `v`, seen from `p`. None from its plane,
    /// or if the solid angle is below 1e-9 sr or less than that from a whole hemisphere: there, sample the area.
    #[inline]
    pub fn new(corner: Vec3, u: Vec3, v: Vec3, p: Vec3) -> Option<Self> {
        let (corner, u, v) = (corner.as_dvec3() - p.as_dvec3(), u.as_dvec3(), v.as_dvec3());
        let size = DVec2::new(u.length(), v.length());
        let (x, y) = (u * size.x.recip(), v * size.y.recip());
        let height = corner.dot(x.cross(y)).abs();
        let min = DVec2::new(corner.dot(x), corner.dot(y));
        let max = min + size;
        // The angle at a corner, in 0..π.
        let angle = |x: f64, y: f64, sign: f64| DVec2::new(sign * x * y, height * DVec3::new(x, y, height).length());
        let left = angle(min.x, min.y, -1.0).rotate(angle(min.x, max.y, 1.0));
        let right = angle(max.x, min.y, 1.0).rotate(angle(max.x, max.y, -1.0));
        let sum = left.rotate(right);
        let sum = sum / sum.abs().max_element();
        // Nothing and a hemisphere are the same angle.
        let precise = sum.y.abs() >= SMALLEST || sum.x < 0.0;
        precise.then(|| {
            let angle = libm::atan2f(sum.y as f32, sum.x as f32);
            let solid_angle = if sum.y < 0.0 { angle + TAU } else { angle };
            Self { corner, u, v, min, size, height, left, solid_angle }
        })
    }

    /// A point of the rectangle.
    #[inline]
    pub fn sample(&self, u: Vec2) -> FlatSample {
        let x = self.sample_column(u.x);
        let y = self.sample_row(x, u.y);
        let st = ((DVec2::new(x, y) - self.min) / self.size).clamp(DVec2::ZERO, DVec2::ONE);
        FlatSample::new(self.corner + st.x * self.u + st.y * self.v, st)
    }

    /// The x that has the share `u` of the solid angle on its left.
    #[inline]
    fn sample_column(&self, u: f32) -> f64 {
        let (sin, cos) = sin_cos_turns(u * self.solid_angle * (0.5 / TAU));
        let half = DVec2::new(f64::from(cos), f64::from(sin));
        // The square of half the angle turns by all of it, and only by that: its length is not quite 1, but known.
        let au = DVec2::new(self.left.x, -self.left.y).rotate(half).rotate(half);
        let [x0_sq, y0_sq] = [self.min.x, self.min.y].map(|c| c * c + self.height * self.height);
        let a = self.min.y * au.x + (self.min.y + self.size.y) * x0_sq * y0_sq * half.length_squared();
        let b = self.height * au.y;
        let x = -b.copysign(a * b) * (y0_sq / ((a - b) * (a + b))).sqrt();
        // In this order what is no number becomes x₀.
        x.max(self.min.x).min(self.min.x + self.size.x)
    }

    /// The y that has the share `u` of a column below it.
    #[inline]
    fn sample_row(&self, x: f64, u: f32) -> f64 {
        let (y0, y1) = (self.min.y, self.min.y + self.size.y);
        let to_axis_sq = x * x + self.height * self.height;
        let [sin0, sin1] = [y0, y1].map(|y| y / (y * y + to_axis_sq).sqrt());
        let sin = sin0 + f64::from(u) * (sin1 - sin0);
        let y = sin * (to_axis_sq / (1.0 - sin * sin)).sqrt();
        y.max(y0).min(y1)
    }

    /// The density of every direction that meets the rectangle, 1/sr.
    #[inline]
    pub fn pdf(&self) -> f32 {
        1.0 / self.solid_angle
    }

    /// The solid angle that the rectangle fills, sr.
    #[inline]
    pub fn solid_angle(&self) -> f32 {
        self.solid_angle
    }
}

#[cfg(test)]
mod tests {
    use glam::DMat3;
    use proptest::prelude::*;
    use proptest::test_runner::RngSeed;

    use super::super::tests::{SAMPLES, check_point, check_uniform, numbers};
    use super::*;
    use crate::testing::chi2_counts;

    #[test]
    fn directions_are_uniform_in_the_solid_angle() {
        let p = Vec3::new(0.5, 1.5, -0.7);
        for (corner, u, v) in [
            (Vec3::new(-1.0, 3.0, -1.0), Vec3::X * 2.0, Vec3::Z * 1.5),
            (Vec3::new(2.0, 0.0, 0.0), Vec3::new(3.0, 4.0, 0.0), Vec3::new(-0.8, 0.6, 2.0)),
            (Vec3::new(-4.0, 1.0, -5.0), Vec3::Z * 9.0, Vec3::X * 7.0),
        ] {
            let shape = SphericalRectangle::new(corner, u, v, p).unwrap();
            let [c, u, v] = [corner - p, u, v].map(Vec3::as_dvec3);
            let to_shape = DMat3::from_cols(c, u, v).inverse();
            let meets = |w: DVec3| {
                let h = to_shape * w;
                h.x > 0.0 && (0.0..=h.x).contains(&h.y) && (0.0..=h.x).contains(&h.z)
            };
            check_uniform(f64::from(shape.solid_angle()), |u| shape.sample(u).wi, meets);
            assert_eq!(shape.pdf(), 1.0 / shape.solid_angle());
        }
    }

    /// The solid angle of x₀..x₁ × y₀..y₁ at a height, as the sum of four right triangles' pairs.
    fn four_arc_tangents([x0, x1]: [f64; 2], [y0, y1]: [f64; 2], h: f64) -> f64 {
        let from_axis = |x: f64, y: f64| (x * y / (h * (x * x + y * y + h * h).sqrt())).atan();
        from_axis(x1, y1) - from_axis(x0, y1) - from_axis(x1, y0) + from_axis(x0, y0)
    }

    /// Near, grazing, thin, far, huge: parts of the rectangle get what their solid angle is.
    #[test]
    fn parts_get_their_share_at_every_scale() {
        const BINS: usize = 16;
        for (x0, y0, width, depth, h) in [
            (-0.5, -0.5, 1.0, 1.0, 0.5),
            (-0.5, -0.7, 1.0, 1.0, 1e-3),
            (-0.5, -0.7, 1.0, 1.0, 1e-6),
            (1.0, -2.0, 3.0, 5.0, 1e-4),
            (0.0, 0.0, 1.0, 1.0, 0.25),
            (-30.0, -1e-3, 60.0, 2e-3, 1.0),
            (-1e-3, 30.0, 2e-3, 60.0, 1.0),
            (100.0, -300.0, 1.0, 1.0, 200.0),
            (3e3, 5e3, 0.5, 0.5, 1e3),
            (-1e12, -1e12, 3e12, 2e12, 1e10),
            (1e-8, -1e-8, 1e-8, 1e-8, 1e-8),
        ] {
            let (corner, u, v) = (Vec3::new(x0, h, y0), Vec3::X * width, Vec3::Z * depth);
            let shape = SphericalRectangle::new(corner, u, v, Vec3::ZERO).unwrap();
            let mut counts = [0; BINS * BINS];
            for s in (0..SAMPLES).map(|i| shape.sample(numbers(i))) {
                let [s, t] = [s.uv.x, s.uv.y].map(|c| ((c * BINS as f32) as usize).min(BINS - 1));
                counts[s * BINS + t] += 1;
            }
            let [x0, y0, width, depth, h] = [x0, y0, width, depth, h].map(f64::from);
            let total = four_arc_tangents([x0, x0 + width], [y0, y0 + depth], h);
            assert!((f64::from(shape.solid_angle()) / total - 1.0).abs() < 1e-6, "{} not {total}", shape.solid_angle());
            let bounds = |i: usize, from: f64, size: f64| [i, i + 1].map(|i| from + size * i as f64 / BINS as f64);
            let share =
                |bin: usize| four_arc_tangents(bounds(bin / BINS, x0, width), bounds(bin % BINS, y0, depth), h) / total;
            let expected: Vec<f64> = (0..counts.len()).map(|bin| f64::from(SAMPLES) * share(bin)).collect();
            chi2_counts(&counts, &expected).unwrap_or_else(|e| panic!("{corner} {u} {v}: {e}"));
        }
    }

    #[test]
    fn known_values() {
        let new = |corner: Vec3, p: Vec3| SphericalRectangle::new(corner, Vec3::X, Vec3::Y, p);
        // A cube's face from its centre, and from its far corner.
        let face = |p: Vec3| new(Vec3::ZERO, p).unwrap().solid_angle();
        assert!((face(Vec3::splat(0.5)) / (4.0 * std::f32::consts::PI / 6.0) - 1.0).abs() < 1e-6);
        assert!((face(Vec3::Z) / (4.0 * std::f32::consts::PI / 24.0) - 1.0).abs() < 1e-6);
        assert!((face(Vec3::new(0.5, 0.5, -0.5)) / face(Vec3::splat(0.5)) - 1.0).abs() < 1e-6);
        // In the plane, edge-on, too far, without area.
        assert!(new(Vec3::ZERO, Vec3::new(0.3, 0.3, 0.0)).is_none());
        assert!(new(Vec3::ZERO, Vec3::new(3.0, 0.3, 0.0)).is_none());
        assert!(new(Vec3::Z * 1e6, Vec3::ZERO).is_none());
        assert!(SphericalRectangle::new(Vec3::Z, Vec3::X, Vec3::ZERO, Vec3::ZERO).is_none());
    }

    proptest! {
        #![proptest_config(ProptestConfig { rng_seed: RngSeed::Fixed(1), failure_persistence: None, ..Default::default() })]

        #[test]
        fn points_lie_on_the_shape(
            corner in prop::array::uniform3(-1.0f32..1.0),
            edges in prop::array::uniform2(prop::array::uniform3(-1.0f32..1.0)),
            p in prop::array::uniform3(-1.0f32..1.0),
            scales in prop::array::uniform3(-12.0f32..12.0),
            u in prop::array::uniform2(0.0f32..1.0),
        ) {
            let [near, width, depth] = scales.map(|s| 10.0_f32.powf(s));
            let [a, b] = edges.map(Vec3::from);
            let (corner, p) = (Vec3::from(corner) * near, Vec3::from(p) * near);
            let (x, y) = (a.normalize_or_zero() * width, a.cross(b).normalize_or_zero() * depth);
            if let Some(shape) = SphericalRectangle::new(corner, x, y, p) {
                let s = shape.sample(Vec2::from(u));
                prop_assert!(shape.pdf() > 0.159 && shape.pdf() < 1.1e9, "{}", shape.pdf());
                prop_assert!(s.uv.cmpge(Vec2::ZERO).all() && s.uv.cmple(Vec2::ONE).all(), "{s:?}");
                prop_assert!((s.wi.length() - 1.0).abs() < 1e-6 && s.distance > 0.0 && s.distance.is_finite());
            }
        }
    }

    #[test]
    fn points_are_where_they_say() {
        let (corner, u, v) = (Vec3::new(1.0, 2.0, -3.0), Vec3::new(3.0, 4.0, 0.0), Vec3::new(-0.8, 0.6, 2.0));
        let shape = SphericalRectangle::new(corner, u, v, Vec3::new(0.1, 0.2, 0.3)).unwrap();
        for s in (0..10_000).map(|i| shape.sample(numbers(i))) {
            let [c, u, v, p] = [corner, u, v, Vec3::new(0.1, 0.2, 0.3)].map(Vec3::as_dvec3);
            check_point(&s, c + f64::from(s.uv.x) * u + f64::from(s.uv.y) * v - p);
        }
    }
}
