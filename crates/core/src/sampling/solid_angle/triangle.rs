//! The spherical triangle: a triangle seen from a point.
//!
//! With a, b, c from the reference point to the vertices, the solid angle S is by van Oosterom & Strackee 1983,
//! doi:10.1109/TBME.1983.325207,
//!
//! tan(S / 2) = |a · (b × c)| / (|a| |b| |c| + (a · b) |c| + (b · c) |a| + (c · a) |b|).
//!
//! A direction is drawn as by Arvo 1995, doi:10.1145/218380.218500. The first number picks the point c′ of the arc a c
//! that cuts off the area σ = u S. From the excess of a triangle of two sides and the angle α between them follows
//!
//! tan(b′ / 2) = sin(σ / 2) / (tan(c / 2) sin(α − σ / 2)),
//!
//! b′ the length of the arc a c′, c that of a b. The second number picks a point w on the arc b c′ such that 1 − cos of
//! its distance from b is uniform: the chord b w is √u of the chord b c′.
//!
//! Half angles neither cancel nor need an inverse function. One arc tangent gives S, where the usual form (Pharr, Jakob
//! & Humphreys 2023, §6.5.4) takes three arc sines and fails below 3e-4 sr.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3, Vec2, Vec3};

use super::{FlatSample, SMALLEST};
use crate::math::sin_cos_turns;

/// A triangle seen from a point off its plane.
#[derive(Clone, Copy, Debug)]
pub struct SphericalTriangle {
    /// From the reference point to a vertex, and from there to the two others.
    a: DVec3,
    ab: DVec3,
    ac: DVec3,
    /// |a · (b × c)|.
    volume: f64,
    solid_angle: f32,
}

impl SphericalTriangle {
    /// Nearer to a hemisphere (sr), single precision's steps of the solid angle show.
    const LARGEST: f64 = TAU - 1e-3;

    /// The triangle seen from `p`. None from its plane, or if the solid angle is below 1e-9 sr or within 1e-3 sr of a
    /// hemisphere: there, sample the area.
    #[inline]
    pub fn new(vertices: [Vec3; 3], p: Vec3) -> Option<Self> {
        let [a, b, c] = vertices.map(Vec3::as_dvec3);
        // Edges are differences of vertices, not of far vectors from `p`: a · (b × c) keeps its digits.
        let (ab, ac) = (b - a, c - a);
        let [a, b, c] = [a, b, c].map(|v| v - p.as_dvec3());
        let volume = a.dot(ab.cross(ac)).abs();
        let [la, lb, lc] = [a, b, c].map(DVec3::length);
        let half = DVec2::new(la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb, volume);
        let half = half / half.abs().max_element();
        let solid_angle = 2.0 * libm::atan2f(half.y as f32, half.x as f32);
        (SMALLEST..=Self::LARGEST).contains(&f64::from(solid_angle)).then_some(Self { a, ab, ac, volume, solid_angle })
    }

    /// A point of the triangle, `uv` along the edges from its first vertex to the second and the third.
    #[inline]
    pub fn sample(&self, u: Vec2) -> FlatSample {
        let Self { a, ab, ac, volume, .. } = *self;
        let (b, c) = (a + ab, a + ac);
        let [la, lb, lc] = [a, b, c].map(DVec3::length);
        // Normals of the planes through two sides, a × b and a × c, which meet in the angle α.
        let (across_ab, across_ac) = (a.cross(ab), a.cross(ac));
        let (l_ab, l_ac) = (across_ab.length(), across_ac.length());
        let (sin_alpha, cos_alpha) = (volume * la / (l_ab * l_ac), across_ab.dot(across_ac) / (l_ab * l_ac));

        // c′: the triangle a, b, c′ has the share u.x of the area.
        let (sin, cos) = sin_cos_turns(u.x * self.solid_angle * (0.25 * std::f32::consts::FRAC_1_PI));
        let (sin, cos) = (f64::from(sin), f64::from(cos));
        let denominator = tan_half(l_ab, a.dot(b), la * lb) * (sin_alpha * cos - cos_alpha * sin);
        let longest = tan_half(l_ac, a.dot(c), la * lc);
        let t = if denominator > 0.0 { (sin / denominator).min(longest) } else { longest };
        let toward_c = across_ac.cross(a) * l_ac.recip();
        let c_prime = ((1.0 - t * t) * a + 2.0 * t * toward_c) * (la + la * t * t).recip();

        // w: the point of the arc from b to c′ whose chord is √u.y of the whole; q is a quarter of that chord's square.
        let b = b * lb.recip();
        let chord = c_prime - b;
        let (q, u) = (0.25 * chord.length_squared(), f64::from(u.y));
        let k = (u * (1.0 - u * q) / (1.0 - q).max(f64::EPSILON)).sqrt();
        let w = (1.0 - 2.0 * u * q + 2.0 * k * q) * b + k * chord;

        let uv = DVec2::new(-w.dot(across_ac), w.dot(across_ab)) / w.dot(ab.cross(ac));
        let uv = uv.max(DVec2::ZERO).min(DVec2::ONE);
        let uv = uv * uv.element_sum().max(1.0).recip();
        FlatSample::new(a + uv.x * ab + uv.y * ac, uv)
    }

    /// The density of every direction that meets the triangle, 1/sr.
    #[inline]
    pub fn pdf(&self) -> f32 {
        1.0 / self.solid_angle
    }

    /// The solid angle that the triangle fills, sr.
    #[inline]
    pub fn solid_angle(&self) -> f32 {
        self.solid_angle
    }
}

/// The tangent of half the angle between two vectors of which the length of their cross product, their dot product and
/// the product of their lengths are known, by the formula that does not cancel.
#[inline]
fn tan_half(cross: f64, dot: f64, lengths: f64) -> f64 {
    if dot > 0.0 { cross / (lengths + dot) } else { (lengths - dot) / cross }
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
        for vertices in [
            [Vec3::new(-1.0, 3.0, -1.0), Vec3::new(2.0, 2.5, -1.0), Vec3::new(0.5, 2.0, 1.0)],
            [Vec3::new(4.0, 0.0, 0.0), Vec3::new(0.0, 0.0, 5.0), Vec3::new(1.0, 3.0, 1.0)],
            [Vec3::new(-4.0, 1.2, -5.0), Vec3::new(0.0, 1.0, 7.0), Vec3::new(6.0, 1.1, -4.0)],
        ] {
            let shape = SphericalTriangle::new(vertices, p).unwrap();
            let [a, b, c] = vertices.map(|v| (v - p).as_dvec3());
            let to_shape = DMat3::from_cols(a, b, c).inverse();
            let meets = |w: DVec3| (to_shape * w).min_element() > 0.0;
            check_uniform(f64::from(shape.solid_angle()), |u| shape.sample(u).wi, meets);
            assert_eq!(shape.pdf(), 1.0 / shape.solid_angle());
        }
    }

    /// The sum of the angles less π: Girard's theorem.
    fn girard(vertices: [DVec3; 3]) -> f64 {
        let angle = |i: usize| {
            let [a, b, c] = [0, 1, 2].map(|k| vertices[(i + k) % 3]);
            let (n, m) = (a.cross(b - a), a.cross(c - a));
            n.cross(m).length().atan2(n.dot(m))
        };
        angle(0) + angle(1) + angle(2) - std::f64::consts::PI
    }

    /// Near, grazing, thin, far, huge: parts of the triangle get what their solid angle is.
    #[test]
    fn parts_get_their_share_at_every_scale() {
        const SIDE: usize = 12;
        for (vertices, scale) in [
            ([[0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [0.0, 1.0, 1.0]], 1.0),
            ([[-1.0, -1.0, 1e-2], [2.0, -1.0, 1e-2], [0.0, 3.0, 1e-2]], 1.0),
            ([[-1.0, -1.0, 1e-3], [2.0, -1.0, 1e-3], [0.0, 3.0, 1e-3]], 1.0),
            ([[1.0, -1.0, 1e-4], [2.0, -1.0, 1e-4], [2.0, 3.0, 1e-4]], 1.0),
            ([[-1.0, -1.0, 1e-3], [2.0, -1.0, 1.0], [0.0, 3.0, 2.0]], 1.0),
            ([[-9.0, 0.0, 1.0], [9.0, 0.0, 1.0], [9.0, 1e-3, 1.0]], 1.0),
            ([[9.0, 1e-3, 1.0], [9.0, 0.0, 1.0], [-9.0, 0.0, 1.0]], 1.0),
            ([[100.0, 70.0, 50.0], [100.1, 70.0, 50.0], [100.0, 70.2, 50.1]], 1.0),
            ([[1e3, 0.0, 50.0], [1e3, 0.5, 50.0], [1e3, 0.0, 50.5]], 1.0),
            ([[0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [0.0, 1.0, 1.0]], 1e12),
            ([[0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [0.0, 1.0, 1.0]], 1e-12),
        ] {
            let vertices = vertices.map(|v| Vec3::from(v) * scale);
            let shape = SphericalTriangle::new(vertices, Vec3::ZERO).unwrap();
            // Two triangles to a cell of (u, v).
            let mut counts = [0; 2 * SIDE * SIDE];
            for s in (0..SAMPLES).map(|i| shape.sample(numbers(i))) {
                let uv = s.uv * SIDE as f32;
                let cell = uv.floor().min(Vec2::splat(SIDE as f32 - 1.0));
                let upper = usize::from((uv - cell).element_sum() > 1.0);
                counts[2 * (cell.x as usize * SIDE + cell.y as usize) + upper] += 1;
            }
            let [a, b, c] = vertices.map(Vec3::as_dvec3);
            let at = |u: usize, v: usize| a + (u as f64 * (b - a) + v as f64 * (c - a)) / SIDE as f64;
            let solid_angle = |bin: usize| {
                let (u, v, upper) = (bin / 2 / SIDE, bin / 2 % SIDE, bin % 2);
                if u + v + upper >= SIDE {
                    return 0.0;
                }
                girard([at(u + upper, v + upper), at(u + 1, v), at(u, v + 1)])
            };
            let solid_angles: Vec<f64> = (0..counts.len()).map(solid_angle).collect();
            let total: f64 = solid_angles.iter().sum();
            assert!((f64::from(shape.solid_angle()) / total - 1.0).abs() < 1e-6, "{} not {total}", shape.solid_angle());
            let expected: Vec<f64> = solid_angles.iter().map(|s| f64::from(SAMPLES) * s / total).collect();
            chi2_counts(&counts, &expected).unwrap_or_else(|e| panic!("{vertices:?}: {e}"));
        }
    }

    #[test]
    fn known_values() {
        let octant = SphericalTriangle::new([Vec3::X, Vec3::Y, Vec3::Z], Vec3::ZERO).unwrap();
        assert!((octant.solid_angle() / std::f32::consts::FRAC_PI_2 - 1.0).abs() < 1e-6);
        // A tetrahedron's face from its centre.
        let [a, b, c] = [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0]].map(Vec3::from);
        let face = SphericalTriangle::new([a, b, c], Vec3::ZERO).unwrap();
        assert!((face.solid_angle() / std::f32::consts::PI - 1.0).abs() < 1e-6);
        // From the plane, from nearly the plane, from afar, without area.
        let triangle = [Vec3::ZERO, Vec3::X, Vec3::Y];
        assert!(SphericalTriangle::new(triangle, Vec3::new(0.3, 0.3, 0.0)).is_none());
        assert!(SphericalTriangle::new(triangle, Vec3::new(3.0, 0.3, 0.0)).is_none());
        assert!(SphericalTriangle::new(triangle, Vec3::new(0.3, 0.3, 1e-6)).is_none());
        assert!(SphericalTriangle::new(triangle, Vec3::new(0.3, 0.3, 1e6)).is_none());
        assert!(SphericalTriangle::new([Vec3::X, Vec3::X, Vec3::Y], Vec3::Z).is_none());
    }

    proptest! {
        #![proptest_config(ProptestConfig { rng_seed: RngSeed::Fixed(1), failure_persistence: None, ..Default::default() })]

        #[test]
        fn points_lie_on_the_shape(
            vertices in prop::array::uniform3(prop::array::uniform3(-1.0f32..1.0)),
            p in prop::array::uniform3(-1.0f32..1.0),
            scales in prop::array::uniform2(-12.0f32..12.0),
            u in prop::array::uniform2(0.0f32..1.0),
        ) {
            let [size, from] = scales.map(|s| 10.0_f32.powf(s));
            let vertices = vertices.map(|v| Vec3::from(v) * size);
            if let Some(shape) = SphericalTriangle::new(vertices, Vec3::from(p) * from) {
                let s = shape.sample(Vec2::from(u));
                prop_assert!(shape.pdf() > 0.159 && shape.pdf() < 1.1e9, "{}", shape.pdf());
                prop_assert!(s.uv.cmpge(Vec2::ZERO).all() && s.uv.element_sum() <= 1.0 + 1e-6, "{s:?}");
                prop_assert!((s.wi.length() - 1.0).abs() < 1e-6 && s.distance > 0.0 && s.distance.is_finite());
            }
        }
    }

    #[test]
    fn points_are_where_they_say() {
        let vertices = [[1.0, 2.0, -3.0], [4.0, 6.0, -3.0], [0.2, 2.6, -1.0]].map(Vec3::from);
        let p = Vec3::new(0.1, 0.2, 0.3);
        let shape = SphericalTriangle::new(vertices, p).unwrap();
        let [a, b, c] = vertices.map(|v| v.as_dvec3() - p.as_dvec3());
        for s in (0..10_000).map(|i| shape.sample(numbers(i))) {
            check_point(&s, a + f64::from(s.uv.x) * (b - a) + f64::from(s.uv.y) * (c - a));
        }
    }
}
