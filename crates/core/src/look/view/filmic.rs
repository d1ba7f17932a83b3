//! A soft shoulder and a toe, as film has them, on each channel.
//!
//! ```text
//! h(x) = (x (A x + C B) + D E) / (x (A x + B) + D F) − E / F
//! s = srgb(h(2 c) / h(W))
//! ```
//!
//! Hable, "Uncharted 2: HDR Lighting", Game Developers Conference 2010, with its numbers: shoulder A = 0.15, line B = 0.5
//! of slope C = 0.1, toe D = 0.2 of numerator E = 0.02 and denominator F = 0.3; white W = 11.2; twice the light before it.
//! White is 5.6, and middle grey 0.18 becomes 0.128.

use crate::look::view::srgb;

const A: f32 = 0.15;
const B: f32 = 0.5;
const C: f32 = 0.1;
const D: f32 = 0.2;
const E: f32 = 0.02;
const F: f32 = 0.3;
const WHITE: f32 = 11.2;

pub(super) fn signal(rgb: [f32; 3]) -> [f32; 3] {
    rgb.map(|c| srgb(hable((2.0 * c).min(WHITE)) / hable(WHITE)))
}

/// On one denominator, so that 0 is exactly 0.
fn hable(x: f32) -> f32 {
    x * (A * (1.0 - E / F) * x + B * (C - E / F)) / (x * (A * x + B) + D * F)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_values() {
        // Of the equation as it was published.
        let published = |x: f64| (x * (0.15 * x + 0.05) + 0.004) / (x * (0.15 * x + 0.5) + 0.06) - 0.02 / 0.3;
        for x in [0.01, 0.36, 1.0, 5.0, 11.2] {
            assert!((f64::from(hable(x as f32)) - published(x)).abs() < 1e-6, "{x}");
        }
        assert!((hable(0.36) / hable(WHITE) - 0.1283).abs() < 1e-4);
        assert_eq!(signal([0.0, 5.6, 100.0]), [0.0, 1.0, 1.0]);
    }
}
