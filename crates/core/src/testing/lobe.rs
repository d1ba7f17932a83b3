//! Everything that a scattering lobe promises.

use std::f64::consts::TAU;
use std::fmt::Debug;

use glam::{UVec2, Vec2, Vec3};

use super::SIGNIFICANCE;
use super::cells::{Cell, Point};
use super::chi2::chi2_at;
use crate::color::Spectrum;
use crate::material::{Bsdf, BsdfSample};
use crate::sampler::Independent;

/// How a surface scatters light: what [`Bsdf`] does.
pub trait Lobe: Debug {
    /// Draws `wi` for a `wo`; none if the light is absorbed.
    fn sample(&self, wo: Vec3, uc: f32, u: Vec2) -> Option<BsdfSample>;

    /// The BSDF times |cos θ| of `wi`, and the density of `wi` per solid angle; 0 for delta lobes.
    fn eval_pdf(&self, wo: Vec3, wi: Vec3) -> (Spectrum, f32);
}

impl Lobe for Bsdf {
    fn sample(&self, wo: Vec3, uc: f32, u: Vec2) -> Option<BsdfSample> {
        self.sample(wo, uc, u)
    }

    fn eval_pdf(&self, wo: Vec3, wi: Vec3) -> (Spectrum, f32) {
        self.eval_pdf(wo, wi)
    }
}

/// Whether a lobe claims that light can be sent either way: f(wo, wi) eta² = f(wi, wo), with eta the index of
/// refraction on the side of wi over that on the side of wo (Veach 1997, §5.2); 1 if they are the same.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reciprocal {
    /// It does.
    Yes,
    /// It does not.
    No,
}

/// All that a lobe promises, for directions of view from straight above to grazing, on both sides: samples follow the
/// density (chi²), weights are eval / pdf, no energy is made, and reciprocity if claimed.
///
/// # Errors
/// The first promise that is broken.
pub fn check_lobe(lobe: &dyn Lobe, reciprocal: Reciprocal) -> Result<(), String> {
    let angles = [0.0_f32, 20.0, 45.0, 70.0, 85.0, 89.0];
    for (i, degrees) in angles.into_iter().enumerate() {
        for side in [1.0, -1.0] {
            let (sin, cos) = degrees.to_radians().sin_cos();
            // Opposite, where lobes are, is far from where azimuths jump from half a turn to minus that.
            let azimuth = 2.4 + 0.3 * i as f32;
            let wo = Vec3::new(sin * azimuth.cos(), sin * azimuth.sin(), side * cos);
            let place = |e: String| format!("{lobe:?} at {degrees} degrees, side {side}: {e}");
            chi2_lobe(lobe, wo, SIGNIFICANCE / (2 * angles.len()) as f64).map_err(place)?;
            check_samples(lobe, wo, reciprocal).map_err(place)?;
        }
    }
    Ok(())
}

/// The point of a direction; near the pole x and y tell it more exactly than z.
fn point(w: Vec3) -> Point {
    let (w, r_sq) = (w.as_dvec3(), w.as_dvec3().truncate().length_squared());
    let z = w.z.abs();
    let depth = if r_sq < 0.5 { r_sq / (1.0 + z) } else { 1.0 - z };
    [depth.clamp(0.0, 1.0), w.y.atan2(w.x) / TAU]
}

fn direction([depth, turn]: Point, side: f64) -> Vec3 {
    let r = (depth * (2.0 - depth)).sqrt();
    let (sin, cos) = (turn * TAU).sin_cos();
    Vec3::new((r * cos) as f32, (r * sin) as f32, (side * (1.0 - depth)) as f32)
}

/// The points of `count` samples in each hemisphere; without delta ones, which have no density.
fn draw(lobe: &dyn Lobe, wo: Vec3, seed: u64, count: u32) -> [Vec<Point>; 2] {
    let mut points = [vec![], vec![]];
    for i in 0..count {
        let mut numbers = Independent::new(seed, UVec2::ZERO, i);
        let (uc, u) = (numbers.get_1d(), numbers.get_2d());
        if let Some(s) = lobe.sample(wo, uc, u).filter(|s| !s.delta) {
            points[usize::from(s.wi.z < 0.0)].push(point(s.wi));
        }
    }
    points
}

/// Chi² of the directions that a lobe draws against its density, integrated box by box; and the share that it absorbs
/// against what the density lacks.
fn chi2_lobe(lobe: &dyn Lobe, wo: Vec3, significance: f64) -> Result<(), String> {
    const LAYOUT: u32 = 20_000;
    const SAMPLES: u32 = 100_000;
    let (mut observed, mut chances) = (vec![], vec![]);
    let hemispheres = draw(lobe, wo, 10, LAYOUT).into_iter().zip(draw(lobe, wo, 11, SAMPLES));
    for ((layout, points), side) in hemispheres.zip([1.0, -1.0]) {
        let density = |p: Point| {
            let (eval, pdf) = lobe.eval_pdf(wo, direction(p, side));
            if eval.is_black() { 0.0 } else { f64::from(pdf) * TAU }
        };
        for (count, chance) in Cell::HEMISPHERE.divide(layout, points, 2e-7, &density) {
            observed.push(count);
            chances.push(chance);
        }
    }
    let (samples, scattered) = (f64::from(SAMPLES), observed.iter().sum::<u64>() as f64);
    let chance: f64 = chances.iter().sum();
    // Five standard deviations, and what the integration may be off.
    let slack = 5.0 * (chance * (1.0 - chance).max(0.0) / samples).sqrt() + 1e-3;
    if (scattered / samples - chance).abs() > slack {
        return Err(format!("{scattered} of {samples} samples scatter, but the density integrates to {chance}"));
    }
    let expected: Vec<f64> = chances.iter().map(|c| c / chance * scattered).collect();
    chi2_at(&observed, &expected, significance)
}

/// Sample by sample: unit directions, weight = eval / pdf, reciprocity; and that weights, which are shares of energy but for the
/// index squared, are at most 1 in the mean. Of a lobe that keeps all energy some are above 1 unless all are 1.
fn check_samples(lobe: &dyn Lobe, wo: Vec3, reciprocal: Reciprocal) -> Result<(), String> {
    const N: usize = 2000;
    let close = |a: f32, b: f32| (a - b).abs() <= 2e-3 * a.abs().max(b.abs()) + 1e-6;
    let mut energies = [[0.0; N]; 3];
    for i in 0..N {
        let mut numbers = Independent::new(12, UVec2::ZERO, i as u32);
        let (uc, u) = (numbers.get_1d(), numbers.get_2d());
        let Some(s) = lobe.sample(wo, uc, u) else {
            continue;
        };
        let weight = s.weight.to_rgb();
        energies.iter_mut().zip(weight).for_each(|(e, weight)| e[i] = f64::from(weight * s.eta * s.eta));
        if s.delta {
            continue;
        }
        if (s.wi.length() - 1.0).abs() > 1e-4 {
            return Err(format!("direction of length {}", s.wi.length()));
        }
        let (eval, pdf) = lobe.eval_pdf(wo, s.wi);
        let eval = eval.to_rgb();
        if !close(pdf, s.pdf) {
            return Err(format!("sample says density {}, pdf says {pdf}", s.pdf));
        }
        for (weight, eval) in weight.into_iter().zip(eval) {
            if !close(weight * pdf, eval) {
                return Err(format!("weight {weight} times density {pdf} is not eval {eval}"));
            }
        }
        if reciprocal == Reciprocal::Yes {
            let there = eval[0] / s.wi.z.abs() * (s.eta * s.eta);
            let back = lobe.eval_pdf(s.wi, wo).0.to_rgb()[0] / wo.z.abs();
            if !close(there, back) {
                return Err(format!("{there} one way, {back} the other"));
            }
        }
    }
    energies.iter().try_for_each(|energies| check_energy(energies))
}

/// That no light is made: weights are 1 or less in the mean, up to four standard errors of it.
fn check_energy(energies: &[f64]) -> Result<(), String> {
    let n = energies.len() as f64;
    let mean = energies.iter().sum::<f64>() / n;
    let error = (energies.iter().map(|e| (e - mean).powi(2)).sum::<f64>() / (n * (n - 1.0))).sqrt();
    if mean > 1.0 + 1e-5 + 4.0 * error {
        return Err(format!("{mean} ± {error} of the light is scattered: makes light"));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_round_trip() {
        for w in [Vec3::new(1e-5, -2e-5, 1.0), Vec3::new(-0.6, 0.0, -0.8), Vec3::new(0.0, 1.0, 1e-4)] {
            assert!((direction(point(w), f64::from(w.z.signum())) - w).length() < 1e-7);
        }
    }
}
