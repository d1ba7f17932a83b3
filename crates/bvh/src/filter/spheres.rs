//! Spheres: how far the ray's line passes from the centre.

use crate::filter::{FilterRay, UNDERFLOW, each};
use crate::simd::Simd;
use crate::wide::SphereBlock;

/// Rounding errors of the sums of products in these tests, relative to their largest factors: about 20 roundings each, and
/// fourfold safety.
const ROUNDING: f32 = 40.0 * f32::EPSILON;

/// Bit i: the ray may meet sphere i before `t_max`.
#[inline(always)]
pub(crate) fn meets_spheres<const N: usize, S: Simd<N>>(
    s: S,
    ray: &FilterRay,
    block: &SphereBlock<N>,
    t_max: f32,
) -> u32 {
    let (d, radius) = (each(|axis| s.splat(ray.d[axis])), s.load(&block.radius));
    let to_center = sub3(s, each(|axis| s.load(&block.center[axis])), each(|axis| s.splat(ray.o[axis])));
    let r_sq = s.mul(radius, radius);
    let d_sq = dot(s, d, d);
    let along = dot(s, to_center, d);
    let distance_sq = dot(s, to_center, to_center);
    let reach = s.add(largest(s, to_center), s.splat(ray.o_error));
    // |c − o|² |d|² − ((c − o) · d)² ≤ r² |d|²
    let slack = s.mul_add(s.mul(reach, reach), s.splat(3.0 * ROUNDING), s.splat(UNDERFLOW));
    let off_axis = s.mul_sub(distance_sq, d_sq, s.mul(along, along));
    let widest = s.mul_add(s.add(r_sq, slack), d_sq, s.splat(UNDERFLOW));
    let met = block.used & s.bits(s.not_gt(off_axis, widest));
    if met == 0 {
        return 0;
    }
    let slack_along = s.mul_add(s.add(reach, radius), s.splat(ROUNDING * ray.d_max), s.splat(UNDERFLOW));
    let ahead =
        s.bits(s.not_gt(s.sub(s.splat(0.0), slack_along), along)) | s.bits(s.not_gt(distance_sq, s.add(r_sq, slack)));
    // The near side is at most a radius before the middle of the chord; |d| ≤ √3 of its largest component.
    let near = s.sub(along, s.mul_add(radius, s.splat(1.75 * ray.d_max), slack_along));
    met & ahead & s.bits(s.not_gt(near, s.mul_add(s.splat(t_max), d_sq, s.splat(UNDERFLOW))))
}

#[inline(always)]
fn sub3<const N: usize, S: Simd<N>>(s: S, a: [S::F32; 3], b: [S::F32; 3]) -> [S::F32; 3] {
    each(|axis| s.sub(a[axis], b[axis]))
}

#[inline(always)]
fn dot<const N: usize, S: Simd<N>>(s: S, a: [S::F32; 3], b: [S::F32; 3]) -> S::F32 {
    s.mul_add(a[0], b[0], s.mul_add(a[1], b[1], s.mul(a[2], b[2])))
}

/// The largest component, by size.
#[inline(always)]
fn largest<const N: usize, S: Simd<N>>(s: S, a: [S::F32; 3]) -> S::F32 {
    s.max(s.abs(a[0]), s.max(s.abs(a[1]), s.abs(a[2])))
}
