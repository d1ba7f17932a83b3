//! Vignetting: the corners of a picture are darker, as light falls on them at an angle.
//!
//! An ideal lens whose picture has the field of view `fov` from the bottom to the top lights its film by cos⁴ θ, with θ
//! the angle to the middle: tan θ = r tan(fov / 2), where r is the distance from the middle in half heights. Gardner,
//! "Validity of the cosine-fourth-power law of illumination", J. Res. Natl. Bur. Stand. 39, 1947,
//! doi:10.6028/jres.039.012.

use crate::film::Image;

/// Darkens a picture; `fov` in degrees.
pub(super) fn darken(image: &mut Image, fov: f32) {
    let (width, height) = (image.width() as f32, image.height() as f32);
    let columns = image.width().max(1) as usize;
    let scale = 2.0 * libm::tanf(0.5 * fov.to_radians()) / height;
    for (y, row) in image.pixels_mut().chunks_mut(columns).enumerate() {
        for (x, pixel) in row.iter_mut().enumerate() {
            let [dx, dy] = [x as f32 + 0.5 - 0.5 * width, y as f32 + 0.5 - 0.5 * height].map(|d| d * scale);
            let cos_sq = 1.0 / (1.0 + dx * dx + dy * dy);
            *pixel = pixel.map(|c| c * (cos_sq * cos_sq));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn by_the_fourth_power_of_the_cosine() {
        let mut image = Image::new(5, 3);
        image.pixels_mut().fill([1.0, 2.0, 4.0]);
        darken(&mut image, 90.0);
        assert_eq!(image.pixel(2, 1), [1.0, 2.0, 4.0]);
        for (x, y) in (0..3).flat_map(|y| (0..5).map(move |x| (x, y))) {
            // At 90 degrees the upper edge is as far away as the film.
            let tan = (f64::from(x) - 2.0).hypot(f64::from(y) - 1.0) / 1.5;
            let expected = tan.atan().cos().powi(4);
            assert!((f64::from(image.pixel(x, y)[0]) - expected).abs() < 1e-6);
            assert_eq!(image.pixel(x, y), image.pixel(4 - x, 2 - y));
        }
    }
}
