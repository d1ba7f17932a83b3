//! The triangle.

use glam::Vec3;

use crate::aabb::Aabb;
use crate::ray::{PrimHit, RayF64};
use crate::span;

/// A triangle; its normal is (b − a) × (c − a).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Triangle {
    /// First vertex.
    pub a: Vec3,
    /// Second vertex.
    pub b: Vec3,
    /// Third vertex.
    pub c: Vec3,
}

impl Triangle {
    pub(crate) fn bounds(&self) -> Aabb {
        Aabb::around([self.a.as_dvec3(), self.b.as_dvec3(), self.c.as_dvec3()])
    }

    #[inline]
    pub(crate) fn intersect(&self, ray: &RayF64) -> Option<PrimHit> {
        let a = self.a.as_dvec3();
        let edges = [self.b.as_dvec3() - a, self.c.as_dvec3() - a];
        span::intersect(a, edges, ray, |u, v, error| u.min(v) >= -error && u + v <= 1.0 + error)
    }
}
