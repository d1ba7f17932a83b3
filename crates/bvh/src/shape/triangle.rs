//! The triangle.

use glam::{DVec3, Vec3};

use crate::aabb::Aabb;
use crate::ray::{PrimHit, RayF64};
use crate::shape::flat;

/// A triangle; its normal is (b − a) × (c − a). Both sides are hit. Triangles that share two vertices leave no gap between them.
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
    #[inline(always)]
    pub(crate) fn vertices(&self) -> [DVec3; 3] {
        [self.a.as_dvec3(), self.b.as_dvec3(), self.c.as_dvec3()]
    }

    pub(crate) fn is_finite(&self) -> bool {
        [self.a, self.b, self.c].into_iter().all(Vec3::is_finite)
    }

    /// Whether it has no area.
    pub(crate) fn is_degenerate(&self) -> bool {
        let [a, b, c] = self.vertices();
        (b - a).cross(c - a) == DVec3::ZERO
    }

    pub(crate) fn bounds(&self) -> Aabb {
        Aabb::around([self.a, self.b, self.c])
    }

    #[inline(always)]
    pub(crate) fn intersect(&self, ray: &RayF64) -> Option<PrimHit> {
        flat::intersect_triangle(self.vertices(), ray)
    }
}
