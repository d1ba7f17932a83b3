//! Least squares: which law do measured points follow, and how well?

/// A law y(x) with two parameters, fitted to points.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fit {
    law: Law,
    /// Value of the line where its abscissa is 0.
    intercept: f64,
    /// The exponent of a power law; what a doubling adds in a logarithmic one.
    pub(super) slope: f64,
    /// Share of the points' variance that the line explains, 0..1.
    pub(super) r2: f64,
}

#[derive(Clone, Copy, Debug)]
enum Law {
    /// ln y = intercept + slope ln x
    Power,
    /// y = intercept + slope log₂ x
    Logarithm,
}

impl Fit {
    /// y = c xᵏ: a line through the logarithms of the points.
    pub(super) fn power(points: &[(f64, f64)]) -> Self {
        Self::line(Law::Power, points.iter().map(|&(x, y)| (x.ln(), y.ln())))
    }

    /// y = a + b log₂ x.
    pub(super) fn logarithm(points: &[(f64, f64)]) -> Self {
        Self::line(Law::Logarithm, points.iter().map(|&(x, y)| (x.log2(), y)))
    }

    fn line(law: Law, points: impl Iterator<Item = (f64, f64)> + Clone) -> Self {
        let n = points.clone().count() as f64;
        let mean_x = points.clone().map(|(x, _)| x).sum::<f64>() / n;
        let mean_y = points.clone().map(|(_, y)| y).sum::<f64>() / n;
        let (mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0);
        for (x, y) in points.map(|(x, y)| (x - mean_x, y - mean_y)) {
            xx += x * x;
            xy += x * y;
            yy += y * y;
        }
        let slope = xy / xx;
        let r2 = if yy == 0.0 { 1.0 } else { slope * xy / yy };
        Self { law, intercept: mean_y - slope * mean_x, slope, r2 }
    }

    pub(super) fn is_power(&self) -> bool {
        matches!(self.law, Law::Power)
    }

    /// The fitted law's value.
    pub(super) fn at(&self, x: f64) -> f64 {
        match self.law {
            Law::Power => (self.intercept + self.slope * x.ln()).exp(),
            Law::Logarithm => self.intercept + self.slope * x.log2(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_laws_in_points_that_follow_them() {
        let xs = [1.0, 3.0, 10.0, 70.0];
        let power = Fit::power(&xs.map(|x: f64| (x, 4.0 * x.powf(-0.5))));
        assert!((power.slope + 0.5).abs() < 1e-12 && (power.r2 - 1.0).abs() < 1e-12);
        assert!((power.at(16.0) - 1.0).abs() < 1e-12);
        let logarithm = Fit::logarithm(&xs.map(|x: f64| (x, 2.0 + 3.0 * x.log2())));
        assert!((logarithm.slope - 3.0).abs() < 1e-12 && (logarithm.r2 - 1.0).abs() < 1e-12);
        assert!((logarithm.at(8.0) - 11.0).abs() < 1e-12);
    }

    /// Anscombe's first data set: y = 3 + 0.5 x with R² = 0.67 (Anscombe 1973, doi:10.1080/00031305.1973.10478966).
    #[test]
    fn agrees_with_anscombe() {
        let x = [10.0, 8.0, 13.0, 9.0, 11.0, 14.0, 6.0, 4.0, 12.0, 7.0, 5.0];
        let y = [8.04, 6.95, 7.58, 8.81, 8.33, 9.96, 7.24, 4.26, 10.84, 4.82, 5.68];
        let points: Vec<_> = x.iter().zip(y).map(|(&x, y): (&f64, f64)| (x.exp2(), y)).collect();
        let fit = Fit::logarithm(&points);
        assert!((fit.intercept - 3.0001).abs() < 1e-4);
        assert!((fit.slope - 0.5001).abs() < 1e-4);
        assert!((fit.r2 - 0.6665).abs() < 1e-4);
    }
}
