//! PNG, JPEG and WebP: signals of 8 or 16 bits, taken as sRGB. Of an animation comes the first frame.

use std::io::Cursor;

use eyebeam_core::texture::{Pixels, Samples};
use image::codecs::jpeg::JpegDecoder;
use image::codecs::webp::WebPDecoder;
use image::metadata::Orientation;
use image::{DynamicImage, ImageDecoder, ImageError, ImageResult};
use png::{BitDepth, Decoder, DecodingError, Limits, Reader, Transformations};

use crate::error::FileError;
use crate::image::read::pixels::{compact, pixels};
use crate::image::read::{DEFLATE, check_length, check_size};
use crate::warning::Warning;

/// A picture, and what could not be kept of it.
type Decoded = Result<(Pixels, Vec<Warning>), FileError>;

type Png<'b> = Reader<Cursor<&'b [u8]>>;

/// What a PNG may keep beside its pixels.
const PNG_MEMORY: usize = 256 << 20;

/// Refused if the picture, and so many bytes more for each pixel, are more than is allowed.
pub(super) fn decode_png(bytes: &[u8], more: u64) -> Decoded {
    let (mut reader, _) = open_png(bytes, more)?;
    let warnings = unkept_of_png(&reader, bytes);
    let (width, height) = reader.info().size();
    let (color, depth) = reader.output_color_type();
    let channels = color.samples();
    let mut signals = vec![0; width as usize * height as usize * stride(&reader)];
    reader.next_frame(&mut signals).map_err(wrong_png)?;
    let (channels, samples) = if depth == BitDepth::Sixteen {
        let words = signals.as_chunks().0.iter().map(|bytes| u16::from_be_bytes(*bytes)).collect();
        let (channels, words) = compact(channels, words, u16::MAX);
        (channels, Samples::Word(words))
    } else {
        let (channels, signals) = compact(channels, signals, u8::MAX);
        (channels, Samples::Byte(signals))
    };
    Ok((pixels([width, height], channels, samples)?, warnings))
}

/// What says how it is to be shown.
fn unkept_of_png(reader: &Png<'_>, bytes: &[u8]) -> Vec<Warning> {
    let info = reader.info();
    let gamma = info.gama_chunk.filter(|_| info.srgb.is_none()).map(|gamma| gamma.into_value());
    let is_other = |gamma: &f32| (gamma - 1.0 / 2.2).abs() > 0.01;
    let gamma = gamma.filter(is_other).map(|gamma| Warning::new(format!("the picture's gamma {gamma} is ignored")));
    let frames = info.animation_control.map_or(1, |animation| animation.num_frames);
    let frames = (frames > 1).then(|| Warning::new(format!("of {frames} frames the first is read")));
    let colors = profile_of_png(bytes).filter(|name| names_other_colors(name)).map(|_| other_colors());
    gamma.into_iter().chain(colors).chain(frames).collect()
}

/// The name of the colour profile, which stands before the pixels and is not compressed.
fn profile_of_png(bytes: &[u8]) -> Option<&[u8]> {
    let mut rest = bytes.get(8..)?;
    loop {
        let (length, chunk) = rest.split_first_chunk()?;
        let (kind, chunk) = chunk.split_first_chunk()?;
        let data = chunk.get(..u32::from_be_bytes(*length) as usize)?;
        match kind {
            b"iCCP" => return data.split(|byte| *byte == 0).next(),
            b"IDAT" => return None,
            // Four bytes of a checksum.
            _ => rest = chunk.get(data.len() + 4..)?,
        }
    }
}

/// Whether the name of a profile is one of those that are not sRGB; most names say nothing.
fn names_other_colors(name: &[u8]) -> bool {
    let others: [&[u8]; 5] = [b"P3", b"Adobe RGB", b"ProPhoto", b"2020", b"Wide Gamut"];
    others.iter().any(|other| name.windows(other.len()).any(|part| part == *other))
}

fn other_colors() -> Warning {
    Warning::new("the picture's colour profile is ignored: it is taken as sRGB")
}

/// The memory that pixels take, by the header alone, and so many bytes more for each.
pub(super) fn png_size(bytes: &[u8], more: u64) -> Result<u64, FileError> {
    open_png(bytes, more).map(|(_, memory)| memory)
}

fn open_png(bytes: &[u8], more: u64) -> Result<(Png<'_>, u64), FileError> {
    let mut decoder = Decoder::new_with_limits(Cursor::new(bytes), Limits { bytes: PNG_MEMORY });
    decoder.set_ignore_text_chunk(true);
    decoder.set_ignore_iccp_chunk(true);
    // Palettes become colours, and less than 8 bits 8.
    decoder.set_transformations(Transformations::EXPAND);
    let reader = decoder.read_info().map_err(wrong_png)?;
    let (width, height) = reader.info().size();
    // Words are put in order in another place.
    let copies = if reader.output_color_type().1 == BitDepth::Sixteen { 2 } else { 1 };
    let memory = check_size(width.into(), height.into(), copies * stride(&reader) as u64 + more)?;
    let in_byte = 8 / reader.info().bits_per_pixel().clamp(1, 8) as u64;
    check_length(bytes, width.into(), height.into(), DEFLATE * in_byte)?;
    Ok((reader, memory))
}

/// Bytes of a pixel.
fn stride(reader: &Png<'_>) -> usize {
    let (color, depth) = reader.output_color_type();
    color.samples() * if depth == BitDepth::Sixteen { 2 } else { 1 }
}

fn wrong_png(e: DecodingError) -> FileError {
    FileError::new(format!("cannot decode the PNG: {e}"))
}

/// A kind of picture of 8 bits whose whole decoder is another crate's.
struct Coded {
    name: &'static str,
    /// What decoding takes for a pixel.
    bytes_per_pixel: u64,
    /// The most pixels that a byte can stand for.
    pixels_in_byte: u64,
}

/// Of a progressive JPEG: three coefficients, their samples, and the decoded bytes. A block of 64 pixels takes a bit at least.
const JPEG: Coded = Coded { name: "JPEG", bytes_per_pixel: 20, pixels_in_byte: 8 * 64 };

/// Of a WebP: the decoded bytes, twice, and what they are predicted from. Pixels of one colour would take nothing; this is enough for a
/// large picture of one.
const WEBP: Coded = Coded { name: "WebP", bytes_per_pixel: 12, pixels_in_byte: 1 << 16 };

impl Coded {
    fn wrong(&self, e: &ImageError) -> FileError {
        FileError::new(format!("cannot decode the {}: {e}", self.name))
    }

    /// With the memory that its pixels take, and so many bytes more for each.
    fn open<D: ImageDecoder>(&self, decoder: ImageResult<D>, bytes: &[u8], more: u64) -> Result<(D, u64), FileError> {
        let decoder = decoder.map_err(|e| self.wrong(&e))?;
        let (width, height) = decoder.dimensions();
        check_size(width.into(), height.into(), self.bytes_per_pixel + more)?;
        check_length(bytes, width.into(), height.into(), self.pixels_in_byte)?;
        let memory = u64::from(width) * u64::from(height) * (u64::from(decoder.color_type().bytes_per_pixel()) + more);
        Ok((decoder, memory))
    }

    fn decode<D: ImageDecoder>(&self, decoder: ImageResult<D>, bytes: &[u8], more: u64) -> Decoded {
        let (mut decoder, _) = self.open(decoder, bytes, more)?;
        let warnings = unkept(&mut decoder);
        let (width, height) = decoder.dimensions();
        let (channels, signals) = match DynamicImage::from_decoder(decoder).map_err(|e| self.wrong(&e))? {
            DynamicImage::ImageLuma8(grey) => (1, grey.into_raw()),
            DynamicImage::ImageRgba8(color) => (4, color.into_raw()),
            color => (3, color.into_rgb8().into_raw()),
        };
        let (channels, signals) = compact(channels, signals, u8::MAX);
        Ok((pixels([width, height], channels, Samples::Byte(signals))?, warnings))
    }
}

/// What says how it is to be shown.
fn unkept(decoder: &mut impl ImageDecoder) -> Vec<Warning> {
    let is_turned = decoder.orientation().is_ok_and(|orientation| orientation != Orientation::NoTransforms);
    let profile = decoder.icc_profile().ok().flatten().filter(|profile| !is_srgb(profile));
    let turned = is_turned.then(|| Warning::new("the picture says that it is to be turned: it is read as it lies"));
    let colors = profile.map(|_| other_colors());
    turned.into_iter().chain(colors).collect()
}

/// Whether a colour profile has the name of sRGB, in one of the ways to write it.
fn is_srgb(profile: &[u8]) -> bool {
    let has = |name: &[u8]| profile.windows(name.len()).any(|part| part == name);
    has(b"sRGB") || has(b"s\0R\0G\0B")
}

/// Refused if the picture, and so many bytes more for each pixel, are more than is allowed.
pub(super) fn decode_jpeg(bytes: &[u8], more: u64) -> Decoded {
    JPEG.decode(JpegDecoder::new(Cursor::new(bytes)), bytes, more)
}

/// The memory that pixels take, by the header alone, and so many bytes more for each.
pub(super) fn jpeg_size(bytes: &[u8], more: u64) -> Result<u64, FileError> {
    JPEG.open(JpegDecoder::new(Cursor::new(bytes)), bytes, more).map(|(_, memory)| memory)
}

/// Refused if the picture, and so many bytes more for each pixel, are more than is allowed.
pub(super) fn decode_webp(bytes: &[u8], more: u64) -> Decoded {
    let decoder = WebPDecoder::new(Cursor::new(bytes));
    let is_animated = decoder.as_ref().is_ok_and(WebPDecoder::has_animation);
    let (pixels, mut warnings) = WEBP.decode(decoder, bytes, more)?;
    if is_animated {
        warnings.push(Warning::new("of an animation the first frame is read"));
    }
    Ok((pixels, warnings))
}

/// The memory that pixels take, by the header alone, and so many bytes more for each.
pub(super) fn webp_size(bytes: &[u8], more: u64) -> Result<u64, FileError> {
    WEBP.open(WebPDecoder::new(Cursor::new(bytes)), bytes, more).map(|(_, memory)| memory)
}

#[cfg(test)]
mod tests {
    use eyebeam_core::color::srgb_decode;
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
            assert_eq!(decode_png(&bytes, 0).unwrap().0.to_image().pixels(), [expected]);
        }
    }

    #[test]
    fn sixteen_bits_are_finer_than_eight() {
        let bytes = png(ColorType::Grayscale, BitDepth::Sixteen, 2, &[], &[128, 0, 128, 1]);
        let image = decode_png(&bytes, 0).unwrap().0.to_image();
        assert!(image.pixel(0, 0)[0] < image.pixel(1, 0)[0]);
    }

    /// Alpha stays if it says anything, and what is grey is kept as one channel.
    #[test]
    fn no_more_channels_than_it_takes() {
        use ColorType::{Grayscale, GrayscaleAlpha, Rgb, Rgba};
        for (color, signals, expected) in [
            (Rgba, &[9, 8, 7, 255, 6, 5, 4, 255][..], &[9, 8, 7, 6, 5, 4][..]),
            (Rgba, &[9, 8, 7, 255, 6, 5, 4, 254], &[9, 8, 7, 255, 6, 5, 4, 254]),
            (Rgba, &[9, 9, 9, 255, 6, 6, 6, 0], &[9, 255, 6, 0]),
            (Rgb, &[9, 9, 9, 6, 6, 6], &[9, 6]),
            (GrayscaleAlpha, &[9, 255, 6, 255], &[9, 6]),
            (Grayscale, &[9, 6], &[9, 6]),
        ] {
            let pixels = decode_png(&png(color, BitDepth::Eight, 2, &[], signals), 0).unwrap().0;
            assert!(*pixels.samples() == Samples::Byte(expected.to_vec()), "{signals:?}");
            assert_eq!(pixels.channels(), expected.len() / 2);
        }
    }

    #[test]
    fn what_says_how_it_is_to_be_shown_is_told_of() {
        use image::codecs::jpeg::JpegEncoder;
        use image::{ExtendedColorType, ImageEncoder};
        let said = |decoded: Decoded| decoded.unwrap().1.into_iter().map(|w| w.message).collect::<Vec<_>>().join("; ");
        let jpeg = |profile: &[u8], orientation: u8| {
            let mut bytes = Vec::new();
            let mut encoder = JpegEncoder::new(&mut bytes);
            encoder.set_icc_profile(profile.to_vec()).unwrap();
            // A TIFF of one number.
            let number = [0x12, 0x01, 3, 0, 1, 0, 0, 0, orientation, 0, 0, 0, 0, 0, 0, 0];
            encoder.set_exif_metadata([b"II*\0\x08\0\0\0\x01\0", &number[..]].concat()).unwrap();
            encoder.write_image(&[9; 3], 1, 1, ExtendedColorType::Rgb8).unwrap();
            bytes
        };
        assert_eq!(said(decode_jpeg(&jpeg(b"the sRGB profile", 1), 0)), "");
        assert_eq!(said(decode_jpeg(&jpeg(b"\0s\0R\0G\0B\0", 1), 0)), "");
        assert_eq!(
            said(decode_jpeg(&jpeg(b"Display P3", 6), 0)),
            "the picture says that it is to be turned: it is read as it lies; \
             the picture's colour profile is ignored: it is taken as sRGB"
        );
        let png = |gamma: f32, frames: u32, profile: &[u8]| {
            let mut bytes = Vec::new();
            let mut info = png::Info::with_size(1, 1);
            info.icc_profile = (!profile.is_empty()).then(|| profile.to_vec().into());
            let mut encoder = Encoder::with_info(&mut bytes, info).unwrap();
            encoder.set_source_gamma(png::ScaledFloat::new(gamma));
            if frames > 1 {
                encoder.set_animated(frames, 0).unwrap();
            }
            let mut writer = encoder.write_header().unwrap();
            (0..frames).for_each(|_| writer.write_image_data(&[7]).unwrap());
            drop(writer);
            bytes
        };
        assert_eq!(said(decode_png(&png(0.45455, 1, b""), 0)), "");
        let profiled = png(0.45455, 1, b"anything");
        assert_eq!(profile_of_png(&profiled), Some(&b"_"[..]));
        assert_eq!(said(decode_png(&profiled, 0)), "");
        assert!(names_other_colors(b"Display P3") && !names_other_colors(b"sRGB IEC61966-2.1"));
        assert_eq!(
            said(decode_png(&png(1.0, 2, b""), 0)),
            "the picture's gamma 1 is ignored; of 2 frames the first is read"
        );
    }

    /// Without losses, as the encoder writes it.
    #[test]
    fn webp_is_the_same_as_png() {
        use image::codecs::webp::WebPEncoder;
        for (color, kind, signals) in [
            (ColorType::Rgb, image::ExtendedColorType::Rgb8, &[9, 8, 7, 6, 5, 4][..]),
            (ColorType::Rgba, image::ExtendedColorType::Rgba8, &[9, 8, 7, 255, 6, 5, 4, 3]),
        ] {
            let mut webp = Vec::new();
            WebPEncoder::new_lossless(&mut webp).encode(signals, 2, 1, kind).unwrap();
            let expected = decode_png(&png(color, BitDepth::Eight, 2, &[], signals), 0).unwrap();
            assert!(decode_webp(&webp, 0).unwrap() == expected);
            assert!(webp_size(&webp, 0).unwrap() >= expected.0.bytes() as u64);
            for end in 0..webp.len() {
                let _ = decode_webp(&webp[..end], 0).is_ok();
            }
        }
    }
}
