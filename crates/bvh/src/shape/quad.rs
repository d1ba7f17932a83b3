//! The quad: a parallelogram, so also every rectangle.
//!
//! Möller & Trumbore 1997 (doi:10.1080/10867651.1997.10487468) with both parameters in 0..1, in double
//! precision: neighbouring quads of a box leave no gap that a ray could find.

use glam::Vec3;

use crate::aabb::Aabb;
use crate::ray::{PrimHit, RayF64};

/// The parallelogram of all `corner + a u + b v` with a and b in 0..1; its normal is u × v.
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
        Aabb::around([c, c + u, c + v, c + u + v])
    }

    #[inline]
    pub(crate) fn intersect(&self, ray: &RayF64) -> Option<PrimHit> {
        let (edge_u, edge_v) = (self.u.as_dvec3(), self.v.as_dvec3());
        let p = ray.d.cross(edge_v);
        let det = edge_u.dot(p);
        if det == 0.0 {
            return None;
        }
        let from_corner = ray.o - self.corner.as_dvec3();
        let q = from_corner.cross(edge_u);
        let u = from_corner.dot(p) / det;
        let v = ray.d.dot(q) / det;
        let t = edge_v.dot(q) / det;
        let inside = (0.0..=1.0).contains(&u) && (0.0..=1.0).contains(&v);
        (inside && t > 0.0).then_some(PrimHit { t, u, v })
    }
}
