//! A contact sheet: pictures of one size side by side, each with a label below.

use eyebeam_core::film::Image;
use eyebeam_io::image::srgb_bytes;
use plotters::element::BitMapElement;

use super::page::{Area, DrawError, text, write_below};

/// Pictures of one size and their labels, row by row; at least one.
pub(super) struct Sheet {
    columns: u32,
    tiles: Vec<(String, Image)>,
}

impl Sheet {
    const GAP: u32 = 12;
    const LABEL: u32 = 34;
    const TEXT: u32 = 20;

    pub(super) fn new(columns: u32, tiles: Vec<(String, Image)>) -> Self {
        Self { columns, tiles }
    }

    /// Distance from a tile to its neighbours on the right and below.
    fn pitch(&self) -> (u32, u32) {
        let (width, height) = self.tiles.first().map_or((0, 0), |(_, image)| (image.width(), image.height()));
        (width + Self::GAP, height + Self::LABEL)
    }

    /// Width and height in pixels.
    pub(super) fn size(&self) -> (u32, u32) {
        let (x, y) = self.pitch();
        let rows = (self.tiles.len() as u32).div_ceil(self.columns);
        (self.columns * x + Self::GAP, rows * y + Self::GAP)
    }

    pub(super) fn draw(&self, area: &Area<'_>) -> Result<(), DrawError> {
        let (x_pitch, y_pitch) = self.pitch();
        for (i, (label, image)) in (0_u32..).zip(&self.tiles) {
            let x = (i % self.columns * x_pitch + Self::GAP) as i32;
            let y = (i / self.columns * y_pitch + Self::GAP) as i32;
            draw_image(area, image, (x, y))?;
            let below = (x + image.width() as i32 / 2, y + image.height() as i32 + 7);
            write_below(area, label, &text(Self::TEXT), below)?;
        }
        Ok(())
    }
}

/// Draws a picture with its top left corner at a point.
pub(super) fn draw_image(area: &Area<'_>, image: &Image, at: (i32, i32)) -> Result<(), DrawError> {
    // The element refuses only a buffer of the wrong size.
    match BitMapElement::with_owned_buffer(at, (image.width(), image.height()), srgb_bytes(image)) {
        Some(bitmap) => area.draw(&bitmap),
        None => Ok(()),
    }
}
