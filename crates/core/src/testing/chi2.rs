//! Pearson's chi² test: whether counts are what chances promise.

use super::SIGNIFICANCE;

/// Pearson's chi² test of counts against expected counts; bins that expect fewer than 5 are pooled.
///
/// # Errors
/// If counts so far off come up with a chance below [`SIGNIFICANCE`], or where nothing was expected.
pub fn chi2_counts(observed: &[u64], expected: &[f64]) -> Result<(), String> {
    chi2_at(observed, expected, SIGNIFICANCE)
}

/// As [`chi2_counts`], with another chance of a false alarm.
pub(super) fn chi2_at(observed: &[u64], expected: &[f64], significance: f64) -> Result<(), String> {
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn survival_matches_tables() {
        for (x, freedom, p) in
            [(3.841, 1, 0.05), (10.828, 1, 0.001), (18.307, 10, 0.05), (149.449, 100, 0.001), (1000.0, 1000, 0.4940)]
        {
            assert!((chi2_survival(x, freedom) - p).abs() < 2e-4, "chi² {x}, {freedom}");
        }
    }

    #[test]
    fn finds_what_is_wrong() {
        chi2_counts(&[1000, 1010, 990], &[1000.0; 3]).unwrap();
        chi2_counts(&[1200, 900, 900], &[1000.0; 3]).unwrap_err();
        chi2_counts(&[1000, 1000, 50], &[1025.0, 1025.0, 0.0]).unwrap_err();
    }
}
