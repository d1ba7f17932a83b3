//! OpenEXR: 32 bit linear RGBA, losslessly compressed.

use std::io::Cursor;

use exr::prelude::*;

use crate::error::Error;

/// Corners of the colour space and its white: Rec. 709, D65.
pub(super) const REC_709: attribute::Chromaticities = attribute::Chromaticities {
    red: Vec2(0.64, 0.33),
    green: Vec2(0.3, 0.6),
    blue: Vec2(0.15, 0.06),
    white: Vec2(0.3127, 0.329),
};

pub(super) fn encode(image: &eyebeam_core::film::Image, provenance: &str) -> std::result::Result<Vec<u8>, Error> {
    let (width, height) = (image.width() as usize, image.height() as usize);
    let channels = SpecificChannels::rgba(|at: Vec2<usize>| {
        let [r, g, b] = image.pixel(at.x() as u32, at.y() as u32);
        (r, g, b, 1.0_f32)
    });
    let mut attributes = LayerAttributes { software_name: Some(Text::from("Eyebeam")), ..LayerAttributes::default() };
    let text = Text::new_or_none(provenance).ok_or_else(|| Error::Encode("provenance is not plain text".to_owned()))?;
    attributes.other.insert(Text::from("eyebeam"), AttributeValue::Text(text));
    let encoding =
        Encoding { compression: Compression::ZIP16, blocks: Blocks::ScanLines, line_order: LineOrder::Increasing };
    let mut file = Image::from_layer(Layer::new((width, height), attributes, encoding, channels));
    file.attributes.chromaticities = Some(REC_709);
    let mut bytes = Vec::new();
    file.write().non_parallel().to_buffered(Cursor::new(&mut bytes)).map_err(|e| Error::Encode(e.to_string()))?;
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_back_bit_for_bit() {
        let mut image = eyebeam_core::film::Image::new(5, 40);
        image.set_pixel(4, 39, [1e-7, 0.3, 12345.678]);
        let bytes = encode(&image, "{\"spp\":4}").unwrap();
        let file = read_first_rgba_layer_from_buffer(&bytes);
        let pixel = |x: usize, y: usize| file.layer_data.channel_data.pixels[y][x];
        assert_eq!(pixel(4, 39), [1e-7, 0.3, 12345.678, 1.0]);
        assert_eq!(pixel(0, 0), [0.0, 0.0, 0.0, 1.0]);
        assert_eq!(file.attributes.chromaticities, Some(REC_709));
        let provenance = &file.layer_data.attributes.other[&Text::from("eyebeam")];
        assert_eq!(provenance, &AttributeValue::Text(Text::from("{\"spp\":4}")));
    }

    type RgbaFile = Image<Layer<SpecificChannels<Vec<Vec<[f32; 4]>>, RgbaChannels>>>;

    fn read_first_rgba_layer_from_buffer(bytes: &[u8]) -> RgbaFile {
        read()
            .no_deep_data()
            .largest_resolution_level()
            .rgba_channels(
                |size, _: &RgbaChannels| vec![vec![[0.0_f32; 4]; size.width()]; size.height()],
                |pixels, at, (r, g, b, a): (f32, f32, f32, f32)| pixels[at.y()][at.x()] = [r, g, b, a],
            )
            .first_valid_layer()
            .all_attributes()
            .from_buffered(Cursor::new(bytes))
            .unwrap()
    }
}
