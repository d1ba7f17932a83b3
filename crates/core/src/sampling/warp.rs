//! Warps of the unit square: each maps uniform numbers to a shape and says nothing about chance but that.

use glam::{Vec2, Vec3};

use crate::math::{sin_cos_eighth, sin_cos_turns};

/// A uniform point of the unit disk. The concentric map keeps neighbours together.
///
/// Shirley & Chiu 1997, doi:10.1080/10867651.1997.10487479.
#[inline]
pub fn uniform_disk(u: Vec2) -> Vec2 {
    let o = 2.0 * u - Vec2::ONE;
    if o == Vec2::ZERO {
        return Vec2::ZERO;
    }
    // The polar coordinates of the square's ring that the point lies on: the angle from the nearer axis counts in turns.
    let steep = o.y.abs() > o.x.abs();
    let (r, across) = if steep { (o.y, o.x) } else { (o.x, o.y) };
    let (sin, cos) = sin_cos_eighth(across / r / 8.0);
    if steep { r * Vec2::new(sin, cos) } else { r * Vec2::new(cos, sin) }
}

/// A direction of the upper hemisphere with density cos θ / π (Malley's method).
#[inline]
pub fn cosine_hemisphere(u: Vec2) -> Vec3 {
    let d = uniform_disk(u);
    d.extend((1.0 - d.length_squared()).max(0.0).sqrt())
}

/// A uniform direction of the sphere, density 1 / 4π.
#[inline]
pub fn uniform_sphere(u: Vec2) -> Vec3 {
    let z = 1.0 - 2.0 * u.x;
    let r = (1.0 - z * z).max(0.0).sqrt();
    let (sin, cos) = sin_cos_turns(u.y);
    Vec3::new(r * cos, r * sin, z)
}

/// A uniform point of the unit ball.
#[inline]
pub fn uniform_ball(uc: f32, u: Vec2) -> Vec3 {
    libm::cbrtf(uc) * uniform_sphere(u)
}

/// A uniform point of a triangle: (u, v) stands for a + u (b − a) + v (c − a). Neighbours stay together, and none of
/// the square is folded over.
///
/// Heitz 2019, "A Low-Distortion Map Between Triangle and Square".
#[inline]
pub fn uniform_triangle(u: Vec2) -> Vec2 {
    if u.y > u.x { Vec2::new(0.5 * u.x, u.y - 0.5 * u.x) } else { Vec2::new(u.x - 0.5 * u.y, 0.5 * u.y) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampler::Independent;
    use crate::testing::chi2_counts;

    const N: u32 = 200_000;
    const BINS: usize = 24;

    /// Chi² of points sorted into equally likely bins of two coordinates that are uniform in 0..1 if the warp is right.
    fn check_uniform(coordinates: impl Fn(f32, Vec2) -> [f32; 2]) {
        let mut counts = vec![0_u64; BINS * BINS];
        for i in 0..N {
            let mut numbers = Independent::new(1, glam::UVec2::ZERO, i);
            let [a, b] =
                coordinates(numbers.get_1d(), numbers.get_2d()).map(|c| ((c * BINS as f32) as usize).min(BINS - 1));
            counts[a * BINS + b] += 1;
        }
        chi2_counts(&counts, &vec![f64::from(N) / (BINS * BINS) as f64; BINS * BINS]).unwrap();
    }

    fn turn(x: f32, y: f32) -> f32 {
        y.atan2(x) / std::f32::consts::TAU + 0.5
    }

    #[test]
    fn disk_is_uniform() {
        check_uniform(|_, u| {
            let p = uniform_disk(u);
            [p.length_squared(), turn(p.x, p.y)]
        });
    }

    #[test]
    fn hemisphere_is_cosine_distributed() {
        check_uniform(|_, u| {
            let w = cosine_hemisphere(u);
            assert!((w.length() - 1.0).abs() < 1e-5);
            [1.0 - w.z * w.z, turn(w.x, w.y)]
        });
    }

    /// v / (1 − u) is uniform, and so is what the points beyond u leave: (1 − u)².
    #[test]
    fn triangle_is_uniform() {
        check_uniform(|_, u| {
            let p = uniform_triangle(u);
            assert!(p.min_element() >= 0.0 && p.element_sum() <= 1.0);
            [(1.0 - p.x).powi(2), p.y / (1.0 - p.x).max(f32::MIN_POSITIVE)]
        });
    }

    #[test]
    fn sphere_and_ball_are_uniform() {
        check_uniform(|_, u| {
            let w = uniform_sphere(u);
            [0.5 * (w.z + 1.0), turn(w.x, w.y)]
        });
        check_uniform(|uc, u| {
            let p = uniform_ball(uc, u);
            [p.length().powi(3), 0.5 * (p.z / p.length() + 1.0)]
        });
    }
}
