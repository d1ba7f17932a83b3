//! The search for the nearest hit: exact tests, one primitive at a time, put off as long as they can be.
//!
//! A hit that is certain need not be known exactly until it is compared with another at about the same distance. Most are
//! never: so most rays make one exact test.

use crate::ray::{Hit, PrimHit, Ray, RayF64};
use crate::wide::{Kind, Tree};

/// Where a tree keeps a primitive. It is of use only with that tree, until it is refitted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Slot(u32);

impl Slot {
    /// Nowhere.
    pub const NONE: Self = Self(u32::MAX);

    const KIND_SHIFT: u32 = 29;
    const LANE_BITS: u32 = 3;

    #[inline(always)]
    pub(crate) fn new(kind: Kind, block: usize, lane: usize) -> Self {
        Self((kind as u32) << Self::KIND_SHIFT | (block as u32) << Self::LANE_BITS | lane as u32)
    }

    #[inline(always)]
    pub(crate) fn unpack(self) -> (Kind, usize, usize) {
        let block = self.0 & ((1 << Self::KIND_SHIFT) - 1);
        (Kind::from_bits(self.0 >> Self::KIND_SHIFT), (block >> Self::LANE_BITS) as usize, self.0 as usize & 7)
    }

    /// Bit i: this is lane i of the block.
    #[inline(always)]
    fn lane_of(self, kind: Kind, block: usize) -> u32 {
        let lane = self.0 ^ Self::new(kind, block, 0).0;
        if lane < 1 << Self::LANE_BITS { 1 << lane } else { 0 }
    }
}

/// Whether a hit counts, by what the caller knows of the surface.
pub(crate) trait Accept: Copy {
    /// Every hit counts; nobody is asked.
    const EVERYTHING: bool;

    fn accepts(&self, hit: &Hit) -> bool;
}

/// Every hit counts.
#[derive(Clone, Copy)]
pub(crate) struct Everything;

impl Accept for Everything {
    const EVERYTHING: bool = true;

    #[inline(always)]
    fn accepts(&self, _: &Hit) -> bool {
        true
    }
}

/// Those hits count that a function accepts.
#[derive(Clone, Copy)]
pub(crate) struct Where<'a>(pub(crate) &'a dyn Fn(&Hit) -> bool);

impl Accept for Where<'_> {
    const EVERYTHING: bool = false;

    #[inline(always)]
    fn accepts(&self, hit: &Hit) -> bool {
        self.0(hit)
    }
}

/// A ray and the nearest hit so far.
#[derive(Clone)]
pub(crate) struct Search {
    pub(crate) ray: RayF64,
    nearest: Hit,
    /// A hit that is certain, and the distances between which it lies; `nearest` is farther.
    pending: Slot,
    pending_near: f32,
    pending_far: f32,
    /// No hit is nearer: where the ray enters the innermost instance.
    floor: f32,
    instances: [u32; Hit::MAX_NESTING],
    apart: [Slot; 2],
}

impl Search {
    #[inline(always)]
    pub(crate) fn new(ray: &Ray) -> Self {
        let nearest = Hit::none(ray.t_max);
        Self {
            ray: RayF64::from(ray),
            nearest,
            pending: Slot::NONE,
            pending_near: 0.0,
            pending_far: nearest.t,
            floor: 0.0,
            instances: nearest.instances,
            apart: ray.apart,
        }
    }

    /// Hits farther than this do not count any more.
    #[inline(always)]
    pub(crate) fn t_max(&self) -> f32 {
        self.pending_far
    }

    /// Hits nearer than the first are not certain, hits farther than the second do not count.
    #[inline(always)]
    pub(crate) fn range(&self) -> [f32; 2] {
        /// Distances below this may be rounded to 0, where there is no hit.
        const LEAST: f32 = 1e-30;
        [self.floor.max(LEAST), self.pending_far]
    }

    /// Bit i: lane i of a block need not be tested.
    #[inline(always)]
    pub(crate) fn apart(&self, kind: Kind, block: usize) -> u32 {
        let [a, b] = self.apart;
        a.lane_of(kind, block) | b.lane_of(kind, block)
    }

    #[inline(always)]
    pub(crate) fn found(&self) -> bool {
        self.nearest.prim != Hit::NO_PRIM
    }

    /// The nearest hit, if nothing is pending.
    #[inline(always)]
    pub(crate) fn hit(&self) -> Option<Hit> {
        self.found().then_some(self.nearest)
    }

    /// Notes a hit that is certain, whose distance lies between two others, before [`t_max`](Self::t_max).
    #[inline(always)]
    pub(crate) fn certain(&mut self, tree: &Tree, slot: Slot, near: f32, far: f32, accept: impl Accept) {
        if self.pending == Slot::NONE || far < self.pending_near {
            self.pending = slot;
            self.pending_near = near;
            self.pending_far = far;
        } else {
            self.test(tree, slot, accept);
        }
    }

    /// Tests what is pending.
    #[inline(always)]
    pub(crate) fn settle(&mut self, tree: &Tree, accept: impl Accept) {
        let slot = std::mem::replace(&mut self.pending, Slot::NONE);
        if slot != Slot::NONE {
            self.test_now(tree, slot, accept);
        }
    }

    /// The nearest hit.
    #[inline(always)]
    pub(crate) fn finish(self, tree: &Tree, accept: impl Accept) -> Option<Hit> {
        // Handed on as it is computed: what has just been stored field by field takes long to be loaded as a whole.
        if self.pending != Slot::NONE
            && let Some(hit) = self.exact(tree, self.pending, accept)
        {
            return Some(hit);
        }
        self.hit()
    }

    /// Tests a primitive, after what is pending.
    #[inline(never)]
    pub(crate) fn test(&mut self, tree: &Tree, slot: Slot, accept: impl Accept) {
        self.settle(tree, accept);
        self.test_now(tree, slot, accept);
    }

    #[inline(always)]
    fn test_now(&mut self, tree: &Tree, slot: Slot, accept: impl Accept) {
        if let Some(hit) = self.exact(tree, slot, accept) {
            self.keep(hit);
        }
    }

    /// The exact hit of a primitive if it counts.
    #[inline(always)]
    fn exact(&self, tree: &Tree, slot: Slot, accept: impl Accept) -> Option<Hit> {
        let (kind, block, lane) = slot.unpack();
        let hit = tree.intersect(kind, block, lane, &self.ray)?;
        self.counts(&hit, tree.id(kind, block, lane), slot, accept)
    }

    /// Takes an exact hit if it counts; nothing must be pending.
    #[inline(always)]
    pub(crate) fn offer(&mut self, hit: &PrimHit, prim: u32, slot: Slot, accept: impl Accept) {
        if let Some(hit) = self.counts(hit, prim, slot, accept) {
            self.keep(hit);
        }
    }

    /// An exact hit, if it counts: if it is nearer than the nearest, or as near and of a lower index.
    #[inline(always)]
    fn counts(&self, hit: &PrimHit, prim: u32, slot: Slot, accept: impl Accept) -> Option<Hit> {
        let t = (hit.t as f32).max(self.floor);
        if t > self.nearest.t {
            return None;
        }
        let hit = Hit { t, prim, u: hit.u as f32, v: hit.v as f32, instances: self.instances, slot };
        let nearest = &self.nearest;
        let counts = t > 0.0 && (t < nearest.t || (t == nearest.t && hit.precedes(nearest)));
        (counts && accept.accepts(&hit)).then_some(hit)
    }

    #[inline(always)]
    fn keep(&mut self, hit: Hit) {
        self.nearest = hit;
        self.pending_far = hit.t;
    }

    /// The search within an instance, by the ray in its object's space, from where the ray enters its box; none if the
    /// instances are too deep within each other. Nothing must be pending.
    pub(crate) fn enter(&self, ray: RayF64, instance: u32, entry: f32) -> Option<Self> {
        let depth = self.instances.iter().position(|&i| i == Hit::NO_INSTANCE)?;
        let mut inner = Self { ray, floor: self.floor.max(entry), apart: [Slot::NONE; 2], ..self.clone() };
        inner.instances[depth] = instance;
        Some(inner)
    }

    /// Takes over what a search within an instance found.
    pub(crate) fn leave(&mut self, inner: &Self) {
        self.nearest = inner.nearest;
        self.pending_far = inner.nearest.t;
    }
}
