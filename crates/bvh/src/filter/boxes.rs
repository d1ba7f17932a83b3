//! The boxes of a node.

use crate::filter::{FilterRay, each};
use crate::simd::{LANES, Simd};

/// What the boxes of a node are compared with.
#[derive(Clone, Copy)]
pub(crate) struct BoxLanes<S: Simd<LANES>> {
    d_inv: [S::F32; 3],
    /// What to add to plane / d for the distance at which the plane is crossed, at the least and at the most.
    near: [S::F32; 3],
    far: [S::F32; 3],
    /// Which of `[lo, hi]` a ray of this sign enters through.
    negative: [usize; 3],
}

impl<S: Simd<LANES>> BoxLanes<S> {
    /// For boxes whose coordinates are at most `reach` in size.
    #[inline(always)]
    pub(crate) fn new(s: S, ray: &FilterRay, reach: f32) -> Self
    where
        S: Simd<4>,
    {
        let [d_inv, near, far] = axes(s, ray, reach);
        let splat = |x: f32| Simd::<LANES>::splat(s, x);
        Self {
            d_inv: each(|axis| splat(d_inv[axis])),
            near: each(|axis| splat(near[axis])),
            far: each(|axis| splat(far[axis])),
            negative: each(|axis| usize::from(ray.d[axis].is_sign_negative())),
        }
    }

    /// For a tree without boxes.
    #[inline(always)]
    pub(crate) fn unused(s: S) -> Self {
        let zero = each(|_| Simd::<LANES>::splat(s, 0.0));
        Self { d_inv: zero, near: zero, far: zero, negative: [0; 3] }
    }

    /// Distances before which the ray is not in the boxes, and which of them it may meet before `t_max`. Where NaN comes in, it
    /// is passed over: distances are numbers.
    #[inline(always)]
    pub(crate) fn meets(&self, s: S, planes: &[[[f32; LANES]; 3]; 2], t_max: f32) -> (S::F32, u32) {
        let cross = |end: usize, axis: usize, offset: S::F32| {
            s.mul_add(s.load(&planes[end & 1][axis]), self.d_inv[axis], offset)
        };
        let enter = each(|axis| cross(self.negative[axis], axis, self.near[axis]));
        let leave = each(|axis| cross(1 - self.negative[axis], axis, self.far[axis]));
        let near = s.max(s.max(enter[0], enter[1]), s.max(enter[2], s.splat(0.0)));
        let far = s.min(s.min(leave[0], leave[1]), s.min(leave[2], s.splat(t_max)));
        (near, s.bits(s.not_gt(near, far)))
    }
}

/// For each axis, what [`BoxLanes`] holds in all lanes.
///
/// plane / d − o / d takes three roundings, and o and d may have been rounded before: five, each at most half an ulp of
/// (|plane| + |o|) / |d|. The distances are moved by more than that, once for all boxes. Beyond the range of the numbers
/// they become infinite or NaN, and rule nothing out.
#[inline(always)]
fn axes<S: Simd<4>>(s: S, ray: &FilterRay, reach: f32) -> [[f32; 4]; 3] {
    /// A direction of 0 counts as this share of the longest: finite inverses keep NaN out. By the slack below, boxes
    /// are still wide enough for rays that run along them, up to 1e13 times their distance from the origin.
    const TINY: f32 = 1e-20;
    const SLACK: f32 = 4.5 * f32::EPSILON;
    let load = |[x, y, z]: [f32; 3]| s.load(&[x, y, z, 1.0]);
    let (o, d) = (load(ray.o), load(ray.d));
    let d_inv = s.div(s.splat(1.0), s.flip(s.max(s.abs(d), s.splat(TINY * ray.d_max)), d));
    let slack = s.mul(s.mul(s.add(s.splat(reach), s.abs(o)), s.abs(d_inv)), s.splat(SLACK));
    let to_origin = s.mul(o, d_inv);
    let near = s.sub(s.sub(s.splat(0.0), slack), to_origin);
    [s.store(d_inv), s.store(near), s.store(s.sub(slack, to_origin))]
}
