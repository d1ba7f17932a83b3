//! What fills the space between surfaces.

mod interior;

pub use interior::{Filling, Interior};
