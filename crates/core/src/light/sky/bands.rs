//! Light in twelve bands of 30 nm from 370 to 730 nm, and the colour it is seen as.

use std::f64::consts::{LN_2, LOG2_E};
use std::ops::{Add, AddAssign, Mul};

use crate::color::{XYZ_TO_RGB, x_bar, y_bar, z_bar};

/// How many bands.
const COUNT: usize = 12;
/// Where the first begins, and how wide each is, nm.
const FIRST: f64 = 370.0;
const WIDTH: f64 = 30.0;

/// A number for each band.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Bands([f64; COUNT]);

/// The sun's irradiance outside of the atmosphere, W / (m² nm): ASTM G173-03, doi:10.1520/G0173-03R20, means of the
/// bins of 10 nm in Bruneton 2017, doi:10.1109/TVCG.2016.2622272.
pub(super) const SOLAR: Bands =
    Bands([1.101, 1.716, 1.853, 1.992, 1.902, 1.871, 1.840, 1.783, 1.675, 1.561, 1.478, 1.373]);

/// Ozone's cross-section at 233 K, 1e-25 m²: Serdyuchenko et al. 2014, doi:10.5194/amt-7-625-2014, from the same bins.
pub(super) const OZONE: Bands =
    Bands([0.003_879, 0.0327, 0.1581, 0.5448, 1.328, 2.662, 4.146, 4.706, 3.753, 2.251, 1.208, 0.6375]);

impl Bands {
    pub(super) const ZERO: Self = Self([0.0; COUNT]);
    pub(super) const ONE: Self = Self([1.0; COUNT]);

    /// A function of the wavelength in micrometres, at the middle of each band.
    pub(super) fn of_micrometres(f: impl Fn(f64) -> f64) -> Self {
        Self(std::array::from_fn(|i| f((FIRST + (i as f64 + 0.5) * WIDTH) * 1e-3)))
    }

    #[inline]
    pub(super) fn map(mut self, f: impl Fn(f64) -> f64) -> Self {
        for value in &mut self.0 {
            *value = f(*value);
        }
        self
    }

    /// exp(-x) of each optical thickness x ≥ 0, to 1e-10. Written so that the compiler computes several at a time.
    #[inline]
    pub(super) fn transmittance(self) -> Self {
        /// A sum with this is rounded to a whole number, which its last bits show.
        const WHOLE: f64 = 6_755_399_441_055_744.0;
        self.map(|x| {
            // 2^(whole + rest) with |rest| <= 1/2; what is less than 2^-1000 is no light.
            let power = (-x * LOG2_E).max(-1000.0);
            let whole = power + WHOLE;
            let r = (power - (whole - WHOLE)) * LN_2;
            let high = 1.0 / 24.0 + r * (1.0 / 120.0 + r * (1.0 / 720.0 + r * (1.0 / 5040.0 + r * (1.0 / 40_320.0))));
            let exp = 1.0 + r * (1.0 + r * (0.5 + r * (1.0 / 6.0 + r * high)));
            exp * f64::from_bits((whole.to_bits() + 1023) << 52)
        })
    }

    #[inline]
    pub(super) fn zip(mut self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        for (value, other) in self.0.iter_mut().zip(other.0) {
            *value = f(*value, other);
        }
        self
    }
}

impl Add for Bands {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        self.zip(other, |a, b| a + b)
    }
}

impl AddAssign for Bands {
    #[inline]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl Mul for Bands {
    type Output = Self;
    #[inline]
    fn mul(self, other: Self) -> Self {
        self.zip(other, |a, b| a * b)
    }
}

impl Mul<f64> for Bands {
    type Output = Self;
    #[inline]
    fn mul(self, factor: f64) -> Self {
        self.map(|a| a * factor)
    }
}

/// From bands to linear Rec. 709.
pub(super) struct Observer {
    /// Red, green and blue of one unit in each band.
    weights: [Bands; 3],
}

impl Observer {
    /// Most that a watt can look like, lm.
    const EFFICACY: f64 = 683.002;

    /// Spectral radiance in W / (m² sr nm) becomes a colour whose luminance is in cd / m².
    pub(super) fn new() -> Self {
        let xyz = [x_bar, y_bar, z_bar].map(|curve| Bands(std::array::from_fn(|band| integral(curve, band))));
        let row = |[x, y, z]: [f64; 3]| (xyz[0] * x + xyz[1] * y + xyz[2] * z) * Self::EFFICACY;
        Self { weights: XYZ_TO_RGB.map(row) }
    }

    /// The colour; channels outside of Rec. 709 are negative.
    pub(super) fn rgb(&self, light: Bands) -> [f64; 3] {
        self.weights.map(|weight| (weight * light).0.iter().sum())
    }
}

/// The integral of a curve over a band, nm.
fn integral(curve: fn(f64) -> f64, band: usize) -> f64 {
    let start = FIRST + band as f64 * WIDTH;
    (0..WIDTH as u32).map(|nm| curve(start + f64::from(nm) + 0.5)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn transmittance_is_the_exponential() {
        for i in 0..100_000 {
            let x = f64::from(i) * 0.007;
            let t = Bands::ONE.map(|_| x).transmittance().0[3];
            assert!((t - (-x).exp()).abs() <= 1e-9 * (-x).exp() + 1e-300, "{x}: {t}");
        }
    }

    #[test]
    fn colours_of_known_lights() {
        let observer = Observer::new();
        // The sun outside: 133 klx (133.1 to 133.8: Darula, Kittler & Gueymard 2005, Solar Energy 79).
        let [r, g, b] = observer.rgb(SOLAR);
        let lux = 0.2126 * r + 0.7152 * g + 0.0722 * b;
        assert!((lux / 133_400.0 - 1.0).abs() < 0.02, "{lux}");
        // An even spectrum is the white point E, x = y = 1/3: 1.2048, 0.9483, 0.9087 of its luminance.
        let rgb = observer.rgb(Bands::ONE);
        for (channel, expected) in rgb.into_iter().zip([1.2048, 0.9483, 0.9087]) {
            assert!((channel / (683.002 * 106.857) / expected - 1.0).abs() < 0.02, "{rgb:?}");
        }
    }
}
