//! OpenEXR: linear RGBA in 32 or 16 bit and any other channels in 32, losslessly compressed.

use std::io::Cursor;

use exr::image::write::channels::WritableChannels;
use exr::image::write::layers::WritableLayers;
use exr::prelude::*;
use eyebeam_core::film::{self, Image as Picture};

use crate::error::Error;
use crate::image::ascii;

/// Corners of the colour space and its white: Rec. 709, D65.
pub(super) const REC_709: attribute::Chromaticities = attribute::Chromaticities {
    red: Vec2(0.64, 0.33),
    green: Vec2(0.3, 0.6),
    blue: Vec2(0.15, 0.06),
    white: Vec2(0.3127, 0.329),
};

/// Names of the ids in a picture, as JSON, in an attribute of this name.
const NAMES: &str = "id.names";

pub(super) fn encode(image: &Picture, provenance: &str, half: bool) -> std::result::Result<Vec<u8>, Error> {
    let alpha = |x: usize, y: usize| image.alpha().map_or(1.0, |alpha| alpha[y * image.width() as usize + x]);
    if half {
        let channels = SpecificChannels::rgba(|Vec2(x, y): Vec2<usize>| {
            let [r, g, b] = image.pixel(x as u32, y as u32).map(to_half);
            (r, g, b, to_half(alpha(x, y)))
        });
        return bytes(&file(image, channels, provenance)?);
    }
    let channels = SpecificChannels::rgba(|Vec2(x, y): Vec2<usize>| {
        let [r, g, b] = image.pixel(x as u32, y as u32);
        (r, g, b, alpha(x, y))
    });
    bytes(&file(image, channels, provenance)?)
}

/// The nearest number of 16 bits; it does not become infinite.
fn to_half(c: f32) -> f16 {
    f16::from_f32(if c.is_finite() { c.clamp(f16::MIN.to_f32(), f16::MAX.to_f32()) } else { c })
}

/// A picture with more channels than its colours. `names` says in JSON what ids stand for; `half` is for the colours.
///
/// # Errors
/// If the picture is too large for the format.
///
/// # Panics
/// If a channel does not have as many numbers as the picture has pixels.
pub fn encode_channels(
    image: &Picture,
    channels: Vec<film::Channel>,
    names: &str,
    provenance: &str,
    half: bool,
) -> std::result::Result<Vec<u8>, Error> {
    let colors = ["R", "G", "B"].into_iter().enumerate();
    let color = |(i, name)| AnyChannel::new(name, samples(image.pixels().iter().map(move |rgb| rgb[i]), half));
    let mut list: SmallVec<[_; 4]> = colors.map(color).collect();
    list.push(AnyChannel::new(
        "A",
        match image.alpha() {
            None => samples(image.pixels().iter().map(|_| 1.0), half),
            Some(alpha) => samples(alpha.iter().copied(), half),
        },
    ));
    list.extend(channels.into_iter().map(|channel| {
        let samples = match channel.values {
            film::Values::Float(values) => FlatSamples::F32(values),
            film::Values::Id(values) => FlatSamples::U32(values),
        };
        // These are no light: nobody may compress them as such.
        AnyChannel { quantize_linearly: true, ..AnyChannel::new(channel.name, samples) }
    }));
    assert!(list.iter().all(|c| c.sample_data.len() == image.pixels().len()), "one number for each pixel");
    let mut file = file(image, AnyChannels::sort(list), &ascii(provenance))?;
    // Of several attributes in one place, the order in the file would be random.
    file.attributes.other.insert(Text::from(NAMES), plain_text(&ascii(names))?);
    bytes(&file)
}

/// Channels of colours by their names, and nothing else.
pub(super) fn encode_samples(
    [width, height]: [u32; 2],
    channels: Vec<(&str, FlatSamples)>,
) -> std::result::Result<Vec<u8>, Error> {
    let list = channels.into_iter().map(|(name, samples)| AnyChannel::new(name, samples)).collect();
    let attributes = LayerAttributes { software_name: Some(Text::from("Eyebeam")), ..LayerAttributes::default() };
    bytes(&image([width as usize, height as usize], attributes, AnyChannels::sort(list)))
}

fn samples(values: impl Iterator<Item = f32>, half: bool) -> FlatSamples {
    if half { FlatSamples::F16(values.map(to_half).collect()) } else { FlatSamples::F32(values.collect()) }
}

/// A picture's channels as a file.
fn file<'c, C: WritableChannels<'c> + 'c>(
    image: &Picture,
    channels: C,
    provenance: &str,
) -> std::result::Result<Image<Layer<C>>, Error> {
    let mut attributes = LayerAttributes { software_name: Some(Text::from("Eyebeam")), ..LayerAttributes::default() };
    attributes.other.insert(Text::from("eyebeam"), plain_text(provenance)?);
    Ok(self::image([image.width() as usize, image.height() as usize], attributes, channels))
}

/// A file of one layer.
fn image<'c, C: WritableChannels<'c> + 'c>(
    [width, height]: [usize; 2],
    attributes: LayerAttributes,
    channels: C,
) -> Image<Layer<C>> {
    let encoding =
        Encoding { compression: Compression::ZIP16, blocks: Blocks::ScanLines, line_order: LineOrder::Increasing };
    let mut file = Image::from_layer(Layer::new((width, height), attributes, encoding, channels));
    file.attributes.chromaticities = Some(REC_709);
    file
}

fn plain_text(text: &str) -> std::result::Result<AttributeValue, Error> {
    let text = Text::new_or_none(text).ok_or_else(|| Error::Encode("an attribute is not plain text".to_owned()))?;
    Ok(AttributeValue::Text(text))
}

fn bytes<'f, L: WritableLayers<'f>>(file: &'f Image<L>) -> std::result::Result<Vec<u8>, Error> {
    let mut bytes = Vec::new();
    file.write().non_parallel().to_buffered(Cursor::new(&mut bytes)).map_err(|e| Error::Encode(e.to_string()))?;
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_back_bit_for_bit() {
        let mut image = Picture::new(5, 40);
        image.set_pixel(4, 39, [1e-7, 0.3, 12345.678]);
        let bytes = encode(&image, "{\"spp\":4}", false).unwrap();
        let file = read_first_rgba_layer_from_buffer(&bytes);
        let pixel = |x: usize, y: usize| file.layer_data.channel_data.pixels[y][x];
        assert_eq!(pixel(4, 39), [1e-7, 0.3, 12345.678, 1.0]);
        assert_eq!(pixel(0, 0), [0.0, 0.0, 0.0, 1.0]);
        assert_eq!(file.attributes.chromaticities, Some(REC_709));
        let provenance = &file.layer_data.attributes.other[&Text::from("eyebeam")];
        assert_eq!(provenance, &AttributeValue::Text(Text::from("{\"spp\":4}")));
    }

    #[test]
    fn channels_read_back_bit_for_bit() {
        let mut image = Picture::new(3, 20).with_alpha(vec![0.25; 60]);
        image.set_pixel(2, 19, [1.0, 2.0, 3.0]);
        let depth: Vec<_> = (0..59).map(|i| i as f32 * 0.1).chain([f32::INFINITY]).collect();
        let id: Vec<_> = (0..60).map(|i| u32::MAX - i).collect();
        let channels = vec![
            film::Channel { name: "id.object", values: film::Values::Id(id.clone()) },
            film::Channel { name: "Z", values: film::Values::Float(depth.clone()) },
        ];
        let bytes = encode_channels(&image, channels, "{\"object\":[\"\",\"ä\"]}", "{}", false).unwrap();
        let file = read_first_flat_layer_from_buffer(&bytes);
        let list = &file.layer_data.channel_data.list;
        let names: Vec<_> = list.iter().map(|c| c.name.to_string()).collect();
        assert_eq!(names, ["A", "B", "G", "R", "Z", "id.object"]);
        assert_eq!(list[0].sample_data, FlatSamples::F32(vec![0.25; 60]));
        assert_eq!(list[4].sample_data, FlatSamples::F32(depth));
        assert_eq!(list[5].sample_data, FlatSamples::U32(id));
        let names = &file.layer_data.attributes.other[&Text::from(NAMES)];
        assert_eq!(names, &AttributeValue::Text(Text::from("{\"object\":[\"\",\"\\u00e4\"]}")));
        let file = read_first_rgba_layer_from_buffer(&bytes);
        assert_eq!(file.layer_data.channel_data.pixels[19][2], [1.0, 2.0, 3.0, 0.25]);
        let plain = read_first_rgba_layer_from_buffer(&encode(&image, "{}", false).unwrap());
        assert_eq!(plain.layer_data.channel_data.pixels, file.layer_data.channel_data.pixels);
    }

    #[test]
    fn half_is_the_nearest_number_of_sixteen_bits() {
        let mut image = Picture::new(2, 1).with_alpha(vec![0.25, 1.0 / 3.0]);
        image.set_pixel(0, 0, [1.0, 0.1, 1e9]);
        image.set_pixel(1, 0, [-1e9, 1e-3, f32::INFINITY]);
        let bytes = encode(&image, "{}", true).unwrap();
        let list = read_first_flat_layer_from_buffer(&bytes).layer_data.channel_data.list;
        assert!(list.iter().all(|channel| matches!(channel.sample_data, FlatSamples::F16(_))));
        let file = read_first_rgba_layer_from_buffer(&bytes);
        let half = |c: f32| f16::from_f32(c).to_f32();
        let expected = [[1.0, half(0.1), 65504.0, 0.25], [-65504.0, half(1e-3), f32::INFINITY, half(1.0 / 3.0)]];
        assert_eq!(file.layer_data.channel_data.pixels[0], expected);
        let ids = vec![film::Channel { name: "id.object", values: film::Values::Id(vec![70_000, 3]) }];
        let bytes = encode_channels(&image, ids, "{}", "{}", true).unwrap();
        assert_eq!(read_first_rgba_layer_from_buffer(&bytes).layer_data.channel_data.pixels[0], expected);
        let list = read_first_flat_layer_from_buffer(&bytes).layer_data.channel_data.list;
        assert_eq!(list[4].sample_data, FlatSamples::U32(vec![70_000, 3]));
    }

    fn read_first_flat_layer_from_buffer(bytes: &[u8]) -> Image<Layer<AnyChannels<FlatSamples>>> {
        let reader = read().no_deep_data().largest_resolution_level().all_channels().first_valid_layer();
        reader.all_attributes().from_buffered(Cursor::new(bytes)).unwrap()
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
