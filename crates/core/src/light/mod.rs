//! Light that comes from no surface.

mod environment;
pub mod select;

pub use environment::{Constant, EnvironmentDesc, Gradient, NoLight};
