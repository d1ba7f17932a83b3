//! A picture: linear radiance, pixel by pixel.

use glam::Vec2;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::color::Spectrum;

/// Linear Rec. 709 red, green and blue, times alpha if there is one; row by row from the top left.
#[derive(Clone, Debug, PartialEq)]
pub struct Image {
    width: u32,
    height: u32,
    pixels: Vec<[f32; 3]>,
    alpha: Option<Vec<f32>>,
}

impl Image {
    /// A black picture.
    pub fn new(width: u32, height: u32) -> Self {
        Self { width, height, pixels: vec![[0.0; 3]; width as usize * height as usize], alpha: None }
    }

    /// Pixels in a row.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Rows.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// All pixels, row by row.
    pub fn pixels(&self) -> &[[f32; 3]] {
        &self.pixels
    }

    /// Whether all pixels are 0.
    pub fn is_black(&self) -> bool {
        self.pixels.iter().all(|&pixel| pixel == [0.0; 3])
    }

    fn index(&self, x: u32, y: u32) -> usize {
        assert!(x < self.width && y < self.height, "pixel ({x}, {y}) of a picture of {} x {}", self.width, self.height);
        y as usize * self.width as usize + x as usize
    }

    /// The pixel in column `x` of row `y`.
    ///
    /// # Panics
    /// Outside the picture.
    pub fn pixel(&self, x: u32, y: u32) -> [f32; 3] {
        self.pixels[self.index(x, y)]
    }

    /// All pixels, row by row.
    pub fn into_pixels(self) -> Vec<[f32; 3]> {
        self.pixels
    }

    /// All pixels, row by row, to be changed.
    pub fn pixels_mut(&mut self) -> &mut [[f32; 3]] {
        &mut self.pixels
    }

    /// The picture at a place, each coordinate 0..1 from the left and from the top: interpolated in both directions between
    /// the middles of pixels. Black if it has none.
    pub fn bilinear(&self, place: Vec2, wrap: Wrap) -> Spectrum {
        let pixel = |x: usize, y: usize| Spectrum::from_rgb(self.pixels[y * self.width as usize + x]);
        bilinear([self.width, self.height], [wrap; 2], place, pixel)
    }

    /// Replaces the pixel in column `x` of row `y`.
    ///
    /// # Panics
    /// Outside the picture.
    pub fn set_pixel(&mut self, x: u32, y: u32, rgb: [f32; 3]) {
        let index = self.index(x, y);
        self.pixels[index] = rgb;
    }

    /// The same with the share of each pixel that is covered, 0..1, which its colour has been multiplied by.
    ///
    /// # Panics
    /// If there is not one for each pixel.
    pub fn with_alpha(self, alpha: Vec<f32>) -> Self {
        assert_eq!(alpha.len(), self.pixels.len(), "one alpha for each pixel");
        Self { alpha: Some(alpha), ..self }
    }

    /// The share of each pixel that is covered, row by row; none if all are.
    pub fn alpha(&self) -> Option<&[f32]> {
        self.alpha.as_deref()
    }
}

/// What lies beyond the edges of a picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Wrap {
    /// The same picture, again and again.
    #[default]
    Repeat,
    /// The picture and its mirror image, in turn.
    Mirror,
    /// Its outermost pixels.
    Clamp,
}

impl Wrap {
    /// The pixel that stands for pixel `i` in a row of `n`.
    #[inline]
    pub(crate) fn index(self, i: i64, n: i64) -> usize {
        if (0..n).contains(&i) {
            return i as usize;
        }
        let within = match self {
            Self::Repeat => i.rem_euclid(n),
            Self::Mirror => {
                let i = i.rem_euclid(2 * n);
                i.min(2 * n - 1 - i)
            }
            Self::Clamp => i.clamp(0, n - 1),
        };
        within as usize
    }
}

/// A picture of a size at a place, each coordinate 0..1 from the left and from the top: interpolated in both directions
/// between the middles of pixels, which `pixel` tells by column and row. Black if there are none. Beyond the edges at the sides and
/// those above and below lies what `wrap` says.
#[inline]
pub(crate) fn bilinear(
    size: [u32; 2],
    wrap: [Wrap; 2],
    place: Vec2,
    pixel: impl Fn(usize, usize) -> Spectrum,
) -> Spectrum {
    let [width, height] = size.map(i64::from);
    if width * height == 0 {
        return Spectrum::BLACK;
    }
    // In pixels from the middle of the first one.
    let at = place * Vec2::new(width as f32, height as f32) - 0.5;
    let (first, rest) = (at.floor(), at - at.floor());
    let [x0, x1] = [0, 1].map(|step| wrap[0].index(first.x as i64 + step, width));
    let [y0, y1] = [0, 1].map(|step| wrap[1].index(first.y as i64 + step, height));
    let in_row = |y: usize| pixel(x0, y).lerp(pixel(x1, y), rest.x);
    in_row(y0).lerp(in_row(y1), rest.y)
}

/// The same, of the pixel that the place lies in.
#[inline]
pub(crate) fn nearest(
    size: [u32; 2],
    wrap: [Wrap; 2],
    place: Vec2,
    pixel: impl Fn(usize, usize) -> Spectrum,
) -> Spectrum {
    let [width, height] = size.map(i64::from);
    if width * height == 0 {
        return Spectrum::BLACK;
    }
    let at = (place * Vec2::new(width as f32, height as f32)).floor();
    pixel(wrap[0].index(at.x as i64, width), wrap[1].index(at.y as i64, height))
}
