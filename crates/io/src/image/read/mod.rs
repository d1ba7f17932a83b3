//! Pictures that scenes refer to: OpenEXR, Radiance HDR, PNG and JPEG, told apart by their first bytes.
//!
//! What comes out is linear Rec. 709 without alpha, finite and not negative. OpenEXR and Radiance are linear already;
//! PNG and JPEG are decoded as sRGB, whatever profile they carry.

mod exr;
mod hdr;
mod repair;
mod srgb;

use std::path::Path;

use eyebeam_core::film::Image;

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
    warnings.extend(repair::repair(&mut image));
    Ok((image, warnings))
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
    picture.warnings.extend(repair::repair(&mut picture.image));
    Ok(picture)
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

fn decode(bytes: &[u8]) -> Decoded {
    match bytes {
        [0x76, 0x2f, 0x31, 0x01, ..] => exr::decode(bytes),
        [b'#', b'?', ..] => hdr::decode(bytes),
        [0x89, b'P', b'N', b'G', ..] => srgb::decode_png(bytes),
        [0xff, 0xd8, 0xff, ..] => srgb::decode_jpeg(bytes),
        [] => Err(FileError::new("the picture is empty")),
        _ => Err(FileError::new("this is no picture of a known format")
            .hint("OpenEXR, Radiance HDR, PNG and JPEG are read; convert it to one of them")),
    }
}

/// Larger pictures are refused.
const MAX_PIXELS: u64 = 1 << 28;
/// Pictures that need more memory to decode are refused.
const MAX_MEMORY: u64 = 4 << 30;

/// A black picture, if it and what its decoder needs for each pixel are within the limits.
fn canvas(width: u64, height: u64, decoder_bytes_per_pixel: u64) -> Result<Image, FileError> {
    check_size(width, height, decoder_bytes_per_pixel)?;
    Ok(Image::new(width as u32, height as u32))
}

fn check_size(width: u64, height: u64, decoder_bytes_per_pixel: u64) -> Result<(), FileError> {
    let pixels = width.saturating_mul(height);
    if pixels == 0 {
        return Err(FileError::new("the picture has no pixels"));
    }
    let memory = pixels.saturating_mul(size_of::<[f32; 3]>() as u64 + decoder_bytes_per_pixel);
    if pixels > MAX_PIXELS || memory > MAX_MEMORY {
        return Err(FileError::new(format!("a picture of {width} x {height} pixels is too large"))
            .hint(format!("up to {MAX_PIXELS} pixels and {} GiB of memory are allowed", MAX_MEMORY >> 30)));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limits() {
        assert!(check_size(3, 2, 100).is_ok());
        for (width, height, bytes) in [(0, 5, 0), (1 << 14, (1 << 14) + 1, 0), (1 << 14, 1 << 14, 5), (1 << 63, 8, 1)] {
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
