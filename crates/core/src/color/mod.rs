//! Light and colour.

mod observer;
mod rgb;
mod spectrum;
mod wavelength;

pub use observer::LUMENS_PER_WATT;
pub(crate) use observer::{XYZ_TO_RGB, x_bar, y_bar, z_bar};
pub use rgb::{Rgb, luminance, srgb_decode, srgb_encode};
pub use spectrum::Spectrum;
pub use wavelength::Wavelength;
