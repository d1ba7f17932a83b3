//! Views: curves from light without bounds to the signal of a screen, each a file.
//!
//! Each is black for black, and of grey light makes grey; more light is nowhere a darker grey.

mod aces;
mod agx;
mod filmic;
mod neutral;
mod raw;
mod standard;

use serde::{Deserialize, Serialize};

use crate::color::srgb_encode;

/// A curve from light to the signal of an sRGB screen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum View {
    /// The sRGB curve, clipped at 1: what the numbers say.
    #[default]
    Standard,
    /// A soft shoulder on each channel, as film has it.
    Filmic,
    /// The contrast and the warm highlights of the film industry's ACES.
    Aces,
    /// Bright colours fade to white, as in photographs.
    Agx,
    /// The same without added contrast, to be developed further.
    AgxBase,
    /// Colours of products as they are; only what is brighter fades to white.
    Neutral,
    /// No curve: linear light, clipped at 1.
    Raw,
}

impl View {
    /// What pictures are developed with if nobody says: of ten pictures, side by side, most looked best with it.
    pub const FOR_PICTURES: Self = Self::Agx;

    /// The same of models in the studio, whose light is even and of a known brightness.
    pub const FOR_MODELS: Self = Self::Neutral;

    /// Every view by its name.
    pub const NAMES: &[(&str, Self)] = &[
        ("standard", Self::Standard),
        ("filmic", Self::Filmic),
        ("aces", Self::Aces),
        ("agx", Self::Agx),
        ("agx-base", Self::AgxBase),
        ("neutral", Self::Neutral),
        ("raw", Self::Raw),
    ];

    /// Its name.
    pub fn name(self) -> &'static str {
        Self::NAMES.iter().find(|(_, view)| *view == self).map_or("", |(name, _)| name)
    }

    /// The signal, 0..1, of a linear Rec. 709 colour, none of which is negative.
    pub fn signal(self, rgb: [f32; 3]) -> [f32; 3] {
        match self {
            Self::Standard => standard::signal(rgb),
            Self::Filmic => filmic::signal(rgb),
            Self::Aces => aces::signal(rgb),
            Self::Agx => agx::signal(rgb),
            Self::AgxBase => agx::base(rgb),
            Self::Neutral => neutral::signal(rgb),
            Self::Raw => raw::signal(rgb),
        }
    }
}

/// The sRGB signal of light; from 1 on it is exactly 1, whatever rounding does.
fn srgb(c: f32) -> f32 {
    if c < 1.0 { srgb_encode(c) } else { 1.0 }
}

#[cfg(test)]
mod tests {
    use serde::de::IntoDeserializer;
    use serde::de::value::StrDeserializer;

    use super::*;
    use crate::color::Rgb;

    /// From 2^−20 to 2^20 in steps of 1/32 EV.
    fn exposures() -> impl Iterator<Item = f32> {
        (-640..=640).map(|i| (i as f32 / 32.0).exp2())
    }

    #[test]
    fn names_are_those_of_files() {
        for (name, view) in View::NAMES {
            let name: StrDeserializer<'_, serde::de::value::Error> = (*name).into_deserializer();
            assert_eq!(View::deserialize(name).as_ref(), Ok(view));
        }
    }

    #[test]
    fn black_is_black_and_bright_is_white() {
        for (name, view) in View::NAMES {
            assert_eq!(view.signal([0.0; 3]), [0.0; 3], "{name}");
            let white = view.signal([f32::INFINITY; 3]);
            assert!(white.iter().all(|c| (254.5 / 255.0..=1.0).contains(c)), "{name}: {white:?}");
        }
    }

    #[test]
    fn grey_stays_grey_and_grows() {
        for (name, view) in View::NAMES {
            let mut before = 0.0;
            for c in exposures() {
                let signal @ [r, g, b] = view.signal([c; 3]);
                let apart = r.max(g).max(b) - r.min(g).min(b);
                // Half a step of 16 bits.
                assert!(apart < 0.5 / 65535.0, "{name} {c}: {signal:?}");
                assert!(g >= before, "{name} {c}: {signal:?}");
                before = g;
            }
        }
    }

    #[test]
    fn more_light_is_never_darker() {
        let colors = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.6, 0.1], [0.2, 0.5, 1.0]];
        for ((name, view), color) in View::NAMES.iter().flat_map(|v| colors.map(|c| (v, c))) {
            let mut before = 0.0;
            for exposure in exposures() {
                let signal = view.signal(color.map(|c| c * exposure));
                assert!(signal.iter().all(|c| (0.0..=1.0).contains(c)), "{name} {color:?} {exposure}: {signal:?}");
                let luminance = Rgb(signal).luminance();
                assert!(luminance >= before - 1e-6, "{name} {color:?} {exposure}: {luminance} after {before}");
                before = luminance;
            }
        }
    }
}
