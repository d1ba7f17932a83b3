//! Light and colour.

mod observer;
mod rgb;
mod spectrum;

pub(crate) use observer::{LUMENS_PER_WATT, XYZ_TO_RGB, x_bar, y_bar, z_bar};
pub use rgb::{Rgb, luminance, srgb_decode, srgb_encode};
pub use spectrum::Spectrum;
