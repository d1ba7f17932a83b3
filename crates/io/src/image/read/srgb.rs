//! PNG and JPEG: signals of 8 or 16 bits, decoded as sRGB. Alpha is ignored; of an animation comes the first frame.

use std::io::Cursor;

use eyebeam_core::color::srgb_decode;
use eyebeam_core::film::Image;
use image::codecs::jpeg::JpegDecoder;
use image::{DynamicImage, ImageDecoder};
use png::{BitDepth, Decoder, DecodingError, Limits, Transformations};

use crate::error::FileError;
use crate::image::read::{Decoded, canvas};

/// What a PNG may keep beside its pixels.
const PNG_MEMORY: usize = 256 << 20;

pub(super) fn decode_png(bytes: &[u8]) -> Decoded {
    let wrong = |e: DecodingError| FileError::new(format!("cannot decode the PNG: {e}"));
    let mut decoder = Decoder::new_with_limits(Cursor::new(bytes), Limits { bytes: PNG_MEMORY });
    decoder.set_ignore_text_chunk(true);
    decoder.set_ignore_iccp_chunk(true);
    // Palettes become colours, and less than 8 bits 8.
    decoder.set_transformations(Transformations::EXPAND);
    let mut reader = decoder.read_info().map_err(wrong)?;
    let (width, height) = reader.info().size();
    let (color, depth) = reader.output_color_type();
    let wide = usize::from(depth == BitDepth::Sixteen) + 1;
    let stride = color.samples() * wide;
    let mut image = canvas(width.into(), height.into(), stride as u64)?;
    let mut signals = vec![0; width as usize * height as usize * stride];
    reader.next_frame(&mut signals).map_err(wrong)?;
    let linear = linear_of(if wide == 2 { u16::MAX } else { 255 });
    // Grey, grey and alpha, colour, colour and alpha.
    let channels = if color.samples() < 3 { [0, 0, 0] } else { [0, 1, 2] };
    fill(&mut image, &signals, stride, |pixel| {
        channels.map(|c| {
            let signal = match pixel[c * wide..(c + 1) * wide] {
                [high, low] => u16::from_be_bytes([high, low]),
                [byte] => byte.into(),
                _ => 0,
            };
            linear[usize::from(signal)]
        })
    });
    Ok((image, Vec::new()))
}

/// Of a progressive JPEG: three coefficients, their samples, and the decoded bytes.
const JPEG_BYTES_PER_PIXEL: u64 = 20;

pub(super) fn decode_jpeg(bytes: &[u8]) -> Decoded {
    let wrong = |e| FileError::new(format!("cannot decode the JPEG: {e}"));
    let decoder = JpegDecoder::new(Cursor::new(bytes)).map_err(wrong)?;
    let (width, height) = decoder.dimensions();
    let mut image = canvas(width.into(), height.into(), JPEG_BYTES_PER_PIXEL)?;
    let signals = DynamicImage::from_decoder(decoder).map_err(wrong)?.into_rgb8();
    let linear = linear_of(255);
    fill(&mut image, signals.as_raw(), 3, |pixel| [0, 1, 2].map(|c| linear[usize::from(pixel[c])]));
    Ok((image, Vec::new()))
}

/// Linear light by signal, 0..=max.
fn linear_of(max: u16) -> Vec<f32> {
    (0..=max).map(|signal| srgb_decode(f32::from(signal) / f32::from(max))).collect()
}

fn fill(image: &mut Image, signals: &[u8], stride: usize, linear: impl Fn(&[u8]) -> [f32; 3]) {
    let width = image.width();
    for (y, row) in signals.chunks_exact(stride * width as usize).enumerate() {
        for (x, pixel) in row.chunks_exact(stride).enumerate() {
            image.set_pixel(x as u32, y as u32, linear(pixel));
        }
    }
}

#[cfg(test)]
mod tests {
    use png::{ColorType, Encoder};

    use super::*;

    fn png(color: ColorType, depth: BitDepth, width: u32, palette: &'static [u8], signals: &[u8]) -> Vec<u8> {
        let mut bytes = Vec::new();
        let mut encoder = Encoder::new(&mut bytes, width, 1);
        encoder.set_color(color);
        encoder.set_depth(depth);
        if !palette.is_empty() {
            encoder.set_palette(palette);
        }
        encoder.write_header().unwrap().write_image_data(signals).unwrap();
        bytes
    }

    #[test]
    fn every_kind_of_png() {
        use BitDepth::{Eight, One, Sixteen};
        use ColorType::{Grayscale, GrayscaleAlpha, Indexed, Rgb, Rgba};
        let byte = |b: u8| srgb_decode(f32::from(b) / 255.0);
        let color = [byte(255), byte(188), byte(0)];
        for (bytes, expected) in [
            (png(Rgb, Eight, 1, &[], &[255, 188, 0]), color),
            (png(Rgba, Eight, 1, &[], &[255, 188, 0, 3]), color),
            (png(Rgb, Sixteen, 1, &[], &[255, 255, 188, 188, 0, 0]), color),
            (png(Rgba, Sixteen, 1, &[], &[255, 255, 188, 188, 0, 0, 9, 9]), color),
            (png(Indexed, Eight, 1, &[0, 0, 0, 255, 188, 0], &[1]), color),
            (png(Grayscale, Eight, 1, &[], &[188]), [byte(188); 3]),
            (png(GrayscaleAlpha, Eight, 1, &[], &[188, 9]), [byte(188); 3]),
            (png(Grayscale, One, 1, &[], &[0x80]), [1.0; 3]),
        ] {
            assert_eq!(decode_png(&bytes).unwrap().0.pixels(), [expected]);
        }
    }

    #[test]
    fn sixteen_bits_are_finer_than_eight() {
        let bytes = png(ColorType::Grayscale, BitDepth::Sixteen, 2, &[], &[128, 0, 128, 1]);
        let (image, _) = decode_png(&bytes).unwrap();
        assert!(image.pixel(0, 0)[0] < image.pixel(1, 0)[0]);
    }
}
