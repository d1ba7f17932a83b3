//! Light and colour.

mod rgb;
mod spectrum;

pub use rgb::{Rgb, luminance, srgb_decode, srgb_encode};
pub use spectrum::Spectrum;
