//! How fast the renderer is, and what to compare it with: a textbook program, Embree, and other renderers.
#![deny(unsafe_code)]

pub mod kernel;
pub mod materials;
pub mod measure;
pub mod peers;
pub mod strategies;
pub mod textbook;
pub mod textures;
mod vec3;
