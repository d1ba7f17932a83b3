//! From uniform numbers to directions and points.

mod mis;
mod solid_angle;
mod warp;

pub use mis::power_heuristic;
pub use solid_angle::{FlatSample, SphereCone, SphereSample, SphericalRectangle, SphericalTriangle, pdf_from_area};
pub use warp::{cosine_hemisphere, uniform_ball, uniform_disk, uniform_sphere, uniform_triangle};
