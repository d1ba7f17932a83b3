//! Sampling a shape by the solid angle that it fills, seen from a point.
//!
//! Points spread evenly over a lamp's area cluster where the lamp is seen at a slant or from afar, and the light of
//! each must be corrected by cos θ / distance². Directions spread evenly over the solid angle need no correction: their
//! density is 1 / solid angle, and only the material's lobe and shadows are left to make noise. Each file maps the unit
//! square to directions toward one shape, continuously, so stratified numbers stay stratified.
//!
//! A value is made for one reference point. Making it costs no more than its solid angle, all that a density needs.
//! Small and slanted shapes live from differences of large numbers, so the flat shapes are computed in double
//! precision.

mod rectangle;
mod sphere;
mod triangle;

use glam::{DVec2, DVec3, Vec2, Vec3};

pub use rectangle::SphericalRectangle;
pub use sphere::{SphereCone, SphereSample};
pub use triangle::SphericalTriangle;

/// A direction to a point of a flat shape.
#[derive(Clone, Copy, Debug)]
pub struct FlatSample {
    /// Unit direction from the reference point.
    pub wi: Vec3,
    /// From the reference point to the point of the shape.
    pub distance: f32,
    /// Where the point lies, as a ray's hit says it: corner + u · edge + v · other edge.
    pub uv: Vec2,
}

impl FlatSample {
    /// The point at `uv`, which is `q` seen from the reference point.
    #[inline]
    fn new(q: DVec3, uv: DVec2) -> Self {
        let distance = q.length();
        Self { wi: (q * distance.recip()).as_vec3(), distance: distance as f32, uv: uv.as_vec2() }
    }
}

/// Flat shapes of a smaller solid angle (sr) than this are not sampled by it: double precision leaves a relative error
/// of about 1e-16 / solid angle.
const SMALLEST: f64 = 1e-9;

/// The density per solid angle (1/sr) of points with the density `pdf_area` (1/m²) on a surface, from a distance whose
/// square is `distance_sq` and with the cosine `cos` between the surface's normal and the direction. 0 where there is
/// none: edge-on.
#[inline]
pub fn pdf_from_area(pdf_area: f32, distance_sq: f32, cos: f32) -> f32 {
    let pdf = pdf_area * distance_sq / cos.abs();
    if pdf.is_finite() { pdf } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{PI, TAU};

    use glam::UVec2;

    use super::*;
    use crate::sampler::Independent;
    use crate::testing::chi2_counts;

    pub(super) const SAMPLES: u32 = 100_000;

    /// Two uniform numbers.
    pub(super) fn numbers(i: u32) -> Vec2 {
        Independent::new(3, UVec2::ZERO, i).get_2d()
    }

    /// Directions that are drawn fill, bin by bin of height and azimuth, those that meet the shape, and those fill the
    /// solid angle: found by trying a lattice of directions.
    pub(super) fn check_uniform(solid_angle: f64, sample: impl Fn(Vec2) -> Vec3, meets: impl Fn(DVec3) -> bool) {
        const HEIGHTS: usize = 16;
        const AZIMUTHS: usize = 32;
        const FINER: usize = 64;
        let bin = |z: f64, turn: f64| {
            let part = |t: f64, n: usize| ((t * n as f64) as usize).min(n - 1);
            part(0.5 * (z + 1.0), HEIGHTS) * AZIMUTHS + part(turn, AZIMUTHS)
        };
        let mut lattice = vec![0.0; HEIGHTS * AZIMUTHS];
        let (rows, columns) = (HEIGHTS * FINER, AZIMUTHS * FINER);
        for (row, column) in (0..rows).flat_map(|r| (0..columns).map(move |c| (r, c))) {
            let z = (2.0 * row as f64 + 1.0) / rows as f64 - 1.0;
            let turn = (column as f64 + 0.5) / columns as f64;
            let (sin, cos) = (TAU * turn).sin_cos();
            let w = DVec3::new(cos * (1.0 - z * z).sqrt(), sin * (1.0 - z * z).sqrt(), z);
            lattice[bin(z, turn)] += f64::from(u8::from(meets(w)));
        }
        let met: f64 = lattice.iter().sum();
        let share = met / (rows * columns) as f64;
        assert!((share * 4.0 * PI / solid_angle - 1.0).abs() < 3e-3, "{} sr, not {solid_angle}", share * 4.0 * PI);
        let mut observed = vec![0; lattice.len()];
        for w in (0..SAMPLES).map(|i| sample(numbers(i)).as_dvec3()) {
            assert!((w.length() - 1.0).abs() < 1e-6);
            observed[bin(w.z, (w.y.atan2(w.x) / TAU).rem_euclid(1.0))] += 1;
        }
        let expected: Vec<f64> = lattice.iter().map(|l| l / met * f64::from(SAMPLES)).collect();
        chi2_counts(&observed, &expected).unwrap();
    }

    /// What a flat shape's sample says of its point agrees: direction and distance with the place on the shape.
    pub(super) fn check_point(s: &FlatSample, q: DVec3) {
        assert!((s.wi.as_dvec3() - q.normalize()).length() < 2e-7, "{s:?} is not at {q}");
        assert!((f64::from(s.distance) / q.length() - 1.0).abs() < 2e-7, "{s:?} is not at {q}");
    }

    #[test]
    fn densities_are_converted() {
        assert_eq!(pdf_from_area(0.5, 9.0, -0.25), 18.0);
        for (distance_sq, cos) in [(1.0, 0.0), (0.0, 0.0), (1e30, 1e-20)] {
            assert_eq!(pdf_from_area(0.5, distance_sq, cos), 0.0);
        }
    }
}
