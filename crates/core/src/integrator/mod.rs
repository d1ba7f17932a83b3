//! Integrators: from a camera ray to the light that it brings.

mod first_hit;
mod path;
mod weekend;

use std::ops::Range;

use eyebeam_bvh::Ray;
use glam::UVec2;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::camera::Camera;
use crate::film::{Filter, Seen, Tile};
use crate::sampler::{Sampler, Samples};
use crate::scene::Scene;

pub(crate) use first_hit::first_hit;
pub use path::Path;
pub use weekend::Weekend;

/// Which integrator renders.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum IntegratorKind {
    /// Paths with light sampling: the same picture as `weekend`, with less noise.
    #[default]
    Path,
    /// The plain backward ray tracer that all others are checked against.
    Weekend,
}

impl IntegratorKind {
    /// Every kind by its name.
    pub const NAMES: &[(&str, Self)] = &[("path", Self::Path), ("weekend", Self::Weekend)];

    /// The integrator for paths of at most `max_depth` edges.
    pub fn build(self, max_depth: u32) -> Box<dyn Integrator> {
        match self {
            Self::Path => Box::new(Path { max_depth }),
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
    /// How a pixel is made of the places around it.
    pub filter: &'a Filter,
    /// The random numbers of these samples.
    pub numbers: &'a Samples,
    /// Which samples of each pixel.
    pub samples: Range<u32>,
}

impl Unit<'_> {
    /// Adds what `see(ray, sampler)` says for each sample of each pixel.
    #[inline]
    pub fn for_each_sample(&self, tile: &mut Tile, mut see: impl FnMut(Ray, &mut Sampler<'_>) -> Seen) {
        tile.for_each_pixel(|pixel, mut film| {
            for sample in self.samples.clone() {
                let CameraSample { ray, weight, mut sampler } = self.camera_sample(pixel, sample);
                film.add(&ray.map_or(Seen::NOTHING, |ray| see(ray, &mut sampler)), weight);
            }
        });
    }

    /// The ray of a sample: it goes through a place of the film around the pixel's centre, as the filter likes.
    #[inline]
    fn camera_sample(&self, pixel: UVec2, sample: u32) -> CameraSample<'_> {
        let mut sampler = self.numbers.sampler(pixel, sample);
        let place = self.filter.sample(sampler.get_2d());
        let ray = self.camera.ray(pixel.as_vec2() + 0.5 + place.offset, &mut sampler);
        CameraSample { ray, weight: place.weight, sampler }
    }
}

/// A ray from the camera.
struct CameraSample<'n> {
    /// None where the film is black.
    ray: Option<Ray>,
    /// The filter's weight.
    weight: f32,
    /// The numbers for what it meets.
    sampler: Sampler<'n>,
}
