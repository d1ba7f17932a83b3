//! Metals by name: their complex index of refraction, eta + i k.
//!
//! Measured data, as collected at refractiveindex.info:
//!
//! - gold, copper: Johnson & Christy 1972, doi:10.1103/PhysRevB.6.4370,
//! - titanium, chromium, nickel: Johnson & Christy 1974, doi:10.1103/PhysRevB.9.5056,
//! - silver, tungsten, platinum: Rakić et al. 1998, doi:10.1364/AO.37.005271 (Brendel & Bormann's model),
//! - aluminium: Rakić 1995, doi:10.1364/AO.34.004755,
//! - iron, brass (70 % copper, 30 % zinc): Querry 1985, Optical Constants, CRDC-CR-85034.
//!
//! A renderer of three channels needs three numbers of a curve. Each is the mean of the curve from 380 to 780 nm, weighted by
//! the light of D65 times the channel's matching function: that of linear Rec. 709, made from those of CIE 1931. The colour
//! that Fresnel's equations give for such means is within 0.02 of that of the measured spectrum, except that gold's red, 1.04,
//! is more than a surface may reflect, and becomes 0.98.
//!
//! ```toml
//! [material.ring.conductor]
//! metal = "gold"
//! roughness = 0.2
//! ```

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::color::Rgb;

/// A metal whose index of refraction is known.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum NamedMetal {
    /// Al, greyish white, slightly blue.
    Aluminium,
    /// Copper with 30 % of zinc, yellow.
    Brass,
    /// Cr, grey.
    Chromium,
    /// Cu, orange.
    Copper,
    /// Au, yellow.
    Gold,
    /// Fe, grey.
    Iron,
    /// Ni, yellowish grey.
    Nickel,
    /// Pt, yellowish grey.
    Platinum,
    /// Ag, nearly white.
    Silver,
    /// Ti, brownish grey.
    Titanium,
    /// W, dark grey.
    Tungsten,
}

impl NamedMetal {
    /// Real and imaginary part of the index of refraction for red, green and blue.
    pub fn eta_k(self) -> (Rgb, Rgb) {
        let (eta, k) = match self {
            Self::Aluminium => ([1.481, 0.982, 0.598], [7.651, 6.549, 5.347]),
            Self::Brass => ([0.418, 0.520, 1.123], [3.668, 2.681, 1.771]),
            Self::Chromium => ([3.251, 3.107, 2.279], [3.289, 3.338, 3.124]),
            Self::Copper => ([0.173, 1.044, 1.290], [3.282, 2.599, 2.367]),
            Self::Gold => ([0.058, 0.500, 1.459], [3.613, 2.324, 1.819]),
            Self::Iron => ([2.437, 2.170, 1.703], [3.334, 3.164, 2.879]),
            Self::Nickel => ([2.022, 1.901, 1.724], [4.173, 3.564, 2.886]),
            Self::Platinum => ([2.344, 2.066, 1.822], [4.233, 3.675, 3.084]),
            Self::Silver => ([0.158, 0.144, 0.135], [3.879, 3.139, 2.305]),
            Self::Titanium => ([2.737, 2.507, 2.236], [3.828, 3.397, 3.010]),
            Self::Tungsten => ([3.666, 3.491, 3.296], [2.814, 2.752, 2.595]),
        };
        (Rgb(eta), Rgb(k))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::fresnel_conductor;

    /// The colours at normal incidence: first those of the measured spectra, then those that are commonly cited, from other
    /// measurements.
    #[test]
    fn metals_have_their_colours() {
        use NamedMetal::*;
        for (metal, spectrum, cited) in [
            (Aluminium, [0.907, 0.916, 0.922], Some([0.91, 0.92, 0.92])),
            (Brass, [0.910, 0.778, 0.423], None),
            (Chromium, [0.550, 0.556, 0.554], Some([0.55, 0.56, 0.55])),
            (Copper, [0.932, 0.623, 0.522], Some([0.95, 0.64, 0.54])),
            (Gold, [1.038, 0.728, 0.365], Some([1.00, 0.78, 0.34])),
            (Iron, [0.575, 0.567, 0.563], Some([0.56, 0.56, 0.58])),
            (Nickel, [0.697, 0.640, 0.563], Some([0.66, 0.61, 0.53])),
            (Platinum, [0.679, 0.640, 0.584], Some([0.67, 0.64, 0.58])),
            (Silver, [0.962, 0.949, 0.919], Some([0.97, 0.96, 0.92])),
            (Titanium, [0.619, 0.579, 0.543], None),
            (Tungsten, [0.506, 0.497, 0.477], None),
        ] {
            let (eta, k) = metal.eta_k();
            for i in 0..3 {
                let reflectance = fresnel_conductor(1.0, eta.0[i], k.0[i]);
                assert!(
                    (reflectance - f32::min(spectrum[i], 1.0)).abs() < 0.02,
                    "{metal:?}: {reflectance}, not {spectrum:?}"
                );
                let cited = f32::min(cited.unwrap_or(spectrum)[i], 1.0);
                assert!((reflectance - cited).abs() < 0.05, "{metal:?}: {reflectance}, not {cited:?}");
            }
        }
    }
}
