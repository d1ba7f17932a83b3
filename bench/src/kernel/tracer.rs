//! The ways of asking for hits that are measured.

use std::hint::black_box;
use std::iter::zip;
use std::slice::from_ref;

use eyebeam_bvh::{Bvh, Hit, Ray};

use super::rays::{Query, RaySet};

/// Something that answers queries about many rays. One virtual call serves many rays, so it does not count.
pub(crate) trait Tracer: Sync {
    /// Distances to the nearest hits; infinite where there is none.
    fn closest(&self, rays: &[Ray], distances: &mut [f32]);

    /// Whether there is any hit.
    fn occluded(&self, rays: &[Ray], occluded: &mut [bool]);
}

/// One call of ours for each ray.
pub(crate) struct OneByOne<'b>(pub(crate) &'b Bvh);

impl Tracer for OneByOne<'_> {
    fn closest(&self, rays: &[Ray], distances: &mut [f32]) {
        for (ray, distance) in rays.iter().zip(distances) {
            // The whole hit is made, as a renderer needs it.
            *distance = black_box(self.0.intersect(ray)).map_or(f32::INFINITY, |hit| hit.t);
        }
    }

    fn occluded(&self, rays: &[Ray], occluded: &mut [bool]) {
        for (ray, occluded) in rays.iter().zip(occluded) {
            *occluded = self.0.occluded(ray);
        }
    }
}

/// One call of ours for each batch of rays.
pub(crate) struct Batched<'b>(pub(crate) &'b Bvh);

impl Batched<'_> {
    /// Rays in a batch.
    pub(crate) const SIZE: usize = 64;
}

impl Tracer for Batched<'_> {
    fn closest(&self, rays: &[Ray], distances: &mut [f32]) {
        let mut hits = [None; Self::SIZE];
        for (rays, distances) in rays.chunks(Self::SIZE).zip(distances.chunks_mut(Self::SIZE)) {
            self.0.intersect_batch(rays, &mut hits);
            for (hit, distance) in black_box(&hits).iter().zip(distances) {
                *distance = hit.map_or(f32::INFINITY, |hit| hit.t);
            }
        }
    }

    fn occluded(&self, rays: &[Ray], occluded: &mut [bool]) {
        for (rays, occluded) in rays.chunks(Self::SIZE).zip(occluded.chunks_mut(Self::SIZE)) {
            self.0.occluded_batch(rays, occluded);
        }
    }
}

/// What a tracer said about a set of rays.
pub(crate) enum Answers {
    /// Distances to the nearest hits.
    Distances(Vec<f32>),
    /// Whether there is any hit.
    Occluded(Vec<bool>),
}

impl Answers {
    /// Room for the answers to a set.
    pub(crate) fn new(set: &RaySet) -> Self {
        match set.query {
            Query::Closest => Self::Distances(vec![0.0; set.rays.len()]),
            Query::Any => Self::Occluded(vec![false; set.rays.len()]),
        }
    }

    /// Asks about the rays from `first` on.
    pub(crate) fn fill(&mut self, tracer: &dyn Tracer, rays: &[Ray], first: usize) {
        let range = first..first + rays.len();
        match self {
            Self::Distances(distances) => tracer.closest(rays, &mut distances[range]),
            Self::Occluded(occluded) => tracer.occluded(rays, &mut occluded[range]),
        }
    }

    /// The number of rays about which the answers differ: hit or not, or distances by more than a thousandth.
    pub(crate) fn differences(&self, other: &Self) -> usize {
        match (self, other) {
            (Self::Distances(a), Self::Distances(b)) => a.iter().zip(b).filter(|&(&a, &b)| !is_close(a, b)).count(),
            (Self::Occluded(a), Self::Occluded(b)) => a.iter().zip(b).filter(|(a, b)| a != b).count(),
            _ => 0,
        }
    }
}

/// Whether two distances are the same but for rounding.
pub(crate) fn is_close(a: f32, b: f32) -> bool {
    a == b || (a - b).abs() <= 1e-3 * b.max(1e-2)
}

/// What the kernel is asked.
#[derive(Clone, Copy)]
enum Call {
    Intersect,
    Occluded,
    IntersectBatch,
    OccludedBatch,
}

/// The kernel; it may log what it is asked, to answer all of it again with nothing in between.
pub(crate) struct Kernel<'b> {
    bvh: &'b Bvh,
    /// Whether it gets batches as such, or ray by ray.
    flies: bool,
    logs: bool,
    calls: Vec<(Call, usize)>,
    pub(crate) rays: Vec<Ray>,
}

impl<'b> Kernel<'b> {
    pub(crate) fn new(bvh: &'b Bvh, flies: bool, logs: bool) -> Self {
        Self { bvh, flies, logs, calls: Vec::new(), rays: Vec::new() }
    }

    #[inline(always)]
    fn log(&mut self, call: Call, rays: &[Ray]) {
        if self.logs {
            self.calls.push((call, rays.len()));
            self.rays.extend_from_slice(rays);
        }
    }

    pub(crate) fn intersect(&mut self, ray: &Ray) -> Option<Hit> {
        self.log(Call::Intersect, from_ref(ray));
        self.bvh.intersect(ray)
    }

    pub(crate) fn occluded(&mut self, ray: &Ray) -> bool {
        self.log(Call::Occluded, from_ref(ray));
        self.bvh.occluded(ray)
    }

    pub(crate) fn intersect_batch(&mut self, rays: &[Ray], hits: &mut [Option<Hit>]) {
        if !self.flies {
            return zip(rays, hits).for_each(|(ray, hit)| *hit = self.intersect(ray));
        }
        self.log(Call::IntersectBatch, rays);
        self.bvh.intersect_batch(rays, hits);
    }

    pub(crate) fn occluded_batch(&mut self, rays: &[Ray], occluded: &mut [bool]) {
        if !self.flies {
            return zip(rays, occluded).for_each(|(ray, occluded)| *occluded = self.occluded(ray));
        }
        self.log(Call::OccludedBatch, rays);
        self.bvh.occluded_batch(rays, occluded);
    }

    /// Asks again.
    pub(crate) fn replay(&self) {
        let (mut hits, mut occluded) = ([None; 64], [false; 64]);
        let mut rest = &self.rays[..];
        for &(call, count) in &self.calls {
            let (rays, others) = rest.split_at(count);
            rest = others;
            match call {
                Call::Intersect => hits[0] = self.bvh.intersect(&rays[0]),
                Call::Occluded => occluded[0] = self.bvh.occluded(&rays[0]),
                Call::IntersectBatch => self.bvh.intersect_batch(rays, &mut hits),
                Call::OccludedBatch => self.bvh.occluded_batch(rays, &mut occluded),
            }
            black_box((&hits, &occluded));
        }
    }
}
