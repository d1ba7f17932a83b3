//! Rays against shapes: spheres, quads and triangles in, the nearest hit out.
//!
//! [`Bvh::build`] sorts the primitives into a bounding volume hierarchy by the surface area heuristic;
//! [`Bvh::intersect`] walks it. The nearest hit is a property of the primitives and the ray alone: it does
//! not depend on the order of the primitives, on the tree, or on whether there is one ([`Bvh::list`]).
//!
//! ```
//! use eyebeam_bvh::{Bvh, Primitive, Ray, Sphere};
//! use glam::Vec3;
//!
//! let ball = Sphere { center: Vec3::ZERO, radius: 1.0 };
//! let bvh = Bvh::build(vec![Primitive::Sphere(ball)]);
//! let hit = bvh.intersect(&Ray::new(Vec3::new(0.0, 0.0, 5.0), Vec3::NEG_Z)).unwrap();
//! assert_eq!((hit.t, hit.prim), (4.0, 0));
//! ```
#![forbid(unsafe_code)]

mod aabb;
mod build;
mod node;
mod primitive;
mod quad;
mod ray;
mod span;
mod sphere;
mod traverse;
mod triangle;

pub use aabb::Aabb;
pub use primitive::Primitive;
pub use quad::Quad;
pub use ray::{Hit, Ray};
pub use sphere::Sphere;
pub use traverse::Bvh;
pub use triangle::Triangle;
