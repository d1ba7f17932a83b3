//! Integrators: from a camera ray to the light that it brings.

mod weekend;

use std::ops::Range;

use glam::{UVec2, Vec2};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::camera::Camera;
use crate::color::Spectrum;
use crate::film::Tile;
use crate::sampler::{Independent, Sampler};
use crate::scene::Scene;

pub use weekend::Weekend;

/// Which integrator renders.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum IntegratorKind {
    /// The plain backward ray tracer that all others are checked against.
    #[default]
    Weekend,
}

impl IntegratorKind {
    /// Every kind by its name.
    pub const NAMES: &[(&str, Self)] = &[("weekend", Self::Weekend)];

    /// The integrator for paths of at most `max_depth` edges.
    pub fn build(self, max_depth: u32) -> Box<dyn Integrator> {
        match self {
            Self::Weekend => Box::new(Weekend { max_depth }),
        }
    }
}

/// A way to estimate the light that falls on the film.
pub trait Integrator: Sync {
    /// Adds a unit's samples to its tile; returns the number of rays that were traced.
    fn render(&self, scene: &Scene, unit: &Unit<'_>, tile: &mut Tile) -> u64;
}

/// A unit of work: some samples of each pixel of a tile. Its result is a pure function of it and the scene.
#[derive(Clone, Debug)]
pub struct Unit<'a> {
    /// The camera.
    pub camera: &'a Camera,
    /// See [`Settings::seed`](crate::render::Settings::seed).
    pub seed: u64,
    /// Which samples of each pixel.
    pub samples: Range<u32>,
}

impl Unit<'_> {
    /// Adds one `radiance(film position, sampler)` for each sample of each pixel.
    ///
    /// The position is the pixel's centre plus a uniform offset in [-0.5, 0.5) in x and y.
    #[inline]
    pub fn for_each_sample(&self, tile: &mut Tile, mut radiance: impl FnMut(Vec2, &mut Sampler) -> Spectrum) {
        tile.for_each_pixel(|pixel: UVec2, sum| {
            let center = pixel.as_vec2() + 0.5;
            for sample in self.samples.clone() {
                let mut sampler = Sampler::Independent(Independent::new(self.seed, pixel, sample));
                let offset = sampler.get_2d() - 0.5;
                sum.add(radiance(center + offset, &mut sampler));
            }
        });
    }
}
