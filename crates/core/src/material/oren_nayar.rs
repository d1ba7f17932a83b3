//! Oren-Nayar: matte and rough, such as plaster, clay, cloth and the moon.
//!
//! Grooves with matte walls look flatter than one matte wall: up to the rim they are bright when light comes from
//! the eye's side. With s = wo · wi − cos θₒ cos θᵢ, t = max(cos θₒ, cos θᵢ) where s > 0 and 1 elsewhere, ρ
//! the albedo and r the roughness, what is scattered once is (Fujii's form)
//!
//! f₁ = ρ / π · A (1 + r s / t), A = 1 / (1 + (1/2 − 2/3π) r).
//!
//! What is scattered more often makes up for what f₁ loses. With E the share that f₁ scatters at ρ = 1, and Ē its mean,
//!
//! f₂ = ρ₂ / π · (1 − E(θₒ)) (1 − E(θᵢ)) / (1 − Ē), ρ₂ = ρ² Ē / (1 − ρ (1 − Ē)).
//!
//! So a white one keeps all light, and one of roughness 0 is lambertian. Reciprocal, and the same on both sides.
//! Portsmouth, Kutz & Hill 2025, "EON: A practical energy-preserving rough diffuse BRDF", JCGT 14 (1),
//! arXiv:2410.18026; Oren & Nayar 1994, doi:10.1145/192161.192213.
//!
//! ```toml
//! [material.plaster.oren-nayar]
//! albedo = [0.8, 0.78, 0.75]
//! roughness = 0.7
//! ```

use std::f32::consts::{FRAC_1_PI, PI};

use glam::{Vec2, Vec3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::color::{Rgb, Spectrum};
use crate::material::BsdfSample;
use crate::material::microfacet::upright;
use crate::sampling::uniform_disk;
use crate::texture::{Color, Scalar, Textures};
use crate::validate::Checker;

/// Matte and rough: lambertian grooves.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct OrenNayar {
    /// Share of the light that the walls of the grooves do not absorb, 0..1 in each channel.
    pub albedo: Color,
    /// 0 is lambertian, 1 completely rough.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub roughness: Scalar,
}

impl Default for OrenNayar {
    fn default() -> Self {
        Self { albedo: Rgb::grey(0.5).into(), roughness: 0.5.into() }
    }
}

impl OrenNayar {
    pub(crate) fn check(&self, c: &mut Checker) {
        self.albedo.check_share("albedo", c);
        self.roughness.check_range("roughness", 0.0, 1.0, c);
    }

    #[inline]
    pub(crate) fn bsdf(&self, textures: &impl Textures) -> OrenNayarBsdf {
        OrenNayarBsdf {
            albedo: Rgb(self.albedo.share_at(textures).to_rgb()),
            roughness: self.roughness.at(textures, 0.0, 1.0),
        }
    }
}

/// The lobe of [`OrenNayar`].
#[derive(Clone, Copy, Debug)]
pub struct OrenNayarBsdf {
    albedo: Rgb,
    roughness: f32,
}

impl OrenNayarBsdf {
    /// 1 / A = 1 + this r.
    const A: f32 = 0.5 - 2.0 / (3.0 * PI);
    /// Ē / A = 1 + this r.
    const MEAN: f32 = 2.0 / 3.0 - 28.0 / (15.0 * PI);

    #[inline(never)]
    pub(crate) fn sample(&self, wo: Vec3, uc: f32, u: Vec2) -> Option<BsdfSample> {
        let side = 1.0_f32.copysign(wo.z);
        let wi = Lobes::new(upright(wo, side), self.roughness).sample(uc, u)?;
        let wi = upright(wi, side);
        BsdfSample::of_eval(wi, self.eval_pdf(wo, wi))
    }

    #[inline(never)]
    pub(crate) fn eval_pdf(&self, wo: Vec3, wi: Vec3) -> (Spectrum, f32) {
        let side = 1.0_f32.copysign(wo.z);
        let (wo, wi) = (upright(wo, side), upright(wi, side));
        if wo.z <= 0.0 || wi.z <= 0.0 {
            return (Spectrum::BLACK, 0.0);
        }
        (self.eval(wo, wi), Lobes::new(wo, self.roughness).pdf(wi))
    }

    /// A rough one that keeps these shares of the light.
    #[inline]
    pub(super) fn new(albedo: Rgb, roughness: f32) -> Self {
        Self { albedo, roughness }
    }

    /// The BRDF times cos θᵢ for directions above the surface.
    pub(super) fn eval(&self, wo: Vec3, wi: Vec3) -> Spectrum {
        let (r, a) = (self.roughness, self.a());
        let s = wo.x * wi.x + wo.y * wi.y;
        // cos θᵢ / t, which is finite where 1 / t is not.
        let cos_over_t = if s > 0.0 { wi.z / wi.z.max(wo.z) } else { wi.z };
        let once = FRAC_1_PI * a * (wi.z + r * s * cos_over_t).max(0.0);
        // 1 − E and 1 − Ē have the factor r A, so nothing is divided by 0.
        let left = |cos: f32| Self::A - gain(cos);
        let more = FRAC_1_PI * wi.z * r * a * left(wo.z) * left(wi.z) / (Self::A - Self::MEAN);
        Spectrum::from_rgb(self.albedo.0.map(|rho| rho * once + self.scattered_often(rho) * more))
    }

    /// A, which is E straight above.
    fn a(&self) -> f32 {
        1.0 / (1.0 + Self::A * self.roughness)
    }

    /// ρ₂.
    fn scattered_often(&self, rho: f32) -> f32 {
        let mean = self.a() * (1.0 + Self::MEAN * self.roughness);
        rho * rho * mean / (1.0 - rho * (1.0 - mean))
    }

    /// The share of light from straight above that is scattered.
    pub(crate) fn albedo(&self) -> Spectrum {
        let once = self.a();
        Spectrum::from_rgb(self.albedo.0.map(|rho| rho * once + self.scattered_often(rho) * (1.0 - once)))
    }
}

/// (E / A − 1) / r as a function of cos θ: what grooves scatter the more, the lower the light. The paper's fit, off by
/// less than 7e-4.
fn gain(cos: f32) -> f32 {
    let x = (1.0 - cos).max(0.0);
    x * (0.057_108_53 + x * (0.491_881_87 + x * (-0.332_181_44 + x * 0.071_443)))
}

/// What directions are drawn from: the light of a hemisphere, distributed by the cosine, is transformed linearly, as
/// Heitz et al. 2016, doi:10.1145/2897824.2925895, do, but only the part of it that comes to lie above the surface (clipped
/// linearly transformed cosines); with a small chance a direction is uniform. By the paper's fits.
struct Lobes {
    /// Across the surface, away from which or to which grooves scatter: that of the view.
    x_axis: Vec2,
    /// The transform takes (x, y, z) to (a x + b z, c y, d x + z).
    a: f32,
    b: f32,
    c: f32,
    d: f32,
    /// Share of the hemisphere's light that comes to lie above the surface.
    above: f32,
    /// Chance of a uniform direction.
    uniform: f32,
}

impl Lobes {
    const UNIFORM_PDF: f32 = 0.5 * FRAC_1_PI;

    fn new(wo: Vec3, r: f32) -> Self {
        let cos = wo.z.min(1.0);
        let across = wo.truncate();
        // From straight above all directions across are alike.
        let x_axis = if across.length_squared() > 1e-12 { across.normalize() } else { Vec2::X };
        let a = 1.0 + r * (0.303_392 + (-0.518_982 + 0.111_709 * cos) * cos + (-0.276_266 + 0.335_918 * cos) * r);
        let b = r * (-1.164_07 + 1.158_59 * cos + (0.150_815 - 0.150_105 * cos) * r) / (cos * cos * cos - 1.435_45);
        let c = 1.0 + r * (0.200_13 + (-0.506_373 + 0.261_777 * cos) * cos);
        // Straight above, the fit ends a little above 0, where another part of the hemisphere would have to be cut off.
        let d = r * (0.540_852 + (-1.016_25 + 0.475_392 * cos) * cos) / (-1.074_3 + (0.072_562_8 + cos) * cos);
        let d = d.min(0.0);
        let above = 0.5 + 0.5 / (d * d + 1.0).sqrt();
        // The paper has the tenth root of the roughness.
        let eighth_root = r.sqrt().sqrt().sqrt();
        let uniform = eighth_root * (0.162_925 + (-0.372_058 + (0.538_233 - 0.290_822 * cos) * cos) * cos);
        Self { x_axis, a, b, c, d, above, uniform }
    }

    /// A direction; none if rounding put it below the surface.
    fn sample(&self, uc: f32, u: Vec2) -> Option<Vec3> {
        let disk = uniform_disk(u);
        let wi = if uc < self.uniform {
            // Evenly spread over the disk, 1 − z is over the axis.
            let r_sq = disk.length_squared();
            (disk * (2.0 - r_sq).max(0.0).sqrt()).extend(1.0 - r_sq)
        } else {
            let across = self.transform(self.clip(disk)).normalize();
            (across.x * self.x_axis + across.y * self.x_axis.perp()).extend(across.z)
        };
        (wi.z > 0.0).then_some(wi)
    }

    /// From the disk's point to that of the hemisphere over it, whose light lies above the surface: lines across the disk
    /// are shortened to where the surface cuts them.
    fn clip(&self, disk: Vec2) -> Vec3 {
        let end = (1.0 - disk.y * disk.y).max(0.0).sqrt();
        let x = -end + self.above * (end - disk.x);
        Vec3::new(x, disk.y, (1.0 - x * x - disk.y * disk.y).max(0.0).sqrt())
    }

    fn transform(&self, w: Vec3) -> Vec3 {
        Vec3::new(self.a * w.x + self.b * w.z, self.c * w.y, self.d * w.x + w.z)
    }

    fn pdf(&self, wi: Vec3) -> f32 {
        self.uniform * Self::UNIFORM_PDF + (1.0 - self.uniform) * self.transformed_pdf(wi)
    }

    /// With w = M⁻¹ wi, the density of w / |w| is divided by the determinant of M times |w|³.
    fn transformed_pdf(&self, wi: Vec3) -> f32 {
        let Self { a, b, c, d, .. } = *self;
        let wi = Vec3::new(wi.truncate().dot(self.x_axis), wi.truncate().dot(self.x_axis.perp()), wi.z);
        let det = a - b * d;
        let w = Vec3::new((wi.x - b * wi.z) / det, wi.y / c, (a * wi.z - d * wi.x) / det);
        let length_sq = w.length_squared();
        w.z.max(0.0) * FRAC_1_PI / (self.above * c * det * length_sq * length_sq)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::{Bsdf, Lambertian};
    use crate::testing::{Reciprocal, check_lobe};
    use crate::texture::NoTextures;

    const GREY: Rgb = Rgb([0.9, 0.5, 0.1]);

    fn rough(albedo: Rgb, roughness: f32) -> OrenNayarBsdf {
        OrenNayar { albedo: albedo.into(), roughness: roughness.into() }.bsdf(&NoTextures)
    }

    fn direction(cos: f64, turn: f64) -> Vec3 {
        let (sin, (y, x)) = ((1.0 - cos * cos).sqrt(), (turn * std::f64::consts::TAU).sin_cos());
        Vec3::new((sin * x) as f32, (sin * y) as f32, cos as f32)
    }

    /// The share of light from `wo` that is scattered, by midpoints in √cos θᵢ and the azimuth.
    fn share(bsdf: OrenNayarBsdf, wo: Vec3) -> f64 {
        const N: u32 = 128;
        let middle = |i: u32| (f64::from(i) + 0.5) / f64::from(N);
        let sum: f64 = (0..N)
            .flat_map(|i| (0..N).map(move |j| (middle(i), middle(j))))
            .map(|(x, turn)| x * f64::from(bsdf.eval_pdf(wo, direction(x * x, turn)).0.to_rgb()[0]))
            .sum();
        sum * 2.0 * std::f64::consts::TAU / f64::from(N * N)
    }

    #[test]
    fn lobe() {
        for roughness in [0.0, 0.05, 0.5, 1.0] {
            check_lobe(&Bsdf::OrenNayar(rough(GREY, roughness)), Reciprocal::Yes).unwrap();
        }
        check_lobe(&Bsdf::OrenNayar(rough(Rgb::grey(1.0), 1.0)), Reciprocal::Yes).unwrap();
    }

    #[test]
    fn roughness_0_is_lambertian() {
        let matte = Lambertian { albedo: GREY.into() }.bsdf(&NoTextures);
        for (wo, wi) in [(0.1, 0.7), (-0.5, -1.0), (0.9, 0.01), (1.0, -0.2)] {
            let (wo, wi) = (direction(wo, 0.2), direction(wi, 0.7));
            let ((eval, pdf), (matte, matte_pdf)) = (rough(GREY, 0.0).eval_pdf(wo, wi), matte.eval_pdf(wo, wi));
            assert!((pdf - matte_pdf).abs() < 1e-6);
            assert!(eval.to_rgb().into_iter().zip(matte.to_rgb()).all(|(a, b)| (a - b).abs() < 1e-6));
        }
    }

    #[test]
    fn white_loses_nothing() {
        for roughness in [0.0, 0.1, 0.5, 1.0] {
            for cos in [0.0005, 0.01, 0.1, 0.3, 0.6, 0.9, 1.0] {
                let share = share(rough(Rgb::grey(1.0), roughness), direction(cos, 0.1));
                assert!((share - 1.0).abs() < 1e-3, "{share} at roughness {roughness}, cosine {cos}");
            }
        }
    }

    /// The paper's series of what is scattered once, twice, … adds up to ρ E + ρ₂ (1 − E), and E is an integral in closed
    /// form.
    #[test]
    fn scatters_what_the_integral_says() {
        let pi = std::f64::consts::PI;
        for (rho, r) in [(0.8_f64, 1.0_f64), (0.5, 0.3), (0.2, 0.7)] {
            let bsdf = rough(Rgb::grey(rho as f32), r as f32);
            for cos in [0.02_f64, 0.2, 0.5, 0.9, 1.0] {
                let sin = (1.0 - cos * cos).sqrt();
                let g = sin * (cos.acos() - sin * cos) + 2.0 / 3.0 * (sin / cos * (1.0 - sin.powi(3)) - sin);
                assert!((g / pi - f64::from(gain(cos as f32))).abs() < 7e-4);
                let a = 1.0 / (1.0 + (0.5 - 2.0 / (3.0 * pi)) * r);
                let (e, mean) = (a * (1.0 + r * g / pi), a * (1.0 + (2.0 / 3.0 - 28.0 / (15.0 * pi)) * r));
                let more: f64 = (0..200).map(|k| rho.powi(k + 2) * (1.0 - mean).powi(k) * mean).sum();
                let expected = rho * e + more * (1.0 - e);
                let share = share(bsdf, direction(cos, 0.6));
                assert!((share - expected).abs() < 1e-3, "{share}, not {expected}, at cosine {cos}");
                if cos == 1.0 {
                    assert!((f64::from(bsdf.albedo().to_rgb()[0]) - expected).abs() < 1e-6);
                }
            }
        }
    }

    /// Light from behind the eye, down to the horizon: A (1 + r sin² / cos).
    #[test]
    fn looks_flat_by_light_from_the_eye() {
        let (wo, albedo) = (direction(0.2, 0.3), 1e-3);
        let eval = rough(Rgb::grey(albedo), 1.0).eval_pdf(wo, wo).0.to_rgb()[0];
        let a = 1.0 / (1.5 - 2.0 / (3.0 * PI));
        let expected = albedo * FRAC_1_PI * a * (0.2 + 0.96);
        assert!((eval / expected - 1.0).abs() < 1e-3, "{eval}, not {expected}");
    }

    #[test]
    fn grazing_light_is_finite() {
        for roughness in [0.0, 1e-30, 1e-3, 0.5, 1.0] {
            let bsdf = rough(Rgb::grey(1.0), roughness);
            for z in [0.0_f32, -0.0, 1e-42, 1e-30, -1e-20, 1e-10, -1e-5, 1.0] {
                let wo = Vec3::new((1.0 - z * z).sqrt(), 0.0, z);
                let last = 1.0 - f32::EPSILON / 2.0;
                for (uc, u) in
                    [(0.0, Vec2::ZERO), (last, Vec2::new(0.5, 0.0)), (0.0, Vec2::splat(last)), (last, Vec2::X)]
                {
                    if let Some(s) = bsdf.sample(wo, uc, u) {
                        assert!(s.weight.to_rgb().iter().all(|w| (0.0..=4.0).contains(w)), "{s:?}");
                        assert!(
                            s.pdf.is_finite() && s.pdf > 0.0 && s.wi.is_normalized() && s.wi.z * wo.z >= 0.0,
                            "{s:?}"
                        );
                    }
                }
                for wi in [Vec3::new(-1.0, 0.0, z), wo, -wo, Vec3::Z, Vec3::X, Vec3::new(1.0, 0.0, 1e-25)] {
                    let (eval, pdf) = bsdf.eval_pdf(wo, wi);
                    assert!(eval.to_rgb().iter().all(|e| e.is_finite() && *e >= 0.0) && pdf.is_finite() && pdf >= 0.0);
                }
            }
        }
    }
}
