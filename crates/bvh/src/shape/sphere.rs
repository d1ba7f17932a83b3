//! The sphere.
//!
//! The quadratic is solved in double precision with the root formula that does not cancel (Press et al.,
//! Numerical Recipes, 1992, §5.6). Single precision would lose a sphere of radius 1e5 (the usual "ground")
//! to steps of a centimetre; double precision keeps 1e-11 there and costs less than the error analysis of
//! Haines et al. 2019 (Ray Tracing Gems, ch. 7, doi:10.1007/978-1-4842-4427-2_7).

use glam::{DVec3, Vec3};

use crate::aabb::Aabb;
use crate::ray::{PrimHit, RayF64};

/// A sphere, hit from outside and from inside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sphere {
    /// Centre.
    pub center: Vec3,
    /// Radius, above 0.
    pub radius: f32,
}

impl Sphere {
    pub(crate) fn bounds(&self) -> Aabb {
        let (c, r) = (self.center.as_dvec3(), DVec3::splat(self.radius.into()));
        Aabb::around([c - r, c + r])
    }

    /// The nearer root of |o + t d − c|² = r² that lies ahead.
    #[inline]
    pub(crate) fn intersect(&self, ray: &RayF64) -> Option<PrimHit> {
        let oc = ray.o - self.center.as_dvec3();
        let r = f64::from(self.radius);
        let a = ray.d.dot(ray.d);
        let half_b = oc.dot(ray.d);
        let c = oc.dot(oc) - r * r;
        let discriminant = half_b * half_b - a * c;
        if discriminant < 0.0 {
            return None;
        }
        let q = -half_b - discriminant.sqrt().copysign(half_b);
        let (t0, t1) = (q / a, c / q);
        let (near, far) = if t0 < t1 { (t0, t1) } else { (t1, t0) };
        let t = if near > 0.0 { near } else { far };
        (t > 0.0).then_some(PrimHit { t, u: 0.0, v: 0.0 })
    }
}
