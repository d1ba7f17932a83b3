//! Pictures of textures: bytes stay bytes, and grey one channel.

use std::path::Path;

use eyebeam_core::texture::{Pixels, Samples};

use crate::error::{Error, FileError};
use crate::file;
use crate::image::read::{Format, LINEAR, exr, hdr, ktx2, of, repair_image, signals};
use crate::warning::Warning;

/// Reads a picture as it is in the file, but for alpha that is 1 everywhere and colours that are all grey, and says what could
/// not be kept.
///
/// # Errors
/// As [`read_image`](super::read_image).
pub fn read_pixels(path: &Path) -> Result<(Pixels, Vec<Warning>), Error> {
    read_pixels_bytes(&path.display().to_string(), &file::read(path)?)
}

/// As [`read_pixels`], from the bytes of a file; `name` stands for it in errors.
///
/// # Errors
/// If the bytes are damaged, or the picture is too large.
pub fn read_pixels_bytes(name: &str, bytes: &[u8]) -> Result<(Pixels, Vec<Warning>), Error> {
    let (pixels, warnings) = decode(bytes).map_err(|e| e.of(name))?;
    Ok((pixels, of(name, warnings)))
}

/// About the memory that [`read_pixels_bytes`] needs for the picture: what its header says, before anything is decoded.
///
/// # Errors
/// If the header is damaged, or the picture is too large.
pub fn pixels_size(name: &str, bytes: &[u8]) -> Result<u64, Error> {
    size(bytes, 0).map_err(|e| e.of(name))
}

/// As [`pixels_size`], for [`read_image_bytes`](super::read_image_bytes).
///
/// # Errors
/// If the header is damaged, or the picture is too large.
pub fn image_size(name: &str, bytes: &[u8]) -> Result<u64, Error> {
    size(bytes, LINEAR).map_err(|e| e.of(name))
}

/// With so many bytes more for each pixel that is a signal.
fn size(bytes: &[u8], more: u64) -> Result<u64, FileError> {
    match Format::of(bytes)? {
        Format::Exr => exr::size(bytes),
        Format::Hdr => hdr::size(bytes),
        Format::Png => signals::png_size(bytes, more),
        Format::Jpeg => signals::jpeg_size(bytes, more),
        Format::WebP => signals::webp_size(bytes, more),
        Format::Ktx2 => ktx2::size(bytes, more),
    }
}

fn decode(bytes: &[u8]) -> Result<(Pixels, Vec<Warning>), FileError> {
    match Format::of(bytes)? {
        Format::Exr => exr::decode_pixels(bytes),
        Format::Hdr => {
            let (mut image, mut warnings) = hdr::decode(bytes)?;
            warnings.extend(repair_image(&mut image));
            let size = [image.width(), image.height()];
            Ok((pixels(size, 3, Samples::Float(image.into_pixels().into_flattened()))?, warnings))
        }
        Format::Png => signals::decode_png(bytes, 0),
        Format::Jpeg => signals::decode_jpeg(bytes, 0),
        Format::WebP => signals::decode_webp(bytes, 0),
        Format::Ktx2 => Ok((ktx2::decode(bytes, 0)?, Vec::new())),
    }
}

/// The picture, if its decoder has given as many numbers as it should.
pub(super) fn pixels([width, height]: [u32; 2], channels: usize, samples: Samples) -> Result<Pixels, FileError> {
    let wrong = || FileError::new("the picture has another size than it says");
    Pixels::new(width, height, channels, samples).ok_or_else(wrong)
}

/// Drops alpha that is `opaque` everywhere, and two channels of colours that are all grey. Returns the number of channels
/// that are left.
pub(super) fn compact<T: Copy + PartialEq>(channels: usize, mut samples: Vec<T>, opaque: T) -> (usize, Vec<T>) {
    let mut all = samples.chunks_exact(channels.max(1));
    let is_grey = channels < 3 || all.clone().all(|p| p[0] == p[1] && p[1] == p[2]);
    let has_alpha = channels.is_multiple_of(2) && all.any(|p| p[channels - 1] != opaque);
    let kept: &[usize] = match (is_grey, has_alpha) {
        (true, false) => &[0],
        (true, true) => &[0, channels - 1],
        (false, false) => &[0, 1, 2],
        (false, true) => &[0, 1, 2, 3],
    };
    if kept.len() == channels {
        return (channels, samples);
    }
    let count = samples.len() / channels.max(1);
    for i in 0..count {
        // What is read lies never before what is written.
        for (to, from) in kept.iter().enumerate() {
            samples[i * kept.len() + to] = samples[i * channels + from];
        }
    }
    samples.truncate(count * kept.len());
    samples.shrink_to_fit();
    (kept.len(), samples)
}
