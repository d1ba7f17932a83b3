//! From uniform numbers to directions and points.

mod warp;

pub use warp::{cosine_hemisphere, uniform_ball, uniform_disk, uniform_sphere};
