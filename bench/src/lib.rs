//! How fast the renderer is, and a textbook program to compare it with.
#![forbid(unsafe_code)]

pub mod measure;
pub mod textbook;
mod vec3;
