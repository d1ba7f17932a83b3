//! What a film keeps of a pixel besides its light, if it is asked to.

use crate::color::{Rgb, Spectrum};
use crate::film::Seen;
use crate::film::exact::Exact;
use crate::film::tile::{BRIGHTEST_SQUARED, PixelSum};

/// What becomes of samples on the film.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FilmOptions {
    /// Whether the background is left out where the camera sees it, so that pixels have an alpha.
    pub transparent: bool,
    /// Samples of higher luminance are darkened to this one; 0 leaves them as they are. The picture loses light.
    pub clamp: f32,
    /// Whether the variance of each channel is known, not only that of the luminance.
    pub variance: bool,
}

impl FilmOptions {
    /// Whether the film has to keep [`PixelDetail`]s.
    pub(super) fn need_detail(&self) -> bool {
        self.transparent || self.clamp > 0.0 || self.variance
    }

    /// What of a sample is drawn, and the luminance that it loses.
    #[inline]
    fn draw(&self, seen: &Seen) -> (Spectrum, f32) {
        let l = if self.transparent { seen.l } else { seen.light() };
        let y = Rgb(l.to_rgb()).luminance();
        if self.clamp > 0.0 && y > self.clamp { (l * (self.clamp / y), y - self.clamp) } else { (l, 0.0) }
    }
}

/// Sums over the samples of one pixel, of which that of its light is kept elsewhere.
#[derive(Clone, Copy, Debug, Default)]
pub struct PixelDetail {
    /// Weights of the samples that saw a surface.
    covered: Exact,
    /// Weights of all samples.
    weight: Exact,
    /// Luminance that clamping has taken away.
    clamped: Exact,
    /// Squares of channels up to [`BRIGHTEST_SQUARED`].
    squares: [Exact; 3],
}

impl PixelDetail {
    #[inline]
    pub(super) fn add(&mut self, sum: &mut PixelSum, seen: &Seen, weight: f32, options: &FilmOptions) {
        let (l, lost) = options.draw(seen);
        let l = l * weight;
        if !sum.add(l) {
            return;
        }
        self.covered += Exact::new(if seen.background.is_none() { weight } else { 0.0 });
        self.weight += Exact::new(weight);
        self.clamped += Exact::new(lost.min(Exact::LIMIT) * weight);
        for (square, c) in self.squares.iter_mut().zip(l.to_rgb()) {
            let c = c.clamp(-BRIGHTEST_SQUARED, BRIGHTEST_SQUARED);
            *square += Exact::new(c * c);
        }
    }

    /// The share of the pixel that is covered, 0..1: exact where all samples agree, whatever their weights.
    pub fn alpha(&self) -> f32 {
        let weight = self.weight.to_f64();
        if weight > 0.0 { (self.covered.to_f64() / weight).clamp(0.0, 1.0) as f32 } else { 0.0 }
    }

    /// The sum of the luminances that samples have lost.
    pub(super) fn clamped(&self) -> f64 {
        self.clamped.to_f64()
    }

    /// The variance of the mean of each channel; none below two samples.
    pub(super) fn variance(&self, sum: &PixelSum) -> Option<[f64; 3]> {
        let n = f64::from(sum.count());
        let mean = sum.mean_f64();
        let variance = |i: usize| (self.squares[i].to_f64() / n - mean[i] * mean[i]).max(0.0) / (n - 1.0);
        (n >= 2.0).then(|| std::array::from_fn(variance))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pixel(options: FilmOptions, samples: &[(Seen, f32)]) -> (PixelSum, PixelDetail) {
        let (mut sum, mut detail) = (PixelSum::default(), PixelDetail::default());
        samples.iter().for_each(|(seen, weight)| detail.add(&mut sum, seen, *weight, &options));
        (sum, detail)
    }

    fn grey(l: f32) -> Seen {
        Seen::surface(Spectrum::ONE * l)
    }

    #[test]
    fn alpha_is_the_share_that_is_covered() {
        let options = FilmOptions { transparent: true, ..FilmOptions::default() };
        let sky = Seen::outside(Spectrum::BLACK, Spectrum::ONE * 5.0, true);
        let mirrored = Seen::outside(Spectrum::BLACK, Spectrum::ONE * 2.0, false);
        let (sum, detail) = pixel(options, &[(grey(1.0), 1.0), (sky, 1.0), (sky, 1.0), (mirrored, 1.0)]);
        assert_eq!((sum.mean(), detail.alpha()), ([0.75; 3], 0.5));
        // A filter with a negative rim does not make holes, and nothing where there is nothing.
        for (seen, alpha) in [(grey(1.0), 1.0), (sky, 0.0), (Seen::NOTHING, 0.0)] {
            assert_eq!(pixel(options, &[(seen, 1.25), (seen, -1.25), (seen, 1.25)]).1.alpha(), alpha);
        }
        assert_eq!(pixel(options, &[(grey(1.0), -1.25), (sky, 1.5)]).1.alpha(), 0.0);
        assert_eq!(pixel(options, &[]).1.alpha(), 0.0);
    }

    #[test]
    fn what_is_clamped_is_known() {
        let options = FilmOptions { clamp: 2.0, ..FilmOptions::default() };
        let red = Seen::surface(Spectrum::from_rgb([100.0, 0.0, 0.0]));
        let (sum, detail) = pixel(options, &[(grey(1.0), 1.0), (grey(12.0), 1.0), (red, 1.0)]);
        assert!((sum.luminance() - 5.0 / 3.0).abs() < 1e-6);
        assert!((detail.clamped() - (10.0 + 21.26 - 2.0)).abs() < 1e-5);
        // As red as before, and what is no number does not count.
        assert_eq!(pixel(options, &[(red, 1.0)]).0.mean()[1..], [0.0; 2]);
        let (sum, detail) = pixel(options, &[(grey(f32::NAN), 1.0), (grey(f32::INFINITY), 1.0), (grey(1e30), 1.0)]);
        assert_eq!((sum.count(), sum.dropped()), (1, 2));
        assert!(detail.clamped() <= f64::from(Exact::LIMIT));
    }

    #[test]
    fn variance_of_each_channel() {
        let options = FilmOptions { variance: true, ..FilmOptions::default() };
        let samples = [[1.0, 5.0, 0.0], [3.0, 5.0, 0.0], [1.0, 5.0, 1.0], [3.0, 5.0, 0.0]];
        let samples = samples.map(|rgb| (Seen::surface(Spectrum::from_rgb(rgb)), 1.0));
        let (sum, detail) = pixel(options, &samples);
        // Squares of deviations over n (n − 1).
        assert_eq!(detail.variance(&sum), Some([4.0 / 12.0, 0.0, 0.75 / 12.0]));
        let (sum, detail) = pixel(options, &samples[..1]);
        assert_eq!(detail.variance(&sum), None);
    }
}
