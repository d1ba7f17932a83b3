//! Light that comes from no surface.

mod environment;
mod ies;

pub use environment::{Constant, EnvironmentDesc, Gradient, NoLight};
pub use ies::IesProfile;
