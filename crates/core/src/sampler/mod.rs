//! Where the random numbers come from.
//!
//! Every number is a pure function of (seed, pixel, sample, dimension): no state is shared between pixels or
//! threads, so any part of a picture can be computed anywhere, in any order, with the same result.

mod independent;
mod sobol;

use std::ops::Range;

use glam::{UVec2, Vec2};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

pub use independent::Independent;
pub use sobol::{Sobol, SobolPoints};

/// Which numbers the samples of a pixel get.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum SamplerKind {
    /// Uniform and independent: the noise that theory is about.
    Independent,
    /// Owen-scrambled Sobol points: evenly spread, so less noise.
    #[default]
    Sobol,
}

impl SamplerKind {
    /// Every kind by its name.
    pub const NAMES: &[(&str, Self)] = &[("sobol", Self::Sobol), ("independent", Self::Independent)];

    /// The numbers of some samples of all pixels.
    pub fn samples(self, seed: u64, samples: Range<u32>) -> Samples {
        match self {
            Self::Independent => Samples::Independent { seed },
            Self::Sobol => Samples::Sobol(SobolPoints::new(seed, samples.start, samples.end)),
        }
    }
}

/// What the numbers of a block of samples have in common.
#[derive(Clone, Debug)]
pub enum Samples {
    /// Nothing but the seed.
    Independent {
        /// Chooses the numbers.
        seed: u64,
    },
    /// Points that pixels shift.
    Sobol(SobolPoints),
}

impl Samples {
    /// The numbers of one sample of one pixel; the sample must be of this block.
    #[inline]
    pub fn sampler(&self, pixel: UVec2, sample: u32) -> Sampler<'_> {
        match self {
            Self::Independent { seed } => Sampler::Independent(Independent::new(*seed, pixel, sample)),
            Self::Sobol(points) => Sampler::Sobol(points.sampler(pixel, sample)),
        }
    }
}

/// The numbers of one sample of one pixel, set by set of dimensions.
#[derive(Clone, Debug)]
pub enum Sampler<'p> {
    /// Uniform random numbers.
    Independent(Independent),
    /// Evenly spread.
    Sobol(Sobol<'p>),
}

impl Sampler<'_> {
    /// The next number, in [0, 1).
    #[inline]
    pub fn get_1d(&mut self) -> f32 {
        match self {
            Self::Independent(s) => s.get_1d(),
            Self::Sobol(s) => s.get_1d(),
        }
    }

    /// The next two numbers, each in [0, 1): spread evenly over the square.
    #[inline]
    pub fn get_2d(&mut self) -> Vec2 {
        match self {
            Self::Independent(s) => s.get_2d(),
            Self::Sobol(s) => s.get_2d(),
        }
    }

    /// A number to choose with and two more, each in [0, 1): spread evenly over the cube.
    #[inline(always)]
    pub fn get_3d(&mut self) -> (f32, Vec2) {
        match self {
            Self::Independent(s) => (s.get_1d(), s.get_2d()),
            Self::Sobol(s) => s.get_3d(),
        }
    }
}
