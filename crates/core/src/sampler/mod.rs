//! Where the random numbers come from.
//!
//! Every number is a pure function of (seed, pixel, sample, dimension): no state is shared between pixels or
//! threads, so any part of a picture can be computed anywhere, in any order, with the same result.

mod independent;

use glam::Vec2;

pub use independent::Independent;

/// The numbers of one sample of one pixel, dimension by dimension.
#[derive(Clone, Debug)]
pub enum Sampler {
    /// Uniform random numbers.
    Independent(Independent),
}

impl Sampler {
    /// The next dimension, in [0, 1).
    #[inline]
    pub fn get_1d(&mut self) -> f32 {
        match self {
            Self::Independent(s) => s.get_1d(),
        }
    }

    /// The next two dimensions, each in [0, 1).
    #[inline]
    pub fn get_2d(&mut self) -> Vec2 {
        match self {
            Self::Independent(s) => s.get_2d(),
        }
    }
}
