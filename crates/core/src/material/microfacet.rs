//! Microfacets: a rough surface is a field of tiny mirrors, too small to be seen one by one.
//!
//! The slopes of the facets are distributed as GGX (Trowbridge & Reitz 1975; Walter et al. 2007):
//!
//! D(m) = 1 / (π α² ((x² + y²) / α² + z²)²),
//!
//! and neighbouring facets hide one another as Smith's model says (Heitz 2014, Understanding the Masking-Shadowing
//! Function, JCGT 3(2)). Seen from w, a square metre of surface shows facets of the area
//!
//! σ(w) = (cos θ + s(w)) / 2, with s(w) = √(z² + α² (x² + y²)),
//!
//! so G₁ = cos θ / σ = 1 / (1 + Λ). Light that is reflected leaves as high as it came; with heights correlated so,
//! G₂ = 1 / (1 + Λₒ + Λᵢ). Light that goes through comes out elsewhere, and G₂ = G₁(wo) G₁(wi), as Walter et al. have
//! it.
//!
//! Normals are drawn in proportion to what is seen of them, D(m) (wo · m) / σ(wo), by reflecting at a spherical cap
//! (Dupuy & Benyoub 2023, doi:10.1111/cgf.14867). What is scattered several times between facets is lost.
//!
//! Here `wo` and all normals are on the side of +z; `wo` may be close to the horizon, but is not on it.

use std::f32::consts::PI;

use glam::{Vec2, Vec3};

use crate::math::sin_cos_turns;

/// The GGX distribution of facets.
#[derive(Clone, Copy, Debug)]
pub struct Ggx {
    alpha: f32,
}

/// The facets that send light from one direction to another.
#[derive(Clone, Copy, Debug)]
pub struct Facet {
    /// Cosine of the angle between `wo` and their normal, above 0.
    pub cos_o: f32,
    /// Cosine of the angle between `wi` and their normal, or its other end for refraction, above 0.
    pub cos_i: f32,
    /// Density of `wi` (1/sr) if visible normals are drawn and all light is sent this way.
    pub pdf: f32,
}

impl Ggx {
    /// Lobes narrower than this (in radians, about) count as a single direction: normals are known to 1e-7, at
    /// grazing angles to some 1e-6.
    pub const MIN_ALPHA: f32 = 5e-4;

    /// From what a user says, 0..=1: alpha = roughness², which looks evenly spaced (Burley 2012, Physically Based
    /// Shading at Disney).
    #[inline]
    pub fn from_roughness(roughness: f32) -> Self {
        Self { alpha: roughness * roughness }
    }

    /// The width of the distribution: half of the ground lies under facets steeper than this slope.
    #[inline]
    pub fn alpha(self) -> f32 {
        self.alpha
    }

    /// Area of facets with normals about `m` per solid angle (1/sr) and surface.
    #[inline]
    pub fn d(self, m: Vec3) -> f32 {
        let alpha_sq = self.alpha * self.alpha;
        let stretched = (m.x * m.x + m.y * m.y) / alpha_sq + m.z * m.z;
        1.0 / (PI * alpha_sq * stretched * stretched)
    }

    /// s(w) above.
    #[inline]
    fn stretch(self, w: Vec3) -> f32 {
        (w.z * w.z + self.alpha * self.alpha * (w.x * w.x + w.y * w.y)).sqrt()
    }

    /// Projected area of the facets that are seen from `w`, from either side.
    #[inline]
    pub fn area(self, w: Vec3) -> f32 {
        0.5 * (w.z.abs() + self.stretch(w))
    }

    /// The share of the facets towards `w` that no others hide, from either side.
    #[inline]
    pub fn g1(self, w: Vec3) -> f32 {
        w.z.abs() / self.area(w)
    }

    /// G₂ / G₁(wo) with correlated heights: the share of the facets seen from `wo` that `wi`, on the same side, sees
    /// too.
    #[inline]
    pub fn g2_over_g1(self, wo: Vec3, wi: Vec3) -> f32 {
        let s = self.stretch(wo);
        (s + wo.z) / (s + self.stretch(wi) * (wo.z / wi.z))
    }

    /// Draws a normal that is seen from `wo`.
    #[inline]
    pub fn sample(self, wo: Vec3, u: Vec2) -> Vec3 {
        // Where alpha is 1 the facets are those of a sphere, and a mirror sphere reflects evenly into the cap z > -w.z.
        let w = Vec3::new(self.alpha * wo.x, self.alpha * wo.y, wo.z).normalize();
        let depth = u.y * (1.0 + w.z);
        let r = (depth * (2.0 - depth)).max(0.0).sqrt();
        let (sin, cos) = sin_cos_turns(u.x);
        // The half vector of w and (r cos, r sin, 1 - depth).
        let h = Vec3::new(r * cos + w.x, r * sin + w.y, (1.0 - u.y) * (1.0 + w.z));
        Vec3::new(self.alpha * h.x, self.alpha * h.y, h.z).normalize()
    }

    /// The facets that reflect light from `wi` to `wo` (`eta` = 1, `wi` on the side of `wo`) or refract it (`eta` the
    /// index behind over before, not 1, `wi` on the other side); none if no facet does.
    ///
    /// Their normal is along h = wo + eta wi, and |dm / dwi| = eta² |wi · m| / |h|² (Walter et al. 2007, §4).
    #[inline]
    pub fn facet(self, wo: Vec3, wi: Vec3, eta: f32) -> Option<Facet> {
        let h = wo + eta * wi;
        let length_sq = h.length_squared();
        if length_sq < f32::MIN_POSITIVE {
            return None;
        }
        let m = h * (1.0_f32.copysign(h.z) / length_sq.sqrt());
        let (cos_o, cos_i) = (wo.dot(m), wi.dot(m) * 1.0_f32.copysign(wi.z));
        if cos_o <= 0.0 || cos_i <= 0.0 {
            return None;
        }
        let pdf_m = self.d(m) * cos_o / self.area(wo);
        Some(Facet { cos_o, cos_i, pdf: pdf_m * (eta * eta * cos_i / length_sq) })
    }
}

/// `w` seen from above if `side` is 1, from below, upside down, if it is -1; its own inverse.
#[inline]
pub(crate) fn upright(w: Vec3, side: f32) -> Vec3 {
    Vec3::new(w.x, w.y, w.z * side)
}

/// `w` mirrored at a facet of normal `m`.
#[inline]
pub(crate) fn reflect_at(w: Vec3, m: Vec3) -> Vec3 {
    2.0 * w.dot(m) * m - w
}

/// `w` refracted at a facet of normal `m` on its side; `eta` is the index behind over before, `cos_t` the cosine of
/// the refracted angle.
#[inline]
pub(crate) fn refract_at(w: Vec3, m: Vec3, eta: f32, cos_t: f32) -> Vec3 {
    let along = (w - w.dot(m) * m) / eta;
    (-along - cos_t * m).normalize()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampler::Independent;
    use crate::testing::chi2_counts;

    fn direction(cos: f64, turn: f64) -> Vec3 {
        let sin = (1.0 - cos * cos).sqrt();
        let (s, c) = (turn * std::f64::consts::TAU).sin_cos();
        Vec3::new((sin * c) as f32, (sin * s) as f32, cos as f32)
    }

    /// Facets cover the ground once, and what is seen of them is `area`.
    #[test]
    fn facets_cover_the_surface() {
        const N: i32 = 200;
        for roughness in [0.3_f32, 0.6, 1.0] {
            let ggx = Ggx::from_roughness(roughness);
            for cos in [1.0, 0.6, 0.1, 1e-3] {
                let wo = direction(cos, 0.1);
                let (mut ground, mut seen) = (0.0, 0.0);
                for (i, j) in (0..N).flat_map(|i| (0..N).map(move |j| (i, j))) {
                    // Evenly spaced where the facets are: tan² = α² (1 / (1 − s)² − 1); dm follows by the chain rule.
                    let rest = 1.0 - (f64::from(i) + 0.5) / f64::from(N);
                    let alpha_sq = f64::from(ggx.alpha()).powi(2);
                    let cos_m = (1.0 + alpha_sq * (rest.powi(-2) - 1.0)).powf(-0.5);
                    let m = direction(cos_m, (f64::from(j) + 0.5) / f64::from(N));
                    let jacobian = std::f64::consts::TAU * alpha_sq * cos_m.powi(3) / rest.powi(3);
                    let area = f64::from(ggx.d(m)) * jacobian / f64::from(N * N);
                    ground += area * f64::from(m.z);
                    seen += area * f64::from(wo.dot(m).max(0.0));
                }
                assert!((ground - 1.0).abs() < 1e-4, "roughness {roughness}: facets over {ground}");
                let area = f64::from(ggx.area(wo));
                assert!((seen - area).abs() < 3e-3 * area, "roughness {roughness}, cos {cos}: {seen}, not {area}");
            }
        }
    }

    /// Normals come as often as they are seen: in bins of the slope and the azimuth.
    #[test]
    fn normals_are_drawn_as_seen() {
        const N: u32 = 100_000;
        const BINS: usize = 12;
        const FINE: usize = 16;
        for (roughness, cos) in [(0.05, 1.0), (0.05, 0.02), (0.5, 0.5), (1.0, 1.0), (1.0, 1e-3)] {
            let (ggx, wo) = (Ggx::from_roughness(roughness), direction(cos, 0.3));
            let alpha_sq = f64::from(ggx.alpha()).powi(2);
            let mut counts = vec![0_u64; BINS * BINS];
            for i in 0..N {
                let m = ggx.sample(wo, Independent::new(5, glam::UVec2::ZERO, i).get_2d()).as_dvec3();
                assert!(m.z > 0.0 && (m.length() - 1.0).abs() < 1e-5 && m.dot(wo.as_dvec3()) > -1e-6);
                let slope_sq = (m.x * m.x + m.y * m.y) / (m.z * m.z) / alpha_sq;
                let bin = |x: f64| ((x * BINS as f64) as usize).min(BINS - 1);
                counts[bin(1.0 - (1.0 + slope_sq).powf(-0.5)) * BINS
                    + bin(m.y.atan2(m.x) / std::f64::consts::TAU + 0.5)] += 1;
            }
            // In these coordinates D cos θ dm is 2 (1 − s) ds, so the share of a bin is the mean of that times
            // (wo · m) / (cos θ σ).
            let mut expected = vec![0.0; BINS * BINS];
            let side = BINS * FINE;
            for (i, j) in (0..side).flat_map(|i| (0..side).map(move |j| (i, j))) {
                let [s, turn] = [i, j].map(|k| (k as f64 + 0.5) / side as f64);
                let slope_times_rest = (alpha_sq * s * (2.0 - s)).sqrt();
                let (sin, cos) = ((turn - 0.5) * std::f64::consts::TAU).sin_cos();
                let across = cos * f64::from(wo.x) + sin * f64::from(wo.y);
                let seen = slope_times_rest * across + (1.0 - s) * f64::from(wo.z);
                expected[i / FINE * BINS + j / FINE] += seen.max(0.0);
            }
            let sum: f64 = expected.iter().sum();
            expected.iter_mut().for_each(|e| *e *= f64::from(N) / sum);
            chi2_counts(&counts, &expected).unwrap_or_else(|e| panic!("roughness {roughness}, cos {cos}: {e}"));
        }
    }

    /// The formulas without division agree with the textbook's Λ.
    #[test]
    fn masking_agrees_with_the_textbook() {
        let ggx = Ggx::from_roughness(0.8);
        let lambda = |w: Vec3| {
            let tan_sq = (1.0 - w.z * w.z) / (w.z * w.z);
            0.5 * ((1.0 + ggx.alpha().powi(2) * tan_sq).sqrt() - 1.0)
        };
        for (a, b) in [(0.9, 0.2), (0.05, 0.7), (0.4, 0.4)] {
            let (wo, wi) = (direction(a, 0.2), direction(b, 0.9));
            assert!((ggx.g1(wo) - 1.0 / (1.0 + lambda(wo))).abs() < 1e-5);
            let g2 = 1.0 / (1.0 + lambda(wo) + lambda(wi));
            assert!((ggx.g2_over_g1(wo, wi) * ggx.g1(wo) - g2).abs() < 1e-5);
        }
    }
}
