//! Exposure: how much brighter a picture is made, as photographers count it: one EV is twice the light.
//!
//! `auto` sets the picture's typical luminance to middle grey:
//!
//! ```text
//! EV = log2 0.18 − mean of log2 y over the pixels between the 10th and the 95th percentile
//! ```
//!
//! The mean of logarithms is that of Reinhard et al., "Photographic Tone Reproduction for Digital Images", 2002,
//! doi:10.1145/566654.566575. Pixels without light are no part of it: a black background says nothing of what stands before
//! it. Of the others, the darkest and the brightest are left out, so neither noise in the dark nor small lamps count.
//! Logarithms go into a histogram in whole steps of 1/64 EV, so the sum is exact and no order changes it.

use std::fmt;
use std::str::FromStr;

use serde::de::{self, Deserialize, Deserializer, Visitor};
use serde::{Serialize, Serializer};

use crate::color::Rgb;
use crate::film::Image;
use crate::look::{Look, MIDDLE_GREY};

/// How much brighter a picture is made. Written as a number, or `"auto"`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Exposure {
    /// By 2 to the power of this, −32 to 32.
    Ev(f32),
    /// So that what is in the picture is about as bright as middle grey.
    Auto,
}

impl FromStr for Exposure {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        if text == "auto" {
            return Ok(Self::Auto);
        }
        let ev = text.parse().ok().filter(|ev: &f32| ev.abs() <= Look::MAX_EV);
        ev.map(Self::Ev).ok_or_else(|| format!("use `auto`, or a number of EV from -{0} to {0}", Look::MAX_EV))
    }
}

impl Serialize for Exposure {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Ev(ev) => ev.serialize(serializer),
            Self::Auto => "auto".serialize(serializer),
        }
    }
}

impl<'de> Deserialize<'de> for Exposure {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct ExposureVisitor;
        impl Visitor<'_> for ExposureVisitor {
            type Value = Exposure;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("an exposure: a number of EV, or \"auto\"")
            }

            fn visit_f64<E: de::Error>(self, ev: f64) -> Result<Exposure, E> {
                Ok(Exposure::Ev(ev as f32))
            }

            fn visit_i64<E: de::Error>(self, ev: i64) -> Result<Exposure, E> {
                Ok(Exposure::Ev(ev as f32))
            }

            fn visit_u64<E: de::Error>(self, ev: u64) -> Result<Exposure, E> {
                Ok(Exposure::Ev(ev as f32))
            }

            fn visit_str<E: de::Error>(self, text: &str) -> Result<Exposure, E> {
                if text == "auto" {
                    Ok(Exposure::Auto)
                } else {
                    Err(E::invalid_value(de::Unexpected::Str(text), &self))
                }
            }
        }
        deserializer.deserialize_any(ExposureVisitor)
    }
}

/// Share of the pixels, in percent, below which and from which on they do not count.
const PERCENTILES: [u64; 2] = [10, 95];
/// Steps of the histogram in one EV.
const STEPS: i32 = 64;
/// The histogram ends at 2 to the power of ± this.
const RANGE: i32 = 40;

/// The exposure of a picture that makes it as bright as middle grey, EV, −32 to 32; 0 if all is black.
pub fn auto_ev(image: &Image) -> f32 {
    let mut histogram = vec![0_u64; (2 * RANGE * STEPS + 1) as usize];
    for y in image.pixels().iter().map(|&rgb| Rgb(rgb.map(|c| c.max(0.0))).luminance()).filter(|&y| y > 0.0) {
        let step = (libm::log2f(y) * STEPS as f32).round() as i32;
        histogram[(step.clamp(-RANGE * STEPS, RANGE * STEPS) + RANGE * STEPS) as usize] += 1;
    }
    let lit: u64 = histogram.iter().sum();
    // At least one pixel is between them.
    let [from, to] = [lit * PERCENTILES[0] / 100, (lit * PERCENTILES[1]).div_ceil(100)];
    let (mut below, mut sum) = (0, 0);
    for (step, count) in (-RANGE * STEPS..).zip(histogram) {
        let within = (below + count).min(to).saturating_sub(below.max(from));
        sum += i64::from(step) * within as i64;
        below += count;
    }
    if lit == 0 {
        return 0.0;
    }
    let mean = sum as f64 / (to - from) as f64 / f64::from(STEPS);
    (libm::log2f(MIDDLE_GREY) - mean as f32).clamp(-Look::MAX_EV, Look::MAX_EV)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture(pixels: impl IntoIterator<Item = f32>) -> Image {
        let pixels: Vec<_> = pixels.into_iter().collect();
        let mut image = Image::new(pixels.len() as u32, 1);
        (0..).zip(pixels).for_each(|(x, c)| image.set_pixel(x, 0, [c; 3]));
        image
    }

    #[test]
    fn middle_grey_needs_no_exposure() {
        for (c, ev) in [(0.18, 0.0), (0.36, -1.0), (0.18 / 16.0, 4.0), (1e30, -32.0), (1e-30, 32.0)] {
            assert!((auto_ev(&picture([c; 7])) - ev).abs() < 1.0 / 64.0, "{c}");
        }
        assert_eq!(auto_ev(&picture([0.18])), auto_ev(&picture([0.18; 1000])));
    }

    #[test]
    fn black_pictures_stay() {
        assert_eq!(auto_ev(&picture([0.0; 9])), 0.0);
        assert_eq!(auto_ev(&picture([f32::NAN, -1.0, f32::NEG_INFINITY])), 0.0);
        assert_eq!(auto_ev(&Image::new(0, 0)), 0.0);
    }

    #[test]
    fn neither_lamps_nor_the_background_count() {
        let scene: Vec<_> = (0..1000).map(|i| 0.05 + i as f32 * 1e-3).collect();
        let plain = auto_ev(&picture(scene.clone()));
        let with_lamps = scene.iter().enumerate().map(|(i, &c)| if i % 100 == 7 { 1e9 } else { c });
        assert!((auto_ev(&picture(with_lamps)) - plain).abs() < 0.1);
        let before_black = scene.iter().copied().chain(std::iter::repeat_n(0.0, 100_000));
        assert_eq!(auto_ev(&picture(before_black)), plain);
        let with_specks = scene.iter().enumerate().map(|(i, &c)| if i % 50 == 7 { 1e-9 } else { c });
        assert!((auto_ev(&picture(with_specks)) - plain).abs() < 0.1);
    }

    #[test]
    fn order_does_not_matter_and_doubling_is_one_step() {
        let scene: Vec<_> = (0..997).map(|i| 1e-4 * (1 + i * 7919 % 997) as f32).collect();
        let ev = auto_ev(&picture(scene.clone()));
        assert_eq!(auto_ev(&picture(scene.iter().rev().copied())), ev);
        assert!((auto_ev(&picture(scene.iter().map(|c| 2.0 * c))) - (ev - 1.0)).abs() < 1e-5);
    }

    #[test]
    fn words() {
        assert_eq!("auto".parse(), Ok(Exposure::Auto));
        assert_eq!("-1.5".parse(), Ok(Exposure::Ev(-1.5)));
        for bad in ["", "bright", "33", "nan", "inf"] {
            assert!(bad.parse::<Exposure>().is_err(), "{bad}");
        }
    }
}
