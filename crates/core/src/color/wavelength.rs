//! Light of one wavelength, as a part of white light.

use std::sync::LazyLock;

use crate::color::{Spectrum, XYZ_TO_RGB, x_bar, y_bar, z_bar};

/// A wavelength, drawn from white light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wavelength {
    /// Nanometres.
    pub nm: f32,
    /// The colour in which it is seen, such that the mean over all that are drawn is white. What is out of gamut is cut off, so a
    /// rainbow is a little less saturated than the sky's.
    pub color: Spectrum,
}

impl Wavelength {
    /// Draws one in proportion to what is seen of it, red, green and blue being worth the same.
    pub fn sample(u: f32) -> Self {
        let Bands { ends, colors } = &*BANDS;
        let i = ends.partition_point(|&end| end <= u).min(COUNT - 1);
        let before = if i == 0 { 0.0 } else { ends[i - 1] };
        let within = ((u - before) / (ends[i] - before)).clamp(0.0, 1.0);
        Self { nm: FIRST + WIDTH * (i as f32 + within), color: colors[i] }
    }
}

/// Where the first band begins, and the width of each, nanometres.
const FIRST: f32 = 390.0;
const WIDTH: f32 = 5.0;
/// Up to 710 nm.
const COUNT: usize = 64;

/// Of one colour each.
struct Bands {
    /// The share of what is drawn up to the end of each.
    ends: [f32; COUNT],
    colors: [Spectrum; COUNT],
}

static BANDS: LazyLock<Bands> = LazyLock::new(|| {
    let rgb: [[f64; 3]; COUNT] = std::array::from_fn(|i| {
        let nm = f64::from(FIRST) + f64::from(WIDTH) * (i as f64 + 0.5);
        let xyz = [x_bar(nm), y_bar(nm), z_bar(nm)];
        XYZ_TO_RGB.map(|row| (row[0] * xyz[0] + row[1] * xyz[1] + row[2] * xyz[2]).max(0.0))
    });
    let sums: [f64; 3] = std::array::from_fn(|channel| rgb.iter().map(|c| c[channel]).sum());
    // Shares of each channel's light, of which the mean is the chance to be drawn.
    let shares = rgb.map(|c| std::array::from_fn::<_, 3, _>(|channel| c[channel] / sums[channel]));
    let chances = shares.map(|share| share.iter().sum::<f64>() / 3.0);
    let mut sum = 0.0;
    let ends = chances.map(|chance| {
        sum += chance;
        sum as f32
    });
    let colors = std::array::from_fn(|i| Spectrum::from_rgb(shares[i].map(|share| (share / chances[i]) as f32)));
    Bands { ends, colors }
});

#[cfg(test)]
mod tests {
    use super::*;

    /// The mean is white, violet comes first and red last, and none is drawn that nobody sees.
    #[test]
    fn is_a_part_of_white() {
        const N: u32 = 100_000;
        let drawn = (0..N).map(|i| Wavelength::sample((i as f32 + 0.5) / N as f32));
        let mut sum = [0.0; 3];
        let mut last = FIRST;
        for wavelength in drawn {
            assert!(wavelength.nm >= last && wavelength.nm <= FIRST + WIDTH * COUNT as f32);
            last = wavelength.nm;
            let rgb = wavelength.color.to_rgb();
            assert!((rgb.iter().sum::<f32>() - 3.0).abs() < 1e-5, "{rgb:?}");
            (0..3).for_each(|i| sum[i] += f64::from(rgb[i]) / f64::from(N));
        }
        assert!(sum.iter().all(|mean| (mean - 1.0).abs() < 1e-3), "{sum:?}");
        let most = |u| {
            let [r, g, b] = Wavelength::sample(u).color.to_rgb();
            if r > g.max(b) {
                'r'
            } else if g > b {
                'g'
            } else {
                'b'
            }
        };
        assert_eq!([0.2, 0.5, 0.9].map(most), ['b', 'g', 'r']);
        assert!(Wavelength::sample(0.0).nm < 400.0 && Wavelength::sample(1.0 - f32::EPSILON).nm > 700.0);
    }
}
