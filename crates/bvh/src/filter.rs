//! Eight primitives at once: which of them can a ray meet at all?
//!
//! The tests are those of the exact ones, in single precision, wider by more than single precision can lose. What
//! passes is tested again, exactly; what does not is missed for certain.

use crate::ray::Ray;
use crate::simd::{LANES, Simd};
use crate::wide::{CornerBlock, SphereBlock};

/// Rounding errors of the sums of products below, relative to their largest factors: about 20 roundings each, and
/// fourfold safety.
const ROUNDING: f32 = 40.0 * f32::EPSILON;

/// A ray in every lane.
#[derive(Clone, Copy)]
pub(crate) struct RayLanes<S: Simd> {
    o: [S::F32; 3],
    d: [S::F32; 3],
    /// Largest component of the direction, by size.
    d_max: f32,
}

impl<S: Simd> RayLanes<S> {
    #[inline(always)]
    pub(crate) fn new(s: S, ray: &Ray) -> Self {
        Self {
            o: ray.o.to_array().map(|x| s.splat(x)),
            d: ray.d.to_array().map(|x| s.splat(x)),
            d_max: ray.d.abs().max_element(),
        }
    }

    /// Lanes with a triangle, or a quad if `QUAD`, that the ray may meet before `t_max`.
    #[inline(always)]
    pub(crate) fn meets_corners<const QUAD: bool>(&self, s: S, block: &CornerBlock, t_max: f32) -> u32 {
        let [a, b, c] = [0, 1, 2].map(|corner| [0, 1, 2].map(|axis| s.load(&block.corner[corner][axis])));
        let edge = |to: [S::F32; 3]| if QUAD { to } else { [0, 1, 2].map(|axis| s.sub(to[axis], a[axis])) };
        let (e1, e2) = (edge(b), edge(c));
        let from_a = [0, 1, 2].map(|axis| s.sub(self.o[axis], a[axis]));
        // Möller & Trumbore 1997: u, v and t times the determinant.
        let p = cross(s, self.d, e2);
        let q = cross(s, from_a, e1);
        let det = dot(s, e1, p);
        let [u, v, t] = [dot(s, from_a, p), dot(s, self.d, q), dot(s, e2, q)].map(|x| s.flip(x, det));
        let det = s.abs(det);
        // What rounding may have added or taken away.
        let reach = s.max(s.abs(from_a[0]), s.max(s.abs(from_a[1]), s.abs(from_a[2])));
        let reach = s.add(reach, s.splat(block.size));
        let slack = s.mul(reach, s.splat(ROUNDING * self.d_max * block.size));
        let least = s.sub(s.splat(0.0), slack);
        let most = s.mul_add(s.splat(2.0), slack, det);
        let inside = if QUAD { s.not_gt(u, most) & s.not_gt(v, most) } else { s.not_gt(s.add(u, v), most) };
        let met = block.used & s.not_gt(least, u) & s.not_gt(least, v) & inside;
        if met == 0 {
            return 0;
        }
        let slack_t = s.mul(s.mul(reach, reach), s.splat(2.0 * ROUNDING * block.size));
        let ahead = s.not_gt(s.sub(s.splat(0.0), slack_t), t);
        met & ahead & s.not_gt(t, s.mul_add(det, s.splat(t_max), slack_t))
    }

    /// Lanes with a sphere that the ray may meet before `t_max`.
    #[inline(always)]
    pub(crate) fn meets_spheres(&self, s: S, block: &SphereBlock, t_max: f32) -> u32 {
        let to_center = [0, 1, 2].map(|axis| s.sub(s.load(&block.center[axis]), self.o[axis]));
        let r = s.load(&block.radius);
        let r_sq = s.mul(r, r);
        let d_sq = dot(s, self.d, self.d);
        let along = dot(s, to_center, self.d);
        let distance_sq = dot(s, to_center, to_center);
        // |c − o|² |d|² − ((c − o) · d)² ≤ r² |d|²
        let slack = s.mul(distance_sq, s.splat(ROUNDING));
        let off_axis = s.mul_sub(distance_sq, d_sq, s.mul(along, along));
        let met = block.used & s.not_gt(off_axis, s.mul(s.add(r_sq, slack), d_sq));
        if met == 0 {
            return 0;
        }
        let reach = s.max(s.abs(to_center[0]), s.max(s.abs(to_center[1]), s.abs(to_center[2])));
        let slack_along = s.mul(s.add(reach, r), s.splat(ROUNDING * self.d_max));
        let ahead = s.not_gt(s.sub(s.splat(0.0), slack_along), along) | s.not_gt(distance_sq, s.add(r_sq, slack));
        // The near side is at most a radius before the middle of the chord; |d| ≤ √3 of its largest component.
        let near = s.sub(along, s.mul_add(r, s.splat(1.75 * self.d_max), slack_along));
        met & ahead & s.not_gt(near, s.mul(s.splat(t_max), d_sq))
    }
}

#[inline(always)]
fn dot<S: Simd>(s: S, a: [S::F32; 3], b: [S::F32; 3]) -> S::F32 {
    s.mul_add(a[0], b[0], s.mul_add(a[1], b[1], s.mul(a[2], b[2])))
}

#[inline(always)]
fn cross<S: Simd>(s: S, a: [S::F32; 3], b: [S::F32; 3]) -> [S::F32; 3] {
    let lane = |i: usize, j: usize| s.mul_sub(a[i], b[j], s.mul(a[j], b[i]));
    [lane(1, 2), lane(2, 0), lane(0, 1)]
}

/// The boxes of a node.
#[derive(Clone, Copy)]
pub(crate) struct BoxLanes<S: Simd> {
    d_inv: [S::F32; 3],
    /// What to add to plane / d for the distance at which the plane is crossed, at the least and at the most.
    near: [S::F32; 3],
    far: [S::F32; 3],
    /// Which of `[lo, hi]` a ray of this sign enters through.
    negative: [usize; 3],
}

impl<S: Simd> BoxLanes<S> {
    /// For boxes whose coordinates are at most `reach` in size.
    ///
    /// plane / d − o / d takes three roundings, each at most half an ulp of (|plane| + |o|) / |d|: the distances are
    /// moved by more than that, once for all boxes.
    #[inline(always)]
    pub(crate) fn new(s: S, ray: &Ray, reach: f32) -> Self {
        /// A direction of 0 counts as this share of the longest: finite inverses keep NaN out. By the slack below, boxes
        /// are still wide enough for rays that run along them.
        const TINY: f32 = 1e-12;
        let tiny = TINY * ray.d.abs().max_element();
        let (mut d_inv, mut near, mut far) = ([0.0; 3], [f32::NEG_INFINITY; 3], [f32::INFINITY; 3]);
        for axis in 0..3 {
            let (o, d) = (ray.o[axis], ray.d[axis]);
            d_inv[axis] = 1.0 / if d.abs() < tiny { tiny.copysign(d) } else { d };
            let farthest = (reach + o.abs()) * d_inv[axis].abs();
            // Beyond the range of the numbers, an axis rules nothing out.
            if farthest < f32::MAX {
                near[axis] = -o * d_inv[axis] - 2.5 * f32::EPSILON * farthest;
                far[axis] = -o * d_inv[axis] + 2.5 * f32::EPSILON * farthest;
            }
        }
        Self {
            d_inv: d_inv.map(|x| s.splat(x)),
            near: near.map(|x| s.splat(x)),
            far: far.map(|x| s.splat(x)),
            negative: ray.d.to_array().map(|d| usize::from(d.is_sign_negative())),
        }
    }

    /// Distances before which the ray is not in the boxes, and which of them it may meet before `t_max`.
    #[inline(always)]
    pub(crate) fn meets(&self, s: S, planes: &[[[f32; LANES]; 3]; 2], t_max: f32) -> (S::F32, u32) {
        let cross = |end: usize, axis: usize, offset: S::F32| {
            s.mul_add(s.load(&planes[end & 1][axis]), self.d_inv[axis], offset)
        };
        let enter = [0, 1, 2].map(|axis| cross(self.negative[axis], axis, self.near[axis]));
        let leave = [0, 1, 2].map(|axis| cross(1 - self.negative[axis], axis, self.far[axis]));
        let near = s.max(s.max(enter[0], enter[1]), s.max(enter[2], s.splat(0.0)));
        let far = s.min(s.min(leave[0], leave[1]), s.min(leave[2], s.splat(t_max)));
        (near, s.not_gt(near, far))
    }
}
