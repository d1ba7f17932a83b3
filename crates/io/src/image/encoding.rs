//! How a picture is written, where its format leaves a choice.

use eyebeam_core::film::Image;
use eyebeam_core::look::{Grade, Look};
use serde::Serialize;

/// Choices of the formats. Each format heeds its own and ignores the others'.
#[derive(Clone, Debug, PartialEq)]
pub struct Encoding {
    /// PNG and JPEG: how light becomes the signal of a screen. EXR and HDR stay linear.
    pub look: Look,
    /// PNG: bits of each channel.
    pub bits: Bits,
    /// EXR: colours and alpha in 16 bits instead of 32; what is brighter than 65504 is as bright as that.
    pub half: bool,
    /// JPEG: 1 (small) to 100 (good).
    pub quality: u8,
}

/// Bits of each channel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Bits {
    /// 256 steps.
    #[default]
    Eight,
    /// 65 536 steps.
    Sixteen,
}

impl Default for Encoding {
    fn default() -> Self {
        Self { look: Look::default(), bits: Bits::Eight, half: false, quality: Self::QUALITY }
    }
}

impl Encoding {
    /// The usual quality.
    pub const QUALITY: u8 = 90;
}

/// What a picture for screens says of its look, as JSON: as it was asked for, and the exposure that came of it.
pub(super) fn look_json(look: &Look, grade: &Grade) -> String {
    #[derive(Serialize)]
    struct Told<'l> {
        #[serde(flatten)]
        look: &'l Look,
        ev: f32,
    }
    serde_json::to_string(&Told { look, ev: grade.ev() }).unwrap_or_default()
}

/// Each pixel as `pixel(colour, column, row)` gives it, row by row.
pub(super) fn pixels<T, P: IntoIterator<Item = T>>(
    image: &Image,
    pixel: impl Fn([f32; 3], u32, u32) -> P,
) -> impl Iterator<Item = T> {
    let places = (0..image.height()).flat_map(|y| (0..image.width()).map(move |x| (x, y)));
    places.zip(image.pixels()).flat_map(move |((x, y), &rgb)| pixel(rgb, x, y))
}
