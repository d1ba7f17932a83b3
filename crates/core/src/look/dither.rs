//! Noise that hides the steps between 256 signals.
//!
//! A number v between two steps, plus noise t, is rounded. If t is the sum of two even distributions over ±½, the mean and
//! the variance of the result do not depend on where between the steps v lies, so no step is seen (Lipshitz, Wannamaker &
//! Vanderkooy, "Quantization and Dither: A Theoretical Survey", J. Audio Eng. Soc. 40(5), 1992). Less than half a step
//! from black and white, where such a sum would leave the range and the mean would be wrong, one of the two is enough.
//!
//! The noise is a hash of the pixel and its channel: the same for every picture and on every machine.

use crate::math::{GAMMA, mix, unit};

/// White in 8 bits.
const WHITE: f32 = 255.0;

/// The noise of a channel with signal `v`, 0..=255, of the pixel in column `x` of row `y`; −1 to 1.
pub(super) fn noise(x: u32, y: u32, channel: u32, v: f32) -> f32 {
    let pixel = u64::from(y) << 32 | u64::from(x);
    let bits = mix(mix(pixel.wrapping_add(GAMMA)).wrapping_add(u64::from(channel).wrapping_mul(GAMMA)));
    let (a, b) = (unit((bits >> 32) as u32) - 0.5, unit(bits as u32) - 0.5);
    if (0.5..=WHITE - 0.5).contains(&v) { a + b } else { a }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn dithered(v: f32) -> Vec<u8> {
        let pixels = (0..100).flat_map(|y| (0..100).flat_map(move |x| (0..3).map(move |c| (x, y, c))));
        pixels.map(|(x, y, c)| (v + noise(x, y, c, v)).round() as u8).collect()
    }

    fn mean_and_variance(bytes: &[u8]) -> (f64, f64) {
        let n = bytes.len() as f64;
        let mean = bytes.iter().map(|&b| f64::from(b)).sum::<f64>() / n;
        (mean, bytes.iter().map(|&b| (f64::from(b) - mean).powi(2)).sum::<f64>() / n)
    }

    #[test]
    fn black_and_white_stay() {
        assert!(dithered(0.0).iter().all(|&b| b == 0));
        assert!(dithered(255.0).iter().all(|&b| b == 255));
    }

    #[test]
    fn the_mean_is_the_signal_everywhere() {
        // Five standard errors of 30 000 numbers.
        for v in [0.05, 0.3, 0.5, 0.7, 1.0, 1.49, 100.25, 100.5, 253.9, 254.4, 254.6, 254.9] {
            let (mean, variance) = mean_and_variance(&dithered(v));
            let tolerance = 5.0 * (variance / 30_000.0).sqrt();
            assert!((mean - f64::from(v)).abs() < tolerance, "{v}: {mean}");
        }
    }

    #[test]
    fn the_variance_is_the_same_between_steps() {
        for v in [100.0, 100.1, 100.25, 100.5, 100.9] {
            let (_, variance) = mean_and_variance(&dithered(v));
            // ¼ of a step's square for the sum, of which rounding is a part.
            assert!((variance - 0.25).abs() < 0.01, "{v}: {variance}");
        }
    }

    #[test]
    fn neighbours_and_channels_are_independent() {
        let at = |x, y, c| f64::from(noise(x, y, c, 100.0));
        for (dx, dy, dc) in [(1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 1, 0)] {
            let pairs = (0..100).flat_map(|y| (0..100).map(move |x| (x, y)));
            let sum: f64 = pairs.map(|(x, y)| at(x, y, 0) * at(x + dx, y + dy, dc)).sum();
            // Each product has the variance 1/36.
            assert!((sum / 10_000.0).abs() < 5.0 / 6.0 / 100.0, "({dx}, {dy}, {dc}): {sum}");
        }
    }
}
