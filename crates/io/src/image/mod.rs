//! Image files. The format that is written follows from the ending of the name, that which is read from the bytes.

mod encoding;
mod exr;
mod hdr;
mod jpeg;
mod lossless;
mod png;
mod read;

pub use encoding::{Bits, Encoding};
pub use exr::encode_channels;
pub use lossless::{encode_light, encode_pixels};
pub use read::{
    LinearPicture, image_size, pixels_size, read_image, read_image_bytes, read_linear, read_linear_bytes, read_pixels,
    read_pixels_bytes,
};

use std::path::Path;

use eyebeam_core::film::Image;
use eyebeam_core::look::Look;

use crate::error::Error;

/// A format that pictures are written in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ImageFormat {
    /// 8 or 16 bit, as screens show it, with straight alpha.
    Png,
    /// 8 bit, as screens show it, with losses; alpha is laid over black.
    Jpeg,
    /// 32 or 16 bit linear, with everything above white, and alpha that colours are multiplied by.
    Exr,
    /// Radiance RGBE, linear; no alpha.
    Hdr,
}

impl ImageFormat {
    /// Formats by the endings of their names.
    const ENDINGS: [(&str, Self); 5] =
        [("png", Self::Png), ("jpg", Self::Jpeg), ("jpeg", Self::Jpeg), ("exr", Self::Exr), ("hdr", Self::Hdr)];

    /// The format of a file, by its name.
    ///
    /// # Errors
    /// If no format has such an ending.
    pub fn from_path(path: &Path) -> Result<Self, Error> {
        let ending = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
        let found = Self::ENDINGS.iter().find(|(e, _)| *e == ending);
        found.map(|(_, format)| *format).ok_or_else(|| Error::UnknownFormat {
            path: path.to_owned(),
            known: Self::ENDINGS.map(|(e, _)| format!(".{e}")).join(", "),
        })
    }

    /// Whether it holds what a screen shows, and not light.
    pub fn is_for_screens(self) -> bool {
        matches!(self, Self::Png | Self::Jpeg)
    }

    /// The most pixels that a side of the picture can have.
    pub fn max_side(self) -> u32 {
        if self == Self::Jpeg { jpeg::MAX_SIDE } else { u32::MAX }
    }

    /// The file's bytes. `provenance` says in JSON what made the picture; all but HDR keep it under the name `eyebeam`, and
    /// those for screens their look as `eyebeam.look`.
    ///
    /// # Errors
    /// If the picture is too large for the format.
    pub fn encode(self, image: &Image, provenance: &str, encoding: &Encoding) -> Result<Vec<u8>, Error> {
        match self {
            Self::Png => png::encode(image, &ascii(provenance), encoding),
            Self::Jpeg => jpeg::encode(image, &ascii(provenance), encoding),
            Self::Exr => exr::encode(image, &ascii(provenance), encoding.half),
            Self::Hdr => hdr::encode(image),
        }
    }
}

/// The picture as screens show it: 8 bit sRGB, three bytes a pixel, row by row.
pub fn srgb_bytes(image: &Image) -> Vec<u8> {
    let grade = Look::default().grade(image);
    encoding::pixels(image, |rgb, x, y| grade.byte(rgb, x, y)).collect()
}

/// JSON in ASCII alone, which every text field takes.
fn ascii(json: &str) -> String {
    let mut units = [0; 2];
    let mut text = String::with_capacity(json.len());
    for c in json.chars() {
        if c.is_ascii() {
            text.push(c);
        } else {
            c.encode_utf16(&mut units).iter().for_each(|unit| text.push_str(&format!("\\u{unit:04x}")));
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn format_by_ending() {
        assert_eq!(ImageFormat::from_path(Path::new("a/b.PNG")).unwrap(), ImageFormat::Png);
        assert_eq!(ImageFormat::from_path(Path::new("b.x.exr")).unwrap(), ImageFormat::Exr);
        for jpeg in ["a.jpg", "a.JPEG"] {
            assert_eq!(ImageFormat::from_path(Path::new(jpeg)).unwrap(), ImageFormat::Jpeg);
        }
        for bad in ["a.gif", "png", "a."] {
            assert!(matches!(ImageFormat::from_path(Path::new(bad)), Err(Error::UnknownFormat { .. })), "{bad}");
        }
    }

    #[test]
    fn provenance_survives_as_ascii() {
        let text = "{\"file\":\"Zürich 𝄞.toml\"}";
        let value: serde_json::Value = serde_json::from_str(&ascii(text)).unwrap();
        assert_eq!(value["file"], "Zürich 𝄞.toml");
    }
}
