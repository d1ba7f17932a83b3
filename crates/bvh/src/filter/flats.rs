//! Triangles and quads: on which side of each edge does the ray pass?

use crate::filter::outline::Outline;
use crate::filter::{FilterRay, UNDERFLOW};
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

/// Triangles or quads that the ray may meet.
pub(crate) struct Flats<const N: usize, S: Simd<N>> {
    /// Bit i: the ray may meet lane i.
    pub(crate) met: u32,
    /// Bit i: the ray meets lane i for certain, if before the farthest distance.
    certain: u32,
    near: S::F32,
    far: S::F32,
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

impl<const N: usize, S: Simd<N>> Flats<N, S> {
    /// Those of the lanes in use that the ray may meet before `t_max`, if any. Before `t_min`, none is certain.
    #[inline(always)]
    pub(crate) fn meet(
        s: S,
        ray: &FilterRay,
        block: Block,
        outline: &impl Outline<N, S>,
        range: [f32; 2],
    ) -> Option<Self> {
        let [least, most] = outline.sides(s);
        let reach = s.abs(outline.corner()[2]);
        let reach = s.add(reach, s.splat(2.0 * block.size + (ray.o_error + 2.0 * block.error)));
        let nearby = s.mul_add(reach, s.splat(4.0 * ROUNDING * f32::EPSILON), s.splat(ROUNDING * block.size));
        let slack = s.mul_add(reach, nearby, s.splat(UNDERFLOW));
        let is_left = s.not_gt(s.sub(s.splat(0.0), slack), least);
        let met = block.used & s.bits(s.or(is_left, s.not_gt(most, slack)));
        if met == 0 {
            return None;
        }
        let passed = Passed { s, ray, size: block.size, outline, sides: [least, most], reach, slack };
        passed.at(met, range)
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

/// Flat shapes of which the ray's line may meet some.
struct Passed<'a, const N: usize, S: Simd<N>, O> {
    s: S,
    ray: &'a FilterRay,
    size: f32,
    outline: &'a O,
    sides: [S::F32; 2],
    reach: S::F32,
    slack: S::F32,
}

impl<const N: usize, S: Simd<N>, O: Outline<N, S>> Passed<'_, N, S, O> {
    /// At what distances they are met. The point is between the corners, so its distance is between theirs.
    #[inline(always)]
    fn at(self, met: u32, [t_min, t_max]: [f32; 2]) -> Option<Flats<N, S>> {
        let Self { s, ray, size, outline, sides: [least, most], reach, slack } = self;
        let slack_along = s.mul(reach, s.splat(ALONG * ray.along_inv.abs()));
        let [first, last] = outline.span(s, s.splat(-ray.along_inv));
        let (mut near, mut far) = (s.sub(first, slack_along), s.add(last, slack_along));
        if size > ray.large {
            let [least, most] = self.narrow();
            // Of NaN and a number, the number.
            (near, far) = (s.max(least, near), s.min(most, far));
        }
        let before = s.not_gt(near, s.splat(t_max));
        let met = met & s.bits(s.and(before, s.not_gt(s.splat(0.0), far)));
        if met == 0 {
            return None;
        }
        // The slack is for vertices near the ray; up to twice as far away, it is less than four times as much.
        let slack = s.mul(s.splat(4.0), slack);
        let inside = s.or(s.gt(least, slack), s.gt(s.sub(s.splat(0.0), slack), most));
        /// Areas of such shapes near the ray are within the range of the numbers.
        const LARGEST: f32 = 1e18;
        let nearby = if size < LARGEST { 4.0 * size } else { 0.0 };
        let [x, y, _] = outline.corner();
        let nearby = s.gt(s.splat(nearby), s.max(s.abs(x), s.abs(y)));
        let certain = met & s.bits(s.and(s.and(inside, nearby), s.gt(near, s.splat(t_min))));
        Some(Flats { met, certain, near, far })
    }

    /// Bounds for the distances that are closer together, for large shapes: by the mean of the corners' with the areas as
    /// weights, and by how far that may be off.
    #[inline(always)]
    fn narrow(&self) -> [S::F32; 2] {
        let (s, along_inv) = (self.s, self.ray.along_inv);
        let [area, weighed] = self.outline.weigh(s);
        let area_inv = s.div(s.splat(1.0), area);
        let mean = s.mul(s.mul(weighed, area_inv), s.splat(-along_inv));
        let off = s.mul(s.mul(s.mul(self.slack, s.abs(area_inv)), s.splat(8.0 * along_inv.abs())), self.reach);
        [s.sub(mean, off), s.add(mean, off)]
    }
}
