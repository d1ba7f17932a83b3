//! A picture: linear radiance, pixel by pixel.

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
