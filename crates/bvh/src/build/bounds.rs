//! Boxes in the form that builders compute with.

use glam::{Vec3, Vec3A};

use crate::aabb::Aabb;

/// Builders compute with coordinates up to this: sums and differences of them are finite, so no split meets NaN.
const HUGE: f32 = 4e37;

/// A box in two registers.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounds {
    pub(super) lo: Vec3A,
    pub(super) hi: Vec3A,
}

impl Bounds {
    pub(super) const EMPTY: Self = Self { lo: Vec3A::INFINITY, hi: Vec3A::NEG_INFINITY };

    #[inline(always)]
    pub(super) fn union(self, other: Self) -> Self {
        Self { lo: self.lo.min(other.lo), hi: self.hi.max(other.hi) }
    }

    #[inline(always)]
    pub(super) fn intersection(self, other: Self) -> Self {
        Self { lo: self.lo.max(other.lo), hi: self.hi.min(other.hi) }
    }

    #[inline(always)]
    pub(super) fn with_point(self, p: Vec3A) -> Self {
        Self { lo: self.lo.min(p), hi: self.hi.max(p) }
    }

    pub(super) fn is_empty(self) -> bool {
        self.lo.cmpgt(self.hi).any()
    }

    /// Half the surface area; 0 if empty.
    #[inline(always)]
    pub(super) fn half_area(self) -> f32 {
        let e = (self.hi - self.lo).max(Vec3A::ZERO);
        e.dot(Vec3A::new(e.y, e.z, e.x))
    }

    /// Twice the centre.
    #[inline(always)]
    pub(super) fn center(self) -> Vec3A {
        self.lo + self.hi
    }
}

impl From<Aabb> for Bounds {
    /// What is out of reach is moved to the edge of it.
    #[inline(always)]
    fn from(b: Aabb) -> Self {
        let within = |p: Vec3| Vec3A::from(p).max(Vec3A::splat(-HUGE)).min(Vec3A::splat(HUGE));
        Self { lo: within(b.lo), hi: within(b.hi) }
    }
}

impl From<Bounds> for Aabb {
    /// What lies on the edge of what builders compute with may lie anywhere beyond it.
    fn from(b: Bounds) -> Self {
        let lo = Vec3A::select(b.lo.cmple(Vec3A::splat(-HUGE)), Vec3A::NEG_INFINITY, b.lo);
        let hi = Vec3A::select(b.hi.cmpge(Vec3A::splat(HUGE)), Vec3A::INFINITY, b.hi);
        Self { lo: lo.into(), hi: hi.into() }
    }
}
