//! The tree's node: four boxes side by side, tested at once.

use glam::{BVec4A, Vec3, Vec4};

use crate::aabb::Aabb;
use crate::ray::Ray;

/// Widens the far end of a box interval by what rounding can have lost, so that a box is never missed by a ray that
/// meets something in it: three roundings at either end, one here (after Ize 2013, Journal of Computer Graphics
/// Techniques 2(2), which leaves out the last).
const ROBUST: f32 = 1.0 + 8.0 * HALF_EPSILON;
const HALF_EPSILON: f32 = f32::EPSILON * 0.5;

/// A correctly rounded distance of a hit is never below this multiple of the distance at which the ray enters its box.
const BEHIND_ENTRY: f32 = 1.0 - 6.0 * HALF_EPSILON;

/// A direction whose size is below this counts as this: finite inverses keep NaN out of the box test.
const TINY: f32 = 1e-38;

/// A child: an inner node, or a run of primitives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Child(u32);

impl Child {
    /// The most primitives that a tree can hold.
    pub(crate) const MAX_SLOTS: usize = 1 << 27;

    pub(crate) const ROOT: Self = Self(0);

    /// No primitives: a ray that is not finite may seem to meet a lane that is not used.
    const NONE: Self = Self(1 << 31);

    pub(crate) fn node(index: usize) -> Self {
        Self(index as u32)
    }

    /// Up to 15 primitives.
    pub(crate) fn leaf(first: usize, count: usize) -> Self {
        Self(1 << 31 | (count as u32) << 27 | first as u32)
    }

    /// The slots of a leaf's primitives, or the index of an inner node.
    #[inline]
    pub(crate) fn unpack(self) -> Result<std::ops::Range<usize>, usize> {
        if self.0 >> 31 == 1 {
            let first = (self.0 & (Self::MAX_SLOTS as u32 - 1)) as usize;
            Ok(first..first + (self.0 >> 27 & 15) as usize)
        } else {
            Err(self.0 as usize)
        }
    }
}

/// Up to four children with their boxes, lane by lane; an unused lane has an empty box, which no finite ray meets.
#[derive(Clone, Debug)]
pub(crate) struct Node {
    /// `[lo, hi][axis]` of the four boxes.
    planes: [[Vec4; 3]; 2],
    pub(crate) child: [Child; 4],
}

impl Node {
    pub(crate) fn new(children: &[(Child, Aabb)]) -> Self {
        let lane = |i: usize| children.get(i).map_or(Aabb::EMPTY, |c| c.1);
        let plane = |get: fn(&Aabb) -> Vec3, axis: usize| Vec4::from_array([0, 1, 2, 3].map(|i| get(&lane(i))[axis]));
        Self {
            planes: [[0, 1, 2].map(|axis| plane(|b| b.lo, axis)), [0, 1, 2].map(|axis| plane(|b| b.hi, axis))],
            child: [0, 1, 2, 3].map(|i| children.get(i).map_or(Child::NONE, |c| c.0)),
        }
    }

    /// Distances at which the ray enters the four boxes, and which of them it meets before `t_max`.
    #[inline]
    pub(crate) fn intersect(&self, ray: &NodeRay, t_max: f32) -> (Vec4, BVec4A) {
        let at = |end: usize, axis: usize| (self.planes[end][axis] - ray.o[axis]) * ray.d_inv[axis];
        let enter = |axis: usize| at(ray.negative[axis], axis);
        let leave = |axis: usize| at(1 - ray.negative[axis], axis);
        let near = enter(0).max(enter(1)).max(enter(2).max(Vec4::ZERO));
        let far = leave(0).min(leave(1)).min(leave(2).min(Vec4::splat(t_max)));
        (near, near.cmple(far * ROBUST))
    }
}

/// What a ray needs at every node, computed once.
pub(crate) struct NodeRay {
    o: [Vec4; 3],
    d_inv: [Vec4; 3],
    /// Which of `[lo, hi]` a ray of this sign enters through.
    negative: [usize; 3],
}

impl NodeRay {
    /// What the tree makes of a distance `t` at which a primitive within `bounds` claims to be hit: no hit if the ray
    /// misses the box, and not before it enters the box.
    ///
    /// The larger boxes around this one are met whenever it is, since rounding keeps order, and no later. So a search
    /// through them never passes over a hit that went through here, however badly conditioned the intersection.
    #[inline]
    pub(crate) fn confirm(&self, t: f32, bounds: Aabb) -> Option<f32> {
        // The arithmetic of `Node::intersect`, for one box.
        let planes = [bounds.lo, bounds.hi];
        let at = |end: usize, axis: usize| (planes[end][axis] - self.o[axis].x) * self.d_inv[axis].x;
        let enter = |axis: usize| at(self.negative[axis], axis);
        let leave = |axis: usize| at(1 - self.negative[axis], axis);
        let near = enter(0).max(enter(1)).max(enter(2).max(0.0));
        let far = leave(0).min(leave(1)).min(leave(2));
        (near <= far * ROBUST).then(|| t.max(near * BEHIND_ENTRY))
    }
}

impl From<&Ray> for NodeRay {
    fn from(ray: &Ray) -> Self {
        let inverse = |d: f32| 1.0 / if d.abs() < TINY { TINY.copysign(d) } else { d };
        Self {
            o: ray.o.to_array().map(Vec4::splat),
            d_inv: ray.d.to_array().map(|d| Vec4::splat(inverse(d))),
            negative: ray.d.to_array().map(|d| usize::from(d.is_sign_negative())),
        }
    }
}
