//! Values that are no radiance: renderers and cameras leave some in their pictures, and one of them in an environment
//! map would spoil whatever it lights.

use crate::warning::Warning;

/// Sets what is negative or not a number to 0, and what is infinite to the largest finite value of the picture. Counts
/// the pixels, each of so many numbers, in a warning. `value` tells a number, and `zero` stands for 0.
pub(super) fn repair<T: Copy>(
    samples: &mut [T],
    channels: usize,
    zero: T,
    value: impl Fn(T) -> f32,
) -> Option<Warning> {
    let (mut not_finite, mut negative, mut largest) = (0_u64, 0_u64, zero);
    for pixel in samples.chunks_exact(channels.max(1)) {
        not_finite += u64::from(pixel.iter().any(|&c| !value(c).is_finite()));
        negative += u64::from(pixel.iter().any(|&c| value(c) < 0.0 && value(c).is_finite()));
        for &c in pixel.iter().filter(|c| value(**c).is_finite()) {
            largest = if value(c) > value(largest) { c } else { largest };
        }
    }
    if not_finite + negative == 0 {
        return None;
    }
    for c in samples {
        *c = if value(*c) > value(largest) { largest } else { *c };
        *c = if value(*c) > 0.0 { *c } else { zero };
    }
    let largest = value(largest);
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
    use eyebeam_core::film::Image;

    use super::*;

    fn repair(image: &mut Image) -> Option<Warning> {
        super::repair(image.pixels_mut().as_flattened_mut(), 3, 0.0, |c| c)
    }

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
