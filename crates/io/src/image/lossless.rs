//! Pictures that were read, written so that they read back bit for bit: signals as PNG, light as OpenEXR.

use exr::prelude::{FlatSamples, f16};
use eyebeam_core::film::Image;
use eyebeam_core::texture::{Pixels, Samples};
use png::{BitDepth, ColorType, Encoder, EncodingError};

use crate::error::Error;
use crate::image::exr::encode_samples;

/// The ending of a file for pixels, and its bytes.
///
/// # Errors
/// If the picture is too large for the format.
pub fn encode_pixels(pixels: &Pixels) -> Result<(&'static str, Vec<u8>), Error> {
    let png = |depth, samples: &[u8]| {
        let bytes = encode_png(pixels, depth, samples).map_err(|e| Error::Encode(e.to_string()))?;
        Ok((".png", bytes))
    };
    let size = [pixels.width(), pixels.height()];
    let exr = |channel: &dyn Fn(usize) -> FlatSamples| {
        // Grey with alpha has no channels of its own; it is told by equal colours.
        let names: &[(&str, usize)] = match pixels.channels() {
            1 => &[("Y", 0)],
            2 => &[("R", 0), ("G", 0), ("B", 0), ("A", 1)],
            3 => &[("R", 0), ("G", 1), ("B", 2)],
            _ => &[("R", 0), ("G", 1), ("B", 2), ("A", 3)],
        };
        let channels = names.iter().map(|&(name, index)| (name, channel(index))).collect();
        Ok((".exr", encode_samples(size, channels)?))
    };
    let count = pixels.channels();
    match pixels.samples() {
        Samples::Byte(bytes) => png(BitDepth::Eight, bytes),
        Samples::Word(words) => {
            png(BitDepth::Sixteen, &words.iter().flat_map(|word| word.to_be_bytes()).collect::<Vec<_>>())
        }
        Samples::Half(words) => exr(&|index| {
            FlatSamples::F16(words.iter().skip(index).step_by(count).map(|&word| f16::from_bits(word)).collect())
        }),
        Samples::Float(numbers) => {
            exr(&|index| FlatSamples::F32(numbers.iter().skip(index).step_by(count).copied().collect()))
        }
    }
}

/// Light as an OpenEXR in single precision, without alpha.
///
/// # Errors
/// If the picture is too large for the format.
pub fn encode_light(image: &Image) -> Result<Vec<u8>, Error> {
    let channel = |index: usize| FlatSamples::F32(image.pixels().iter().map(|pixel| pixel[index]).collect());
    let channels = [("R", 0), ("G", 1), ("B", 2)].map(|(name, index)| (name, channel(index)));
    encode_samples([image.width(), image.height()], channels.into())
}

fn encode_png(pixels: &Pixels, depth: BitDepth, samples: &[u8]) -> Result<Vec<u8>, EncodingError> {
    let mut bytes = Vec::new();
    let mut encoder = Encoder::new(&mut bytes, pixels.width(), pixels.height());
    encoder.set_depth(depth);
    encoder.set_color(match pixels.channels() {
        1 => ColorType::Grayscale,
        2 => ColorType::GrayscaleAlpha,
        3 => ColorType::Rgb,
        _ => ColorType::Rgba,
    });
    encoder.write_header()?.write_image_data(samples)?;
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::image::{read_image_bytes, read_pixels_bytes};

    #[test]
    fn all_kinds_read_back() {
        for channels in 1..=4 {
            let count = 5 * 3 * channels as u16;
            let kinds = [
                Samples::Byte((0..count).map(|i| i as u8 * 3).collect()),
                Samples::Word((0..count).map(|i| i * 1021).collect()),
                Samples::Half((0..count).map(|i| i * 403).collect()),
                Samples::Float((0..count).map(|i| f32::from(i) * 0.123).collect()),
            ];
            for samples in kinds {
                let pixels = Pixels::new(5, 3, channels, samples).unwrap();
                let (_, bytes) = encode_pixels(&pixels).unwrap();
                assert!(read_pixels_bytes("a", &bytes).unwrap() == (pixels.clone(), vec![]), "{pixels:?}");
            }
        }
        let mut image = Image::new(5, 3);
        image.set_pixel(4, 2, [1e-7, 0.3, 12345.678]);
        assert_eq!(read_image_bytes("a", &encode_light(&image).unwrap()).unwrap(), (image, vec![]));
    }
}
