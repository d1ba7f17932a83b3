//! A square of pixels and their sums.

use glam::UVec2;

use crate::color::{Rgb, Spectrum, luminance};
use crate::film::exact::Exact;
use crate::film::{FilmOptions, PixelDetail, Seen};

/// The samples of one pixel, added up.
#[derive(Clone, Copy, Debug, Default)]
pub struct PixelSum {
    rgb: [Exact; 3],
    /// Of the squares of luminances up to [`BRIGHTEST_SQUARED`].
    luminance_sq: Exact,
    count: u32,
    dropped: u32,
}

/// Brighter samples count as this bright in the estimate of the error: 2²⁴ such squares fit into the sum.
pub(super) const BRIGHTEST_SQUARED: f32 = 524_288.0;

impl PixelSum {
    /// Adds one sample, and says so. What is not finite, or beyond ±2³², is dropped and counted.
    #[inline]
    pub fn add(&mut self, l: Spectrum) -> bool {
        let rgb = l.to_rgb();
        let counts = rgb.iter().all(|c| c.abs() < Exact::LIMIT);
        if counts {
            let y = Rgb(rgb).luminance().clamp(-BRIGHTEST_SQUARED, BRIGHTEST_SQUARED);
            for (sum, c) in self.rgb.iter_mut().zip(rgb) {
                *sum += Exact::new(c);
            }
            self.luminance_sq += Exact::new(y * y);
            self.count += 1;
        } else {
            self.dropped += 1;
        }
        counts
    }

    /// Samples that count.
    pub fn count(&self) -> u32 {
        self.count
    }

    /// Samples that do not.
    pub fn dropped(&self) -> u32 {
        self.dropped
    }

    pub(super) fn mean_f64(&self) -> [f64; 3] {
        self.rgb.map(|sum| sum.to_f64() / f64::from(self.count.max(1)))
    }

    /// The mean of the samples; black without any.
    pub fn mean(&self) -> [f32; 3] {
        self.mean_f64().map(|c| c as f32)
    }

    /// The mean luminance.
    pub fn luminance(&self) -> f64 {
        luminance(self.mean_f64())
    }

    /// The standard error of the mean luminance; none below two samples.
    pub fn standard_error(&self) -> Option<f64> {
        let n = f64::from(self.count);
        let square = self.luminance_sq.to_f64() / n;
        let variance = (square - self.luminance().powi(2)).max(0.0) / (n - 1.0);
        (self.count >= 2).then_some(variance.sqrt())
    }
}

/// A pixel to add samples to.
#[derive(Debug)]
pub struct PixelMut<'t> {
    sum: &'t mut PixelSum,
    detail: Option<&'t mut PixelDetail>,
    options: &'t FilmOptions,
}

impl PixelMut<'_> {
    /// Adds what one camera ray brought, times the filter's weight.
    #[inline]
    pub fn add(&mut self, seen: &Seen, weight: f32) {
        match &mut self.detail {
            None => drop(self.sum.add(seen.light() * weight)),
            Some(detail) => detail.add(self.sum, seen, weight, self.options),
        }
    }
}

/// A part of the film: [`SIDE`](Self::SIDE)² pixels, or fewer at the right and bottom edge.
#[derive(Clone, Debug)]
pub struct Tile {
    origin: UVec2,
    width: u32,
    options: FilmOptions,
    sums: Vec<PixelSum>,
    /// One for each sum, or none at all.
    details: Vec<PixelDetail>,
}

impl Tile {
    /// Pixels along a side.
    pub const SIDE: u32 = 16;

    /// The tiles of a film, row by row.
    pub(super) fn cover(width: u32, height: u32, options: FilmOptions) -> Vec<Self> {
        let starts = |extent: u32| (0..extent).step_by(Self::SIDE as usize);
        starts(height)
            .flat_map(|y| starts(width).map(move |x| UVec2::new(x, y)))
            .map(|origin| {
                let size = (UVec2::new(width, height) - origin).min(UVec2::splat(Self::SIDE));
                let count = (size.x * size.y) as usize;
                let details = if options.need_detail() { count } else { 0 };
                Self {
                    origin,
                    width: size.x,
                    options,
                    sums: vec![PixelSum::default(); count],
                    details: vec![PixelDetail::default(); details],
                }
            })
            .collect()
    }

    fn position(&self, index: usize) -> UVec2 {
        self.origin + UVec2::new(index as u32 % self.width, index as u32 / self.width)
    }

    /// The pixels' positions on the film and their sums, row by row.
    pub fn pixels(&self) -> impl Iterator<Item = (UVec2, &PixelSum)> {
        self.sums.iter().enumerate().map(|(i, sum)| (self.position(i), sum))
    }

    /// As [`pixels`](Self::pixels), with their details; none if the film keeps none.
    pub fn details(&self) -> impl Iterator<Item = (UVec2, &PixelSum, &PixelDetail)> {
        self.pixels().zip(&self.details).map(|((pixel, sum), detail)| (pixel, sum, detail))
    }

    /// Calls `f` with each pixel's position on the film and the pixel.
    #[inline]
    pub fn for_each_pixel(&mut self, mut f: impl FnMut(UVec2, PixelMut<'_>)) {
        for i in 0..self.sums.len() {
            let position = self.position(i);
            f(position, PixelMut { sum: &mut self.sums[i], detail: self.details.get_mut(i), options: &self.options });
        }
    }
}
