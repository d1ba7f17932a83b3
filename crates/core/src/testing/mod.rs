//! Statistical tests of everything that is sampled.
//!
//! Each part of the renderer has a small trait that says what is tested, so that a wrapper can be tested as well as the
//! part itself, and a function `check_…` that says what is promised. [`scenes`] are pictures that are known beforehand, and
//! [`selftest`] is a fast subset of all this.
//!
//! Thresholds are p = 1e-3, divided by the number of tests that are run together; seeds are fixed, so a result never
//! changes without the code. After the chi² tests of Mitsuba (Jakob et al.) and pbrt-v4 (Pharr et al. 2023).

mod camera;
mod cells;
mod chi2;
mod filter;
mod image;
mod light;
mod lights;
mod lobe;
mod numbers;
mod refraction;
pub mod scenes;
mod selection;
pub mod selftest;

pub use camera::{CameraRays, check_camera};
pub use chi2::chi2_counts;
pub use filter::{PixelFilter, check_filter};
pub use image::{Estimate, z_test, z_test_films};
pub use light::{LightSampling, check_light};
pub use lights::lights_of;
pub use lobe::{Lobe, Reciprocal, check_lobe};
pub use numbers::{Numbers, check_numbers};
pub use refraction::check_refraction;
pub use selection::{LightChoice, check_selection};

/// Chance of a false alarm of one test.
pub const SIGNIFICANCE: f64 = 1e-3;
