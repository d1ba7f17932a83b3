//! Triangles and quads: u, v and t of Möller & Trumbore 1997, each times the determinant, and how far they may be off.

use crate::filter::{FilterRay, ROUNDING, UNDERFLOW, cross, dot, largest, sub3};
use crate::simd::Simd;

/// Primitives that are spanned by three points, or by a point and two edges if `QUAD`, with the ray's coordinates in them.
pub(crate) struct Corners<const N: usize, const QUAD: bool, S: Simd<N>> {
    /// Bit i: the ray may meet lane i.
    pub(crate) met: u32,
    u: S::F32,
    v: S::F32,
    t: S::F32,
    det: S::F32,
    /// The most by which u, v and det are off, and by which t is.
    slack: S::F32,
    slack_t: S::F32,
}

impl<const N: usize, const QUAD: bool, S: Simd<N>> Corners<N, QUAD, S> {
    /// Those of the lanes `used` that the ray may meet before `t_max`, if any. They lie in a box whose longest side is `size`;
    /// the points are off by a rounding of `error` at most.
    #[inline(always)]
    pub(crate) fn meet(
        s: S,
        ray: &FilterRay,
        corner: [[S::F32; 3]; 3],
        (size, error): (f32, f32),
        used: u32,
        t_max: f32,
    ) -> Option<Self> {
        let [a, b, c] = corner;
        let (e1, e2) = if QUAD { (b, c) } else { (sub3(s, b, a), sub3(s, c, a)) };
        let (from_a, d) = (sub3(s, ray.o(s), a), ray.d(s));
        let p = cross(s, d, e2);
        let q = cross(s, from_a, e1);
        let det = dot(s, e1, p);
        let u = s.flip(dot(s, from_a, p), det);
        let v = s.flip(dot(s, d, q), det);
        let t = s.flip(dot(s, e2, q), det);
        let det = s.abs(det);
        let reach = s.add(largest(s, from_a), s.splat(size + (ray.o_error + error)));
        let slack = s.mul_add(reach, s.splat(ROUNDING * ray.d_max * size), s.splat(UNDERFLOW));
        let outside = if QUAD { s.max(u, v) } else { s.add(u, v) };
        let inside = s.and(
            s.not_gt(s.sub(s.splat(0.0), slack), s.min(u, v)),
            s.not_gt(outside, s.mul_add(s.splat(2.0), slack, det)),
        );
        let met = used & s.bits(inside);
        if met == 0 {
            return None;
        }
        let slack_t = s.mul_add(s.mul(reach, reach), s.splat(2.0 * ROUNDING * size), s.splat(UNDERFLOW));
        let ahead = s.not_gt(s.sub(s.splat(0.0), slack_t), t);
        let before = s.not_gt(t, s.mul_add(s.add(det, slack), s.splat(t_max), slack_t));
        let met = met & s.bits(s.and(ahead, before));
        (met != 0).then_some(Self { met, u, v, t, det, slack, slack_t })
    }

    /// Lanes whose plane the ray crosses inside for certain.
    #[inline(always)]
    fn inside(&self, s: S) -> S::Mask {
        let within = |x: S::F32| s.gt(self.det, s.mul_add(s.splat(3.0), self.slack, x));
        let inside = if QUAD { s.and(within(self.u), within(self.v)) } else { within(s.add(self.u, self.v)) };
        // Nor seen edge-on.
        let upright = s.gt(self.det, s.mul(s.splat(8.0), self.slack));
        s.and(s.and(inside, upright), s.gt(s.min(self.u, self.v), self.slack))
    }

    /// Bit i: the ray meets lane i after `t_min` and before `t_max` for certain.
    #[inline(always)]
    pub(crate) fn certain(&self, s: S, t_min: f32, t_max: f32) -> u32 {
        let after = s.gt(s.sub(self.t, self.slack_t), s.mul(s.add(self.det, self.slack), s.splat(t_min)));
        let before = s.gt(s.mul(s.sub(self.det, self.slack), s.splat(t_max)), s.add(self.t, self.slack_t));
        self.met & s.bits(s.and(self.inside(s), s.and(after, before)))
    }

    /// Between which distances the ray meets a lane if it does.
    #[inline(always)]
    pub(crate) fn distances(&self, s: S) -> ([f32; N], [f32; N]) {
        let near = s.div(s.sub(self.t, self.slack_t), s.add(self.det, self.slack));
        let far = s.div(s.add(self.t, self.slack_t), s.sub(self.det, self.slack));
        (s.store(near), s.store(far))
    }
}
