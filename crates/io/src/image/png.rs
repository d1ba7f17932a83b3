//! PNG: 8 bit sRGB, as screens show it, with straight alpha.

use eyebeam_core::film::Image;
use png::{BitDepth, ColorType, Compression, Encoder, EncodingError, SrgbRenderingIntent};

use crate::error::Error;
use crate::image::{srgb_byte, srgb_bytes};

pub(super) fn encode(image: &Image, provenance: &str) -> Result<Vec<u8>, Error> {
    let mut bytes = Vec::new();
    write(image, provenance, &mut bytes).map_err(|e| Error::Encode(e.to_string()))?;
    Ok(bytes)
}

fn write(image: &Image, provenance: &str, bytes: &mut Vec<u8>) -> Result<(), EncodingError> {
    let mut encoder = Encoder::new(bytes, image.width(), image.height());
    encoder.set_color(if image.alpha().is_some() { ColorType::Rgba } else { ColorType::Rgb });
    encoder.set_depth(BitDepth::Eight);
    encoder.set_compression(Compression::Balanced);
    encoder.set_source_srgb(SrgbRenderingIntent::Perceptual);
    encoder.add_text_chunk("Software".to_owned(), format!("Eyebeam {}", env!("CARGO_PKG_VERSION")))?;
    encoder.add_itxt_chunk("eyebeam".to_owned(), provenance.to_owned())?;
    let bytes = image.alpha().map_or_else(|| srgb_bytes(image), |alpha| straight(image, alpha));
    encoder.write_header()?.write_image_data(&bytes)
}

/// Four bytes a pixel: colours as if the pixel were covered, and how much of it is; black where nothing is.
fn straight(image: &Image, alpha: &[f32]) -> Vec<u8> {
    let pixel = |(rgb, &alpha): (&[f32; 3], &f32)| {
        let [r, g, b] = rgb.map(|c| if alpha > 0.0 { srgb_byte(c / alpha) } else { 0 });
        [r, g, b, (alpha.clamp(0.0, 1.0) * 255.0).round() as u8]
    };
    image.pixels().iter().zip(alpha).flat_map(pixel).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_back() {
        let mut image = Image::new(3, 2);
        image.set_pixel(0, 0, [0.0, 0.5, 1.0]);
        image.set_pixel(2, 1, [-1.0, 7.0, f32::NAN]);
        let bytes = encode(&image, "{\"spp\":4}").unwrap();
        let mut reader = png::Decoder::new(std::io::Cursor::new(bytes)).read_info().unwrap();
        let mut pixels = vec![1; reader.output_buffer_size().unwrap()];
        reader.next_frame(&mut pixels).unwrap();
        assert_eq!(pixels[..3], [0, 188, 255]);
        assert_eq!(pixels[15..], [0, 255, 0]);
        let info = reader.info();
        assert_eq!((info.width, info.height), (3, 2));
        assert_eq!(info.srgb, Some(SrgbRenderingIntent::Perceptual));
        let text = &info.utf8_text[0];
        assert_eq!((text.keyword.as_str(), text.get_text().unwrap().as_str()), ("eyebeam", "{\"spp\":4}"));
    }

    #[test]
    fn alpha_reads_back_straight() {
        let mut image = Image::new(4, 1).with_alpha(vec![0.5, 1.0, 0.0, 0.2]);
        for (x, rgb) in [[0.25, 0.5, 1.0], [0.5; 3], [0.0; 3], [-0.1, 0.1, 0.2]].into_iter().enumerate() {
            image.set_pixel(x as u32, 0, rgb);
        }
        let bytes = encode(&image, "{}").unwrap();
        let mut reader = png::Decoder::new(std::io::Cursor::new(bytes)).read_info().unwrap();
        let mut pixels = vec![1; reader.output_buffer_size().unwrap()];
        reader.next_frame(&mut pixels).unwrap();
        assert_eq!(reader.info().color_type, ColorType::Rgba);
        assert_eq!(pixels, [188, 255, 255, 128, 188, 188, 188, 255, 0, 0, 0, 0, 0, 188, 255, 51]);
    }
}
