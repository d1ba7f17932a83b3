//! A picture in the making, as a value: every [`step`](Render::step) adds samples; everything else is a loop around it.
//!
//! The unit of work is a tile and a block of samples, of a size that depends on nothing. A unit's samples are a pure
//! function of the scene, the settings and the unit, and the film adds them up exactly: the picture is the same bits for any
//! number of threads, and wherever a render was stopped and resumed.

use std::num::NonZeroUsize;
use std::sync::atomic::{AtomicBool, AtomicU64, AtomicUsize, Ordering::Relaxed};
use std::sync::{Mutex, PoisonError};
use std::thread;

use crate::camera::Camera;
use crate::desc::RenderDesc;
use crate::film::{Film, FilmOptions, Filter, FilterDesc};
use crate::integrator::{Integrator, IntegratorKind, Unit};
use crate::sampler::SamplerKind;
use crate::scene::Scene;

/// How to render. All but `threads` decides the picture; `threads` only how soon it is there.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// Pixels in a row, at least 1.
    pub width: u32,
    /// Rows, at least 1.
    pub height: u32,
    /// Samples per pixel.
    pub spp: u32,
    /// The most edges of a path.
    pub max_depth: u32,
    /// Chooses the random numbers.
    pub seed: u64,
    /// How light is traced.
    pub integrator: IntegratorKind,
    /// Which random numbers.
    pub sampler: SamplerKind,
    /// How a pixel is made of the places around it.
    pub filter: FilterDesc,
    /// What becomes of samples.
    pub film: FilmOptions,
    /// Threads that render; all processors that the process may use by default.
    pub threads: NonZeroUsize,
}

impl From<&RenderDesc> for Settings {
    fn from(desc: &RenderDesc) -> Self {
        let RenderDesc {
            width,
            height,
            spp,
            max_depth,
            seed,
            integrator,
            sampler,
            filter,
            transparent,
            clamp,
            light_selection: _,
            shutter: _,
        } = desc.clone();
        let film = FilmOptions { transparent, clamp, variance: false };
        let threads = thread::available_parallelism().unwrap_or(NonZeroUsize::MIN);
        Self { width, height, spp, max_depth, seed, integrator, sampler, filter, film, threads }
    }
}

/// What another thread may see and say while a step runs.
#[derive(Debug, Default)]
pub struct Monitor {
    /// Rays traced so far.
    pub rays: AtomicU64,
    /// Units of work done so far, of [`Render::units`].
    pub units: AtomicU64,
    /// Asks the step to end as soon as the units in work are done.
    pub pause: AtomicBool,
}

/// A picture in the making.
pub struct Render<'s> {
    scene: &'s Scene,
    settings: Settings,
    camera: Camera,
    filter: Filter,
    integrator: Box<dyn Integrator>,
    film: Film,
    /// Units before this one are done; those of a pass come tile by tile.
    next_unit: u64,
}

impl<'s> Render<'s> {
    /// Samples that each pixel gets in one pass over the film.
    pub const SAMPLES_PER_PASS: u32 = 16;

    /// A picture without samples.
    pub fn new(scene: &'s Scene, settings: Settings) -> Self {
        let integrator = settings.integrator.build(settings.max_depth);
        Self::with_integrator(scene, settings, integrator)
    }

    /// As [`new`](Self::new), by an integrator of one's own instead of that of the settings.
    pub fn with_integrator(scene: &'s Scene, settings: Settings, integrator: Box<dyn Integrator>) -> Self {
        Self {
            scene,
            camera: scene.camera(settings.width, settings.height),
            filter: Filter::new(&settings.filter),
            integrator,
            film: Film::new(settings.width, settings.height, settings.film),
            settings,
            next_unit: 0,
        }
    }

    /// Adds a pass of samples, or what is left of one; ends early when asked to pause, and the next step goes on there.
    pub fn step(&mut self, monitor: &Monitor) {
        if self.is_done() {
            return;
        }
        let tile_count = self.film.tile_count() as u64;
        let pass = self.next_unit / tile_count;
        let first = pass as u32 * Self::SAMPLES_PER_PASS;
        let samples = first..self.settings.spp.min(first + Self::SAMPLES_PER_PASS);
        let numbers = self.settings.sampler.samples(self.settings.seed, samples.clone());
        let unit = Unit { camera: &self.camera, filter: &self.filter, numbers: &numbers, samples };
        let begun = self.next_unit % tile_count;
        let tiles = self.film.tiles_mut().iter_mut().skip(begun as usize).collect();
        let done = in_parallel(self.settings.threads, tiles, &monitor.pause, |tile| {
            let rays = self.integrator.render(self.scene, &unit, tile);
            monitor.rays.fetch_add(rays, Relaxed);
            monitor.units.fetch_add(1, Relaxed);
        });
        self.next_unit += done as u64;
    }

    /// Steps until every pixel has all its samples, or until it is asked to pause.
    pub fn finish(&mut self, monitor: &Monitor) {
        while !self.is_done() && !monitor.pause.load(Relaxed) {
            self.step(monitor);
        }
    }

    /// Units of work in the whole render.
    pub fn units(&self) -> u64 {
        u64::from(self.settings.spp.div_ceil(Self::SAMPLES_PER_PASS)) * self.film.tile_count() as u64
    }

    /// Whether every pixel has all its samples.
    pub fn is_done(&self) -> bool {
        self.next_unit >= self.units()
    }

    /// The samples so far.
    pub fn film(&self) -> &Film {
        &self.film
    }

    /// How it is rendered.
    pub fn settings(&self) -> &Settings {
        &self.settings
    }
}

/// Calls `work` with each item, from several threads; leaves the last ones out when asked to pause, and returns the number
/// of those that are done.
pub(crate) fn in_parallel<T: Send>(
    threads: NonZeroUsize,
    items: Vec<T>,
    pause: &AtomicBool,
    work: impl Fn(&mut T) + Sync,
) -> usize {
    let items: Vec<_> = items.into_iter().map(Mutex::new).collect();
    let next = AtomicUsize::new(0);
    let run = || {
        while !pause.load(Relaxed) {
            let Some(item) = items.get(next.fetch_add(1, Relaxed)) else {
                break;
            };
            work(&mut item.lock().unwrap_or_else(PoisonError::into_inner));
        }
    };
    thread::scope(|scope| {
        for _ in 1..threads.get().min(items.len()) {
            // Fewer threads than asked for make the same picture.
            if thread::Builder::new().spawn_scoped(scope, run).is_err() {
                break;
            }
        }
        run();
    });
    next.into_inner().min(items.len())
}
