//! The film: exact sums of samples, and the picture that they make.
//!
//! Sums are integers (see [`exact`](self)), so their value does not depend on the order of the samples: one thread,
//! many threads, several machines or an interrupted and resumed render give the same bits.

mod aov;
mod detail;
mod exact;
mod filter;
mod image;
mod seen;
mod tile;

pub use aov::{Aov, Channel, FirstHit, Ids, Values, channels};
pub use detail::{FilmOptions, PixelDetail};
pub use filter::{BlackmanHarris, BoxFilter, Filter, FilterDesc, FilterSample, Gaussian, Mitchell, Tent};
pub use image::{Image, Wrap};
pub(crate) use image::{bilinear, nearest};
pub use seen::Seen;
pub use tile::{PixelMut, PixelSum, Tile};

/// Statistical error of a picture, known from its own samples: the standard error of each pixel's luminance over that
/// luminance plus 1 % of the picture's mean.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ErrorEstimate {
    /// Mean over the pixels.
    pub mean: f64,
    /// The error that 95 % of the pixels stay below.
    pub p95: f64,
}

/// How often the pixels of a film were sampled.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SampleCounts {
    /// Samples of the pixel that has fewest.
    pub min: u32,
    /// Samples a pixel on average.
    pub mean: f64,
    /// Samples of the pixel that has most.
    pub max: u32,
    /// Samples that were not finite numbers, or beyond ±2³², and do not count.
    pub dropped: u64,
}

/// Sums of samples, tile by tile.
#[derive(Clone, Debug)]
pub struct Film {
    width: u32,
    height: u32,
    options: FilmOptions,
    tiles: Vec<Tile>,
}

impl Film {
    /// A film without samples.
    pub fn new(width: u32, height: u32, options: FilmOptions) -> Self {
        Self { width, height, options, tiles: Tile::cover(width, height, options) }
    }

    /// Bytes that such a film and its picture take.
    pub fn bytes(width: u32, height: u32, options: &FilmOptions) -> u64 {
        let detail = if options.need_detail() { size_of::<PixelDetail>() } else { 0 };
        let alpha = if options.transparent { size_of::<f32>() } else { 0 };
        let pixel = size_of::<PixelSum>() + detail + size_of::<[f32; 3]>() + alpha;
        u64::from(width) * u64::from(height) * pixel as u64
    }

    /// The tiles, row by row.
    pub fn tiles(&self) -> &[Tile] {
        &self.tiles
    }

    /// The tiles, row by row, to add samples to.
    pub fn tiles_mut(&mut self) -> &mut [Tile] {
        &mut self.tiles
    }

    /// The number of tiles.
    pub fn tile_count(&self) -> usize {
        self.tiles.len()
    }

    /// The mean of each pixel's samples; black where there are none. With an alpha if the film is transparent.
    pub fn develop(&self) -> Image {
        let mut image = Image::new(self.width, self.height);
        for (pixel, sum) in self.tiles.iter().flat_map(Tile::pixels) {
            image.set_pixel(pixel.x, pixel.y, sum.mean());
        }
        if self.options.transparent {
            let alpha = self.details(|_, detail| detail.alpha());
            return image.with_alpha(alpha);
        }
        image
    }

    /// `f` of each pixel, row by row; its default where the film keeps no details.
    fn details<T: Clone + Default>(&self, f: impl Fn(&PixelSum, &PixelDetail) -> T) -> Vec<T> {
        let mut values = vec![T::default(); self.width as usize * self.height as usize];
        for (pixel, sum, detail) in self.tiles.iter().flat_map(Tile::details) {
            values[pixel.y as usize * self.width as usize + pixel.x as usize] = f(sum, detail);
        }
        values
    }

    /// The variance of each channel's mean, row by row: the square of its standard error. Infinite below two samples, 0
    /// if the film was not told to keep it.
    pub fn variance(&self) -> Vec<[f32; 3]> {
        self.details(|sum, detail| detail.variance(sum).map_or([f32::INFINITY; 3], |v| v.map(|v| v as f32)))
    }

    /// The samples that count of each pixel, row by row.
    pub fn counts(&self) -> Vec<u32> {
        let mut counts = vec![0; self.width as usize * self.height as usize];
        for (pixel, sum) in self.tiles.iter().flat_map(Tile::pixels) {
            counts[pixel.y as usize * self.width as usize + pixel.x as usize] = sum.count();
        }
        counts
    }

    /// The luminance that clamping has taken from the picture, in the mean over its pixels.
    pub fn clamped(&self) -> f64 {
        let lost = |(_, sum, detail): (_, &PixelSum, &PixelDetail)| detail.clamped() / f64::from(sum.count().max(1));
        let pixels = f64::from(self.width) * f64::from(self.height);
        self.tiles.iter().flat_map(Tile::details).map(lost).sum::<f64>() / pixels
    }

    /// How often pixels were sampled.
    pub fn sample_counts(&self) -> SampleCounts {
        let mut counts = SampleCounts { min: u32::MAX, ..SampleCounts::default() };
        let (mut pixels, mut total) = (0_u64, 0_u64);
        for (_, sum) in self.tiles.iter().flat_map(Tile::pixels) {
            counts.min = counts.min.min(sum.count());
            counts.max = counts.max.max(sum.count());
            counts.dropped += u64::from(sum.dropped());
            pixels += 1;
            total += u64::from(sum.count());
        }
        counts.min = counts.min.min(counts.max);
        counts.mean = total as f64 / pixels.max(1) as f64;
        counts
    }

    /// The picture's own error; none before every pixel has two samples.
    pub fn error(&self) -> Option<ErrorEstimate> {
        let sums = || self.tiles.iter().flat_map(Tile::pixels).map(|(_, sum)| sum);
        let pixels = sums().count().max(1) as f64;
        let floor = 0.01 * sums().map(PixelSum::luminance).sum::<f64>() / pixels;
        let relative = |sum: &PixelSum| {
            let error = sum.standard_error()?;
            Some(if error == 0.0 { 0.0 } else { error / (sum.luminance() + floor) })
        };
        let mut errors: Vec<f64> = sums().map(relative).collect::<Option<_>>()?;
        let mean = errors.iter().sum::<f64>() / pixels;
        let rank = (errors.len() * 95 / 100).min(errors.len().saturating_sub(1));
        let p95 = if errors.is_empty() { 0.0 } else { *errors.select_nth_unstable_by(rank, f64::total_cmp).1 };
        Some(ErrorEstimate { mean, p95 })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::Spectrum;

    fn fill(film: &mut Film, samples: &[f32]) {
        for tile in film.tiles_mut() {
            tile.for_each_pixel(|_, mut pixel| {
                samples.iter().for_each(|&s| pixel.add(&Seen::surface(Spectrum::ONE * s), 1.0));
            });
        }
    }

    #[test]
    fn develops_the_mean_in_any_order() {
        let (mut a, mut b) = (Film::new(33, 17, FilmOptions::default()), Film::new(33, 17, FilmOptions::default()));
        let samples = [1e-7, 3.5, 1e6, 0.1, 123.456, 1e-3];
        fill(&mut a, &samples);
        for sample in samples.iter().rev() {
            fill(&mut b, &[*sample]);
        }
        assert_eq!(a.develop(), b.develop());
        let mean = samples.iter().map(|&s| f64::from(s)).sum::<f64>() / samples.len() as f64;
        assert_eq!(a.develop().pixel(32, 16), [mean as f32; 3]);
    }

    #[test]
    fn knows_its_error() {
        let mut film = Film::new(8, 8, FilmOptions::default());
        assert!(film.error().is_none());
        fill(&mut film, &[0.5, 1.5, 0.5, 1.5]);
        // Variance of the mean: (4 · 0.25 / 3) / 4; luminance 1, floor 0.01.
        let expected = (1.0_f64 / 12.0).sqrt() / 1.01;
        let error = film.error().unwrap();
        assert!((error.mean - expected).abs() < 1e-6 && (error.p95 - expected).abs() < 1e-6);
    }

    #[test]
    fn knows_its_error_in_the_dark_and_in_the_light() {
        for scale in [1e-7_f32, 1e-3, 1e3, 1e5] {
            let mut film = Film::new(8, 8, FilmOptions::default());
            fill(&mut film, &[0.5, 1.5, 0.5, 1.5].map(|s| s * scale));
            let expected = (1.0_f64 / 12.0).sqrt() / 1.01;
            let error = film.error().unwrap().mean;
            assert!((error - expected).abs() < 1e-3, "{error} at {scale}");
        }
    }

    #[test]
    fn drops_and_counts_what_is_no_number() {
        let mut film = Film::new(1, 1, FilmOptions::default());
        fill(&mut film, &[1.0, f32::NAN, f32::INFINITY, 1e30, 3.0]);
        assert_eq!(film.sample_counts().dropped, 3);
        assert_eq!(film.develop().pixel(0, 0), [2.0; 3], "the mean of those that count");
    }
}
