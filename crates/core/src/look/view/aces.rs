//! The reference rendering of the Academy Color Encoding System on an sRGB screen, as fitted by Stephen Hill.
//!
//! ```text
//! v = M c       f(v) = (v (v + 0.0245786) − 0.000090537) / (v (0.983729 v + 0.4329510) + 0.238081)
//! s = srgb(N f(v))
//! ```
//!
//! M goes to the primaries of ACEScg and takes away some saturation, N leads back. Source: `ACES.hlsl` of the Baking Lab by
//! Pettineo & Hill, 2016 (github.com/TheRealMJP/BakingLab), fitted to the RRT and ODT of ACES 1.0 (SMPTE ST 2065, Academy
//! TB-2014-004). As in ACES, the picture is dark: middle grey 0.18 becomes 0.106, and 0.7 EV bring it back.

use glam::{Mat3, Vec3};

use crate::look::view::srgb;

/// Columns.
const TO_ACES: Mat3 = Mat3::from_cols_array(&[
    0.59719, 0.07600, 0.02840, //
    0.35458, 0.90834, 0.13383, //
    0.04823, 0.01566, 0.83777,
]);

/// Columns.
const FROM_ACES: Mat3 = Mat3::from_cols_array(&[
    1.60475, -0.10208, -0.00327, //
    -0.53108, 1.10813, -0.07276, //
    -0.07367, -0.00605, 1.07602,
]);

/// Light beyond it is as bright as this: its square must be finite, and the curve is flat long before.
const BRIGHTEST: f32 = 1e6;

pub(super) fn signal(rgb: [f32; 3]) -> [f32; 3] {
    let v = TO_ACES * Vec3::from(rgb).min(Vec3::splat(BRIGHTEST));
    let shown = FROM_ACES * Vec3::from(v.to_array().map(fit));
    shown.to_array().map(|c| srgb(c.max(0.0)))
}

/// The curve of each channel.
fn fit(v: f32) -> f32 {
    (v * (v + 0.024_578_6) - 0.000_090_537) / (v * (0.983_729 * v + 0.432_951) + 0.238_081)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_values() {
        for (c, expected) in [(0.18, 0.10559), (1.0, 0.61912), (4.0, 0.90902)] {
            assert!((fit(c) - expected).abs() < 1e-4, "{c}: {}", fit(c));
        }
    }

    #[test]
    fn bright_colours_fade_to_white() {
        let [r, g, b] = signal([100.0, 0.0, 0.0]);
        assert!(r == 1.0 && g > 0.3 && b > 0.2, "{r} {g} {b}");
        let [r, g, b] = signal([0.1, 0.0, 0.0]);
        assert!(r > 10.0 * g.max(b), "{r} {g} {b}");
    }
}
