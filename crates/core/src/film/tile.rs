//! A square of pixels and their sums.

use glam::UVec2;

use crate::color::{Rgb, Spectrum, luminance};
use crate::film::exact::Exact;

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
const BRIGHTEST_SQUARED: f32 = 524_288.0;

impl PixelSum {
    /// Adds one sample. What is not finite, or beyond ±2³², is dropped and counted.
    #[inline]
    pub fn add(&mut self, l: Spectrum) {
        let rgb = l.to_rgb();
        if rgb.iter().all(|c| c.abs() < Exact::LIMIT) {
            let y = Rgb(rgb).luminance().min(BRIGHTEST_SQUARED);
            for (sum, c) in self.rgb.iter_mut().zip(rgb) {
                *sum += Exact::new(c);
            }
            self.luminance_sq += Exact::new(y * y);
            self.count += 1;
        } else {
            self.dropped += 1;
        }
    }

    /// Samples that count.
    pub fn count(&self) -> u32 {
        self.count
    }

    /// Samples that do not.
    pub fn dropped(&self) -> u32 {
        self.dropped
    }

    fn mean_f64(&self) -> [f64; 3] {
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

/// A part of the film: [`SIDE`](Self::SIDE)² pixels, or fewer at the right and bottom edge.
#[derive(Clone, Debug)]
pub struct Tile {
    origin: UVec2,
    width: u32,
    sums: Vec<PixelSum>,
}

impl Tile {
    /// Pixels along a side.
    pub const SIDE: u32 = 16;

    /// The tiles of a film, row by row.
    pub(super) fn cover(width: u32, height: u32) -> Vec<Self> {
        let starts = |extent: u32| (0..extent).step_by(Self::SIDE as usize);
        starts(height)
            .flat_map(|y| starts(width).map(move |x| UVec2::new(x, y)))
            .map(|origin| {
                let size = (UVec2::new(width, height) - origin).min(UVec2::splat(Self::SIDE));
                Self { origin, width: size.x, sums: vec![PixelSum::default(); (size.x * size.y) as usize] }
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

    /// Calls `f` with each pixel's position on the film and its sum.
    #[inline]
    pub fn for_each_pixel(&mut self, mut f: impl FnMut(UVec2, &mut PixelSum)) {
        for i in 0..self.sums.len() {
            f(self.position(i), &mut self.sums[i]);
        }
    }
}
