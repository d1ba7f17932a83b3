//! Statistical tests of everything that is sampled.
//!
//! Thresholds are p = 1e-3, divided by the number of tests that are run together; seeds are fixed, so a result never
//! changes without the code. After the chi² tests of Mitsuba (Jakob et al.) and pbrt-v4 (Pharr et al. 2023).

mod lobe;

use crate::film::Image;

pub use lobe::{Reciprocal, check_lobe};

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
    }

    #[test]
    fn chi2_finds_what_is_wrong() {
        chi2_counts(&[1000, 1010, 990], &[1000.0; 3]).unwrap();
        chi2_counts(&[1200, 900, 900], &[1000.0; 3]).unwrap_err();
        chi2_counts(&[1000, 1000, 50], &[1025.0, 1025.0, 0.0]).unwrap_err();
    }
}
