//! Colours of products as they are: Khronos PBR Neutral.
//!
//! ```text
//! x = min(r, g, b),  c ← c − (x < 0.08 ? x − 6.25 x² : 0.04)          takes off what a gloss of index 1.5 adds
//! p = max(r, g, b),  p' = 1 − d² / (p + d − 0.76),  d = 0.24          if p > 0.76
//! s = srgb(mix(c p' / p, p', 1 − 1 / (0.15 (p − p') + 1)))            highlights fade to white
//! ```
//!
//! Under white light of irradiance π a glossy surface has its own base colour, to the byte; only what is brighter is compressed.
//! Khronos Group 2024, "Khronos PBR Neutral Tone Mapper Specification".

use crate::look::view::srgb;

/// Where highlights begin.
const START: f32 = 0.8 - 0.04;
const DESATURATION: f32 = 0.15;
/// Light beyond is as white as can be.
const MOST: f32 = 1e9;

pub(super) fn signal(rgb: [f32; 3]) -> [f32; 3] {
    let rgb = rgb.map(|c| c.min(MOST));
    let least = rgb[0].min(rgb[1]).min(rgb[2]);
    let gloss = if least < 0.08 { least - 6.25 * least * least } else { 0.04 };
    let rgb = rgb.map(|c| c - gloss);
    let peak = rgb[0].max(rgb[1]).max(rgb[2]);
    if peak < START {
        return rgb.map(srgb);
    }
    const D: f32 = 1.0 - START;
    let compressed = 1.0 - D * D / (peak + D - START);
    let white = 1.0 - 1.0 / (DESATURATION * (peak - compressed) + 1.0);
    rgb.map(|c| srgb((c * (compressed / peak)) * (1.0 - white) + compressed * white))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A base colour, and the gloss over it that is 0.04 of white light.
    #[test]
    fn base_colors_stay() {
        for color in [[0.5, 0.2, 0.04], [0.7, 0.7, 0.7], [0.04, 0.6, 0.3]] {
            let signal = signal(color.map(|c| c + 0.04));
            for (s, c) in signal.into_iter().zip(color) {
                assert!((s - srgb(c)).abs() < 1e-5, "{signal:?} of {color:?}");
            }
        }
    }

    /// Of the specification's equations by hand.
    #[test]
    fn highlights_are_compressed() {
        // Without gloss 1.96 and 0.04; 1 − 0.0576 / 1.44 = 0.96, and what fades is 1 − 1 / (0.15 · 1 + 1).
        let [r, g, b] = signal([2.0, 0.08, 0.08]);
        let white = 1.0 - 1.0 / 1.15_f32;
        assert!((r - srgb(0.96)).abs() < 1e-5, "{r}");
        let pale = 0.04 * (0.96 / 1.96) * (1.0 - white) + 0.96 * white;
        assert!((g - srgb(pale)).abs() < 1e-5 && g == b, "{g}");
        assert!(signal([f32::INFINITY, 0.0, 0.0]).iter().all(|&c| c > 0.99));
    }
}
