//! JPEG: 8 bit, as screens show it, with losses. A picture with alpha is laid over black.
//!
//! What made it stands in comments, `eyebeam {…}` and `eyebeam.look {…}`; a text of more than 64 KiB is left out.

use eyebeam_core::film::Image;
use image::ExtendedColorType;
use image::codecs::jpeg::JpegEncoder;

use crate::error::Error;
use crate::image::encoding::{Encoding, look_json, pixels};

/// The most pixels that a side can have.
pub(super) const MAX_SIDE: u32 = 65535;

pub(super) fn encode(image: &Image, provenance: &str, encoding: &Encoding) -> Result<Vec<u8>, Error> {
    let image = &*encoding.look.through_lens(image);
    let grade = encoding.look.grade(image);
    // Colours that are multiplied by alpha are colours over black.
    let samples: Vec<_> = pixels(image, |rgb, x, y| grade.byte(rgb, x, y)).collect();
    let mut bytes = Vec::new();
    JpegEncoder::new_with_quality(&mut bytes, encoding.quality.clamp(1, 100))
        .encode(&samples, image.width(), image.height(), ExtendedColorType::Rgb8)
        .map_err(|e| Error::Encode(e.to_string()))?;
    let texts = [("eyebeam", provenance), ("eyebeam.look", &look_json(&encoding.look, &grade))];
    let comments: Vec<_> = texts.iter().flat_map(|(key, json)| comment(&format!("{key} {json}"))).collect();
    let at = after_first_segment(&bytes);
    bytes.splice(at..at, comments);
    Ok(bytes)
}

/// A text as a segment; nothing if it is too long for one.
fn comment(text: &str) -> Vec<u8> {
    const COM: [u8; 2] = [0xff, 0xfe];
    // The length counts itself.
    let length = u16::try_from(text.len() + 2).ok();
    length.map_or_else(Vec::new, |length| [&COM, &length.to_be_bytes(), text.as_bytes()].concat())
}

/// Where the segment ends that says what kind of JPEG it is, and which must come first.
fn after_first_segment(bytes: &[u8]) -> usize {
    match bytes {
        &[_, _, 0xff, 0xe0, high, low, ..] => 4 + usize::from(u16::from_be_bytes([high, low])),
        _ => 2,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn gradient() -> Image {
        let mut image = Image::new(40, 24);
        let places = (0..24).flat_map(|y| (0..40).map(move |x| (x, y)));
        places.for_each(|(x, y)| image.set_pixel(x, y, [x as f32 / 40.0, y as f32 / 24.0, 0.3]));
        image
    }

    fn read(bytes: &[u8]) -> Vec<u8> {
        image::load_from_memory_with_format(bytes, image::ImageFormat::Jpeg).unwrap().into_rgb8().into_raw()
    }

    fn error(quality: u8) -> f64 {
        let bytes = encode(&gradient(), "{}", &Encoding { quality, ..Encoding::default() }).unwrap();
        let expected = crate::image::srgb_bytes(&gradient());
        let errors = read(&bytes).into_iter().zip(&expected).map(|(a, &b)| (f64::from(a) - f64::from(b)).powi(2));
        (errors.sum::<f64>() / expected.len() as f64).sqrt()
    }

    #[test]
    fn reads_back_about_the_same() {
        assert!(error(90) < 2.0 && error(100) < error(90) && error(90) < error(20), "{} {}", error(90), error(100));
    }

    #[test]
    fn says_what_made_it() {
        let provenance = "{\"spp\":4}";
        let bytes = encode(&gradient(), provenance, &Encoding::default()).unwrap();
        assert_eq!((&bytes[..2], &bytes[6..10]), (&[0xff, 0xd8][..], &b"JFIF"[..]));
        let text = String::from_utf8_lossy(&bytes).into_owned();
        assert!(text.contains("eyebeam {\"spp\":4}") && text.contains("eyebeam.look {\"view\":\"standard\""));
        let long = format!("{{\"scene\":\"{}\"}}", "a".repeat(70_000));
        assert_eq!(read(&encode(&gradient(), &long, &Encoding::default()).unwrap()), read(&bytes));
    }

    #[test]
    fn alpha_is_laid_over_black() {
        let opaque = encode(&gradient(), "{}", &Encoding::default()).unwrap();
        let transparent = encode(&gradient().with_alpha(vec![0.5; 40 * 24]), "{}", &Encoding::default()).unwrap();
        assert_eq!(opaque, transparent);
    }
}
