//! A white page to draw on, and the PNG that it becomes.

use plotters::coord::Shift;
use plotters::drawing::{DrawingArea, DrawingAreaErrorKind, IntoDrawingArea};
use plotters::prelude::{BitMapBackend, DrawingBackend, RGBColor, WHITE};
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{FontStyle, IntoFont, TextStyle, register_font};
use png::{BitDepth, ColorType, Compression, Encoder, EncodingError, SrgbRenderingIntent};

use crate::error::Error;

/// A part of a page.
pub(super) type Area<'a> = DrawingArea<BitMapBackend<'a>, Shift>;

pub(super) type DrawError = DrawingAreaErrorKind<<BitMapBackend<'static> as DrawingBackend>::ErrorType>;

/// The colour of text and axes.
pub(super) const INK: RGBColor = RGBColor(38, 38, 38);

const FONT: &str = "DejaVu Sans";

/// Draws a page of so many pixels; returns it as PNG.
pub(super) fn draw(size: (u32, u32), paint: impl FnOnce(&Area<'_>) -> Result<(), DrawError>) -> Result<Vec<u8>, Error> {
    let fail = |reason: String| Error::Io(eyebeam_io::Error::Encode(reason));
    for (style, font) in [(FontStyle::Normal, dejavu::sans::regular()), (FontStyle::Bold, dejavu::sans::bold())] {
        register_font(FONT, style, font).map_err(|_| fail("the font is broken".to_owned()))?;
    }
    let mut pixels = vec![0; 3 * size.0 as usize * size.1 as usize];
    {
        let area = BitMapBackend::with_buffer(&mut pixels, size).into_drawing_area();
        area.fill(&WHITE).and_then(|()| paint(&area)).map_err(|e| fail(e.to_string()))?;
        area.present().map_err(|e| fail(e.to_string()))?;
    }
    encode(size, &pixels).map_err(|e| fail(e.to_string()))
}

fn encode((width, height): (u32, u32), pixels: &[u8]) -> Result<Vec<u8>, EncodingError> {
    let mut bytes = Vec::new();
    let mut encoder = Encoder::new(&mut bytes, width, height);
    encoder.set_color(ColorType::Rgb);
    encoder.set_depth(BitDepth::Eight);
    encoder.set_compression(Compression::High);
    encoder.set_source_srgb(SrgbRenderingIntent::Perceptual);
    encoder.write_header()?.write_image_data(pixels)?;
    Ok(bytes)
}

/// Text of a height in pixels.
pub(super) fn text(height: u32) -> TextStyle<'static> {
    (FONT, height).into_font().color(&INK)
}

/// The text of titles.
pub(super) fn title(height: u32) -> TextStyle<'static> {
    (FONT, height, FontStyle::Bold).into_font().color(&INK)
}

/// Writes a line, centred below a point of the area.
pub(super) fn write_below(area: &Area<'_>, line: &str, style: &TextStyle<'_>, at: (i32, i32)) -> Result<(), DrawError> {
    area.draw_text(line, &style.pos(Pos::new(HPos::Center, VPos::Top)), at)
}
