//! PNG: 8 bit sRGB, as screens show it.

use eyebeam_core::film::Image;
use png::{BitDepth, ColorType, Compression, Encoder, EncodingError, SrgbRenderingIntent};

use crate::error::Error;
use crate::image::srgb_bytes;

pub(super) fn encode(image: &Image, provenance: &str) -> Result<Vec<u8>, Error> {
    let mut bytes = Vec::new();
    write(image, provenance, &mut bytes).map_err(|e| Error::Encode(e.to_string()))?;
    Ok(bytes)
}

fn write(image: &Image, provenance: &str, bytes: &mut Vec<u8>) -> Result<(), EncodingError> {
    let mut encoder = Encoder::new(bytes, image.width(), image.height());
    encoder.set_color(ColorType::Rgb);
    encoder.set_depth(BitDepth::Eight);
    encoder.set_compression(Compression::Balanced);
    encoder.set_source_srgb(SrgbRenderingIntent::Perceptual);
    encoder.add_text_chunk("Software".to_owned(), format!("Eyebeam {}", env!("CARGO_PKG_VERSION")))?;
    encoder.add_itxt_chunk("eyebeam".to_owned(), provenance.to_owned())?;
    encoder.write_header()?.write_image_data(&srgb_bytes(image))
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
}
