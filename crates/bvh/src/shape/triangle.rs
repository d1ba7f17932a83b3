//! The triangle.
//!
//! The sides on which the ray passes the three edges are triple products d · (a × b) of the vertices seen
//! from the origin (Plücker coordinates; Kensler & Shirley 2006, doi:10.1109/RT.2006.280208). Two triangles that
//! share an edge compute that edge's product from the same numbers with opposite sign, bit for bit, so no
//! ray slips between them.

use glam::Vec3;

use crate::aabb::Aabb;
use crate::ray::{PrimHit, RayF64};

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
        let a = self.a.as_dvec3() - ray.o;
        let b = self.b.as_dvec3() - ray.o;
        let c = self.c.as_dvec3() - ray.o;
        let weight_a = ray.d.dot(b.cross(c));
        let weight_b = ray.d.dot(c.cross(a));
        let weight_c = ray.d.dot(a.cross(b));
        let all_positive = weight_a >= 0.0 && weight_b >= 0.0 && weight_c >= 0.0;
        let all_negative = weight_a <= 0.0 && weight_b <= 0.0 && weight_c <= 0.0;
        let sum = weight_a + weight_b + weight_c;
        if !(all_positive || all_negative) || sum == 0.0 {
            return None;
        }
        let n = (b - a).cross(c - a);
        let t = a.dot(n) / ray.d.dot(n);
        (t > 0.0).then_some(PrimHit { t, u: weight_b / sum, v: weight_c / sum })
    }
}
