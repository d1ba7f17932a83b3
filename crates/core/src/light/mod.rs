//! Light that comes from no surface.

mod environment;

pub use environment::{Constant, EnvironmentDesc, Gradient, NoLight};
