//! The search for the nearest hit: exact tests, one primitive at a time.

use crate::ray::{Hit, Ray, RayF64};
use crate::wide::{Kind, Tree};

/// Where the tree keeps a primitive.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Slot(u32);

impl Slot {
    /// Nowhere.
    pub(crate) const NONE: Self = Self(u32::MAX);

    #[inline(always)]
    pub(crate) fn new(kind: Kind, block: usize, lane: usize) -> Self {
        Self((kind as u32) << 30 | (block as u32) << 3 | lane as u32)
    }

    #[inline(always)]
    pub(crate) fn unpack(self) -> (Kind, usize, usize) {
        (Kind::from_bits(self.0 >> 30), (self.0 << 2 >> 5) as usize, self.0 as usize & 7)
    }
}

/// A ray and the nearest hit so far.
pub(crate) struct Search {
    ray: RayF64,
    nearest: Hit,
}

impl Search {
    #[inline(always)]
    pub(crate) fn new(ray: &Ray) -> Self {
        Self { ray: RayF64::from(ray), nearest: Hit::none(ray.t_max) }
    }

    /// Hits farther than this do not count any more.
    #[inline(always)]
    pub(crate) fn t_max(&self) -> f32 {
        self.nearest.t
    }

    #[inline(always)]
    pub(crate) fn hit(&self) -> Option<Hit> {
        (self.nearest.prim != Hit::NO_PRIM).then_some(self.nearest)
    }

    /// Tests a primitive; of hits at the same distance, that of the lowest index counts.
    ///
    /// A hit outside the primitive's box, as a badly conditioned intersection may claim it, would be found or not found
    /// depending on the tree. So there is none where the ray misses the box, and none before it enters the box.
    #[inline]
    pub(crate) fn test(&mut self, tree: &Tree, slot: Slot) {
        let (kind, block, lane) = slot.unpack();
        let primitive = tree.primitive(kind, block, lane);
        let Some(hit) = primitive.intersect(&self.ray).filter(|hit| hit.t as f32 <= self.nearest.t) else {
            return;
        };
        let entry = if hit.is_sure { Some(0.0) } else { self.ray.enters(primitive.bounds()) };
        let Some(entry) = entry else {
            return;
        };
        let (t, prim) = (hit.t.max(entry) as f32, tree.id(kind, block, lane));
        let nearest = &self.nearest;
        // A distance may have been rounded to 0.
        if t > 0.0 && (t < nearest.t || (t == nearest.t && prim < nearest.prim)) {
            self.nearest = Hit { t, prim, u: hit.u as f32, v: hit.v as f32, slot };
        }
    }
}
