//! Rays and hits.

use glam::{DVec3, Vec3};

/// A half line from `o` along `d`, looked at for `0 < t <= t_max`.
///
/// `d` may have any length from 1e-18 to 1e18; `t` counts in multiples of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Origin.
    pub o: Vec3,
    /// Direction; not zero.
    pub d: Vec3,
    /// Hits farther than this do not count. Infinite by default.
    pub t_max: f32,
}

impl Ray {
    /// A ray of infinite length.
    pub fn new(o: Vec3, d: Vec3) -> Self {
        Self { o, d, t_max: f32::INFINITY }
    }
}

/// Where a ray met a primitive.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Distance along the ray, in multiples of its direction.
    pub t: f32,
    /// The primitive's index in the list that the tree was built from.
    pub prim: u32,
    /// First parameter of the point on the primitive: along `u` of a quad, weight of vertex `b` of a triangle, 0 on a sphere.
    pub u: f32,
    /// Second parameter: along `v` of a quad, weight of vertex `c` of a triangle, 0 on a sphere.
    pub v: f32,
    /// Where the tree keeps the primitive; for [`Bvh::primitive`](crate::Bvh::primitive).
    pub(crate) slot: u32,
}

impl Hit {
    /// The index of no primitive.
    pub(crate) const NO_PRIM: u32 = u32::MAX;

    /// Where a search up to `t_max` begins; loses against every hit at a finite distance.
    pub(crate) fn none(t_max: f32) -> Self {
        Self { t: t_max.min(f32::MAX), prim: Self::NO_PRIM, u: 0.0, v: 0.0, slot: 0 }
    }
}

/// A ray in double precision, in which the primitives are intersected.
///
/// Inputs are single precision numbers, so differences of them are (nearly) exact here: that is what keeps
/// spheres of radius 1e5 and long thin triangles free of self-intersection.
#[derive(Clone, Copy)]
pub(crate) struct RayF64 {
    pub(crate) o: DVec3,
    pub(crate) d: DVec3,
    /// The largest component of `d` by size.
    pub(crate) d_max: f64,
}

impl From<&Ray> for RayF64 {
    fn from(ray: &Ray) -> Self {
        let d = ray.d.as_dvec3();
        Self { o: ray.o.as_dvec3(), d, d_max: d.abs().max_element() }
    }
}

/// A hit of one primitive: distance and surface parameters, not yet rounded.
#[derive(Clone, Copy)]
pub(crate) struct PrimHit {
    pub(crate) t: f64,
    pub(crate) u: f64,
    pub(crate) v: f64,
}
