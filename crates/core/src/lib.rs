//! The renderer: what light does between a description of a scene and a picture.
//!
//! ```text
//! SceneDesc ── Scene::build ──► Scene ── Render::step ──► Film ── develop ──► Image
//! ```
//!
//! [`desc::SceneDesc`] is what a file or a program said, [`scene::Scene`] what is rendered, [`render::Render`] a
//! picture in the making. Nothing here opens a file or prints.
//!
//! ```
//! use eyebeam_core::desc::SceneDesc;
//! use eyebeam_core::render::{Monitor, Render, Settings};
//! use eyebeam_core::scene::Scene;
//! use eyebeam_core::shape::SphereDesc;
//!
//! let mut desc = SceneDesc::default();
//! desc.shape.sphere.push(SphereDesc { center: [0.0, 0.0, 0.0], radius: 1.0, ..SphereDesc::default() });
//! let scene = Scene::build(&desc).unwrap();
//! let settings = Settings { width: 32, height: 32, spp: 4, ..Settings::from(&desc.render) };
//! let mut render = Render::new(&scene, settings);
//! render.finish(&Monitor::default());
//! let image = render.film().develop();
//! assert!(image.pixel(16, 16)[0] < image.pixel(0, 0)[0], "the ball is darker than the sky");
//! ```
#![forbid(unsafe_code)]

mod array;
pub mod camera;
pub mod color;
pub mod desc;
pub mod film;
pub mod first_hits;
pub mod integrator;
pub mod interaction;
pub mod light;
pub mod look;
pub mod material;
pub mod math;
pub mod medium;
pub mod motion;
pub mod names;
pub mod render;
pub mod sampler;
pub mod sampling;
pub mod scene;
pub mod setup;
pub mod shape;
#[cfg(any(test, feature = "testing"))]
pub mod testing;
pub mod texture;
pub mod validate;
mod warnings;
