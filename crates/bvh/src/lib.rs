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
//!
//! # Instances
//!
//! A tree can show other trees, each as often as it likes, moved, turned, mirrored, stretched and sheared, up to
//! [three](Hit::MAX_NESTING) within each other. Distances are those of the outermost ray.
//!
//! ```
//! use std::sync::Arc;
//!
//! use eyebeam_bvh::{Affine, BuildError, Bvh, Geometry, Instance, Primitive, Quality, Ray, Sphere};
//! use glam::{DVec3, Vec3};
//!
//! struct Forest {
//!     places: Vec<Affine>,
//!     objects: Vec<Arc<Bvh>>,
//! }
//!
//! impl Geometry for Forest {
//!     fn len(&self) -> usize {
//!         self.places.len()
//!     }
//!
//!     fn primitive(&self, index: usize) -> Primitive {
//!         Primitive::Instance(Instance::new(0, self.places[index]))
//!     }
//!
//!     fn objects(&self) -> &[Arc<Bvh>] {
//!         &self.objects
//!     }
//! }
//!
//! # fn main() -> Result<(), BuildError> {
//! let ball = Primitive::Sphere(Sphere { center: Vec3::ZERO, radius: 1.0 });
//! let object = Arc::new(Bvh::build(&vec![ball], Quality::Balanced)?);
//! let tall = Affine { axes: [Vec3::X, 3.0 * Vec3::Y, Vec3::Z], offset: 10.0 * Vec3::X };
//! let forest = Forest { places: vec![Affine::IDENTITY, tall], objects: vec![object] };
//! let bvh = Bvh::build(&forest, Quality::Balanced)?;
//!
//! let ray = Ray::new(Vec3::new(10.0, 5.0, 0.0), Vec3::NEG_Y);
//! let hit = bvh.intersect(&ray).unwrap();
//! assert_eq!((hit.t, hit.instances[0], hit.prim), (2.0, 1, 0));
//! // The surface is that of the object; from there to the world:
//! let top = bvh.to_world(&hit, ray.time).transform_point3(DVec3::Y);
//! assert_eq!(top, DVec3::new(10.0, 3.0, 0.0));
//! # Ok(())
//! # }
//! ```
//!
//! # Motion
//!
//! Triangles and instances move on straight lines while they exist. A motion of several keys is several primitives, one for
//! each interval; at a key both are there, in the same place, and the first counts.
//!
//! ```
//! use eyebeam_bvh::{BuildError, Bvh, MovingTriangle, Primitive, Quality, Ray, Triangle};
//! use glam::Vec3;
//!
//! # fn main() -> Result<(), BuildError> {
//! let at = |z| Triangle { a: Vec3::new(-1.0, -1.0, z), b: Vec3::new(1.0, -1.0, z), c: Vec3::new(0.0, 1.0, z) };
//! let keys = [(0.0, at(0.0)), (0.5, at(-4.0)), (1.0, at(-5.0))];
//! let moving = keys.windows(2).map(|key| {
//!     let [(start, from), (end, to)] = [key[0], key[1]];
//!     Primitive::MovingTriangle(MovingTriangle { at: [from, to], time: [start, end] })
//! });
//! let bvh = Bvh::build(&moving.collect::<Vec<_>>(), Quality::Balanced)?;
//!
//! let seen = |time| bvh.intersect(&Ray { time, ..Ray::new(Vec3::Z, Vec3::NEG_Z) }).map(|hit| (hit.t, hit.prim));
//! assert_eq!(seen(0.25), Some((3.0, 0)));
//! assert_eq!(seen(0.5), Some((5.0, 0)));
//! assert_eq!(seen(0.75), Some((5.5, 1)));
//! assert_eq!(seen(1.5), None);
//! # Ok(())
//! # }
//! ```
//!
//! # Holes
//!
//! A callback decides which hits count ([`Bvh::intersect_where`]): by a texture, say, or to leave out what a ray begins on.
//!
//! ```
//! use eyebeam_bvh::{BuildError, Bvh, Hit, Primitive, Quad, Quality, Ray};
//! use glam::Vec3;
//!
//! # fn main() -> Result<(), BuildError> {
//! let leaf = |z| Primitive::Quad(Quad { corner: Vec3::new(0.0, 0.0, z), u: Vec3::X, v: Vec3::Y });
//! let bvh = Bvh::build(&vec![leaf(2.0), leaf(1.0)], Quality::Balanced)?;
//! // Of the leaf in front, half is transparent.
//! let is_opaque = |hit: &Hit| hit.prim == 0 || hit.u < 0.5;
//!
//! let seen = |x| bvh.intersect_where(&Ray::new(Vec3::new(x, 0.5, 0.0), Vec3::Z), is_opaque).map(|hit| hit.prim);
//! assert_eq!((seen(0.25), seen(0.75)), (Some(1), Some(0)));
//! # Ok(())
//! # }
//! ```
//!
//! # What is promised
//!
//! Lengths and times have no unit: they are the caller's. Coordinates are 0 or from 1e-18 to 1e18 in size, and so are the
//! lengths of directions, in the space of the ray and in that of each object that it comes to. Then:
//!
//! - **Hits are a property of the primitives and the ray.** They are the same bits with every [`Quality`], every [`Isa`], any
//!   number of threads, one by one and in batches, after [`refit`](Bvh::refit), and without a tree ([`Bvh::list`]).
//! - **Distances** are computed in double precision, and rounded once. Of hits at the same rounded distance, the one of the
//!   lowest index counts: first that in the outermost list, then that within the instance, and so on.
//! - **Closed meshes are closed.** Triangles that share two vertices, bit by bit, leave no gap at their edge, from wherever
//!   they are seen, however thin they are; nor do triangles that move, if the shared vertices and times are the same, nor
//!   those of one object within an instance. The two halves of a quad are such triangles.
//! - **Both sides** of every surface are hit.
//! - [`occluded`](Bvh::occluded) says whether [`intersect`](Bvh::intersect) finds something, always.
//! - Nothing that is traced allocates memory, takes a lock or panics. Rays end, whatever their numbers are.
//! - A [`Bvh`] can be read from many threads at once, and moved between them.
//!
//! # What is not promised
//!
//! - Neighbours are not watertight against each other where they share no vertices: instances that touch, quads that share an
//!   edge but were given by other corners, spheres that touch.
//! - A ray that begins on a surface, as far as single precision can tell, may hit this surface again just ahead, or not.
//!   Whoever wants neither lets rays begin a little off it, or rejects the primitive.
//! - Triangles without area are left out. A mesh that needs one to be closed, where a vertex lies on the edge of another
//!   triangle, may have a gap there, a rounding of double precision wide.
//! - A triangle that is seen exactly edge-on, as a line, is not hit. One that is seen nearly so is hit at a distance between
//!   those of its vertices, and its `u` and `v` are in 0..=1, but where in between may be anybody's guess.
//! - Of a sphere there is one hit: where the ray enters or, from inside, where it leaves. If a callback rejects that, the ray
//!   passes the sphere.
//! - How often, for which hits and in which order callbacks are asked differs between trees.
//! - Motion is linear; rotations are not: between its keys, an instance that turns is a little smaller. Boxes are around
//!   whole intervals, so what moves far slows rays down: more keys help.
//! - The matrix of an instance is undone in double precision: one that stretches a direction by 1e10 times as much as
//!   another leaves six digits.
//! - Beyond the range above, and where a number of the ray is infinite or not a number, rays end, but what they hit is not
//!   specified.
//! - Hits are not promised to be the same bits in another version of the crate.
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
pub use search::Slot;
pub use shape::{MovingTriangle, Primitive, Quad, Sphere, Surface, Triangle};
pub use simd::Isa;
pub use stats::Stats;
