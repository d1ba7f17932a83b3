//! The closed set of shapes that rays are intersected with.

mod flat;
mod moving;
mod quad;
mod sphere;
mod triangle;

use std::sync::Arc;

use glam::{DVec3, Vec3};

use crate::aabb::Aabb;
use crate::bvh::Bvh;
use crate::instance::Instance;

pub use moving::MovingTriangle;
pub use quad::Quad;
pub use sphere::Sphere;
pub use triangle::Triangle;

/// Something that a ray can hit. All numbers are single precision, and must be finite; to intersect them, double precision is
/// used. The range in which hits are exact is told [here](crate#what-is-promised).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Primitive {
    /// A triangle.
    Triangle(Triangle),
    /// A parallelogram.
    Quad(Quad),
    /// A sphere.
    Sphere(Sphere),
    /// A triangle that moves.
    MovingTriangle(MovingTriangle),
    /// An object shown again, elsewhere.
    Instance(Instance),
}

/// What was hit, as its points are computed: in double precision, at the time of the ray, in the space of the object.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Surface {
    /// A triangle or a quad: the points `corner + u edges[0] + v edges[1]`; the normal is `edges[0] × edges[1]`.
    Flat {
        /// The first vertex.
        corner: DVec3,
        /// From there to the next two.
        edges: [DVec3; 2],
    },
    /// A sphere.
    Sphere(Sphere),
}

impl Primitive {
    /// The surface at a time; none for an instance, whose object has one.
    #[inline]
    pub(crate) fn surface(&self, time: f32) -> Option<Surface> {
        let flat = |[a, b, c]: [DVec3; 3]| Some(Surface::Flat { corner: a, edges: [b - a, c - a] });
        match self {
            Self::Triangle(t) => flat(t.vertices()),
            Self::MovingTriangle(t) => flat(t.vertices(time)),
            Self::Quad(q) => Some(Surface::Flat { corner: q.corner.as_dvec3(), edges: q.edges() }),
            Self::Sphere(s) => Some(Surface::Sphere(*s)),
            Self::Instance(_) => None,
        }
    }

    /// Whether all its numbers are finite; the times of an instance at rest need not be.
    pub(crate) fn is_finite(&self) -> bool {
        match self {
            Self::Triangle(t) => t.is_finite(),
            Self::Quad(q) => [q.corner, q.u, q.v].into_iter().all(Vec3::is_finite),
            Self::Sphere(s) => s.center.is_finite() && s.radius.is_finite(),
            Self::MovingTriangle(t) => t.at.iter().all(Triangle::is_finite) && t.time.into_iter().all(f32::is_finite),
            Self::Instance(i) => i.is_finite(),
        }
    }

    /// Whether there is nothing to hit: no radius, no area in double precision, or a transform that cannot be undone.
    pub(crate) fn is_degenerate(&self) -> bool {
        match self {
            Self::Triangle(t) => t.is_degenerate(),
            Self::Quad(q) => q.u.as_dvec3().cross(q.v.as_dvec3()) == DVec3::ZERO,
            Self::Sphere(s) => s.radius <= 0.0,
            Self::MovingTriangle(t) => t.at.iter().all(Triangle::is_degenerate) || t.time[0] > t.time[1],
            Self::Instance(i) => i.is_degenerate(),
        }
    }

    /// The box around it at all times, wider by a few roundings; for an instance, around the transformed box of what the list
    /// of objects has for it, and [empty](Aabb::EMPTY) if that is nothing.
    pub fn bounds(&self, objects: &[Arc<Bvh>]) -> Aabb {
        match self {
            Self::Triangle(t) => t.bounds(),
            Self::Quad(q) => q.bounds(),
            Self::Sphere(s) => s.bounds(),
            Self::MovingTriangle(t) => t.bounds(),
            Self::Instance(i) => objects.get(i.object as usize).map_or(Aabb::EMPTY, |object| i.bounds(object)),
        }
    }
}
