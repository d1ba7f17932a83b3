//! OpenEXR: the first layer that has R, G and B, or Y alone; half, float or integer, scan lines or tiles.
//!
//! The picture is the layer's data window. Deep data, further layers and smaller resolutions are not read, and alpha only
//! where it is asked for.

use std::io::Cursor;

use exr::block::samples::FromNativeSample;
use exr::block::{self, reader::Reader};
use exr::compression::Compression;
use exr::error::Error as ExrError;
use exr::image::read::specific_channels::ReadSpecificChannel;
use exr::math::Vec2;
use exr::meta::attribute::SampleType;
use exr::meta::attribute::{AttributeValue, Text};
use exr::meta::header::Header;
use exr::prelude::{ReadChannels, ReadLayers, f16, read};
use eyebeam_core::film::Image;
use eyebeam_core::texture::{Pixels, Samples};

use crate::error::FileError;
use crate::image::exr::REC_709;
use crate::image::read::pixels::{compact, pixels};
use crate::image::read::repair::repair;
use crate::image::read::{DEFLATE, Decoded, LinearPicture, check_length, check_size};
use crate::warning::Warning;

/// Of a picture with alpha in single precision.
const BYTES_PER_PIXEL: u64 = 16;
/// A block of lines or a tile is decoded at once.
const MAX_BLOCK: usize = 1 << 30;
/// A small one may always be.
const SMALL_BLOCK: u64 = 1 << 20;

pub(super) fn decode(bytes: &[u8]) -> Decoded {
    let Opened { file, color, warnings, .. } = open(bytes)?;
    let image = if color { decode_rgb(file) } else { decode_y(file) };
    Ok((image.map_err(wrong)?, warnings))
}

/// As [`decode`], with alpha if not all of it is 1, and with the attribute that says in JSON what made the picture.
pub(super) fn decode_linear(bytes: &[u8]) -> Result<LinearPicture, FileError> {
    let Opened { file, color, alpha, provenance, warnings, .. } = open(bytes)?;
    let image = match (color, alpha) {
        (true, true) => decode_rgba(file),
        (true, false) => decode_rgb(file),
        (false, _) => decode_y(file),
    };
    Ok(LinearPicture { image: image.map_err(wrong)?, provenance, warnings })
}

/// As they are in the file: in 16 bits if all that is read is. What is infinite, no number or negative is put right.
pub(super) fn decode_pixels(bytes: &[u8]) -> Result<(Pixels, Vec<Warning>), FileError> {
    let Opened { file, color, half, mut warnings, .. } = open(bytes)?;
    let (size, channels, samples) = if half {
        let (size, channels, samples) = collect(file, color).map_err(wrong)?;
        let mut bits: Vec<_> = samples.into_iter().map(f16::to_bits).collect();
        warnings.extend(repair(&mut bits, channels, 0, |bits| f16::from_bits(bits).to_f32()));
        let (channels, bits) = compact(channels, bits, f16::ONE.to_bits());
        (size, channels, Samples::Half(bits))
    } else {
        let (size, channels, mut samples) = collect(file, color).map_err(wrong)?;
        warnings.extend(repair(&mut samples, channels, 0.0, |c| c));
        let (channels, samples) = compact(channels, samples, 1.0);
        (size, channels, Samples::Float(samples))
    };
    Ok((pixels(size, channels, samples)?, warnings))
}

/// The memory that pixels take, by the header alone, at most.
pub(super) fn size(bytes: &[u8]) -> Result<u64, FileError> {
    open(bytes).map(|opened| opened.memory)
}

/// The size, and the numbers of either colour and alpha, 1 where there is none, or of grey.
fn collect<T: FromNativeSample>(
    file: Reader<Cursor<&[u8]>>,
    color: bool,
) -> Result<([u32; 2], usize, Vec<T>), ExrError> {
    let read = read().no_deep_data().largest_resolution_level().specific_channels();
    let size = |Vec2(width, height)| [width as u32, height as u32];
    if !color {
        let pixels = read.required("Y").collect_pixels(
            |Vec2(width, height), _| (size(Vec2(width, height)), vec![T::default(); width * height]),
            |(size, samples): &mut ([u32; 2], Vec<T>), Vec2(x, y), (luminance,): (T,)| {
                samples[y * size[0] as usize + x] = luminance;
            },
        );
        let file = pixels.first_valid_layer().all_attributes().non_parallel().from_chunks(file)?;
        let (size, samples) = file.layer_data.channel_data.pixels;
        return Ok((size, 1, samples));
    }
    let pixels = read.required("R").required("G").required("B").optional("A", T::from_f32(1.0)).collect_pixels(
        |Vec2(width, height), _| (size(Vec2(width, height)), vec![[T::default(); 4]; width * height]),
        |(size, samples): &mut ([u32; 2], Vec<[T; 4]>), Vec2(x, y), (r, g, b, a): (T, T, T, T)| {
            samples[y * size[0] as usize + x] = [r, g, b, a];
        },
    );
    let file = pixels.first_valid_layer().all_attributes().non_parallel().from_chunks(file)?;
    let (size, samples) = file.layer_data.channel_data.pixels;
    Ok((size, 4, samples.into_flattened()))
}

fn wrong(e: ExrError) -> FileError {
    FileError::new(format!("cannot decode the OpenEXR picture: {e}"))
}

/// A file whose pixels are still to be decoded, and what its header tells.
struct Opened<'b> {
    file: Reader<Cursor<&'b [u8]>>,
    /// Whether it has R, G and B.
    color: bool,
    /// Whether they come with alpha.
    alpha: bool,
    /// Whether all of these are in 16 bits.
    half: bool,
    /// What its pixels take, at most.
    memory: u64,
    provenance: Option<String>,
    warnings: Vec<Warning>,
}

fn open(bytes: &[u8]) -> Result<Opened<'_>, FileError> {
    let file = block::read(Cursor::new(bytes), false).map_err(wrong)?;
    let headers = file.headers();
    let with = |names: &[&str]| headers.iter().find(|h| !h.deep && names.iter().all(|n| channel(h, n)));
    let color = with(&["R", "G", "B"]);
    let header = color.or_else(|| with(&["Y"])).ok_or_else(|| no_channels(headers))?;
    let Vec2(width, height) = header.layer_size;
    let memory = check_size(width as u64, height as u64, BYTES_PER_PIXEL)?;
    check_length(bytes, width as u64, height as u64, pixels_in_byte(header.compression))?;
    if header.max_block_byte_size() > block_limit(bytes, header.compression) {
        return Err(FileError::new("the blocks of the OpenEXR picture are too large").hint("store it in scan lines"));
    }
    let (color, alpha) = (color.is_some(), channel(header, "A"));
    let is_read = |name: &Text| ["R", "G", "B", "A"].iter().any(|read| name.eq(read)) || !color && name.eq("Y");
    let mut read = header.channels.list.iter().filter(|c| is_read(&c.name));
    let half = read.all(|c| c.sample_type == SampleType::F16);
    let (provenance, warnings) = (provenance(header), warnings(header, !color));
    Ok(Opened { file, color, alpha, half, memory, provenance, warnings })
}

/// How many bytes a block can have that is in so many.
fn block_limit(bytes: &[u8], compression: Compression) -> usize {
    let gain = 4 * pixels_in_byte(compression);
    (bytes.len() as u64).saturating_mul(gain).max(SMALL_BLOCK).min(MAX_BLOCK as u64) as usize
}

/// The most pixels that a byte can stand for: of one channel in 16 bits.
fn pixels_in_byte(compression: Compression) -> u64 {
    match compression {
        Compression::Uncompressed => 1,
        // Runs of 128 bytes in two, of which two are a pixel.
        Compression::RLE => 32,
        // 4 x 4 pixels in three bytes.
        Compression::B44 | Compression::B44A => 6,
        // Of 8 x 8 pixels there may be one number, which is deflated.
        Compression::DWAA(_) | Compression::DWAB(_) => 64 * DEFLATE,
        _ => DEFLATE,
    }
}

fn provenance(header: &Header) -> Option<String> {
    let AttributeValue::Text(text) = header.own_attributes.other.get(&Text::from("eyebeam"))? else { return None };
    let text = text.to_string();
    // Anybody may have written it.
    serde_json::from_str::<serde_json::Map<_, _>>(&text).is_ok().then_some(text)
}

fn channel(header: &Header, name: &str) -> bool {
    header.channels.list.iter().any(|c| c.name.eq(name) && c.sampling == Vec2(1, 1))
}

fn no_channels(headers: &[Header]) -> FileError {
    if headers.iter().all(|h| h.deep) {
        return FileError::new("deep OpenEXR pictures are not read").hint("flatten it");
    }
    let names: Vec<_> = headers.iter().flat_map(|h| &h.channels.list).map(|c| c.name.to_string()).take(20).collect();
    FileError::new(format!("no layer of the OpenEXR picture has R, G and B, or Y; there are {}", names.join(", ")))
        .hint("rename the channels of the layer that you want")
}

fn warnings(header: &Header, grey: bool) -> Vec<Warning> {
    let mut warnings = Vec::new();
    if header.shared_attributes.chromaticities.is_some_and(|c| c != REC_709) {
        warnings.push(Warning::new("the picture's primaries are not those of Rec. 709: they are ignored"));
    }
    if header.data_window() != header.shared_attributes.display_window {
        warnings.push(Warning::new("the picture's data window is not its display window: it is cut to its data"));
    }
    if grey && ["RY", "BY"].iter().any(|n| header.channels.list.iter().any(|c| c.name.eq(n))) {
        warnings.push(Warning::new("the picture's colour differences RY and BY are ignored: it is grey"));
    }
    warnings
}

fn decode_rgb(file: Reader<Cursor<&[u8]>>) -> Result<Image, ExrError> {
    let pixels = read().no_deep_data().largest_resolution_level().specific_channels();
    let pixels = pixels.required("R").required("G").required("B");
    let pixels = pixels.collect_pixels(
        |Vec2(width, height), _| Image::new(width as u32, height as u32),
        |image: &mut Image, Vec2(x, y), (r, g, b): (f32, f32, f32)| image.set_pixel(x as u32, y as u32, [r, g, b]),
    );
    let file = pixels.first_valid_layer().all_attributes().non_parallel().from_chunks(file)?;
    Ok(file.layer_data.channel_data.pixels)
}

fn decode_rgba(file: Reader<Cursor<&[u8]>>) -> Result<Image, ExrError> {
    let pixels = read().no_deep_data().largest_resolution_level().specific_channels();
    let pixels = pixels.required("R").required("G").required("B").required("A");
    let pixels = pixels.collect_pixels(
        |Vec2(width, height), _| (Image::new(width as u32, height as u32), vec![0.0; width * height]),
        |(image, alpha): &mut (Image, Vec<f32>), Vec2(x, y), (r, g, b, a): (f32, f32, f32, f32)| {
            image.set_pixel(x as u32, y as u32, [r, g, b]);
            alpha[y * image.width() as usize + x] = if a.is_finite() { a } else { 0.0 };
        },
    );
    let file = pixels.first_valid_layer().all_attributes().non_parallel().from_chunks(file)?;
    let (image, alpha) = file.layer_data.channel_data.pixels;
    Ok(if alpha.iter().all(|&a| a == 1.0) { image } else { image.with_alpha(alpha) })
}

fn decode_y(file: Reader<Cursor<&[u8]>>) -> Result<Image, ExrError> {
    let pixels = read().no_deep_data().largest_resolution_level().specific_channels().required("Y");
    let pixels = pixels.collect_pixels(
        |Vec2(width, height), _| Image::new(width as u32, height as u32),
        |image: &mut Image, Vec2(x, y), (luminance,): (f32,)| image.set_pixel(x as u32, y as u32, [luminance; 3]),
    );
    let file = pixels.first_valid_layer().all_attributes().non_parallel().from_chunks(file)?;
    Ok(file.layer_data.channel_data.pixels)
}

#[cfg(test)]
mod tests {
    use exr::prelude::*;

    fn encode(compression: Compression, channels: &[(&str, FlatSamples)]) -> Vec<u8> {
        let channels = channels.iter().map(|(name, samples)| AnyChannel::new(*name, samples.clone())).collect();
        let encoding = Encoding { compression, blocks: Blocks::Tiles(Vec2(2, 2)), line_order: LineOrder::Increasing };
        let layer = Layer::new((3, 1), LayerAttributes::named("a"), encoding, AnyChannels::sort(channels));
        let mut bytes = Vec::new();
        let file = Image::from_layer(layer);
        file.write().non_parallel().to_buffered(std::io::Cursor::new(&mut bytes)).unwrap();
        bytes
    }

    fn pixels(bytes: &[u8]) -> Vec<[f32; 3]> {
        super::decode(bytes).unwrap().0.pixels().to_vec()
    }

    #[test]
    fn every_kind_of_sample() {
        let half = FlatSamples::F16([0.5, 1.0, 2.0].map(f16::from_f32).to_vec());
        let float = FlatSamples::F32(vec![0.1, 1e-20, 1e30]);
        let integer = FlatSamples::U32(vec![0, 1, 70000]);
        for compression in [Compression::Uncompressed, Compression::RLE, Compression::ZIP1, Compression::PIZ] {
            let channels = [("R", half.clone()), ("A", half.clone()), ("G", float.clone()), ("B", integer.clone())];
            let expected = [[0.5, 0.1, 0.0], [1.0, 1e-20, 1.0], [2.0, 1e30, 70000.0]];
            assert_eq!(pixels(&encode(compression, &channels)), expected, "{compression:?}");
        }
        assert_eq!(pixels(&encode(Compression::ZIP16, &[("Y", half)])), [[0.5; 3], [1.0; 3], [2.0; 3]]);
    }

    /// Only if every channel that is read has 16 bits they stay so.
    #[test]
    fn pixels_are_as_wide_as_in_the_file() {
        let half = |values: [f32; 3]| FlatSamples::F16(values.map(f16::from_f32).to_vec());
        let decode =
            |channels: &[(&str, FlatSamples)]| super::decode_pixels(&encode(Compression::ZIP1, channels)).unwrap();
        let values = [0.5, 1.0, -2.0];
        let [r, g, b] = [half(values), half([0.25; 3]), half([f32::NAN, 1.0, f32::INFINITY])];
        let (pixels, warnings) = decode(&[("R", r.clone()), ("G", g.clone()), ("B", b.clone()), ("Z", r.clone())]);
        assert_eq!((pixels.channels(), pixels.bytes(), warnings.len()), (3, 18, 1));
        assert_eq!(pixels.to_image().pixels(), [[0.5, 0.25, 0.0], [1.0, 0.25, 1.0], [0.0, 0.25, 1.0]]);
        let float = FlatSamples::F32(vec![1.0, 1.0, 0.5]);
        let (pixels, _) = decode(&[("R", r.clone()), ("G", g), ("B", b), ("A", float)]);
        assert_eq!((pixels.channels(), pixels.bytes()), (4, 48));
        let (pixels, _) = decode(&[("Y", r)]);
        assert_eq!((pixels.channels(), pixels.bytes()), (1, 6));
    }

    #[test]
    fn other_channels_are_told() {
        let samples = FlatSamples::F32(vec![0.0; 3]);
        let bytes = encode(Compression::RLE, &[("Z", samples.clone()), ("diffuse.R", samples)]);
        let error = super::decode(&bytes).unwrap_err();
        assert!(error.message.ends_with("there are Z, diffuse.R"), "{error}");
    }
}
