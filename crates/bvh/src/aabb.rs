//! Axis-aligned bounding boxes.

use glam::Vec3;

/// The box of all points between `lo` and `hi`; empty if any `lo` exceeds its `hi`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aabb {
    /// Lowest corner.
    pub lo: Vec3,
    /// Highest corner.
    pub hi: Vec3,
}

impl Aabb {
    /// The box without points: the neutral element of [`union`](Self::union).
    pub const EMPTY: Self = Self { lo: Vec3::INFINITY, hi: Vec3::NEG_INFINITY };

    /// A box around points that are off by a rounding at most, wider by a few, so that a ray along a face, with a direction of
    /// 0 across it, is inside.
    #[inline]
    pub(crate) fn around(points: impl IntoIterator<Item = Vec3>) -> Self {
        /// Times the inverse of the smallest direction, this is longer than any ray.
        const LEAST: f32 = 1e-18;
        let Self { lo, hi } = points.into_iter().fold(Self::EMPTY, |b, p| b.union(Self { lo: p, hi: p }));
        let margin = |p: Vec3| p.abs() * (2.0 * f32::EPSILON) + LEAST;
        // With its margin, what is out of single precision's reach is infinite.
        let within = |p: Vec3| p.max(Vec3::MIN).min(Vec3::MAX);
        let (lo, hi) = (within(lo), within(hi));
        Self { lo: lo - margin(lo), hi: hi + margin(hi) }
    }

    /// The smallest box around both.
    pub fn union(self, other: Self) -> Self {
        Self { lo: self.lo.min(other.lo), hi: self.hi.max(other.hi) }
    }

    /// Half the surface area, to which the chance that a ray meets the box is proportional; 0 if empty.
    pub fn half_area(self) -> f32 {
        let e = (self.hi - self.lo).max(Vec3::ZERO);
        e.x * e.y + e.y * e.z + e.z * e.x
    }
}
