//! What the camera sees first through every pixel, in the making: albedo, normals, depth, names and more, without noise
//! to speak of.

use std::sync::atomic::Ordering::Relaxed;

use glam::UVec2;

use crate::camera::Camera;
use crate::film::{Filter, FirstHit};
use crate::integrator::{Unit, first_hit};
use crate::render::{Monitor, Settings, in_parallel};
use crate::sampler::Samples;
use crate::scene::Scene;

/// The first hits of a picture. The unit of work is a row; what it finds is a function of the scene and the settings alone.
pub struct FirstHits<'s> {
    scene: &'s Scene,
    settings: Settings,
    through: bool,
    camera: Camera,
    filter: Filter,
    numbers: Samples,
    samples: u32,
    pixels: Vec<FirstHit>,
    next_row: usize,
}

impl<'s> FirstHits<'s> {
    /// The most samples a pixel; a picture of fewer has as many here.
    pub const MAX_SPP: u32 = 64;

    /// Nothing seen yet, for a picture that is rendered with these settings. With `through`, albedo and normals are those of
    /// what perfect mirrors and smooth glass show.
    pub fn new(scene: &'s Scene, settings: Settings, through: bool) -> Self {
        let samples = settings.spp.min(Self::MAX_SPP);
        Self {
            scene,
            through,
            camera: scene.camera(settings.width, settings.height),
            filter: Filter::new(&settings.filter),
            numbers: settings.sampler.samples(settings.seed, 0..samples),
            samples,
            pixels: vec![FirstHit::NOTHING; settings.width as usize * settings.height as usize],
            settings,
            next_row: 0,
        }
    }

    /// Bytes that a picture of this size takes.
    pub fn bytes(width: u32, height: u32) -> u64 {
        u64::from(width) * u64::from(height) * size_of::<FirstHit>() as u64
    }

    /// Looks through all pixels, row by row; ends early when asked to pause, and goes on there the next time.
    pub fn step(&mut self, monitor: &Monitor) {
        let unit =
            Unit { camera: &self.camera, filter: &self.filter, numbers: &self.numbers, samples: 0..self.samples };
        let rows = self.pixels.chunks_mut(self.settings.width as usize).enumerate();
        let rows = rows.skip(self.next_row).map(|(y, row)| (y as u32, row)).collect();
        let done = in_parallel(self.settings.threads, rows, &monitor.pause, |(y, row)| {
            for (x, pixel) in row.iter_mut().enumerate() {
                *pixel = first_hit(self.scene, &unit, UVec2::new(x as u32, *y), self.through);
            }
            // Those of the camera: one a sample, and one for the names.
            monitor.rays.fetch_add(row.len() as u64 * u64::from(self.samples + 1), Relaxed);
            monitor.units.fetch_add(1, Relaxed);
        });
        self.next_row += done;
    }

    /// Whether every pixel has been looked through.
    pub fn is_done(&self) -> bool {
        self.next_row >= self.settings.height as usize
    }

    /// Samples a pixel.
    pub fn spp(&self) -> u32 {
        self.samples
    }

    /// What is seen, row by row; nothing where nobody has looked yet.
    pub fn pixels(&self) -> &[FirstHit] {
        &self.pixels
    }
}
