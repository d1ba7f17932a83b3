//! Statistical tests of everything that is sampled.
//!
//! Thresholds are p = 1e-3, divided by the number of tests that are run together; seeds are fixed, so a result never
//! changes without the code. After the chi² tests of Mitsuba (Jakob et al.) and pbrt-v4 (Pharr et al. 2023).

use std::f64::consts::TAU;

use glam::{UVec2, Vec3};

use crate::film::Image;
use crate::material::Bsdf;
use crate::sampler::Independent;

/// Chance of a false alarm of one test.
pub const SIGNIFICANCE: f64 = 1e-3;

/// Pearson's chi² test of counts against expected counts; bins that expect fewer than 5 are pooled.
///
/// # Errors
/// If counts so far off come up with a chance below [`SIGNIFICANCE`], or where nothing was expected.
pub fn chi2_counts(observed: &[u64], expected: &[f64]) -> Result<(), String> {
    chi2_at(observed, expected, SIGNIFICANCE)
}

fn chi2_at(observed: &[u64], expected: &[f64], significance: f64) -> Result<(), String> {
    assert_eq!(observed.len(), expected.len());
    let (mut chi2, mut bins) = (0.0, 0);
    let mut add = |o: f64, e: f64| {
        chi2 += (o - e).powi(2) / e;
        bins += 1;
    };
    let mut pool = (0.0, 0.0);
    for (&o, &e) in observed.iter().zip(expected) {
        if e >= 5.0 {
            add(o as f64, e);
        } else {
            pool = (pool.0 + o as f64, pool.1 + e);
        }
    }
    if pool.1 >= 5.0 {
        add(pool.0, pool.1);
    } else if pool.0 > pool.1 + 6.0 * pool.1.sqrt() + 10.0 {
        return Err(format!("{} samples where {:.2} were expected", pool.0, pool.1));
    }
    let freedom = bins.max(2) - 1;
    let p = chi2_survival(chi2, freedom);
    if p < significance {
        Err(format!("chi² {chi2:.1} with {freedom} degrees of freedom: p = {p:.1e}"))
    } else {
        Ok(())
    }
}

/// The chance of a chi² above `x`: the regularised upper incomplete gamma function Q(k/2, x/2).
///
/// Series and continued fraction of Press et al., Numerical Recipes, 1992, §6.2.
fn chi2_survival(x: f64, freedom: usize) -> f64 {
    let (a, x) = (freedom as f64 / 2.0, x / 2.0);
    if x <= 0.0 {
        return 1.0;
    }
    let scale = (a * x.ln() - x - libm::lgamma(a)).exp();
    if x < a + 1.0 {
        let (mut term, mut sum) = (1.0 / a, 1.0 / a);
        for k in 1..10_000 {
            term *= x / (a + f64::from(k));
            sum += term;
        }
        return 1.0 - scale * sum;
    }
    let mut b = x + 1.0 - a;
    let mut c = f64::MAX;
    let mut d = 1.0 / b;
    let mut h = d;
    for i in 1..10_000 {
        let i = f64::from(i);
        let an = -i * (i - a);
        b += 2.0;
        d = 1.0 / (an * d + b);
        c = b + an / c;
        h *= c * d;
    }
    scale * h
}

/// Whether a lobe claims that light can be sent either way: f(wo, wi) = f(wi, wo).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reciprocal {
    /// It does.
    Yes,
    /// It does not.
    No,
}

/// All that a lobe promises, for directions of view from straight above to grazing, on both sides: samples follow the
/// density (chi²), weights are eval / pdf, no light is made, and reciprocity if claimed.
///
/// # Errors
/// The first promise that is broken.
pub fn check_lobe(bsdf: &Bsdf, reciprocal: Reciprocal) -> Result<(), String> {
    let angles = [0.0_f32, 20.0, 45.0, 70.0, 85.0, 89.0];
    for (i, degrees) in angles.into_iter().enumerate() {
        for side in [1.0, -1.0] {
            let (sin, cos) = degrees.to_radians().sin_cos();
            let azimuth = 0.7 * i as f32;
            let wo = Vec3::new(sin * azimuth.cos(), sin * azimuth.sin(), side * cos);
            let place = |e: String| format!("{bsdf:?} at {degrees} degrees, side {side}: {e}");
            chi2_lobe(bsdf, wo, SIGNIFICANCE / (2 * angles.len()) as f64).map_err(place)?;
            check_samples(bsdf, wo, reciprocal).map_err(place)?;
        }
    }
    Ok(())
}

/// Chi² of the directions that a lobe draws, sorted by height and azimuth, against its density, integrated bin by bin; and
/// the share that it absorbs against what the density lacks.
fn chi2_lobe(bsdf: &Bsdf, wo: Vec3, significance: f64) -> Result<(), String> {
    const SAMPLES: u32 = 200_000;
    const HEIGHTS: usize = 40;
    const AZIMUTHS: usize = 80;
    let mut observed = vec![0_u64; HEIGHTS * AZIMUTHS];
    for i in 0..SAMPLES {
        let mut numbers = Independent::new(11, UVec2::ZERO, i);
        let (uc, u) = (numbers.get_1d(), numbers.get_2d());
        if let Some(s) = bsdf.sample(wo, uc, u) {
            let height = (0.5 * f64::from(s.wi.z) + 0.5) * HEIGHTS as f64;
            let azimuth = (f64::from(s.wi.y).atan2(f64::from(s.wi.x)) / TAU + 0.5) * AZIMUTHS as f64;
            observed[(height as usize).min(HEIGHTS - 1) * AZIMUTHS + (azimuth as usize).min(AZIMUTHS - 1)] += 1;
        }
    }
    let density = |z: f64, turn: f64| {
        let wi = direction(z, turn);
        if bsdf.eval(wo, wi).is_black() { 0.0 } else { f64::from(bsdf.pdf(wo, wi)) * TAU }
    };
    let chance_of = |bin: usize| {
        let (height, azimuth) = ((bin / AZIMUTHS) as f64, (bin % AZIMUTHS) as f64);
        let z = [height, height + 1.0].map(|h| 2.0 * h / HEIGHTS as f64 - 1.0);
        let turn = [azimuth, azimuth + 1.0].map(|a| a / AZIMUTHS as f64 - 0.5);
        integrate(density, z, turn)
    };
    let chances: Vec<f64> = (0..HEIGHTS * AZIMUTHS).map(chance_of).collect();
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

fn direction(z: f64, turn: f64) -> Vec3 {
    let r = (1.0 - z * z).max(0.0).sqrt();
    let (sin, cos) = (turn * TAU).sin_cos();
    Vec3::new((r * cos) as f32, (r * sin) as f32, z as f32)
}

/// The integral over a rectangle by midpoints, halved until it holds still.
fn integrate(f: impl Fn(f64, f64) -> f64, x: [f64; 2], y: [f64; 2]) -> f64 {
    let midpoints = |n: i32| {
        let (dx, dy) = ((x[1] - x[0]) / f64::from(n), (y[1] - y[0]) / f64::from(n));
        let at = |i: i32, j: i32| f(x[0] + (f64::from(i) + 0.5) * dx, y[0] + (f64::from(j) + 0.5) * dy);
        (0..n).flat_map(|i| (0..n).map(move |j| (i, j))).map(|(i, j)| at(i, j)).sum::<f64>() * dx * dy
    };
    let (mut n, mut before) = (32, midpoints(16));
    loop {
        let value = midpoints(n);
        if (value - before).abs() <= 1e-3 * value + 1e-9 || n >= 512 {
            return value;
        }
        (n, before) = (2 * n, value);
    }
}

/// Sample by sample: unit directions, weight = eval / pdf, weight at most 1, reciprocity.
fn check_samples(bsdf: &Bsdf, wo: Vec3, reciprocal: Reciprocal) -> Result<(), String> {
    let close = |a: f32, b: f32| (a - b).abs() <= 2e-3 * a.abs().max(b.abs()) + 1e-6;
    for i in 0..2000 {
        let mut numbers = Independent::new(12, UVec2::ZERO, i);
        let (uc, u) = (numbers.get_1d(), numbers.get_2d());
        let Some(s) = bsdf.sample(wo, uc, u).filter(|s| !s.delta) else {
            continue;
        };
        if (s.wi.length() - 1.0).abs() > 1e-4 {
            return Err(format!("direction of length {}", s.wi.length()));
        }
        let (pdf, eval) = (bsdf.pdf(wo, s.wi), bsdf.eval(wo, s.wi).to_rgb());
        if !close(pdf, s.pdf) {
            return Err(format!("sample says density {}, pdf says {pdf}", s.pdf));
        }
        for (weight, eval) in s.weight.to_rgb().into_iter().zip(eval) {
            if !close(weight * pdf, eval) {
                return Err(format!("weight {weight} times density {pdf} is not eval {eval}"));
            }
            if weight > 1.0 + 1e-5 {
                return Err(format!("weight {weight} makes light"));
            }
        }
        if reciprocal == Reciprocal::Yes {
            let there = eval[0] / s.wi.z.abs();
            let back = bsdf.eval(s.wi, wo).to_rgb()[0] / wo.z.abs();
            if !close(there, back) {
                return Err(format!("{there} one way, {back} the other"));
            }
        }
    }
    Ok(())
}

/// Z-test of an image against known radiance: block by block, the mean must lie within what `standard_error` of a pixel
/// allows at [`SIGNIFICANCE`] divided by the number of blocks.
///
/// # Errors
/// The block that is farthest off.
pub fn z_test(
    image: &Image,
    expected: impl Fn(u32, u32) -> f64,
    standard_error: impl Fn(u32, u32) -> f64,
    block: u32,
) -> Result<(), String> {
    let (columns, rows) = (image.width().div_ceil(block), image.height().div_ceil(block));
    let limit = normal_quantile(SIGNIFICANCE / f64::from(columns * rows));
    let mut worst = (0.0, String::new());
    for (row, column) in (0..rows).flat_map(|r| (0..columns).map(move |c| (r, c))) {
        let (mut difference, mut variance, mut size) = (0.0, 0.0, 0.0);
        for y in row * block..((row + 1) * block).min(image.height()) {
            for x in column * block..((column + 1) * block).min(image.width()) {
                let l = crate::color::Rgb(image.pixel(x, y)).luminance();
                difference += f64::from(l) - expected(x, y);
                variance += standard_error(x, y).powi(2);
                size += expected(x, y).abs();
            }
        }
        // Single precision leaves a trace where the noise is gone.
        let z = difference.abs() / (variance.sqrt() + 1e-6 * size + 1e-12);
        if z > worst.0 {
            worst = (z, format!("block ({column}, {row}) is off by {z:.2} standard errors, {limit:.2} are allowed"));
        }
    }
    if worst.0 > limit { Err(worst.1) } else { Ok(()) }
}

/// The z that a normal variable exceeds on either side with chance `p`.
fn normal_quantile(p: f64) -> f64 {
    let (mut lo, mut hi) = (0.0, 40.0);
    for _ in 0..100 {
        let z = 0.5 * (lo + hi);
        if libm::erfc(z / std::f64::consts::SQRT_2) > p { lo = z } else { hi = z }
    }
    hi
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn chi2_survival_matches_tables() {
        for (x, freedom, p) in
            [(3.841, 1, 0.05), (10.828, 1, 0.001), (18.307, 10, 0.05), (149.449, 100, 0.001), (1000.0, 1000, 0.4940)]
        {
            assert!((chi2_survival(x, freedom) - p).abs() < 2e-4, "chi² {x}, {freedom}");
        }
        assert!((normal_quantile(0.05) - 1.959_96).abs() < 1e-4);
        assert!((integrate(|x, y| x * y * y, [0.0, 1.0], [0.0, 3.0]) - 4.5).abs() < 1e-2);
    }

    #[test]
    fn chi2_finds_what_is_wrong() {
        chi2_counts(&[1000, 1010, 990], &[1000.0; 3]).unwrap();
        chi2_counts(&[1200, 900, 900], &[1000.0; 3]).unwrap_err();
        chi2_counts(&[1000, 1000, 50], &[1025.0, 1025.0, 0.0]).unwrap_err();
    }
}
