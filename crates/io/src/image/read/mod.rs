//! Pictures that scenes refer to: OpenEXR, Radiance HDR, PNG, JPEG, WebP and KTX2, told apart by their first bytes.
//!
//! What comes out is linear Rec. 709 without alpha, finite and not negative. OpenEXR and Radiance are linear already;
//! the others are decoded as sRGB, whatever profile they carry. Pictures of textures stay as they are in the file.

mod exr;
mod hdr;
mod ktx2;
mod pixels;
mod repair;
mod signals;

pub use pixels::{image_size, pixels_size, read_pixels, read_pixels_bytes};

use std::path::Path;

use eyebeam_core::film::Image;
use eyebeam_core::texture::Pixels;

use crate::error::{Error, FileError};
use crate::file;
use crate::warning::Warning;

/// A picture, or what is wrong with the file.
type Decoded = Result<(Image, Vec<Warning>), FileError>;

/// Reads a picture, and says what in it could not be kept.
///
/// Values that are negative or not a number count as 0, infinite ones as the largest of the picture.
///
/// # Errors
/// If the file cannot be read, is damaged, or is longer or larger (2²⁸ pixels, 4 GiB of memory) than is allowed.
pub fn read_image(path: &Path) -> Result<(Image, Vec<Warning>), Error> {
    read_image_bytes(&path.display().to_string(), &file::read(path)?)
}

/// As [`read_image`], from the bytes of a file; `name` stands for it in errors.
///
/// # Errors
/// If the bytes are damaged, or the picture is too large.
pub fn read_image_bytes(name: &str, bytes: &[u8]) -> Result<(Image, Vec<Warning>), Error> {
    let (mut image, mut warnings) = decode(bytes).map_err(|e| e.of(name))?;
    warnings.extend(repair_image(&mut image));
    Ok((image, of(name, warnings)))
}

/// Those of a file.
fn of(name: &str, warnings: Vec<Warning>) -> Vec<Warning> {
    warnings.into_iter().map(|warning| warning.of(name)).collect()
}

/// A picture of linear light, as a renderer wrote it.
#[derive(Clone, Debug, PartialEq)]
pub struct LinearPicture {
    /// Linear Rec. 709, finite and not negative, and its alpha.
    pub image: Image,
    /// What made it, as the JSON that Eyebeam writes.
    pub provenance: Option<String>,
    /// What could not be kept.
    pub warnings: Vec<Warning>,
}

/// Reads an OpenEXR or Radiance picture with its alpha and with what it says of itself, from a file or, for `-`, from
/// standard input.
///
/// # Errors
/// As [`read_image`], and if the picture is of another format.
pub fn read_linear(path: &Path) -> Result<LinearPicture, Error> {
    let bytes = if path == Path::new("-") { file::read_standard_input()? } else { file::read(path)? };
    read_linear_bytes(&path.display().to_string(), &bytes)
}

/// As [`read_linear`], from the bytes of a file; `name` stands for it in errors.
///
/// # Errors
/// If the bytes are damaged, the picture is too large, or of another format.
pub fn read_linear_bytes(name: &str, bytes: &[u8]) -> Result<LinearPicture, Error> {
    let mut picture = decode_linear(bytes).map_err(|e| e.of(name))?;
    picture.warnings.extend(repair_image(&mut picture.image));
    Ok(LinearPicture { warnings: of(name, picture.warnings), ..picture })
}

fn repair_image(image: &mut Image) -> Option<Warning> {
    repair::repair(image.pixels_mut().as_flattened_mut(), 3, 0.0, |c| c)
}

fn decode_linear(bytes: &[u8]) -> Result<LinearPicture, FileError> {
    match bytes {
        [0x76, 0x2f, 0x31, 0x01, ..] => exr::decode_linear(bytes),
        [b'#', b'?', ..] => {
            let (image, warnings) = hdr::decode(bytes)?;
            Ok(LinearPicture { image, provenance: None, warnings })
        }
        [] => Err(FileError::new("the picture is empty")),
        _ => Err(FileError::new("this is no picture of linear light").hint("OpenEXR and Radiance HDR are read")),
    }
}

/// A format that is read.
#[derive(Clone, Copy)]
enum Format {
    Exr,
    Hdr,
    Png,
    Jpeg,
    WebP,
    Ktx2,
}

impl Format {
    /// Told by the first bytes.
    fn of(bytes: &[u8]) -> Result<Self, FileError> {
        match bytes {
            [0x76, 0x2f, 0x31, 0x01, ..] => Ok(Self::Exr),
            [b'#', b'?', ..] => Ok(Self::Hdr),
            [0x89, b'P', b'N', b'G', ..] => Ok(Self::Png),
            [0xff, 0xd8, 0xff, ..] => Ok(Self::Jpeg),
            [b'R', b'I', b'F', b'F', _, _, _, _, b'W', b'E', b'B', b'P', ..] => Ok(Self::WebP),
            _ if bytes.starts_with(&ktx2::MAGIC) => Ok(Self::Ktx2),
            [] => Err(FileError::new("the picture is empty")),
            _ => Err(FileError::new("this is no picture of a known format")
                .hint("OpenEXR, Radiance HDR, PNG, JPEG, WebP and KTX2 are read; convert it to one of them")),
        }
    }
}

fn decode(bytes: &[u8]) -> Decoded {
    let signals = |(pixels, warnings): (Pixels, _)| (pixels.to_image(), warnings);
    match Format::of(bytes)? {
        Format::Exr => exr::decode(bytes),
        Format::Hdr => hdr::decode(bytes),
        Format::Png => signals::decode_png(bytes, LINEAR).map(signals),
        Format::Jpeg => signals::decode_jpeg(bytes, LINEAR).map(signals),
        Format::WebP => signals::decode_webp(bytes, LINEAR).map(signals),
        Format::Ktx2 => ktx2::decode(bytes, LINEAR).map(|pixels| signals((pixels, Vec::new()))),
    }
}

/// Bytes of a pixel of an [`Image`].
const LINEAR: u64 = size_of::<[f32; 3]>() as u64;

/// Larger pictures are refused.
const MAX_PIXELS: u64 = 1 << 28;
/// Pictures that need more memory to decode are refused.
const MAX_MEMORY: u64 = 4 << 30;

/// That so many bytes can stand for a picture; a byte stands for no more than `most` pixels.
///
/// Headers promise anything. So what is allocated is in proportion to what is there.
fn check_length(bytes: &[u8], width: u64, height: u64, most: u64) -> Result<(), FileError> {
    if width.saturating_mul(height) <= (bytes.len() as u64).saturating_mul(most) {
        return Ok(());
    }
    let length = bytes.len();
    Err(FileError::new(format!("{length} bytes are too few for a picture of {width} x {height} pixels"))
        .hint("it is cut off, or its header is wrong"))
}

/// What zlib makes of a byte at most: a run of 258 bytes in two bits.
const DEFLATE: u64 = 1032;

/// That a picture is within the limits that needs so much memory for each pixel; returns how much it needs.
fn check_size(width: u64, height: u64, bytes_per_pixel: u64) -> Result<u64, FileError> {
    let pixels = width.saturating_mul(height);
    if pixels == 0 {
        return Err(FileError::new("the picture has no pixels"));
    }
    let memory = pixels.saturating_mul(bytes_per_pixel);
    if pixels > MAX_PIXELS || memory > MAX_MEMORY {
        return Err(FileError::new(format!("a picture of {width} x {height} pixels is too large"))
            .hint(format!("up to {MAX_PIXELS} pixels and {} GiB of memory are allowed", MAX_MEMORY >> 30)));
    }
    Ok(memory)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limits() {
        assert_eq!(check_size(3, 2, 100), Ok(600));
        for (width, height, bytes) in [(0, 5, 0), (1 << 14, (1 << 14) + 1, 0), (1 << 14, 1 << 14, 17), (1 << 63, 8, 1)]
        {
            assert!(check_size(width, height, bytes).is_err(), "{width} x {height}");
        }
    }

    #[test]
    fn what_is_no_picture() {
        for (bytes, said) in [(&b""[..], "empty"), (b"GIF89a", "no picture of a known format"), (b"#", "no picture")] {
            let error = read_image_bytes("a.png", bytes).unwrap_err().to_string();
            assert!(error.contains(said) && error.contains("--> a.png"), "{error}");
        }
    }
}
