//! The boxes of the two parts of a primitive that a plane across an axis cuts it into.
//!
//! Corners are computed in double precision and boxes are wider by a few roundings, as those of whole primitives are: what
//! lies on the plane lies in both.

use glam::{DVec3, Vec3};

use crate::aabb::Aabb;
use crate::build::bounds::Bounds;
use crate::shape::Primitive;

/// The parts below and above `at` of a primitive's part in a box. A part that is not there has an empty box.
pub(super) fn clip(primitive: &Primitive, within: Bounds, axis: usize, at: f32) -> [Bounds; 2] {
    let parts = match primitive {
        Primitive::Quad(q) => {
            let [c, u, v] = [q.corner, q.u, q.v].map(|p| p.as_dvec3());
            cut_polygon(&[c, c + u, c + u + v, c + v], axis, at)
        }
        Primitive::Triangle(t) => cut_polygon(&t.vertices(), axis, at),
        Primitive::Sphere(_) | Primitive::MovingTriangle(_) | Primitive::Instance(_) => cut_box(within, axis, at),
    };
    parts.map(|part| part.intersection(within))
}

fn cut_box(bounds: Bounds, axis: usize, at: f32) -> [Bounds; 2] {
    let (mut low, mut high) = (bounds, bounds);
    let cut = Aabb::around([Vec3::splat(at)]);
    low.hi[axis] = cut.hi[axis];
    high.lo[axis] = cut.lo[axis];
    [low, high]
}

fn cut_polygon(corners: &[DVec3], axis: usize, at: f32) -> [Bounds; 2] {
    let at = f64::from(at);
    let (mut low, mut high) = (Extent::EMPTY, Extent::EMPTY);
    for (i, &a) in corners.iter().enumerate() {
        let b = corners[(i + 1) % corners.len()];
        if a[axis] <= at {
            low.add(a);
        }
        if a[axis] >= at {
            high.add(a);
        }
        if (a[axis] < at && b[axis] > at) || (a[axis] > at && b[axis] < at) {
            let mut p = a + (b - a) * ((at - a[axis]) / (b[axis] - a[axis]));
            p[axis] = at;
            low.add(p);
            high.add(p);
        }
    }
    [low.bounds(), high.bounds()]
}

/// A box in double precision.
struct Extent {
    lo: DVec3,
    hi: DVec3,
}

impl Extent {
    const EMPTY: Self = Self { lo: DVec3::INFINITY, hi: DVec3::NEG_INFINITY };

    #[inline(always)]
    fn add(&mut self, p: DVec3) {
        (self.lo, self.hi) = (self.lo.min(p), self.hi.max(p));
    }

    fn bounds(&self) -> Bounds {
        if self.lo.x > self.hi.x { Bounds::EMPTY } else { Aabb::around([self.lo, self.hi].map(|p| p.as_vec3())).into() }
    }
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;
    use crate::shape::{Quad, Triangle};

    /// Points of a shape, on a grid over it, are in the part on their side.
    #[test]
    fn parts_hold_what_is_on_their_side() {
        let (a, b, c) = (Vec3::new(0.1, -2.0, 3.0), Vec3::new(5.0, 1.0, -1.0), Vec3::new(-3.0, 0.7, 0.2));
        let shapes =
            [Primitive::Triangle(Triangle { a, b, c }), Primitive::Quad(Quad { corner: a, u: b - a, v: c - a })];
        for (shape, axis, step) in shapes.iter().flat_map(|s| (0..3).flat_map(move |a| (0..40).map(move |i| (s, a, i))))
        {
            let whole = Bounds::from(shape.bounds(&[]));
            let at = whole.lo[axis] + (whole.hi[axis] - whole.lo[axis]) * step as f32 / 39.0;
            let parts = clip(shape, whole, axis, at);
            for (i, j) in (0..=30).flat_map(|i| (0..=30).map(move |j| (i, j))) {
                let (u, v) = (f64::from(i) / 30.0, f64::from(j) / 30.0);
                if matches!(shape, Primitive::Triangle(_)) && u + v > 1.0 {
                    continue;
                }
                let p = a.as_dvec3() + (b - a).as_dvec3() * u + (c - a).as_dvec3() * v;
                let inside = |b: Bounds| {
                    (p.as_vec3() - Vec3::from(b.lo)).min_element() >= 0.0
                        && (Vec3::from(b.hi) - p.as_vec3()).min_element() >= 0.0
                };
                assert!(p[axis] > f64::from(at) || inside(parts[0]));
                assert!(p[axis] < f64::from(at) || inside(parts[1]));
            }
        }
    }
}
