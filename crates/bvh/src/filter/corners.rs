//! Triangles and quads, seen along the ray as the exact test sees them (`shape/flat.rs`): on which side of each edge it passes.

use crate::filter::{FilterRay, UNDERFLOW, each};
use crate::simd::Simd;

/// How far the area that the ray and an edge span may be off, relative to the size of the primitive and its distance.
///
/// For a primitive that is met, vertices lie within twice its size of the ray, across it. Each coordinate of these is off by at
/// most three roundings of the distance, if the origin and the direction were rounded before; a product of two, by four times
/// their product with the size, and a rounding of its own; the difference of two products by 32 roundings. This is twice that.
/// Where the distance's roundings are more than the size, they take its place.
const ROUNDING: f32 = 64.0 * f32::EPSILON;

/// How far distances along the ray may be off, relative to themselves and to the size.
const ALONG: f32 = 8.0 * f32::EPSILON;

/// Primitives with `M` corners each, seen from the ray.
pub(crate) struct Corners<const N: usize, const M: usize, S: Simd<N>> {
    /// Bit i: the ray may meet lane i.
    pub(crate) met: u32,
    /// Bit i: the ray meets lane i for certain, if before the farthest distance.
    certain: u32,
    near: S::F32,
    far: S::F32,
}

/// A corner in the space of the ray: across it, and along the axis that is nearest to its direction; all negated.
pub(crate) type Corner<V> = [V; 3];

/// A ray as corners are seen from it.
pub(crate) struct View<const N: usize, S: Simd<N>> {
    s: S,
    order: [usize; 3],
    o: [S::F32; 3],
    shear: [S::F32; 2],
}

impl<const N: usize, S: Simd<N>> View<N, S> {
    #[inline(always)]
    pub(crate) fn new(s: S, ray: &FilterRay) -> Self {
        let shear = [s.splat(ray.shear[0]), s.splat(ray.shear[1])];
        Self { s, order: ray.order, o: each(|axis| s.splat(ray.turned_o[axis])), shear }
    }

    /// A point, for each axis the coordinate in each lane.
    #[inline(always)]
    pub(crate) fn point(&self, p: &[[f32; N]; 3]) -> Corner<S::F32> {
        let [x, y, z] = self.load(p);
        self.sheared([self.s.sub(self.o[0], x), self.s.sub(self.o[1], y), self.s.sub(self.o[2], z)])
    }

    /// The corners of a triangle.
    #[inline(always)]
    pub(crate) fn points(&self, [a, b, c]: &[[[f32; N]; 3]; 3]) -> [Corner<S::F32>; 3] {
        [self.point(a), self.point(b), self.point(c)]
    }

    /// The corners of a quad: of a corner and two edges.
    #[inline(always)]
    pub(crate) fn quad(&self, [corner, u, v]: &[[[f32; N]; 3]; 3]) -> [Corner<S::F32>; 4] {
        let (corner, u, v) = (self.point(corner), self.edge(u), self.edge(v));
        let next = self.add(corner, u);
        [corner, next, self.add(next, v), self.add(corner, v)]
    }

    /// From one point to another.
    #[inline(always)]
    fn edge(&self, to: &[[f32; N]; 3]) -> Corner<S::F32> {
        let ([x, y, z], zero) = (self.load(to), self.s.splat(0.0));
        self.sheared([self.s.sub(zero, x), self.s.sub(zero, y), self.s.sub(zero, z)])
    }

    #[inline(always)]
    fn load(&self, p: &[[f32; N]; 3]) -> [S::F32; 3] {
        let [x, y, z] = self.order;
        debug_assert!(x.max(y).max(z) < 3);
        // SAFETY: the order is one of `ORDERS`.
        unsafe { [self.s.load(p.get_unchecked(x)), self.s.load(p.get_unchecked(y)), self.s.load(p.get_unchecked(z))] }
    }

    #[inline(always)]
    fn sheared(&self, [x, y, z]: [S::F32; 3]) -> Corner<S::F32> {
        [self.s.neg_mul_add(self.shear[0], z, x), self.s.neg_mul_add(self.shear[1], z, y), z]
    }

    /// The other end of an edge.
    #[inline(always)]
    fn add(&self, point: Corner<S::F32>, edge: Corner<S::F32>) -> Corner<S::F32> {
        each(|axis| self.s.add(point[axis], edge[axis]))
    }
}

/// What a block of primitives says of itself.
#[derive(Clone, Copy)]
pub(crate) struct Block {
    /// Bit i: lane i is in use.
    pub(crate) used: u32,
    /// The longest side of the box around all primitives.
    pub(crate) size: f32,
    /// The corners are off by a rounding of this at most.
    pub(crate) error: f32,
}

impl<const N: usize, const M: usize, S: Simd<N>> Corners<N, M, S> {
    /// Those of the lanes in use that the ray may meet before `t_max`, if any. Before `t_min`, none is certain.
    #[inline(always)]
    pub(crate) fn meet(
        s: S,
        ray: &FilterRay,
        block: Block,
        corners: [Corner<S::F32>; M],
        [t_min, t_max]: [f32; 2],
    ) -> Option<Self> {
        let side = |i: usize| {
            let (from, to) = (corners[i], corners[(i + 1) % M]);
            s.mul_sub(from[0], to[1], s.mul(from[1], to[0]))
        };
        let sides: [S::F32; M] = corners_of(side);
        let reach = s.add(s.abs(corners[0][2]), s.splat(2.0 * block.size + (ray.o_error + 2.0 * block.error)));
        let nearby = s.mul_add(reach, s.splat(4.0 * ROUNDING * f32::EPSILON), s.splat(ROUNDING * block.size));
        let slack = s.mul_add(reach, nearby, s.splat(UNDERFLOW));
        let (least, most) = (fold(sides, |a, b| s.min(a, b)), fold(sides, |a, b| s.max(a, b)));
        let is_left = s.not_gt(s.sub(s.splat(0.0), slack), least);
        let met = block.used & s.bits(s.or(is_left, s.not_gt(most, slack)));
        if met == 0 {
            return None;
        }
        let seen = Seen { s, corners, sides, reach, slack, size: block.size };
        seen.at(ray, met, (least, most), [t_min, t_max])
    }

    /// Bit i: the ray meets lane i, and before `t_max`, for certain.
    #[inline(always)]
    pub(crate) fn certain(&self, s: S, t_max: f32) -> u32 {
        self.certain & s.bits(s.gt(s.splat(t_max), self.far))
    }

    /// Between which distances the ray meets a lane if it does.
    #[inline(always)]
    pub(crate) fn distances(&self, s: S) -> ([f32; N], [f32; N]) {
        (s.store(self.near), s.store(self.far))
    }
}

/// Primitives near the ray.
struct Seen<const N: usize, const M: usize, S: Simd<N>> {
    s: S,
    corners: [Corner<S::F32>; M],
    sides: [S::F32; M],
    reach: S::F32,
    slack: S::F32,
    size: f32,
}

impl<const N: usize, const M: usize, S: Simd<N>> Seen<N, M, S> {
    /// At what distances they are met. The point is between the corners, so its distance is between theirs; for large
    /// primitives, the mean of their distances with the areas as weights is closer.
    #[inline(always)]
    fn at(
        self,
        ray: &FilterRay,
        met: u32,
        (least, most): (S::F32, S::F32),
        [t_min, t_max]: [f32; 2],
    ) -> Option<Corners<N, M, S>> {
        let Self { s, corners, reach, slack, size, .. } = self;
        let along_inv = s.splat(-ray.along_inv);
        let along: [S::F32; M] = corners_of(|i| s.mul(corners[i][2], along_inv));
        let slack_along = s.mul(reach, s.splat(ALONG * ray.along_inv.abs()));
        let mut near = s.sub(fold(along, |a, b| s.min(a, b)), slack_along);
        let mut far = s.add(fold(along, |a, b| s.max(a, b)), slack_along);
        let (area, weighed) = self.weigh(along);
        let area_inv = s.div(s.splat(1.0), area);
        let mean = s.mul(weighed, area_inv);
        let off = s.mul(s.mul(s.mul(slack, s.abs(area_inv)), s.splat(8.0 * ray.along_inv.abs())), reach);
        // Of NaN and a number, the number.
        near = s.max(s.sub(mean, off), near);
        far = s.min(s.add(mean, off), far);
        let before = s.not_gt(near, s.splat(t_max));
        let met = met & s.bits(s.and(before, s.not_gt(s.splat(0.0), far)));
        if met == 0 {
            return None;
        }
        // The slack is for vertices near the ray; up to twice as far away, it is less than four times as much.
        let slack = s.mul(s.splat(4.0), slack);
        let inside = s.or(s.gt(least, slack), s.gt(s.sub(s.splat(0.0), slack), most));
        let nearby = s.gt(s.splat(4.0 * size), s.max(s.abs(corners[0][0]), s.abs(corners[0][1])));
        // Nor beyond the range of the numbers.
        let finite = s.gt(s.splat(f32::MAX), s.abs(area));
        let certain = s.and(s.and(inside, nearby), s.and(finite, s.gt(near, s.splat(t_min))));
        let certain = met & s.bits(certain);
        Some(Corners { met, certain, near, far })
    }

    /// The area, and the mean of the corners' distances times it.
    #[inline(always)]
    fn weigh(&self, along: [S::F32; M]) -> (S::F32, S::F32) {
        let (s, sides) = (self.s, &self.sides);
        if M == 3 {
            let area = s.add(s.add(sides[0], sides[1]), sides[2]);
            return (area, s.mul_add(sides[1], along[0], s.mul_add(sides[2], along[1], s.mul(sides[0], along[2]))));
        }
        // From the first corner of a parallelogram along both edges, by the areas at the others.
        let area = s.add(sides[0], sides[2]);
        let by_edge = s.mul(sides[M - 1], s.sub(along[1], along[0]));
        let by_both = s.mul_add(sides[0], s.sub(along[M - 1], along[0]), by_edge);
        (area, s.mul_add(area, along[0], by_both))
    }
}

/// One value for each corner; [`each`] tells why not by the standard library.
#[inline(always)]
fn corners_of<T: Copy, const M: usize>(f: impl Fn(usize) -> T) -> [T; M] {
    let mut all = [f(0); M];
    let mut i = 1;
    while i < M {
        all[i] = f(i);
        i += 1;
    }
    all
}

#[inline(always)]
fn fold<T: Copy, const M: usize>(values: [T; M], f: impl Fn(T, T) -> T) -> T {
    let mut all = values[0];
    let mut i = 1;
    while i < M {
        all = f(values[i], all);
        i += 1;
    }
    all
}
