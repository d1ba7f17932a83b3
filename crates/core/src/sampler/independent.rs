//! Independent uniform numbers from a counter.
//!
//! The key of a sample is a hash of (seed, pixel, sample); dimension k is a hash of key + k γ: the hash and the step of
//! SplitMix64.

use glam::{UVec2, Vec2};

use crate::math::{GAMMA, mix, unit};

/// Uniform random numbers, independent of each other.
#[derive(Clone, Debug)]
pub struct Independent {
    counter: u64,
}

impl Independent {
    /// The stream of one sample of one pixel.
    #[inline]
    pub fn new(seed: u64, pixel: UVec2, sample: u32) -> Self {
        let key = mix(seed.wrapping_add(GAMMA));
        let key = mix(key ^ (u64::from(pixel.y) << 32 | u64::from(pixel.x)));
        let key = mix(key.wrapping_add(GAMMA) ^ u64::from(sample));
        Self { counter: key }
    }

    #[inline]
    fn next(&mut self) -> u64 {
        self.counter = self.counter.wrapping_add(GAMMA);
        mix(self.counter)
    }

    /// The next number in [0, 1).
    #[inline]
    pub fn get_1d(&mut self) -> f32 {
        unit((self.next() >> 32) as u32)
    }

    /// The next two numbers in [0, 1).
    #[inline]
    pub fn get_2d(&mut self) -> Vec2 {
        let bits = self.next();
        Vec2::new(unit((bits >> 32) as u32), unit(bits as u32))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::chi2_counts;

    fn stream(seed: u64, x: u32, sample: u32) -> Independent {
        Independent::new(seed, UVec2::new(x, 5), sample)
    }

    #[test]
    fn repeats_and_separates() {
        let take = |mut s: Independent| [s.get_1d(), s.get_1d(), s.get_2d().x];
        assert_eq!(take(stream(1, 2, 3)), take(stream(1, 2, 3)));
        for other in [stream(2, 2, 3), stream(1, 3, 3), stream(1, 2, 4)] {
            assert_ne!(take(stream(1, 2, 3)), take(other));
        }
    }

    /// Pairs (dimension k of sample i, dimension k of sample i + 1) and (x, y of one 2D dimension) fill the square evenly.
    #[test]
    fn pairs_are_uniform() {
        const BINS: usize = 16;
        const N: u32 = 200_000;
        let bin = |u: f32| (u * BINS as f32) as usize;
        let mut across = vec![0_u64; BINS * BINS];
        let mut within = vec![0_u64; BINS * BINS];
        for i in 0..N {
            let (mut a, mut b) = (stream(7, i % 64, i / 64), stream(7, i % 64, i / 64 + 1));
            across[bin(a.get_1d()) * BINS + bin(b.get_1d())] += 1;
            let u = a.get_2d();
            within[bin(u.x) * BINS + bin(u.y)] += 1;
        }
        let expected = vec![f64::from(N) / (BINS * BINS) as f64; BINS * BINS];
        chi2_counts(&across, &expected).unwrap();
        chi2_counts(&within, &expected).unwrap();
    }
}
