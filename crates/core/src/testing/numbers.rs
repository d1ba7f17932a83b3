//! What a sampler's numbers promise.

use glam::{UVec2, Vec2};

use super::SIGNIFICANCE;
use super::chi2::chi2_at;
use crate::sampler::Sampler;

/// The numbers of one sample of one pixel: what [`Sampler`] gives.
pub trait Numbers {
    /// The next number, in [0, 1).
    fn get_1d(&mut self) -> f32;

    /// The next two numbers, each in [0, 1).
    fn get_2d(&mut self) -> Vec2;

    /// The next three numbers, each in [0, 1).
    fn get_3d(&mut self) -> (f32, Vec2);
}

impl Numbers for Sampler<'_> {
    fn get_1d(&mut self) -> f32 {
        self.get_1d()
    }

    fn get_2d(&mut self) -> Vec2 {
        self.get_2d()
    }

    fn get_3d(&mut self) -> (f32, Vec2) {
        self.get_3d()
    }
}

/// Over many pixels, each number is uniform in [0, 1), and independent of the others of the same sample, of the next
/// sample, and of the pixel to the right (chi² of pairs). `numbers` are those of a pixel's sample 3 or 4.
///
/// # Errors
/// The pair that is not.
pub fn check_numbers<'s>(numbers: &dyn Fn(UVec2, u32) -> Box<dyn Numbers + 's>) -> Result<(), String> {
    const BINS: usize = 16;
    const ROW: u32 = 256;
    const PIXELS: u32 = 100 * ROW;
    const NAMES: [&str; 7] = [
        "x and y of two",
        "x and y of three",
        "x and z of three",
        "a number and that of the next set",
        "numbers of two sets",
        "numbers of two samples",
        "numbers of two pixels",
    ];
    let mut counts = NAMES.map(|_| vec![0_u64; BINS * BINS]);
    for i in 0..PIXELS {
        let pixel = UVec2::new(i % ROW, i / ROW);
        let draw = |pixel: UVec2, sample: u32| {
            let mut numbers = numbers(pixel, sample);
            (numbers.get_2d(), numbers.get_3d(), numbers.get_1d(), numbers.get_1d())
        };
        let (two, (z, three), a, b) = draw(pixel, 3);
        let (sample, ..) = draw(pixel, 4);
        let (right, ..) = draw(pixel + UVec2::X, 3);
        let pairs = [
            [two.x, two.y],
            [three.x, three.y],
            [three.x, z],
            [a, b],
            [two.x, three.x],
            [two.x, sample.y],
            [two.x, right.x],
        ];
        for (counts, pair) in counts.iter_mut().zip(pairs) {
            if pair.iter().any(|u| !(0.0..1.0).contains(u)) {
                return Err(format!("{pair:?} are not in [0, 1)"));
            }
            let [row, column] = pair.map(|u| (u * BINS as f32) as usize);
            counts[row * BINS + column] += 1;
        }
    }
    let expected = vec![f64::from(PIXELS) / (BINS * BINS) as f64; BINS * BINS];
    for (name, counts) in NAMES.iter().zip(&counts) {
        chi2_at(counts, &expected, SIGNIFICANCE / NAMES.len() as f64).map_err(|e| format!("{name}: {e}"))?;
    }
    Ok(())
}
