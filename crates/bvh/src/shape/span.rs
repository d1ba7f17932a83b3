//! A corner and two edges: what quads and triangles have in common.
//!
//! Möller & Trumbore 1997 (doi:10.1080/10867651.1997.10487468) in double precision. The shape is taken to be wider on all
//! sides by the rounding error of the computation: a ray that meets an edge or a corner, even exactly, is seen by one of
//! the shapes that share it, and closed surfaces have no gap. That is about 1e-14 of the distance.

use glam::DVec3;

use crate::ray::{PrimHit, RayF64};

/// Bound on the rounding errors of each product below, relative to the largest factors: 42 roundings in a row.
const ROUNDING: f64 = 32.0 * f64::EPSILON;

/// With errors below this, relative to the edges, the point is off by far less than the margins of the tree's boxes.
const SURE: f64 = 1e-9;

/// Seen so much edge-on that it is narrower than this many rounding errors, a shape is not hit.
const EDGE_ON: f64 = 64.0;

/// The hit of the plane through `corner` that the edges span, in coordinates along them; `inside` says whether coordinates
/// that are off by at most its third argument belong to the shape.
#[inline]
pub(crate) fn intersect(
    corner: DVec3,
    edges: [DVec3; 2],
    ray: &RayF64,
    inside: impl Fn(f64, f64, f64) -> bool,
) -> Option<PrimHit> {
    let from_corner = ray.o - corner;
    let p = ray.d.cross(edges[1]);
    let q = from_corner.cross(edges[0]);
    let det = edges[0].dot(p);
    let longest = edges[0].abs().max(edges[1].abs()).max_element();
    let error = ROUNDING * ray.d_max * longest * (from_corner.abs().max_element() + longest);
    if det.abs() <= EDGE_ON * error {
        return None;
    }
    let (u, v) = (from_corner.dot(p) / det, ray.d.dot(q) / det);
    let t = edges[1].dot(q) / det;
    let error = error / det.abs();
    let hit = PrimHit { t, u: u.clamp(0.0, 1.0), v: v.clamp(0.0, 1.0), is_sure: error < SURE };
    (inside(u, v, error) && t > 0.0).then_some(hit)
}
