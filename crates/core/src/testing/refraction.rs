//! What a smooth boundary of something clear promises.

use glam::{UVec2, Vec2, Vec3};

use super::chi2::chi2_at;
use super::{Lobe, SIGNIFICANCE};
use crate::sampler::Independent;

/// Of the lobe of smooth glass of index `eta`: reflections come as often as Fresnel's equations say and go where a mirror
/// sends them; refractions obey Snell's law, weigh 1 / eta², and say by what the index changes; beyond the critical angle
/// all is reflected. From both sides.
///
/// # Errors
/// The first promise that is broken.
pub fn check_refraction(lobe: &dyn Lobe, eta: f32) -> Result<(), String> {
    const ANGLES: [f64; 5] = [0.0, 25.0, 50.0, 70.0, 85.0];
    for degrees in ANGLES {
        for side in [1.0, -1.0] {
            let relative = if side > 0.0 { f64::from(eta) } else { 1.0 / f64::from(eta) };
            let (sin, cos) = degrees.to_radians().sin_cos();
            let wo = Vec3::new(sin as f32, 0.0, (side * cos) as f32);
            check_at(lobe, wo, relative, SIGNIFICANCE / (2 * ANGLES.len()) as f64)
                .map_err(|e| format!("index {relative:.3} at {degrees} degrees: {e}"))?;
        }
    }
    Ok(())
}

fn check_at(lobe: &dyn Lobe, wo: Vec3, eta: f64, significance: f64) -> Result<(), String> {
    const SAMPLES: u32 = 10_000;
    let reflectance = fresnel(f64::from(wo.z.abs()), eta);
    let mut counts = [0; 2];
    for i in 0..SAMPLES {
        let s = lobe.sample(wo, Independent::new(50, UVec2::ZERO, i).get_1d(), Vec2::splat(0.5));
        let Some(s) = s.filter(|s| s.delta) else {
            return Err("glass absorbs nothing, and smooth glass blurs nothing".to_owned());
        };
        let refracted = s.wi.z * wo.z < 0.0;
        counts[usize::from(refracted)] += 1;
        let (bend, weight, change) = if refracted { (eta, 1.0 / (eta * eta), eta) } else { (1.0, 1.0, 1.0) };
        let off = f64::from(s.wi.x) * bend + f64::from(wo.x);
        if off.abs() > 1e-4 || s.wi.y.abs() > 1e-4 || (s.wi.length() - 1.0).abs() > 1e-4 {
            return Err(format!("{wo} goes on as {}", s.wi));
        }
        for (found, expected) in [(s.weight.to_rgb()[0], weight), (s.eta, change)] {
            if (f64::from(found) / expected - 1.0).abs() > 1e-4 {
                return Err(format!("{s:?}: a weight or change of index is {found}, not {expected}"));
            }
        }
    }
    let expected = [reflectance, 1.0 - reflectance].map(|chance| chance * f64::from(SAMPLES));
    if reflectance == 1.0 && counts[1] > 0 {
        return Err("refraction beyond the critical angle".to_owned());
    }
    chi2_at(&counts, &expected, significance).map_err(|e| format!("share of reflections: {e}"))
}

/// Share of unpolarised light that is reflected, by the sines and tangents of both angles (Born & Wolf, §1.5.2).
fn fresnel(cos_i: f64, eta: f64) -> f64 {
    let theta_i = cos_i.min(1.0).acos();
    if theta_i < 1e-6 {
        return ((eta - 1.0) / (eta + 1.0)).powi(2);
    }
    let sin_t = theta_i.sin() / eta;
    if sin_t >= 1.0 {
        return 1.0;
    }
    let theta_t = sin_t.asin();
    let (difference, sum) = (theta_i - theta_t, theta_i + theta_t);
    0.5 * ((difference.sin() / sum.sin()).powi(2) + (difference.tan() / sum.tan()).powi(2))
}
