//! What the numbers say: the curve of sRGB, clipped at 1.
//!
//! ```text
//! s = srgb(min(c, 1))
//! ```
//!
//! IEC 61966-2-1:1999. A surface of albedo 0.5 in light of irradiance π has the signal that colour pickers call 0.5 linear.
//! All that is brighter than 1 is lost, each channel by itself, so bright colours change their hue.

use crate::look::view::srgb;

pub(super) fn signal(rgb: [f32; 3]) -> [f32; 3] {
    rgb.map(srgb)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_values() {
        // The standard's own worked value: linear 0.5 is 188 of 255.
        let [r, g, b] = signal([0.5, 1.0, 7.0]);
        assert!((r - 0.735_357).abs() < 1e-6 && g == 1.0 && b == 1.0);
        assert!((signal([0.001; 3])[0] - 0.01292).abs() < 1e-8);
    }
}
