//! The quad: a parallelogram, so also every rectangle.

use glam::{DVec3, Vec3};

use crate::aabb::Aabb;
use crate::ray::{PrimHit, RayF64};
use crate::shape::flat;

/// The parallelogram of all `corner + a u + b v` with a and b in 0..=1; its normal is u × v. Both sides are hit. Quads that
/// share an edge leave no gap only as far as their corners, added up in double precision, are the same.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quad {
    /// One corner.
    pub corner: Vec3,
    /// Edge from the corner.
    pub u: Vec3,
    /// The other edge from the corner.
    pub v: Vec3,
}

impl Quad {
    pub(crate) fn bounds(&self) -> Aabb {
        let (c, u, v) = (self.corner.as_dvec3(), self.u.as_dvec3(), self.v.as_dvec3());
        Aabb::around([c, c + u, c + v, c + u + v].map(|p| p.as_vec3()))
    }

    #[inline]
    pub(crate) fn edges(&self) -> [DVec3; 2] {
        [self.u.as_dvec3(), self.v.as_dvec3()]
    }

    #[inline]
    pub(crate) fn intersect(&self, ray: &RayF64) -> Option<PrimHit> {
        flat::intersect_quad(self.corner.as_dvec3(), self.edges(), ray)
    }
}
