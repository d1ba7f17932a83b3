//! Z-tests of pictures: whether they show what they should, within their noise.

use super::SIGNIFICANCE;
use crate::color::Rgb;
use crate::film::{Film, Image, Tile};

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

/// Z-test of two pictures of the same size and scene against each other, block by block, by the noise that both films
/// report.
///
/// # Errors
/// The block that is farthest off.
pub fn z_test_films(a: &Film, b: &Film, block: u32) -> Result<(), String> {
    let (a_image, b_image) = (a.develop(), b.develop());
    let width = a_image.width();
    let (a_errors, b_errors) = (standard_errors(a, width), standard_errors(b, width));
    let expected = |x: u32, y: u32| f64::from(Rgb(b_image.pixel(x, y)).luminance());
    let at = |x: u32, y: u32| (y * width + x) as usize;
    z_test(&a_image, expected, |x, y| a_errors[at(x, y)].hypot(b_errors[at(x, y)]), block)
}

/// Standard error of each pixel's luminance, row by row; infinite below two samples.
fn standard_errors(film: &Film, width: u32) -> Vec<f64> {
    let mut pixels: Vec<_> = film.tiles().iter().flat_map(Tile::pixels).collect();
    pixels.sort_by_key(|(place, _)| place.y * width + place.x);
    pixels.into_iter().map(|(_, sum)| sum.standard_error().unwrap_or(f64::INFINITY)).collect()
}

/// The mean of several independent estimates of the same number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// Their mean.
    pub mean: f64,
    /// Its standard error, from their scatter.
    pub standard_error: f64,
}

impl Estimate {
    /// Of at least two estimates.
    pub fn new(estimates: &[f64]) -> Self {
        let n = estimates.len() as f64;
        let mean = estimates.iter().sum::<f64>() / n;
        let variance = estimates.iter().map(|e| (e - mean).powi(2)).sum::<f64>() / (n - 1.0);
        Self { mean, standard_error: (variance / n).sqrt() }
    }

    /// Of the mean over a picture, by at least two of it. Its pixels are independent, but differ: the scatter of each from
    /// picture to picture is what counts.
    pub fn of_pictures(pictures: &[Vec<f64>]) -> Self {
        let size = pictures[0].len();
        let pixels = (0..size).map(|i| Self::new(&pictures.iter().map(|picture| picture[i]).collect::<Vec<_>>()));
        let (sum, variance) =
            pixels.fold((0.0, 0.0), |(sum, variance), it| (sum + it.mean, variance + it.standard_error.powi(2)));
        Self { mean: sum / size as f64, standard_error: variance.sqrt() / size as f64 }
    }

    /// Z-test against what is known, but for `rounding` relative to it. `tests` are run together.
    ///
    /// # Errors
    /// If the mean is farther off than noise allows.
    pub fn z_test(&self, expected: f64, rounding: f64, tests: u32) -> Result<(), String> {
        let limit = normal_quantile(SIGNIFICANCE / f64::from(tests));
        let allowed = limit * self.standard_error + rounding * expected.abs();
        let Self { mean, standard_error } = self;
        if (mean - expected).abs() <= allowed {
            Ok(())
        } else {
            Err(format!("it is {mean:.6} ± {standard_error:.6}, not {expected:.6}"))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::Spectrum;
    use crate::film::{FilmOptions, Seen};

    #[test]
    fn quantiles_match_tables() {
        assert!((normal_quantile(0.05) - 1.959_96).abs() < 1e-4);
        assert!((normal_quantile(1e-3) - 3.290_53).abs() < 1e-4);
    }

    #[test]
    fn estimates_know_their_error() {
        let estimate = Estimate::new(&[1.0, 2.0, 3.0, 2.0]);
        assert!(
            (estimate.mean - 2.0).abs() < 1e-12 && (estimate.standard_error - (1.0_f64 / 6.0).sqrt()).abs() < 1e-12
        );
        estimate.z_test(2.0 + 3.2 * estimate.standard_error, 0.0, 1).unwrap();
        estimate.z_test(2.0 + 3.4 * estimate.standard_error, 0.0, 1).unwrap_err();
        estimate.z_test(f64::NAN, 0.0, 1).unwrap_err();
        Estimate::new(&[1.0, 1.0]).z_test(1.0, 0.0, 1).unwrap();
        Estimate::new(&[1.0, f64::NAN]).z_test(1.0, 0.0, 1).unwrap_err();
    }

    /// Two pixels that differ by 10 and scatter as much as one another.
    #[test]
    fn pixels_of_pictures_may_differ() {
        let estimate = Estimate::of_pictures(&[vec![1.0, 14.0], vec![3.0, 12.0], vec![2.0, 13.0]]);
        assert!((estimate.mean - 7.5).abs() < 1e-12);
        assert!((estimate.standard_error - (2.0_f64 / 3.0).sqrt() / 2.0).abs() < 1e-12);
    }

    #[test]
    fn films_are_compared_by_their_noise() {
        let film = |samples: [f32; 4]| {
            let mut film = Film::new(20, 3, FilmOptions::default());
            for tile in film.tiles_mut() {
                tile.for_each_pixel(|_, mut sum| {
                    samples.iter().for_each(|&s| sum.add(&Seen::surface(Spectrum::ONE * s), 1.0))
                });
            }
            film
        };
        z_test_films(&film([1.0, 3.0, 1.0, 3.0]), &film([1.1, 3.1, 1.1, 3.1]), 1).unwrap();
        z_test_films(&film([1.0, 3.0, 1.0, 3.0]), &film([2.0, 4.0, 2.0, 4.0]), 20).unwrap_err();
    }
}
