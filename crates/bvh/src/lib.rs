//! Rays against shapes: spheres, quads and triangles in, the nearest hit out.
//!
//! [`Bvh::build`] sorts the primitives into a bounding volume hierarchy by the surface area heuristic;
//! [`Bvh::intersect`] walks it. The nearest hit is a property of the primitives and the ray alone: it does
//! not depend on the order of the primitives, on the tree, or on whether there is one ([`Bvh::list`]).
//!
//! ```
//! use eyebeam_bvh::{Bvh, Primitive, Quality, Ray, Sphere};
//! use glam::Vec3;
//!
//! # fn main() -> Result<(), eyebeam_bvh::BuildError> {
//! let ball = Sphere { center: Vec3::ZERO, radius: 1.0 };
//! let bvh = Bvh::build(&vec![Primitive::Sphere(ball)], Quality::Balanced)?;
//! let hit = bvh.intersect(&Ray::new(Vec3::new(0.0, 0.0, 5.0), Vec3::NEG_Z)).unwrap();
//! assert_eq!((hit.t, hit.prim), (4.0, 0));
//! # Ok(())
//! # }
//! ```
#![deny(unsafe_op_in_unsafe_fn)]

mod aabb;
mod build;
mod bvh;
mod error;
mod filter;
mod geometry;
mod instance;
mod ray;
mod search;
mod shape;
mod simd;
mod stats;
mod traverse;
mod validate;
mod wide;

pub use aabb::Aabb;
pub use build::Quality;
pub use bvh::Bvh;
pub use error::BuildError;
pub use geometry::{Geometry, Mesh};
pub use instance::{Affine, Instance};
pub use ray::{Hit, Ray};
pub use shape::{MovingTriangle, Primitive, Quad, Sphere, Surface, Triangle};
pub use simd::Isa;
pub use stats::Stats;
