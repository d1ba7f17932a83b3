//! The look: how linear light becomes the signal of a screen.
//!
//! ```text
//! radiance ─ bloom ─ vignette ─ white balance, exposure ─ contrast ─ saturation ─ view ─► signal 0..1 ─ dither, round ─► 8 or 16 bit
//! ```
//!
//! With linear Rec. 709 colours c and middle grey 0.18:
//!
//! - bloom and vignette, which a lens does: light scattered around what is bright, and darker corners,
//! - white balance and exposure: c ← 2^EV M c ([`white_balance`](self), [`Exposure`]),
//! - contrast: c ← 0.18 (c / 0.18)^contrast, which keeps black black and middle grey as it is,
//! - saturation: c ← y + saturation (c − y) with y the luminance of c, and nothing below 0,
//! - the [`View`]: a curve from light without bounds to the signal of a screen.
//!
//! It is a room of its own beside the film: the film is sums of light and must not know how somebody looks at them. A
//! look needs no more than an [`Image`], and does the same to one that was read from a file.
//!
//! ```
//! use eyebeam_core::film::Image;
//! use eyebeam_core::look::{Exposure, Look, View};
//!
//! let mut image = Image::new(1, 1);
//! image.set_pixel(0, 0, [0.18; 3]);
//! let look = Look { view: View::Agx, exposure: Exposure::Ev(1.0), ..Look::default() };
//! let [r, g, b] = look.grade(&image).byte(image.pixel(0, 0), 0, 0);
//! assert!(r > 127 && r == g && g == b);
//! ```

mod dither;
mod exposure;
mod glare;
mod tone;
mod view;
mod vignette;
mod white_balance;

pub use exposure::{Exposure, auto_ev};
pub use view::View;

use std::borrow::Cow;

use glam::{Mat3, Vec3};
use serde::{Deserialize, Serialize};

use crate::film::Image;

/// The linear light that contrast does not change: a grey that reflects 18 % of it.
const MIDDLE_GREY: f32 = 0.18;

/// Light beyond it is as bright as this, so that nothing overflows.
const BRIGHTEST: f32 = 1e20;

/// How a picture is shown; the default shows what the picture says, clipped at 1.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Look {
    /// The curve from light to signal.
    pub view: View,
    /// The share of light that the lens scatters, 0 to 1, which glows around what is bright. 0 is off.
    pub bloom: f32,
    /// The field of view, from the bottom to the top of the picture, of a lens that darkens its corners, degrees, 0 to 170. 0 is
    /// off.
    pub vignette: f32,
    /// How much brighter the picture is made, EV, −32 to 32, or found from the picture.
    pub exposure: Exposure,
    /// The temperature of the light that is to look white, kelvin, 1000 to 15 000. At 6500 nothing changes.
    pub white_balance: f32,
    /// Slope of the logarithm of light about middle grey, 0.1 to 4. At 1 nothing changes.
    pub contrast: f32,
    /// Distance of colours from grey, 0 (grey) to 4. At 1 nothing changes.
    pub saturation: f32,
    /// Whether 8 bit pictures get a noise of one step, which hides the steps of soft gradients.
    pub dither: bool,
}

impl Default for Look {
    fn default() -> Self {
        Self {
            view: View::default(),
            bloom: 0.0,
            vignette: 0.0,
            exposure: Exposure::Ev(0.0),
            white_balance: Self::WHITE,
            contrast: 1.0,
            saturation: 1.0,
            dither: false,
        }
    }
}

impl Look {
    /// The least and the most bloom.
    pub const BLOOM_RANGE: [f32; 2] = [0.0, 1.0];
    /// The narrowest and the widest field of view of a vignette, degrees.
    pub const VIGNETTE_RANGE: [f32; 2] = [0.0, 170.0];
    /// The largest step of exposure in either direction, EV.
    pub const MAX_EV: f32 = 32.0;
    /// The white balance that changes nothing, kelvin.
    pub const WHITE: f32 = 6500.0;
    /// The lowest and highest white balance, kelvin.
    pub const WHITE_RANGE: [f32; 2] = [1000.0, 15_000.0];
    /// The lowest and highest contrast.
    pub const CONTRAST_RANGE: [f32; 2] = [0.1, 4.0];
    /// The lowest and highest saturation.
    pub const SATURATION_RANGE: [f32; 2] = [0.0, 4.0];

    /// What the lens makes of the light of a picture, before [`grade`](Self::grade): the same picture if it does nothing.
    /// Values out of range are taken as the nearest in it.
    pub fn through_lens<'i>(&self, image: &'i Image) -> Cow<'i, Image> {
        let within = |value: f32, [lo, hi]: [f32; 2]| if value > lo { value.min(hi) } else { lo };
        let mut image = Cow::Borrowed(image);
        let bloom = within(self.bloom, Self::BLOOM_RANGE);
        if bloom > 0.0 {
            glare::scatter(image.to_mut(), bloom);
        }
        let vignette = within(self.vignette, Self::VIGNETTE_RANGE);
        if vignette > 0.0 {
            vignette::darken(image.to_mut(), vignette);
        }
        image
    }

    /// The memory that [`through_lens`](Self::through_lens) takes for each pixel, bytes.
    pub fn lens_bytes(&self) -> u64 {
        // A copy, and two to blur.
        let pictures = if self.bloom > 0.0 { 3 } else { u64::from(self.vignette > 0.0) };
        pictures * size_of::<[f32; 3]>() as u64
    }

    /// The look as it is for this picture. Values out of range are taken as the nearest in it.
    pub fn grade(&self, image: &Image) -> Grade {
        let within = |value: f32, [lo, hi]: [f32; 2]| value.clamp(lo, hi);
        let ev = match self.exposure {
            Exposure::Ev(ev) => within(ev, [-Self::MAX_EV, Self::MAX_EV]),
            Exposure::Auto => auto_ev(image),
        };
        let white = within(self.white_balance, Self::WHITE_RANGE);
        Grade {
            view: self.view,
            ev,
            gain: libm::exp2f(ev),
            balance: (white != Self::WHITE).then(|| white_balance::matrix(white)),
            contrast: within(self.contrast, Self::CONTRAST_RANGE),
            saturation: within(self.saturation, Self::SATURATION_RANGE),
            dither: self.dither && self.view != View::Raw,
        }
    }
}

/// A look with all that depends on the picture known: from a pixel's light to its signal.
#[derive(Clone, Debug)]
pub struct Grade {
    view: View,
    ev: f32,
    gain: f32,
    balance: Option<Mat3>,
    contrast: f32,
    saturation: f32,
    dither: bool,
}

impl Grade {
    /// How much brighter the picture is made, EV.
    pub fn ev(&self) -> f32 {
        self.ev
    }

    /// The signal of a pixel, 0..1, from its linear Rec. 709 colour. What is negative or no number is black.
    pub fn signal(&self, rgb: [f32; 3]) -> [f32; 3] {
        // What is no number is not above 0.
        let light = rgb.map(|c| if c > 0.0 { c.min(BRIGHTEST) } else { 0.0 });
        let light = self.balance(light).map(|c| tone::contrast(c, self.contrast));
        self.view.signal(tone::saturate(light, self.saturation))
    }

    /// The pixel in column `x` of row `y` in 8 bits, with the look's dithering.
    pub fn byte(&self, rgb: [f32; 3], x: u32, y: u32) -> [u8; 3] {
        let signal = self.signal(rgb);
        let noise = |c: usize| if self.dither { dither::noise(x, y, c as u32, 255.0 * signal[c]) } else { 0.0 };
        // The conversion ends at 0 and 255.
        [0, 1, 2].map(|c| (255.0 * signal[c] + noise(c)).round() as u8)
    }

    /// The pixel in 16 bits, which need no dithering.
    pub fn word(&self, rgb: [f32; 3]) -> [u16; 3] {
        self.signal(rgb).map(|c| (65535.0 * c).round() as u16)
    }

    fn balance(&self, rgb: [f32; 3]) -> [f32; 3] {
        let balanced = self.balance.map_or(rgb, |matrix| (matrix * Vec3::from(rgb)).to_array());
        balanced.map(|c| c.max(0.0) * self.gain)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::{Rgb, srgb_encode};

    fn grade(look: Look) -> Grade {
        look.grade(&Image::new(1, 1))
    }

    /// Light that pictures and mistakes are made of.
    const LIGHT: [f32; 9] = [0.0, 1e-40, 1e-6, 0.18, 1.0, 7.0, 65504.0, 1e19, f32::MAX];

    #[test]
    fn the_default_is_srgb() {
        let grade = grade(Look::default());
        for c in LIGHT {
            let expected = if c < 1.0 { srgb_encode(c) } else { 1.0 };
            assert_eq!(grade.signal([c; 3]), [expected; 3]);
        }
        assert_eq!(grade.byte([0.0, 0.5, 1.0], 3, 4), [0, 188, 255]);
        assert_eq!(grade.word([0.0, 0.5, 1.0]), [0, 48192, 65535]);
    }

    #[test]
    fn a_lens_that_does_nothing_changes_nothing() {
        let mut image = Image::new(2, 2);
        image.set_pixel(1, 0, [7.0, 1.0, 1e-40]);
        let image = image.with_alpha(vec![0.5; 4]);
        let look = Look { bloom: f32::NAN, vignette: -1.0, ..Look::default() };
        for look in [Look::default(), look] {
            assert!(matches!(look.through_lens(&image), Cow::Borrowed(same) if *same == image));
            assert_eq!(look.lens_bytes(), 0);
        }
        for (bloom, vignette) in [(0.1, 0.0), (0.0, 40.0), (9.0, 999.0)] {
            let seen = Look { bloom, vignette, ..Look::default() }.through_lens(&image).into_owned();
            assert!(seen != image && seen.alpha() == image.alpha());
            assert!(seen.pixels().as_flattened().iter().all(|c| c.is_finite() && *c >= 0.0));
        }
    }

    #[test]
    fn what_is_no_light_is_black() {
        for (_, view) in View::NAMES {
            let grade = grade(Look { view: *view, contrast: 1.5, saturation: 2.0, ..Look::default() });
            assert_eq!(grade.signal([-1.0, f32::NAN, f32::NEG_INFINITY]), [0.0; 3], "{view:?}");
        }
    }

    #[test]
    fn every_look_of_any_light_is_a_signal() {
        for (_, view) in View::NAMES {
            for extreme in [-1.0, 1.0] {
                let end = |[lo, hi]: [f32; 2]| if extreme < 0.0 { lo } else { hi };
                let grade = grade(Look {
                    view: *view,
                    bloom: 0.0,
                    vignette: 0.0,
                    exposure: Exposure::Ev(extreme * f32::INFINITY),
                    white_balance: end(Look::WHITE_RANGE),
                    contrast: end(Look::CONTRAST_RANGE),
                    saturation: end(Look::SATURATION_RANGE),
                    dither: true,
                });
                for (r, g) in LIGHT.iter().flat_map(|&r| LIGHT.map(|g| (r, g))) {
                    let signal = grade.signal([r, g, f32::INFINITY]);
                    assert!(signal.iter().all(|c| (0.0..=1.0).contains(c)), "{view:?} {extreme} {r} {g}: {signal:?}");
                }
            }
        }
    }

    #[test]
    fn a_step_of_exposure_is_twice_the_light() {
        let brighter = grade(Look { exposure: Exposure::Ev(1.0), ..Look::default() });
        let darker = grade(Look { exposure: Exposure::Ev(-2.0), ..Look::default() });
        for c in [0.01, 0.18, 0.4] {
            assert_eq!(brighter.signal([c; 3]), [srgb_encode(2.0 * c); 3]);
            assert_eq!(darker.signal([c; 3]), [srgb_encode(c / 4.0); 3]);
        }
    }

    #[test]
    fn contrast_keeps_middle_grey() {
        let look = |contrast| grade(Look { view: View::Raw, contrast, ..Look::default() });
        for contrast in [0.5, 2.0] {
            assert!((look(contrast).signal([0.18; 3])[0] - 0.18).abs() < 1e-7);
            assert_eq!(look(contrast).signal([0.0; 3]), [0.0; 3]);
        }
        assert!((look(2.0).signal([0.09; 3])[0] - 0.045).abs() < 1e-7);
        assert!((look(0.5).signal([0.72; 3])[0] - 0.36).abs() < 1e-6);
    }

    #[test]
    fn saturation_keeps_luminance_and_greys() {
        let look = |saturation| grade(Look { view: View::Raw, saturation, ..Look::default() });
        let rgb = [0.4, 0.3, 0.2];
        let y = Rgb(rgb).luminance();
        for saturation in [0.0, 0.5, 1.5] {
            let signal = look(saturation).signal(rgb);
            assert!((Rgb(signal).luminance() - y).abs() < 1e-6);
            assert!((signal[0] - signal[2] - saturation * 0.2).abs() < 1e-6);
            assert!(look(saturation).signal([0.3; 3]).iter().all(|c| (c - 0.3).abs() < 1e-6));
        }
    }

    #[test]
    fn dithering_is_for_screens() {
        let bytes = |view, dither| {
            let grade = grade(Look { view, dither, ..Look::default() });
            (0..100).map(|x| grade.byte([0.2; 3], x, 7)).collect::<Vec<_>>()
        };
        assert_ne!(bytes(View::Standard, true), bytes(View::Standard, false));
        assert_eq!(bytes(View::Raw, true), bytes(View::Raw, false));
    }
}
