//! White balance: light of one temperature made to look white.
//!
//! What has the chromaticity of a black body of T kelvin comes to have that of one of 6500 K, which is nearly the white of
//! Rec. 709 (D65), so at 6500 K nothing changes, and lower numbers take away the yellow of lamps. The eye's adaptation is a
//! factor on each of three cone-like responses (von Kries), those of Bradford:
//!
//! ```text
//! M = (B X)⁻¹ diag(B w(6500) / B w(T)) (B X)        X: Rec. 709 to CIE XYZ,  B: XYZ to responses,  w: white in XYZ
//! ```
//!
//! Lam, "Metamerism and colour constancy", PhD thesis, University of Bradford, 1985. The black body's chromaticity:
//! Krystek, "An algorithm to calculate correlated colour temperature", Color Research & Application 10(1), 1985,
//! doi:10.1002/col.5080100109, within 1e-4 from 1000 to 15 000 K.

use glam::{DMat3, DVec3, Mat3};

use crate::look::Look;

/// Linear Rec. 709 to CIE XYZ, from the primaries and D65; rows.
const RGB_TO_XYZ: [[f64; 3]; 3] = [
    [0.412_390_8, 0.357_584_3, 0.180_480_8],
    [0.212_639_0, 0.715_168_7, 0.072_192_3],
    [0.019_330_8, 0.119_194_8, 0.950_532_2],
];

/// CIE XYZ to Bradford's responses; rows.
const BRADFORD: [[f64; 3]; 3] = [[0.8951, 0.2664, -0.1614], [-0.7502, 1.7135, 0.0367], [0.0389, -0.0685, 1.0296]];

/// What makes light of `kelvin`, 1000 to 15 000, look as that of 6500 K does: on linear Rec. 709.
pub(super) fn matrix(kelvin: f32) -> Mat3 {
    let to_responses = rows(BRADFORD) * rows(RGB_TO_XYZ);
    let white = |kelvin: f32| rows(BRADFORD) * black_body(kelvin.into());
    let gains = white(Look::WHITE) / white(kelvin);
    (to_responses.inverse() * DMat3::from_diagonal(gains) * to_responses).as_mat3()
}

fn rows(rows: [[f64; 3]; 3]) -> DMat3 {
    DMat3::from_cols_array_2d(&rows).transpose()
}

/// XYZ of a black body of temperature `t`, of luminance 1.
fn black_body(t: f64) -> DVec3 {
    // CIE 1960 UCS.
    let u = (0.860_117_757 + 1.541_182_54e-4 * t + 1.286_412_12e-7 * t * t)
        / (1.0 + 8.424_202_35e-4 * t + 7.081_451_63e-7 * t * t);
    let v = (0.317_398_726 + 4.228_062_45e-5 * t + 4.204_816_91e-8 * t * t)
        / (1.0 - 2.897_418_16e-5 * t + 1.614_560_53e-7 * t * t);
    let [x, y] = [3.0 * u, 2.0 * v].map(|c| c / (2.0 * u - 8.0 * v + 4.0));
    DVec3::new(x, y, 1.0 - x - y) / y
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;

    fn chromaticity(xyz: DVec3) -> [f64; 2] {
        [xyz.x, xyz.y].map(|c| c / xyz.element_sum())
    }

    /// Planck's law with the CIE 1931 observer; illuminant A is a black body of 2856 K.
    #[test]
    fn black_bodies() {
        let uv = |[x, y]: [f64; 2]| [4.0 * x, 6.0 * y].map(|c| c / (12.0 * y - 2.0 * x + 3.0));
        for (t, expected) in [(2856.0, [0.4476, 0.4074]), (5000.0, [0.3451, 0.3516]), (10000.0, [0.2807, 0.2884])] {
            let [seen, expected] = [chromaticity(black_body(t)), expected].map(uv);
            // What the formula promises, and the last digit.
            assert!(
                seen.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1.5e-4),
                "{t} K: {seen:?}, not {expected:?}"
            );
        }
    }

    #[test]
    fn at_6500_kelvin_nothing_changes() {
        assert!(matrix(6500.0).abs_diff_eq(Mat3::IDENTITY, 1e-6));
        assert_eq!(chromaticity(rows(RGB_TO_XYZ) * DVec3::ONE).map(|c| (c * 1e4).round()), [3127.0, 3290.0]);
    }

    #[test]
    fn the_light_of_a_lamp_becomes_as_that_of_6500_kelvin() {
        for kelvin in [1000.0, 1900.0, 2856.0, 4000.0, 9000.0, 15000.0] {
            let to_rgb = rows(RGB_TO_XYZ).inverse();
            let lamp = (to_rgb * black_body(kelvin.into())).as_vec3();
            let expected = (to_rgb * black_body(6500.0)).as_vec3();
            let seen = matrix(kelvin) * lamp;
            assert!(seen.abs_diff_eq(expected, 1e-5 * lamp.abs().max_element()), "{kelvin} K: {seen}");
        }
    }

    #[test]
    fn low_temperatures_make_blue_and_high_ones_yellow() {
        let blueness = |kelvin| (matrix(kelvin) * Vec3::ONE).dot(Vec3::new(-1.0, 0.0, 1.0));
        assert!([2000.0, 3000.0, 5000.0, 6500.0, 8000.0, 15000.0].map(blueness).is_sorted_by(|a, b| a > b));
    }
}
