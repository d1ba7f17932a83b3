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
//! Brushed metal has facets that are steeper along x than along y: αx and αy, of which α is the geometric mean. Stretching
//! the surface makes them alike, so x / αx and y / αy stand for x / α and y / α above, and αx x, αy y for α x, α y (Heitz
//! 2014, §5.3).
//!
//! Here `wo` and all normals are on the side of +z; `wo` may be close to the horizon, but is not on it.

use std::f32::consts::PI;

use glam::{Vec2, Vec2Swizzles, Vec3};

use crate::math::sin_cos_turns;

/// The GGX distribution of facets.
#[derive(Clone, Copy, Debug)]
pub struct Ggx {
    alpha: f32,
    /// αx and αy over alpha; each is one over the other.
    aspect: Vec2,
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

    /// The aspect of what is stretched most, √0.1.
    pub const MIN_ASPECT: f32 = 0.316_227_77;

    /// From what a user says, 0..=1: alpha = roughness², which looks evenly spaced (Burley 2012, Physically Based
    /// Shading at Disney).
    #[inline]
    pub fn from_roughness(roughness: f32) -> Self {
        Self::from_alpha(roughness * roughness)
    }

    /// The same along x and y.
    #[inline]
    pub fn from_alpha(alpha: f32) -> Self {
        Self { alpha, aspect: Vec2::ONE }
    }

    /// Facets that are the same in area, but steeper along x, the more so the nearer `anisotropy` in 0..=1 is to 1:
    /// αx = alpha / aspect and αy = alpha · aspect with aspect = √(1 − 0.9 anisotropy) (Burley 2012), or less so where αy
    /// would be below [`MIN_ALPHA`](Self::MIN_ALPHA).
    #[inline]
    #[must_use]
    pub fn stretched(self, anisotropy: f32) -> Self {
        let aspect = (1.0 - 0.9 * anisotropy).sqrt().max(Self::MIN_ASPECT);
        self.with_aspect(aspect.max((Self::MIN_ALPHA / self.alpha).min(1.0)))
    }

    /// αx = alpha / aspect, αy = alpha · aspect.
    #[inline]
    #[must_use]
    pub fn with_aspect(self, aspect: f32) -> Self {
        Self { aspect: Vec2::new(1.0 / aspect, aspect), ..self }
    }

    /// The width of the distribution: half of the ground lies under facets steeper than this slope. The geometric mean of
    /// [`alphas`](Self::alphas).
    #[inline]
    pub fn alpha(self) -> f32 {
        self.alpha
    }

    /// The width along x and along y.
    #[inline]
    pub fn alphas(self) -> Vec2 {
        self.alpha * self.aspect
    }

    /// Whether it is as wide along x as along y.
    #[inline]
    pub fn is_isotropic(self) -> bool {
        self.aspect == Vec2::ONE
    }

    /// Area of facets with normals about `m` per solid angle (1/sr) and surface.
    #[inline]
    pub fn d(self, m: Vec3) -> f32 {
        let alpha_sq = self.alpha * self.alpha;
        // One over an aspect is the other one.
        let across = self.aspect.yx() * m.truncate();
        let stretched = across.length_squared() / alpha_sq + m.z * m.z;
        1.0 / (PI * alpha_sq * stretched * stretched)
    }

    /// s(w) above.
    #[inline]
    fn stretch(self, w: Vec3) -> f32 {
        (w.z * w.z + self.alpha * self.alpha * (self.aspect * w.truncate()).length_squared()).sqrt()
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
        let alphas = self.alphas();
        let w = Vec3::new(alphas.x * wo.x, alphas.y * wo.y, wo.z).normalize();
        let depth = u.y * (1.0 + w.z);
        let r = (depth * (2.0 - depth)).max(0.0).sqrt();
        let (sin, cos) = sin_cos_turns(u.x);
        // The half vector of w and (r cos, r sin, 1 - depth).
        let h = Vec3::new(r * cos + w.x, r * sin + w.y, (1.0 - u.y) * (1.0 + w.z));
        Vec3::new(alphas.x * h.x, alphas.y * h.y, h.z).normalize()
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
    use glam::{DVec2, DVec3};

    use super::*;
    use crate::sampler::Independent;
    use crate::testing::chi2_counts;

    fn direction(cos: f64, turn: f64) -> Vec3 {
        let sin = (1.0 - cos * cos).sqrt();
        let (s, c) = (turn * std::f64::consts::TAU).sin_cos();
        Vec3::new((sin * c) as f32, (sin * s) as f32, cos as f32)
    }

    /// The facet whose slope, over the widths along x and y, is that of the point (s, turn) of the distribution: 1 − s of the
    /// ground lies under steeper ones, in proportion to (1 − s)².
    fn facet_at(ggx: Ggx, s: f64, turn: f64) -> DVec3 {
        let slope = ((1.0 - s).powi(-2) - 1.0).sqrt();
        let (sin, cos) = (turn * std::f64::consts::TAU).sin_cos();
        (ggx.alphas().as_dvec2() * slope * DVec2::new(cos, sin)).extend(1.0).normalize()
    }

    fn ggx(roughness: f32, anisotropy: f32) -> Ggx {
        Ggx::from_roughness(roughness).stretched(anisotropy)
    }

    /// Facets cover the ground once, and what is seen of them is `area`.
    #[test]
    fn facets_cover_the_surface() {
        const N: i32 = 200;
        for ggx in [ggx(0.3, 0.0), ggx(0.6, 0.0), ggx(1.0, 0.0), ggx(0.6, 0.5), ggx(0.6, 1.0)] {
            for cos in [1.0, 0.6, 0.1, 1e-3] {
                let wo = direction(cos, 0.1);
                let (mut ground, mut seen) = (0.0, 0.0);
                for (i, j) in (0..N).flat_map(|i| (0..N).map(move |j| (i, j))) {
                    // Evenly spaced where the facets are; dm = cos³ d(slopes).
                    let s = (f64::from(i) + 0.5) / f64::from(N);
                    let m = facet_at(ggx, s, (f64::from(j) + 0.5) / f64::from(N));
                    let alpha_sq = f64::from(ggx.alpha()).powi(2);
                    let jacobian = std::f64::consts::TAU * alpha_sq * m.z.powi(3) / (1.0 - s).powi(3);
                    let area = f64::from(ggx.d(m.as_vec3())) * jacobian / f64::from(N * N);
                    ground += area * m.z;
                    seen += area * wo.as_dvec3().dot(m).max(0.0);
                }
                assert!((ground - 1.0).abs() < 1e-4, "{ggx:?}: facets over {ground}");
                let area = f64::from(ggx.area(wo));
                assert!((seen - area).abs() < 3e-3 * area, "{ggx:?}, cos {cos}: {seen}, not {area}");
            }
        }
    }

    /// Normals come as often as they are seen: in bins of the slope and the azimuth.
    #[test]
    fn normals_are_drawn_as_seen() {
        const N: u32 = 100_000;
        const BINS: usize = 12;
        const FINE: usize = 16;
        let cases = [(0.05, 0.0, 1.0), (0.05, 0.0, 0.02), (0.5, 0.0, 0.5), (1.0, 0.0, 1.0), (1.0, 0.0, 1e-3)];
        for (roughness, anisotropy, cos) in
            cases.into_iter().chain([(0.3, 0.9, 1.0), (0.8, 0.5, 0.3), (0.5, 1.0, 0.02)])
        {
            let (ggx, wo) = (ggx(roughness, anisotropy), direction(cos, 0.3));
            let mut counts = vec![0_u64; BINS * BINS];
            for i in 0..N {
                let m = ggx.sample(wo, Independent::new(5, glam::UVec2::ZERO, i).get_2d()).as_dvec3();
                assert!(m.z > 0.0 && (m.length() - 1.0).abs() < 1e-5 && m.dot(wo.as_dvec3()) > -1e-6);
                let slope = m.truncate() / m.z / ggx.alphas().as_dvec2();
                let bin = |x: f64| ((x * BINS as f64) as usize).min(BINS - 1);
                counts[bin(1.0 - (1.0 + slope.length_squared()).powf(-0.5)) * BINS
                    + bin(slope.y.atan2(slope.x) / std::f64::consts::TAU + 0.5)] += 1;
            }
            // In these coordinates D cos θ dm is 2 (1 − s) ds, so the share of a bin is the mean of that times
            // (wo · m) / (cos θ σ).
            let mut expected = vec![0.0; BINS * BINS];
            let side = BINS * FINE;
            for (i, j) in (0..side).flat_map(|i| (0..side).map(move |j| (i, j))) {
                let [s, turn] = [i, j].map(|k| (k as f64 + 0.5) / side as f64);
                let m = facet_at(ggx, s, turn - 0.5);
                expected[i / FINE * BINS + j / FINE] += (1.0 - s) * (m.dot(wo.as_dvec3()) / m.z).max(0.0);
            }
            let sum: f64 = expected.iter().sum();
            expected.iter_mut().for_each(|e| *e *= f64::from(N) / sum);
            chi2_counts(&counts, &expected).unwrap_or_else(|e| panic!("{ggx:?}, cos {cos}: {e}"));
        }
    }

    /// The formulas without division agree with the textbook's Λ.
    #[test]
    fn masking_agrees_with_the_textbook() {
        for anisotropy in [0.0, 0.7] {
            let ggx = ggx(0.8, anisotropy);
            let lambda = |w: Vec3| {
                let tangents = ggx.alphas() * w.truncate() / w.z;
                0.5 * ((1.0 + tangents.length_squared()).sqrt() - 1.0)
            };
            for (a, b) in [(0.9, 0.2), (0.05, 0.7), (0.4, 0.4)] {
                let (wo, wi) = (direction(a, 0.2), direction(b, 0.9));
                assert!((ggx.g1(wo) - 1.0 / (1.0 + lambda(wo))).abs() < 1e-5);
                let g2 = 1.0 / (1.0 + lambda(wo) + lambda(wi));
                assert!((ggx.g2_over_g1(wo, wi) * ggx.g1(wo) - g2).abs() < 1e-5);
            }
        }
    }

    /// Where there is nothing to stretch, the bits stay: a factor of 1 changes none.
    #[test]
    fn isotropic_is_the_special_case() {
        let same = ggx(0.4, 0.0);
        assert!(same.is_isotropic() && same.alphas() == Vec2::splat(same.alpha()));
        let m = direction(0.8, 0.3);
        let alpha_sq = same.alpha() * same.alpha();
        let stretched = (m.x * m.x + m.y * m.y) / alpha_sq + m.z * m.z;
        assert_eq!(same.d(m), 1.0 / (PI * alpha_sq * stretched * stretched));
        for roughness in [0.0, 0.01, 0.0224, 0.03, 0.5] {
            let alphas = ggx(roughness, 1.0).alphas();
            assert!(alphas.y >= alphas.x.min(Ggx::MIN_ALPHA) * 0.999 && alphas.is_finite());
        }
    }
}
