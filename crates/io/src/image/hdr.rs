//! Radiance HDR: linear, one exponent for three channels.

use eyebeam_core::film::Image;
use image::Rgb;
use image::codecs::hdr::HdrEncoder;

use crate::error::Error;

pub(super) fn encode(image: &Image) -> Result<Vec<u8>, Error> {
    let mut bytes = Vec::new();
    let pixels: Vec<_> = image.pixels().iter().map(|&p| Rgb(p)).collect();
    HdrEncoder::new(&mut bytes)
        .encode(&pixels, image.width() as usize, image.height() as usize)
        .map_err(|e| Error::Encode(e.to_string()))?;
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_back_to_eight_bits() {
        let mut image = Image::new(20, 3);
        image.set_pixel(7, 2, [0.25, 3.0, 100.0]);
        let bytes = encode(&image).unwrap();
        let read = image::load_from_memory_with_format(&bytes, image::ImageFormat::Hdr).unwrap().into_rgb32f();
        assert_eq!(read.dimensions(), (20, 3));
        for (c, expected) in read.get_pixel(7, 2).0.into_iter().zip([0.25, 3.0, 100.0]) {
            assert!((c - expected).abs() <= 100.0 / 256.0, "{c} instead of {expected}");
        }
        assert_eq!(read.get_pixel(0, 0).0, [0.0; 3]);
    }
}
