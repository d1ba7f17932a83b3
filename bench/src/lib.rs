//! How fast the renderer is, and what to compare it with: a textbook program, and Embree.
#![deny(unsafe_code)]

pub mod kernel;
pub mod measure;
pub mod textbook;
mod vec3;
