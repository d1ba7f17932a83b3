//! Image files. The format that is written follows from the ending of the name, that which is read from the bytes.

mod exr;
mod hdr;
mod png;
mod read;

pub use exr::encode_channels;
pub use read::{read_image, read_image_bytes};

use std::path::Path;

use eyebeam_core::color::srgb_encode;
use eyebeam_core::film::Image;

use crate::error::Error;

/// A format that pictures are written in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ImageFormat {
    /// 8 bit sRGB, with straight alpha.
    Png,
    /// 32 bit linear, with everything above white, and alpha that colours are multiplied by.
    Exr,
    /// Radiance RGBE, linear; no alpha.
    Hdr,
}

impl ImageFormat {
    /// Formats by the endings of their names.
    const ENDINGS: [(&str, Self); 3] = [("png", Self::Png), ("exr", Self::Exr), ("hdr", Self::Hdr)];

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

    /// The file's bytes. `provenance` says in JSON what made the picture; PNG and EXR keep it under the name `eyebeam`.
    ///
    /// # Errors
    /// If the picture is too large for the format.
    pub fn encode(self, image: &Image, provenance: &str) -> Result<Vec<u8>, Error> {
        match self {
            Self::Png => png::encode(image, &ascii(provenance)),
            Self::Exr => exr::encode(image, &ascii(provenance)),
            Self::Hdr => hdr::encode(image),
        }
    }
}

/// The picture as screens show it: 8 bit sRGB, three bytes a pixel, row by row.
pub fn srgb_bytes(image: &Image) -> Vec<u8> {
    image.pixels().iter().flatten().map(|&c| srgb_byte(c)).collect()
}

fn srgb_byte(linear: f32) -> u8 {
    (srgb_encode(linear.clamp(0.0, 1.0)) * 255.0).round() as u8
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
        for bad in ["a.jpg", "png", "a."] {
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
