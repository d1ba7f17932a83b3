//! A small diffuse path tracer, one path at a time and in batches: what the shape of the integrators costs or gains.
//!
//! Every surface reflects 0.7 of the light diffusely, the sky and the lights shine, paths have five vertices. Depth-first is the
//! textbook's loop. A batch goes through the same steps in stages: closest hits, shading, shadow rays. Both make the same
//! picture, bit for bit: random numbers depend on pixel, sample and dimension alone, sums have the same order.

use std::f32::consts::FRAC_1_PI;
use std::io::Write;
use std::iter::zip;
use std::mem::swap;
use std::ops::Range;

use eyebeam_bvh::{Bvh, Hit, Quality, Ray};

use super::meshes::{MeshName, Model};
use super::rays::{Camera, connection, cosine_direction, surface};
use super::table::{header, mega, row};
use super::tracer::Kernel;
use super::{Outcome, Plan};
use crate::measure::{median, thread_time};

const DEPTH: u32 = 5;
/// Samples of a pixel follow each other.
const SPP: u32 = 4;
const ALBEDO: f32 = 0.7;
const SKY: f32 = 0.3;
const LIGHT: f32 = 10.0;
/// Pieces of the picture in which all take turns.
const TURNS: u32 = 4;

/// A way to trace paths.
struct Way {
    name: &'static str,
    /// Paths that go through the stages together; without it, depth-first.
    batch: Option<usize>,
    /// Whether the kernel has several rays of a batch in flight.
    flies: bool,
}

/// Stages cost or gain something by themselves, and something by what the kernel makes of many rays.
const WAYS: [Way; 4] = [
    Way { name: "depth-first", batch: None, flies: false },
    Way { name: "64, rays one by one", batch: Some(64), flies: false },
    Way { name: "16, rays in flight", batch: Some(16), flies: true },
    Way { name: "64, rays in flight", batch: Some(64), flies: true },
];

/// All ways in turn on each mesh.
pub(super) fn run(meshes: &[(MeshName, &Model)], plan: Plan, out: &mut dyn Write) -> Outcome {
    writeln!(out, "\n### Paths of {DEPTH} vertices, one thread\n")?;
    let columns = ["paths at a time", "rays per path", "Msamples/s", "over depth-first", "of it traversal"];
    header(out, "mesh", columns.map(str::to_owned).into_iter())?;
    for (name, model) in meshes {
        let bvh = Bvh::build(&model.mesh(), Quality::Balanced)?.with_rays_in_flight(true);
        let camera = Camera::new(model, (plan.resolution / 4).max(Camera::TILE));
        let job = Job { model, bvh: &bvh, camera };
        let samples = (camera.pixels() * SPP) as usize;
        let seconds = measure(&job, plan.rounds)?;
        for (way, own) in zip(WAYS, &seconds) {
            let ratio = median(zip(&seconds[0], own).map(|(depth_first, own)| depth_first / own).collect());
            let own = median(own.clone());
            let (rays, traversal) = replay(&job, &way, plan.rounds.div_ceil(3));
            let cells = [
                way.name.to_owned(),
                format!("{:.1}", rays as f64 / samples as f64),
                format!("{:.3}", mega(samples, own)),
                format!("{ratio:.2}"),
                format!("{:.0} %", 100.0 * traversal / own),
            ];
            row(out, name.label(), cells.into_iter())?;
        }
    }
    Ok(())
}

/// Seconds of each way in each round.
fn measure(job: &Job<'_>, rounds: usize) -> Result<[Vec<f64>; WAYS.len()], &'static str> {
    let mut seconds = WAYS.map(|_| vec![0.0; rounds]);
    for round in 0..rounds {
        let mut pictures = WAYS.map(|_| vec![0.0; job.camera.pixels() as usize]);
        for turn in 0..TURNS {
            for ((way, picture), seconds) in zip(WAYS, &mut pictures).zip(&mut seconds) {
                let mut kernel = Kernel::new(job.bvh, way.flies, false);
                seconds[round] += thread_time(|| job.trace(way.batch, turn, picture, &mut kernel)).as_secs_f64();
            }
        }
        let bits = |picture: &[f64]| picture.iter().map(|l| l.to_bits()).collect::<Vec<_>>();
        if pictures.iter().any(|picture| bits(picture) != bits(&pictures[0])) {
            return Err("the pictures of paths differ");
        }
    }
    Ok(seconds)
}

/// The rays of a picture, and the seconds that the kernel takes for them by themselves.
fn replay(job: &Job<'_>, way: &Way, rounds: usize) -> (usize, f64) {
    let mut log = Kernel::new(job.bvh, way.flies, true);
    let mut picture = vec![0.0; job.camera.pixels() as usize];
    (0..TURNS).for_each(|turn| job.trace(way.batch, turn, &mut picture, &mut log));
    (log.rays.len(), median((0..rounds).map(|_| thread_time(|| log.replay()).as_secs_f64()).collect()))
}

/// A path by its place in the picture.
#[derive(Clone, Copy)]
struct Path {
    pixel: u32,
    sample: u32,
}

impl Path {
    fn new(index: u32) -> Self {
        Self { pixel: index / SPP, sample: index % SPP }
    }

    /// Two uniform numbers in [0, 1), and an integer.
    fn random(self, dimension: u32) -> ([f32; 2], u32) {
        let unit = |x: u32| (x >> 8) as f32 * (1.0 / 16_777_216.0);
        let a = hash(self.pixel ^ hash(self.sample ^ hash(dimension.wrapping_add(0x9e37_79b9))));
        let b = hash(a ^ 0x5163_3e2d);
        ([unit(a), unit(b)], hash(b ^ 0x68bc_21eb))
    }
}

/// Of Wellons, "Prospecting for hash functions" (2018).
fn hash(mut x: u32) -> u32 {
    x = (x ^ (x >> 16)).wrapping_mul(0x7feb_352d);
    x = (x ^ (x >> 15)).wrapping_mul(0x846c_a68b);
    x ^ (x >> 16)
}

/// A picture to make.
struct Job<'a> {
    model: &'a Model,
    bvh: &'a Bvh,
    camera: Camera,
}

impl Job<'_> {
    /// Adds the samples of one turn to the picture: depth-first, or in batches of some size.
    fn trace(&self, batch: Option<usize>, turn: u32, picture: &mut [f64], kernel: &mut Kernel<'_>) {
        let paths = self.camera.pixels() * SPP / TURNS;
        let paths = turn * paths..(turn + 1) * paths;
        match batch {
            None => self.depth_first(paths, picture, kernel),
            Some(size) => self.batches(paths, size, picture, kernel),
        }
    }

    fn camera_ray(&self, path: Path) -> Ray {
        self.camera.ray(path.pixel, path.random(0).0)
    }

    /// What a light adds if the shadow ray reaches it, and the ray that goes on.
    fn shade(&self, path: Path, depth: u32, ray: &Ray, hit: &Hit, beta: f32) -> (Option<(Ray, f32)>, Ray) {
        let (p, n) = surface(self.model, ray, hit);
        let (u, uc) = path.random(2 * depth + 1);
        let lights = &self.model.lights;
        let light = lights[uc as usize % lights.len()];
        let connection = connection(p, n, light, u).map(|(shadow, distance)| {
            let cosines = n.dot(shadow.d) * light[1].cross(light[2]).dot(shadow.d).abs();
            (shadow, beta * FRAC_1_PI * LIGHT * cosines * lights.len() as f32 / (distance * distance))
        });
        (connection, Ray::new(p, cosine_direction(n, path.random(2 * depth + 2).0)))
    }

    fn depth_first(&self, paths: Range<u32>, picture: &mut [f64], kernel: &mut Kernel<'_>) {
        for path in paths.map(Path::new) {
            let (mut ray, mut beta, mut l) = (self.camera_ray(path), 1.0, 0.0);
            for depth in 0..DEPTH {
                let Some(hit) = kernel.intersect(&ray) else {
                    l += beta * SKY;
                    break;
                };
                beta *= ALBEDO;
                let (connection, next) = self.shade(path, depth, &ray, &hit, beta);
                if let Some((shadow, ld)) = connection
                    && !kernel.occluded(&shadow)
                {
                    l += ld;
                }
                ray = next;
            }
            picture[path.pixel as usize] += f64::from(l);
        }
    }

    fn batches(&self, paths: Range<u32>, size: usize, picture: &mut [f64], kernel: &mut Kernel<'_>) {
        let [mut batch, mut next, mut shadows] = [(); 3].map(|()| Queue::default());
        let (mut hits, mut occluded) = (vec![None; size], vec![false; size]);
        let mut radiance = vec![0.0; size];
        for first in paths.clone().step_by(size) {
            let all = first..paths.end.min(first + size as u32);
            radiance.fill(0.0);
            batch.clear();
            all.clone().enumerate().for_each(|(slot, path)| batch.push(slot, self.camera_ray(Path::new(path)), 1.0));
            for depth in 0..DEPTH {
                if depth == 0 {
                    zip(&mut hits, &batch.rays).for_each(|(hit, ray)| *hit = kernel.intersect(ray));
                } else {
                    kernel.intersect_batch(&batch.rays, &mut hits);
                }
                next.clear();
                shadows.clear();
                for ((slot, ray, beta), hit) in zip(batch.iter(), &hits) {
                    let Some(hit) = hit else {
                        radiance[slot] += beta * SKY;
                        continue;
                    };
                    let beta = beta * ALBEDO;
                    let (connection, scattered) = self.shade(Path::new(first + slot as u32), depth, ray, hit, beta);
                    connection.into_iter().for_each(|(shadow, ld)| shadows.push(slot, shadow, ld));
                    next.push(slot, scattered, beta);
                }
                swap(&mut batch, &mut next);
                kernel.occluded_batch(&shadows.rays, &mut occluded);
                for ((slot, _, ld), _) in zip(shadows.iter(), &occluded).filter(|(_, occluded)| !**occluded) {
                    radiance[slot] += ld;
                }
            }
            zip(all.map(Path::new), &radiance).for_each(|(path, &l)| picture[path.pixel as usize] += f64::from(l));
        }
    }
}

/// Rays of paths that are alive, or to lights: places in the batch, and throughputs or what the lights add.
#[derive(Default)]
struct Queue {
    slots: Vec<usize>,
    rays: Vec<Ray>,
    weights: Vec<f32>,
}

impl Queue {
    fn clear(&mut self) {
        self.slots.clear();
        self.rays.clear();
        self.weights.clear();
    }

    fn push(&mut self, slot: usize, ray: Ray, weight: f32) {
        self.slots.push(slot);
        self.rays.push(ray);
        self.weights.push(weight);
    }

    fn iter(&self) -> impl Iterator<Item = (usize, &Ray, f32)> {
        zip(&self.slots, &self.rays).zip(&self.weights).map(|((&slot, ray), &weight)| (slot, ray, weight))
    }
}
