//! The triangle that moves.

use glam::DVec3;

use crate::aabb::Aabb;
use crate::ray::{PrimHit, RayF64};
use crate::shape::{Triangle, flat};

/// A triangle whose vertices move on straight lines at constant speed, while it exists. A motion of several keys is one of these
/// for each interval between them, and at a key, where two are in the same place, that of the lower index is hit.
///
/// The tree has boxes around the whole way: the farther a triangle moves for its size, the slower are rays. Meshes stay closed if
/// the triangles that share a vertex have the same numbers for it, and the same times.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MovingTriangle {
    /// At the beginning and at the end of its time. One of the two may be without area.
    pub at: [Triangle; 2],
    /// When it begins and ends to exist, both inclusive, in the time of [`Ray::time`](crate::Ray::time). Finite; if it ends
    /// before it begins, it is never there.
    pub time: [f32; 2],
}

impl MovingTriangle {
    /// How much of the way from `start` to `end` has passed at `time`.
    #[inline]
    pub(crate) fn share(start: f32, end: f32, time: f32) -> f64 {
        let length = f64::from(end) - f64::from(start);
        if length > 0.0 { ((f64::from(time) - f64::from(start)) / length).clamp(0.0, 1.0) } else { 0.0 }
    }

    pub(crate) fn bounds(&self) -> Aabb {
        self.at[0].bounds().union(self.at[1].bounds())
    }

    #[inline]
    pub(crate) fn intersect(&self, ray: &RayF64) -> Option<PrimHit> {
        let [start, end] = self.time;
        if !(start <= ray.time && ray.time <= end) {
            return None;
        }
        flat::intersect_triangle(self.vertices(ray.time), ray)
    }

    /// The vertices at a time.
    #[inline]
    pub(crate) fn vertices(&self, time: f32) -> [DVec3; 3] {
        let share = Self::share(self.time[0], self.time[1], time);
        let [from, to] = self.at.map(|t| t.vertices());
        [0, 1, 2].map(|i| from[i] + (to[i] - from[i]) * share)
    }
}
