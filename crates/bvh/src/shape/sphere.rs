//! The sphere.
//!
//! The quadratic is solved in double precision, with the root formula that does not cancel (Press et al., Numerical
//! Recipes, 1992, §5.6) and the discriminant that does not (Haines et al. 2019, Ray Tracing Gems, ch. 7,
//! doi:10.1007/978-1-4842-4427-2_7). Single precision would lose a sphere of radius 1e5 (the usual "ground") to steps of
//! a centimetre; this is off by 1e-11 there. The textbook discriminant would see spheres of radius 1e-6 from 100 times
//! their size too large.

use glam::{DVec3, Vec3};

use crate::aabb::Aabb;
use crate::ray::{PrimHit, RayF64};

/// A sphere, hit from outside and from inside: once, at the nearer point that lies ahead.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sphere {
    /// Centre.
    pub center: Vec3,
    /// Radius. If it is not above 0, there is nothing to hit.
    pub radius: f32,
}

impl Sphere {
    pub(crate) fn bounds(&self) -> Aabb {
        let (c, r) = (self.center.as_dvec3(), DVec3::splat(self.radius.into()));
        Aabb::around([c - r, c + r].map(|p| p.as_vec3()))
    }

    /// The nearer root of |o + t d − c|² = r² that lies ahead.
    #[inline]
    pub(crate) fn intersect(&self, ray: &RayF64) -> Option<PrimHit> {
        let oc = ray.o - self.center.as_dvec3();
        let r = f64::from(self.radius);
        let a = ray.d.dot(ray.d);
        let middle = -oc.dot(ray.d) / a;
        // From the centre to the middle of the chord.
        let off_axis = oc + middle * ray.d;
        let half_chord_sq = r * r - off_axis.dot(off_axis);
        if half_chord_sq < 0.0 {
            return None;
        }
        let t0 = middle + (half_chord_sq / a).sqrt().copysign(middle);
        let t1 = (oc.dot(oc) - r * r) / (a * t0);
        let (near, far) = if t0 < t1 { (t0, t1) } else { (t1, t0) };
        let t = if near > 0.0 { near } else { far };
        (t > 0.0).then_some(PrimHit { t, u: 0.0, v: 0.0 })
    }
}
