//! Axis-aligned bounding boxes.

use glam::{DVec3, Vec3};

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

    /// The smallest single-precision box around double-precision points.
    pub(crate) fn around(points: impl IntoIterator<Item = DVec3>) -> Self {
        points.into_iter().fold(Self::EMPTY, |b, p| {
            let near = p.as_vec3();
            let exact = near.as_dvec3();
            let down = |f: f32, e: f64, x: f64| if e > x { f.next_down() } else { f };
            let up = |f: f32, e: f64, x: f64| if e < x { f.next_up() } else { f };
            b.union(Self {
                lo: Vec3::new(down(near.x, exact.x, p.x), down(near.y, exact.y, p.y), down(near.z, exact.z, p.z)),
                hi: Vec3::new(up(near.x, exact.x, p.x), up(near.y, exact.y, p.y), up(near.z, exact.z, p.z)),
            })
        })
    }

    /// The smallest box around both.
    pub fn union(self, other: Self) -> Self {
        Self { lo: self.lo.min(other.lo), hi: self.hi.max(other.hi) }
    }

    /// Wider by the least that counts, so that a ray along a face, with a direction of 0 across it, is inside the box.
    pub(crate) fn padded(self) -> Self {
        /// Times the inverse of the smallest direction, this is longer than any ray.
        const LEAST: f32 = 1e-18;
        Self {
            lo: Vec3::from_array(self.lo.to_array().map(|x| x.next_down().min(x - LEAST))),
            hi: Vec3::from_array(self.hi.to_array().map(|x| x.next_up().max(x + LEAST))),
        }
    }

    /// Half the surface area, to which the chance that a ray meets the box is proportional; 0 if empty.
    pub fn half_area(self) -> f32 {
        let e = (self.hi - self.lo).max(Vec3::ZERO);
        e.x * e.y + e.y * e.z + e.z * e.x
    }

    /// Twice the centre.
    pub(crate) fn centroid_twice(self) -> Vec3 {
        self.lo + self.hi
    }
}
