//! AgX by Troy Sobotka: colours fade to white as they grow bright, as in photographs.
//!
//! The curve alone, `agx-base`, is flat, made to be developed further; `agx` gives it the contrast (1.3, about middle grey) and
//! the saturation (1.2) that made ten pictures look best.
//!
//! ```text
//! v = 0.8 c + 0.2 g,   g = w · c                     a little of each primary goes into the others
//! x = (log2(v / 0.18) + 10) / 16.5                   from 10 EV below middle grey to 6.5 above
//! y = ½ + 2 d / (1 + ((4 m)^p − 1) (|d| / m)^p)^(1/p),   d = x − x₀,  x₀ = 10 / 16.5
//! s = (y − 0.2 (w · y)) / 0.8                        and back
//! ```
//!
//! Below middle grey m = x₀ and p = 3, above it m = 1 − x₀ and p = 3.25, so the sigmoid goes through (0, 0), (x₀, ½) with
//! slope 2, and (1, 1). y is the signal of a screen. In chromaticities the first line moves each primary by a fifth of the
//! way to white; w are the primaries' shares in X + Y + Z of white, which makes the matrix this simple.
//!
//! Sobotka, "AgX", 2022 (github.com/sobotka/AgX: its curve and inset); the way back is from Wrensch, "Minimal AgX
//! Implementation", 2023 (iolite-engine.com/blog_posts/minimal_agx_implementation), in closed form instead of rounded numbers.

use crate::look::{MIDDLE_GREY, tone};

/// How far primaries move to white.
const INSET: f32 = 0.2;
/// Shares of the Rec. 709 primaries in X + Y + Z of D65.
const SHARES: [f32; 3] = [0.211_995, 0.392_151, 0.395_854];
/// EV from the darkest light that is seen to middle grey, and to the brightest.
const EV: [f32; 2] = [10.0, 16.5];
/// The place of middle grey between them.
const PIVOT: f32 = EV[0] / EV[1];
/// Signal of middle grey, and the slope there.
const GREY: f32 = 0.5;
const SLOPE: f32 = 2.0;
const TOE: f32 = 3.0;
const SHOULDER: f32 = 3.25;
/// Light beyond it is as bright as this.
const BRIGHTEST: f32 = 1e20;

/// Contrast and saturation of a developed picture.
const CONTRAST: f32 = 1.3;
const SATURATION: f32 = 1.2;

pub(super) fn signal(rgb: [f32; 3]) -> [f32; 3] {
    base(tone::saturate(rgb.map(|c| tone::contrast(c, CONTRAST)), SATURATION))
}

pub(super) fn base(rgb: [f32; 3]) -> [f32; 3] {
    let rgb = rgb.map(|c| c.min(BRIGHTEST));
    let grey = shares(rgb);
    let y = rgb.map(|c| sigmoid(log_encode((1.0 - INSET) * c + INSET * grey)));
    let grey = shares(y);
    y.map(|y| ((y - INSET * grey) / (1.0 - INSET)).clamp(0.0, 1.0))
}

/// The grey that a colour is mixed with.
fn shares([r, g, b]: [f32; 3]) -> f32 {
    SHARES[0] * r + SHARES[1] * g + SHARES[2] * b
}

/// 0..1 between the darkest and the brightest light that is seen.
fn log_encode(v: f32) -> f32 {
    ((libm::log2f(v / MIDDLE_GREY) + EV[0]) / EV[1]).clamp(0.0, 1.0)
}

fn sigmoid(x: f32) -> f32 {
    // The ends are exact, whatever rounding does.
    if x <= 0.0 || x >= 1.0 {
        return x;
    }
    let (d, [length, power]) = (x - PIVOT, if x < PIVOT { [PIVOT, TOE] } else { [1.0 - PIVOT, SHOULDER] });
    // So steep a line would be at the end by this factor too far.
    let beyond = libm::powf(SLOPE * length / GREY, power) - 1.0;
    let bend = libm::powf(1.0 + beyond * libm::powf(d.abs() / length, power), 1.0 / power);
    (GREY + SLOPE * d / bend).clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_values() {
        assert!((sigmoid(PIVOT) - 0.5).abs() < 1e-6);
        assert!(sigmoid(1e-6).abs() < 2e-6 && (sigmoid(1.0 - 1e-6) - 1.0).abs() < 2e-6);
        // The polynomial that Wrensch fitted to the original table, within its error.
        for i in 0..=100 {
            let x = f64::from(i) / 100.0;
            let terms = [-0.00232, 0.1191, 0.4298, -6.868, 31.96, -40.14, 15.5];
            let fitted = terms.iter().rev().fold(0.0, |sum, term| sum * x + term);
            assert!((f64::from(sigmoid(x as f32)) - fitted).abs() < 6e-3, "{x}: {} and {fitted}", sigmoid(x as f32));
        }
        let [r, g, b] = base([0.18; 3]);
        assert!([r, g, b].iter().all(|c| (c - 0.5).abs() < 1e-5), "{r} {g} {b}");
    }

    #[test]
    fn the_inset_is_the_original_one() {
        // Rows of the matrix in Sobotka's configuration.
        let original = [[0.8425, 0.0784, 0.0792], [0.0423, 0.8785, 0.0792], [0.0424, 0.0784, 0.8791]];
        for (i, row) in original.iter().enumerate() {
            for (j, expected) in row.iter().enumerate() {
                let entry = INSET * SHARES[j] + if i == j { 1.0 - INSET } else { 0.0 };
                assert!((entry - expected).abs() < 2e-4, "{i} {j}: {entry}");
            }
        }
    }

    #[test]
    fn bright_colours_fade_to_white() {
        let [r, g, b] = base([20.0, 0.0, 0.0]);
        assert!(r == 1.0 && g.min(b) > 0.5, "{r} {g} {b}");
        let [r, g, b] = base([0.1, 0.0, 0.0]);
        assert!(r > g.max(b) + 0.2, "{r} {g} {b}");
    }
}
