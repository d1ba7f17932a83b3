//! The closed set of shapes that rays are intersected with.

mod quad;
mod span;
mod sphere;
mod triangle;

use crate::aabb::Aabb;
use crate::ray::{PrimHit, RayF64};

pub use quad::Quad;
pub use sphere::Sphere;
pub use triangle::Triangle;

/// A shape that a ray can hit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Primitive {
    /// A sphere.
    Sphere(Sphere),
    /// A parallelogram.
    Quad(Quad),
    /// A triangle.
    Triangle(Triangle),
}

impl Primitive {
    /// The box around the shape, wider by a few roundings.
    #[inline]
    pub fn bounds(&self) -> Aabb {
        match self {
            Self::Sphere(s) => s.bounds(),
            Self::Quad(q) => q.bounds(),
            Self::Triangle(t) => t.bounds(),
        }
    }

    #[inline]
    pub(crate) fn intersect(&self, ray: &RayF64) -> Option<PrimHit> {
        match self {
            Self::Sphere(s) => s.intersect(ray),
            Self::Quad(q) => q.intersect(ray),
            Self::Triangle(t) => t.intersect(ray),
        }
    }
}
