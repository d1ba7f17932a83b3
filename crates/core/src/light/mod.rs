//! Light that comes from no surface.

mod environment;
pub mod sky;

pub use environment::{Constant, EnvironmentDesc, Gradient, NoLight};
