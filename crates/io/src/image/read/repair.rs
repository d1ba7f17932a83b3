//! Values that are no radiance: renderers and cameras leave some in their pictures, and one of them in an environment
//! map would spoil whatever it lights.

use eyebeam_core::film::Image;

use crate::warning::Warning;

/// Sets what is negative or not a number to 0, and what is infinite to the largest finite value of the picture. Counts
/// the pixels in a warning.
pub(super) fn repair(image: &mut Image) -> Option<Warning> {
    let (mut not_finite, mut negative, mut largest) = (0_u64, 0_u64, 0.0_f32);
    for pixel in image.pixels() {
        not_finite += u64::from(pixel.iter().any(|c| !c.is_finite()));
        negative += u64::from(pixel.iter().any(|&c| c < 0.0 && c.is_finite()));
        largest = pixel.iter().filter(|c| c.is_finite()).fold(largest, |l, &c| l.max(c));
    }
    if not_finite + negative == 0 {
        return None;
    }
    for y in 0..image.height() {
        for x in 0..image.width() {
            let pixel = image.pixel(x, y).map(|c| if c > 0.0 { c.min(largest) } else { 0.0 });
            image.set_pixel(x, y, pixel);
        }
    }
    let pixels = |n| if n == 1 { "1 pixel".to_owned() } else { format!("{n} pixels") };
    let message = match (not_finite, negative) {
        (0, negative) => format!("{} had negative values: they are 0 now", pixels(negative)),
        (bad, 0) => format!("{} had values that are not finite: they are 0 now, or {largest} if infinite", pixels(bad)),
        (bad, negative) => format!(
            "{} had values that are not finite, {} negative ones: they are 0 now, or {largest} if infinite",
            pixels(bad),
            pixels(negative)
        ),
    };
    Some(Warning::new(message))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture(pixels: &[[f32; 3]]) -> Image {
        let mut image = Image::new(pixels.len() as u32, 1);
        pixels.iter().enumerate().for_each(|(x, &p)| image.set_pixel(x as u32, 0, p));
        image
    }

    #[test]
    fn what_is_fine_stays() {
        let mut image = picture(&[[0.0, 1e30, 2.0], [1e-40, 0.5, f32::MAX]]);
        let before = image.clone();
        assert_eq!(repair(&mut image), None);
        assert_eq!(image, before);
    }

    #[test]
    fn each_kind_is_counted_by_pixel() {
        let (nan, inf) = (f32::NAN, f32::INFINITY);
        let mut image = picture(&[[nan, nan, 1.0], [inf, 7.0, -inf], [-1.0, -2.0, 3.0], [1.0; 3]]);
        let warning = repair(&mut image).unwrap();
        assert_eq!(image.pixels(), [[0.0, 0.0, 1.0], [7.0, 7.0, 0.0], [0.0, 0.0, 3.0], [1.0; 3]]);
        assert!(warning.message.starts_with("2 pixels had values that are not finite, 1 pixel negative"), "{warning}");
        assert_eq!(repair(&mut image), None);
    }

    #[test]
    fn nothing_finite_is_black() {
        let mut image = picture(&[[f32::INFINITY; 3]]);
        assert!(repair(&mut image).is_some());
        assert_eq!(image.pixels(), [[0.0; 3]]);
    }
}
