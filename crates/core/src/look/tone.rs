//! Contrast and saturation of linear light.

use crate::color::Rgb;
use crate::look::{BRIGHTEST, MIDDLE_GREY};

/// Light with another slope about middle grey, in stops; 1 changes nothing.
pub(super) fn contrast(c: f32, slope: f32) -> f32 {
    if slope == 1.0 {
        return c;
    }
    (MIDDLE_GREY * libm::powf(c / MIDDLE_GREY, slope)).min(BRIGHTEST)
}

/// A colour farther from the grey of its luminance, or nearer; 1 changes nothing.
pub(super) fn saturate(rgb: [f32; 3], factor: f32) -> [f32; 3] {
    if factor == 1.0 {
        return rgb;
    }
    let y = Rgb(rgb).luminance();
    rgb.map(|c| (y + factor * (c - y)).max(0.0))
}
