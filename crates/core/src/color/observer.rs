//! What an eye sees of light of one wavelength: the CIE 1931 colour matching functions as fitted by Wyman, Sloan & Shirley
//! 2013, jcgt.org/published/0002/02/01, and linear Rec. 709 of them.

/// From X, Y and Z to linear Rec. 709: IEC 61966-2-1.
pub(crate) const XYZ_TO_RGB: [[f64; 3]; 3] =
    [[3.240_97, -1.537_383, -0.498_611], [-0.969_244, 1.875_968, 0.041_555], [0.055_63, -0.203_977, 1.056_972]];

/// Luminous efficacy of light that is even from 370 to 730 nm, lm / W.
pub const LUMENS_PER_WATT: f32 = 683.0 * 106.86 / 360.0;

/// A Gaussian with one width on either side, each as its inverse.
fn lobe(nm: f64, center: f64, left: f64, right: f64) -> f64 {
    let t = (nm - center) * if nm < center { left } else { right };
    libm::exp(-0.5 * t * t)
}

pub(crate) fn x_bar(nm: f64) -> f64 {
    1.056 * lobe(nm, 599.8, 0.0264, 0.0323) + 0.362 * lobe(nm, 442.0, 0.0624, 0.0374)
        - 0.065 * lobe(nm, 501.1, 0.0490, 0.0382)
}

pub(crate) fn y_bar(nm: f64) -> f64 {
    0.821 * lobe(nm, 568.8, 0.0213, 0.0247) + 0.286 * lobe(nm, 530.9, 0.0613, 0.0322)
}

pub(crate) fn z_bar(nm: f64) -> f64 {
    1.217 * lobe(nm, 437.0, 0.0845, 0.0278) + 0.681 * lobe(nm, 459.0, 0.0385, 0.0725)
}
