//! Rough metal and glass under an even sky, by a slow formula in double precision.
//!
//! Facets of normals about m are D(m) (wo · m) / cos θₒ of what is seen of a surface from wo. With the share S of the light of
//! the sky that each sends there,
//!
//! L = ∫ D(m) (wo · m) / cos θₒ S(wo, m) dm, S = R G₂(wo, wi) for reflection, (1 − R) G₁(wo) G₁(wi) / eta² for refraction,
//!
//! as the lobes of Walter et al. 2007, doi:10.2312/EGWR/EGSR07/195-206, are per facet, without |dm / dwi|. Masking is
//! Smith's: G₁ = 1 / (1 + Λ), and of correlated heights G₂ = 1 / (1 + Λₒ + Λᵢ) (Heitz 2014, Understanding the
//! Masking-Shadowing Function, JCGT 3(2)).

use std::f64::consts::PI;

use glam::DVec3;

use super::KnownScene;
use super::build::*;
use crate::color::{Rgb, luminance};
use crate::material::{Conductor, Dielectric, MaterialDesc};

pub(super) fn scenes() -> Vec<KnownScene> {
    let white = |roughness: f32| [0.0, 60.0].map(|degrees| white_metal(roughness, degrees));
    let glass = [(0.4, 0.0), (0.7, 60.0), (0.5, 150.0)].map(|(roughness, degrees)| frosted(roughness, degrees));
    [&white(0.3)[..], &white(0.7), &[gold(0.5, 60.0)], &glass].concat()
}

/// A surface under an even sky, seen at an angle from its normal.
fn under_the_sky(name: String, material: MaterialDesc, degrees: f64, expected: f64) -> KnownScene {
    let (sin, cos) = degrees.to_radians().sin_cos();
    let eye = [(3.0 * sin) as f32, (3.0 * cos) as f32, 0.0];
    let mut desc = empty(WHITE, parallel(eye, [0.0; 3], 1.0));
    add_quad(&mut desc, floor(0.0), "rough", material);
    KnownScene::new(format!("{name} at {degrees} degrees"), desc, 2, expected)
}

/// Metal without what goes from facet to facet.
fn once_scattered() -> Conductor {
    Conductor { compensation: false, ..Conductor::default() }
}

/// What reflects all at every facet shows what is lost between them.
fn white_metal(roughness: f32, degrees: f64) -> KnownScene {
    let metal = Conductor { reflectance: Some(Rgb::grey(1.0).into()), roughness: roughness.into(), ..once_scattered() };
    let facets = Facets::new(roughness);
    let expected = facets.radiance(degrees, |wo, m| facets.reflected(wo, m));
    under_the_sky(format!("white facets of roughness {roughness}"), MaterialDesc::Conductor(metal), degrees, expected)
}

fn gold(roughness: f32, degrees: f64) -> KnownScene {
    let (eta, k) = ([0.143, 0.375, 1.44], [3.98, 2.39, 1.60]);
    let metal = Conductor { eta: Some(Rgb(eta)), k: Some(Rgb(k)), roughness: roughness.into(), ..once_scattered() };
    let facets = Facets::new(roughness);
    let radiance = std::array::from_fn(|i| {
        let (eta, k) = (f64::from(eta[i]), f64::from(k[i]));
        facets.radiance(degrees, |wo, m| metal_reflectance(wo.dot(m), eta, k) * facets.reflected(wo, m))
    });
    let name = format!("gold of roughness {roughness}");
    under_the_sky(name, MaterialDesc::Conductor(metal), degrees, luminance(radiance))
}

/// From outside, or, beyond 90 degrees, from inside the glass.
fn frosted(roughness: f32, degrees: f64) -> KnownScene {
    let glass = Dielectric { roughness: roughness.into(), ..Dielectric::default() };
    let facets = Facets::new(roughness);
    let (angle, eta) = if degrees < 90.0 { (degrees, 1.5) } else { (180.0 - degrees, 1.0 / 1.5) };
    let expected = facets.radiance(angle, |wo, m| {
        let r = glass_reflectance(wo.dot(m), eta);
        r * facets.reflected(wo, m) + (1.0 - r) * facets.refracted(wo, m, eta) / (eta * eta)
    });
    under_the_sky(format!("frosted glass of roughness {roughness}"), MaterialDesc::Dielectric(glass), degrees, expected)
}

/// The GGX distribution of facets.
#[derive(Clone, Copy)]
struct Facets {
    alpha: f64,
}

impl Facets {
    fn new(roughness: f32) -> Self {
        Self { alpha: f64::from(roughness).powi(2) }
    }

    /// L above for an angle of view and a share S, by midpoints of normals: tan² θ = α² (1 / s² − 1) makes
    /// D(m) cos θ dm = s / π ds dφ, as the integral of D shows (Walter et al. 2007, equation 35). Both halves of a turn are
    /// alike.
    fn radiance(self, degrees: f64, share: impl Fn(DVec3, DVec3) -> f64) -> f64 {
        const SLOPES: u32 = 1000;
        const TURNS: u32 = 50;
        let middle = |i: u32, n: u32| (f64::from(i) + 0.5) / f64::from(n);
        let (sin, cos) = degrees.to_radians().sin_cos();
        let wo = DVec3::new(sin, 0.0, cos);
        let normal = |slope: f64, (sin_phi, cos_phi): (f64, f64)| {
            DVec3::new(slope * cos_phi, slope * sin_phi, 1.0) / (slope * slope + 1.0).sqrt()
        };
        let turn = |i: u32| {
            let phi = (PI * middle(i, TURNS)).sin_cos();
            let at = |s: f64| {
                let m = normal(self.alpha * (1.0 / (s * s) - 1.0).sqrt(), phi);
                let seen = wo.dot(m) / (cos * m.z);
                if seen > 0.0 { 2.0 * s * seen * share(wo, m) } else { 0.0 }
            };
            (0..SLOPES).map(|j| at(middle(j, SLOPES))).sum::<f64>()
        };
        (0..TURNS).map(turn).sum::<f64>() / f64::from(SLOPES * TURNS)
    }

    /// Of the facets of normal `m`, those that see both `wo` and where it is reflected to.
    fn reflected(self, wo: DVec3, m: DVec3) -> f64 {
        let wi = 2.0 * wo.dot(m) * m - wo;
        if wi.z > 0.0 { 1.0 / (1.0 + self.lambda(wo) + self.lambda(wi)) } else { 0.0 }
    }

    /// Those that see both `wo` and where it is refracted to; `eta` is the index behind over before.
    fn refracted(self, wo: DVec3, m: DVec3, eta: f64) -> f64 {
        let c = wo.dot(m);
        let cos_sq_t = 1.0 - (1.0 - c * c) / (eta * eta);
        let wi = (c / eta - cos_sq_t.max(0.0).sqrt()) * m - wo / eta;
        if wi.z < 0.0 && cos_sq_t > 0.0 { 1.0 / ((1.0 + self.lambda(wo)) * (1.0 + self.lambda(wi))) } else { 0.0 }
    }

    /// Facets that others hide, over those that are seen.
    fn lambda(self, w: DVec3) -> f64 {
        let tan_sq = (w.x * w.x + w.y * w.y) / (w.z * w.z);
        0.5 * ((1.0 + self.alpha * self.alpha * tan_sq).sqrt() - 1.0)
    }
}

/// Fresnel's share for something clear (Walter et al. 2007, equation 22).
fn glass_reflectance(c: f64, eta: f64) -> f64 {
    let g_sq = eta * eta - 1.0 + c * c;
    if g_sq <= 0.0 {
        return 1.0;
    }
    let g = g_sq.sqrt();
    let ratio = (c * (g + c) - 1.0) / (c * (g - c) + 1.0);
    0.5 * ((g - c) / (g + c)).powi(2) * (1.0 + ratio * ratio)
}

/// Fresnel's share for a metal: with a + i b = √((eta + i k)² − sin²), and t = 2a cos, of both polarisations.
fn metal_reflectance(cos: f64, eta: f64, k: f64) -> f64 {
    let (cos_sq, sin_sq) = (cos * cos, 1.0 - cos * cos);
    let re = eta * eta - k * k - sin_sq;
    let length = re.hypot(2.0 * eta * k);
    let t = 2.0 * (0.5 * (length + re)).sqrt() * cos;
    let s = (length + cos_sq - t) / (length + cos_sq + t);
    let p = (cos_sq * length + sin_sq * sin_sq - t * sin_sq) / (cos_sq * length + sin_sq * sin_sq + t * sin_sq);
    0.5 * s * (1.0 + p)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is seen of facets is the surface, from everywhere; the roughest metal loses ln 2 straight on; without facets
    /// there is Fresnel's share.
    #[test]
    fn known_integrals() {
        for (roughness, degrees) in [(0.3, 0.0), (0.5, 60.0), (0.7, 30.0), (1.0, 80.0)] {
            let facets = Facets::new(roughness);
            let seen = facets.radiance(degrees, |wo, _| 1.0 / (1.0 + facets.lambda(wo)));
            assert!((seen - 1.0).abs() < 1e-5, "roughness {roughness}, {degrees} degrees: {seen}");
        }
        let rough = Facets::new(1.0);
        let white = rough.radiance(0.0, |wo, m| rough.reflected(wo, m));
        assert!((white - (1.0 - std::f64::consts::LN_2)).abs() < 1e-5, "{white}");
        assert!((glass_reflectance(1.0, 1.5) - 0.04).abs() < 1e-12 && glass_reflectance(0.5, 1.0 / 1.5) == 1.0);
        assert!((metal_reflectance(0.3, 1.5, 0.0) - glass_reflectance(0.3, 1.5)).abs() < 1e-12);
        // ((eta − 1)² + k²) / ((eta + 1)² + k²).
        assert!((metal_reflectance(1.0, 0.2, 3.0) - 9.64 / 10.44).abs() < 1e-12);
    }
}
