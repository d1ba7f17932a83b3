//! PNG: 8 or 16 bit, as screens show it, with straight alpha.

use eyebeam_core::film::Image;
use eyebeam_core::look::{Grade, View};
use png::{BitDepth, ColorType, Compression, Encoder, EncodingError, ScaledFloat, SrgbRenderingIntent};

use crate::error::Error;
use crate::image::encoding::{Bits, Encoding, look_json, pixels};

pub(super) fn encode(image: &Image, provenance: &str, encoding: &Encoding) -> Result<Vec<u8>, Error> {
    let mut bytes = Vec::new();
    write(image, provenance, encoding, &mut bytes).map_err(|e| Error::Encode(e.to_string()))?;
    Ok(bytes)
}

fn write(image: &Image, provenance: &str, encoding: &Encoding, bytes: &mut Vec<u8>) -> Result<(), EncodingError> {
    let image = &*encoding.look.through_lens(image);
    let grade = encoding.look.grade(image);
    let mut encoder = Encoder::new(bytes, image.width(), image.height());
    encoder.set_color(if image.alpha().is_some() { ColorType::Rgba } else { ColorType::Rgb });
    encoder.set_compression(Compression::Balanced);
    if encoding.look.view == View::Raw {
        encoder.set_source_gamma(ScaledFloat::new(1.0));
    } else {
        encoder.set_source_srgb(SrgbRenderingIntent::Perceptual);
    }
    encoder.add_text_chunk("Software".to_owned(), format!("Eyebeam {}", env!("CARGO_PKG_VERSION")))?;
    encoder.add_itxt_chunk("eyebeam".to_owned(), provenance.to_owned())?;
    encoder.add_itxt_chunk("eyebeam.look".to_owned(), look_json(&encoding.look, &grade))?;
    let (depth, samples) = match encoding.bits {
        Bits::Eight => (BitDepth::Eight, bytes_of(image, &grade)),
        Bits::Sixteen => (BitDepth::Sixteen, words_of(image, &grade)),
    };
    encoder.set_depth(depth);
    encoder.write_header()?.write_image_data(&samples)
}

fn bytes_of(image: &Image, grade: &Grade) -> Vec<u8> {
    match image.alpha() {
        None => pixels(image, |rgb, x, y| grade.byte(rgb, x, y)).collect(),
        Some(alpha) => pixels(image, |rgb, x, y| {
            let alpha = alpha[y as usize * image.width() as usize + x as usize];
            let [r, g, b] = grade.byte(straight(rgb, alpha), x, y);
            [r, g, b, (alpha.clamp(0.0, 1.0) * 255.0).round() as u8]
        })
        .collect(),
    }
}

/// The more significant byte first.
fn words_of(image: &Image, grade: &Grade) -> Vec<u8> {
    match image.alpha() {
        None => pixels(image, |rgb, _, _| grade.word(rgb)).flat_map(u16::to_be_bytes).collect(),
        Some(alpha) => pixels(image, |rgb, x, y| {
            let alpha = alpha[y as usize * image.width() as usize + x as usize];
            let [r, g, b] = grade.word(straight(rgb, alpha));
            [r, g, b, (alpha.clamp(0.0, 1.0) * 65535.0).round() as u16]
        })
        .flat_map(u16::to_be_bytes)
        .collect(),
    }
}

/// The colour as if the pixel were covered; black where nothing is.
fn straight(rgb: [f32; 3], alpha: f32) -> [f32; 3] {
    if alpha > 0.0 { rgb.map(|c| c / alpha) } else { [0.0; 3] }
}

#[cfg(test)]
mod tests {
    use eyebeam_core::look::{Exposure, Look};

    use super::*;

    /// Samples and what the file says of itself.
    fn read(bytes: &[u8]) -> (Vec<u8>, png::Info<'static>) {
        let mut reader = png::Decoder::new(std::io::Cursor::new(bytes)).read_info().unwrap();
        let mut samples = vec![1; reader.output_buffer_size().unwrap()];
        reader.next_frame(&mut samples).unwrap();
        (samples, reader.info().clone())
    }

    fn gradient() -> Image {
        let mut image = Image::new(3, 2);
        image.set_pixel(0, 0, [0.0, 0.5, 1.0]);
        image.set_pixel(2, 1, [-1.0, 7.0, f32::NAN]);
        image
    }

    #[test]
    fn reads_back() {
        let (samples, info) = read(&encode(&gradient(), "{\"spp\":4}", &Encoding::default()).unwrap());
        assert_eq!(samples[..3], [0, 188, 255]);
        assert_eq!(samples[15..], [0, 255, 0]);
        assert_eq!((info.width, info.height), (3, 2));
        assert_eq!(info.srgb, Some(SrgbRenderingIntent::Perceptual));
        let texts = info.utf8_text.iter().map(|text| (text.keyword.as_str(), text.get_text().unwrap()));
        let look = "{\"view\":\"standard\",\"bloom\":0.0,\"vignette\":0.0,\"exposure\":0.0,\"white_balance\":6500.0,\
            \"contrast\":1.0,\"saturation\":1.0,\"dither\":false,\"ev\":0.0}";
        let expected = [("eyebeam", "{\"spp\":4}".to_owned()), ("eyebeam.look", look.to_owned())];
        assert!(texts.eq(expected), "{:?}", info.utf8_text);
    }

    #[test]
    fn alpha_reads_back_straight() {
        let mut image = Image::new(4, 1).with_alpha(vec![0.5, 1.0, 0.0, 0.2]);
        for (x, rgb) in [[0.25, 0.5, 1.0], [0.5; 3], [0.0; 3], [-0.1, 0.1, 0.2]].into_iter().enumerate() {
            image.set_pixel(x as u32, 0, rgb);
        }
        let (samples, info) = read(&encode(&image, "{}", &Encoding::default()).unwrap());
        assert_eq!(info.color_type, ColorType::Rgba);
        assert_eq!(samples, [188, 255, 255, 128, 188, 188, 188, 255, 0, 0, 0, 0, 0, 188, 255, 51]);
        let (wide, _) = read(&encode(&image, "{}", &Encoding { bits: Bits::Sixteen, ..Encoding::default() }).unwrap());
        let words: Vec<_> = wide.chunks_exact(2).map(|pair| u16::from_be_bytes([pair[0], pair[1]])).collect();
        assert_eq!(words[..8], [48192, 65535, 65535, 32768, 48192, 48192, 48192, 65535]);
        assert_eq!(words[8..12], [0; 4]);
    }

    #[test]
    fn sixteen_bits_round_to_eight() {
        let look = Look { exposure: Exposure::Auto, view: View::Agx, ..Look::default() };
        let mut image = Image::new(64, 1);
        (0..64).for_each(|x| image.set_pixel(x, 0, [x as f32 / 64.0, 0.5, 0.1 * x as f32]));
        let file =
            |bits| read(&encode(&image, "{}", &Encoding { look: look.clone(), bits, ..Encoding::default() }).unwrap());
        let ((narrow, _), (wide, info)) = (file(Bits::Eight), file(Bits::Sixteen));
        assert_eq!(info.bit_depth, BitDepth::Sixteen);
        for (byte, word) in narrow.iter().zip(wide.chunks_exact(2)) {
            let word = f32::from(u16::from_be_bytes([word[0], word[1]]));
            assert!((word / 257.0 - f32::from(*byte)).abs() <= 0.51, "{byte} and {word}");
        }
    }

    #[test]
    fn linear_signals_are_called_so() {
        let look = Look { view: View::Raw, ..Look::default() };
        let (samples, info) = read(&encode(&gradient(), "{}", &Encoding { look, ..Encoding::default() }).unwrap());
        assert_eq!(samples[..3], [0, 128, 255]);
        assert_eq!((info.srgb, info.gama_chunk), (None, Some(ScaledFloat::new(1.0))));
    }
}
