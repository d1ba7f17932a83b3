//! The tree's node: four boxes side by side, tested at once.

use glam::{BVec4A, Vec3, Vec4};

use crate::aabb::Aabb;
use crate::ray::Ray;

/// Widens the far end of a box interval by what its three roundings can have lost, so that a box is never
/// missed by a ray that meets something in it (Ize 2013, Journal of Computer Graphics Techniques 2(2)).
const ROBUST: f32 = 1.0 + 2.0 * GAMMA_3;
const GAMMA_3: f32 = 3.0 * HALF_EPSILON / (1.0 - 3.0 * HALF_EPSILON);
const HALF_EPSILON: f32 = f32::EPSILON * 0.5;

/// A child: an inner node, or a run of primitives. 0 is the root's index, which is nobody's child.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Child(u32);

impl Child {
    /// The most primitives that a tree can hold.
    pub(crate) const MAX_SLOTS: usize = 1 << 27;

    pub(crate) const ROOT: Self = Self(0);

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

/// Up to four children with their boxes, lane by lane; an unused lane has an empty box, which no ray hits.
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
            child: [0, 1, 2, 3].map(|i| children.get(i).map_or(Child::ROOT, |c| c.0)),
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

impl From<&Ray> for NodeRay {
    fn from(ray: &Ray) -> Self {
        /// A direction of 0 counts as this: finite inverses keep NaN out of the box test.
        const TINY: f32 = 1e-30;
        let inverse = |d: f32| 1.0 / if d.abs() < TINY { TINY.copysign(d) } else { d };
        Self {
            o: ray.o.to_array().map(Vec4::splat),
            d_inv: ray.d.to_array().map(|d| Vec4::splat(inverse(d))),
            negative: ray.d.to_array().map(|d| usize::from(d.is_sign_negative())),
        }
    }
}
