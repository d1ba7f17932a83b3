//! Owen-scrambled Sobol points, shifted for each pixel.
//!
//! What a path needs comes in sets of at most three dimensions: a place on the film, one on the lens, a choice of light with a
//! point on it. Each set has the first three dimensions of the Sobol sequence (Joe & Kuo 2008, doi:10.1137/070709359),
//! with a nested uniform scrambling and a nested uniform shuffle of the order of its own, so that sets are independent of each
//! other (Owen 1995, doi:10.1007/978-1-4612-2552-2_19; Burley 2020, "Practical Hash-based Owen Scrambling", JCGT 9(4)). Any
//! number of samples is good, and so is any prefix.
//!
//! Pixels share the points of a block of samples: they are scrambled once in a pass, bit by bit, and a pixel changes them by a
//! random digital shift, x ⊕ s (Kollig & Keller 2002, doi:10.1111/1467-8659.00706), and by i ⊕ r in the order within
//! a block. A shifted scrambled net is a scrambled net, and as shifts are independent and uniform, so is the noise of
//! pixels. So a number costs one hash, one load and one exclusive or: as much as an independent one.

use std::array;

use glam::{UVec2, Vec2};

use crate::math::{GAMMA, mix, unit};

/// Samples come in blocks of this many, within which pixels change the order.
const BLOCK: u32 = 16;

/// Sets of dimensions that are stratified; what lies beyond is independent.
const SETS: u32 = 96;

const DIMENSIONS: usize = 3;

/// The points of some samples, before a pixel shifts them.
#[derive(Clone, Debug)]
pub struct SobolPoints {
    seed: u64,
    first: u32,
    /// Points of a set, which padding aligns.
    len: u32,
    points: Vec<[u32; DIMENSIONS + 1]>,
}

impl SobolPoints {
    /// The points of samples from `first` to before `end`.
    pub fn new(seed: u64, first: u32, end: u32) -> Self {
        let first = first - first % BLOCK;
        let len = end.saturating_sub(first).div_ceil(BLOCK) * BLOCK;
        let matrices = array::from_fn(sobol_matrix);
        let points = (0..SETS).flat_map(|set| (first..first + len).map(move |i| (set, i)));
        let points =
            points.map(|(set, i)| scrambled_point(&matrices, mix(seed ^ u64::from(set).wrapping_mul(GAMMA)), i));
        Self { seed, first, len, points: points.collect() }
    }

    /// The numbers of one sample of one pixel.
    #[inline]
    pub fn sampler(&self, pixel: UVec2, sample: u32) -> Sobol<'_> {
        let key = mix(self.seed.wrapping_add(GAMMA));
        let key = mix(key ^ (u64::from(pixel.y) << 32 | u64::from(pixel.x)));
        Sobol { points: self, key, index: sample - self.first, set: 0 }
    }
}

/// The numbers of one sample of one pixel.
#[derive(Clone, Debug)]
pub struct Sobol<'p> {
    points: &'p SobolPoints,
    /// Of the pixel.
    key: u64,
    index: u32,
    set: u32,
}

impl Sobol<'_> {
    /// The next set's point of this sample, and the pixel's hash for the set.
    #[inline]
    fn next(&mut self) -> ([u32; DIMENSIONS + 1], u64) {
        let set = self.set;
        self.set += 1;
        let hash = mix(self.key.wrapping_add(u64::from(set).wrapping_mul(GAMMA)));
        // The last bits of the hash are not used by the shifts.
        let index = self.index ^ (hash as u32 % BLOCK);
        match self.points.points.get((set * self.points.len + index) as usize) {
            Some(&point) if set < SETS => (point, hash),
            _ => {
                let random = mix(hash ^ u64::from(self.index).wrapping_mul(GAMMA));
                ([(random >> 32) as u32, random as u32, mix(random) as u32, 0], hash)
            }
        }
    }

    /// The next number in [0, 1).
    #[inline]
    pub fn get_1d(&mut self) -> f32 {
        let ([x, ..], hash) = self.next();
        unit(x ^ (hash >> 32) as u32)
    }

    /// The next two numbers in [0, 1).
    #[inline]
    pub fn get_2d(&mut self) -> Vec2 {
        let ([x, y, ..], hash) = self.next();
        Vec2::new(unit(x ^ (hash >> 32) as u32), unit(y ^ hash as u32))
    }

    /// The next three numbers in [0, 1).
    #[inline]
    pub fn get_3d(&mut self) -> (f32, Vec2) {
        let ([x, y, z, _], hash) = self.next();
        let shift_z = (mix(hash ^ GAMMA) >> 32) as u32;
        (unit(z ^ shift_z), Vec2::new(unit(x ^ (hash >> 32) as u32), unit(y ^ hash as u32)))
    }
}

/// Point `i` of the sequence that `key` shuffles and scrambles.
fn scrambled_point(matrices: &[[u32; 32]; DIMENSIONS], key: u64, i: u32) -> [u32; DIMENSIONS + 1] {
    let index = owen_scramble(i, mix(key));
    let mut point = [0; DIMENSIONS + 1];
    for (d, (x, matrix)) in point.iter_mut().zip(matrices).enumerate() {
        let bits = (0..32).filter(|bit| index >> bit & 1 == 1);
        let value = bits.fold(0, |sum, bit| sum ^ matrix[bit]);
        *x = owen_scramble(value, mix(key.wrapping_add((d as u64 + 1).wrapping_mul(GAMMA))));
    }
    point
}

/// Flips each bit by a random choice that depends on all bits before it.
fn owen_scramble(x: u32, key: u64) -> u32 {
    (0..32).fold(0, |flips, bit| {
        // The bits before this one, with a one before them, so that 0, 00 and 000 differ.
        let before = (1_u64 << 32 | u64::from(x)) >> (32 - bit);
        let flip = (mix(key ^ before.wrapping_mul(GAMMA)) >> 63) as u32;
        flips | flip << (31 - bit)
    }) ^ x
}

/// Column by column, the generator matrix of a dimension: direction numbers of Joe & Kuo 2008.
fn sobol_matrix(dimension: usize) -> [u32; 32] {
    let (coefficients, initial): (u32, &[u32]) = match dimension {
        0 => return array::from_fn(|bit| 1 << 31 >> bit),
        1 => (0, &[1]),
        _ => (1, &[1, 3]),
    };
    let degree = initial.len();
    let mut v = [0; 32];
    for k in 0..32 {
        v[k] = if k < degree {
            initial[k] << (31 - k)
        } else {
            let taps = (1..degree).filter(|j| coefficients >> (degree - 1 - j) & 1 == 1);
            taps.fold(v[k - degree] ^ v[k - degree] >> degree, |sum, j| sum ^ v[k - j])
        };
    }
    v
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::chi2_counts;

    fn take(points: &SobolPoints, pixel: UVec2, samples: u32, skip: u32) -> Vec<[f32; 3]> {
        let numbers = |i| {
            let mut sampler = points.sampler(pixel, i);
            (0..skip).for_each(|_| _ = sampler.get_1d());
            let (z, xy) = sampler.get_3d();
            [xy.x, xy.y, z]
        };
        (0..samples).map(numbers).collect()
    }

    /// Every elementary interval of 2^m points in two dimensions holds one of them: for each set, pixel and prefix.
    #[test]
    fn prefixes_are_nets() {
        let points = SobolPoints::new(3, 0, 256);
        for (pixel, skip) in [(UVec2::ZERO, 0), (UVec2::new(17, 4), 1), (UVec2::new(1000, 999), SETS - 1)] {
            for m in 0..=8 {
                let n = 1_u32 << m;
                let net = take(&points, pixel, n, skip);
                for columns in (0..=m).map(|k| 1_u32 << k) {
                    let mut counts = vec![0; n as usize];
                    for [x, y, _] in &net {
                        let (column, row) = ((x * columns as f32) as u32, (y * (n / columns) as f32) as u32);
                        counts[(row * columns + column) as usize] += 1;
                    }
                    assert!(counts.iter().all(|&c| c == 1), "{n} points, {columns} columns, set {skip}");
                }
                let mut thirds: Vec<_> = net.iter().map(|p| (p[2] * n as f32) as u32).collect();
                thirds.sort_unstable();
                assert!(thirds.into_iter().eq(0..n), "{n} points, third dimension");
            }
        }
    }

    /// A number is the same whatever block it is taken from.
    #[test]
    fn depends_on_seed_pixel_sample_and_dimension_alone() {
        let (all, part) = (SobolPoints::new(5, 0, 64), SobolPoints::new(5, 37, 45));
        let other = SobolPoints::new(6, 37, 45);
        for sample in 37..45 {
            let numbers = |points: &SobolPoints, x: u32| {
                let mut sampler = points.sampler(UVec2::new(x, 3), sample);
                [sampler.get_1d(), sampler.get_2d().y, sampler.get_3d().0]
            };
            assert_eq!(numbers(&all, 2), numbers(&part, 2));
            assert_ne!(numbers(&all, 2), numbers(&other, 2));
            assert_ne!(numbers(&all, 2), numbers(&all, 1));
        }
    }

    /// Over pixels, every number of a sample is uniform, and independent of those of other sets, samples and pixels.
    #[test]
    fn pairs_over_pixels_are_uniform() {
        const BINS: usize = 16;
        const N: u32 = 200_000;
        let points = SobolPoints::new(7, 0, 16);
        let bin = |u: f32| (u * BINS as f32) as usize;
        let mut counts = [(); 4].map(|()| vec![0_u64; BINS * BINS]);
        for i in 0..N {
            let (here, right) = (UVec2::new(i % 512, i / 512), UVec2::new(i % 512 + 1, i / 512));
            let mut first = points.sampler(here, 3);
            let ((z, xy), next) = (first.get_3d(), first.get_1d());
            let (_, sibling) = points.sampler(here, 4).get_3d();
            let (_, neighbor) = points.sampler(right, 3).get_3d();
            for (counts, [a, b]) in
                counts.iter_mut().zip([[xy.x, xy.y], [z, next], [xy.x, sibling.y], [xy.x, neighbor.x]])
            {
                counts[bin(a) * BINS + bin(b)] += 1;
            }
        }
        let expected = vec![f64::from(N) / (BINS * BINS) as f64; BINS * BINS];
        counts.iter().for_each(|counts| chi2_counts(counts, &expected).unwrap());
    }

    /// Beyond the last set numbers are independent.
    #[test]
    fn goes_on_for_ever() {
        let points = SobolPoints::new(1, 0, 16);
        let mut sum = 0.0;
        for sample in 0..16 {
            let mut sampler = points.sampler(UVec2::ONE, sample);
            sum += (0..10_000).map(|_| f64::from(sampler.get_1d())).sum::<f64>();
        }
        // The standard deviation of the mean is 1 / √(12 · 160,000).
        assert!((sum / 160_000.0 - 0.5).abs() < 5.0 * 7.2e-4);
    }

    /// The variance of a smooth integral falls by far faster than 1 / n.
    #[test]
    fn converges_faster_than_random() {
        let variance = |n: u32| {
            let errors = (0..400).map(|x| {
                let points = SobolPoints::new(9, 0, n);
                let values = take(&points, UVec2::new(x, 0), n, 2).into_iter();
                values.map(|[x, y, z]| f64::from((3.0 * x * x) * (2.0 * y) * (0.5 + z))).sum::<f64>() / f64::from(n)
                    - 1.0
            });
            errors.map(|e| e * e).sum::<f64>() / 400.0
        };
        let (few, many) = (variance(16), variance(256));
        assert!(few / many > 16.0 * 8.0, "{few} with 16, {many} with 256");
    }
}
