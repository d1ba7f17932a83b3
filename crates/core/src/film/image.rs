//! A picture: linear radiance, pixel by pixel.

/// Linear Rec. 709 red, green and blue; row by row from the top left.
#[derive(Clone, Debug, PartialEq)]
pub struct Image {
    width: u32,
    height: u32,
    pixels: Vec<[f32; 3]>,
}

impl Image {
    /// A black picture.
    pub fn new(width: u32, height: u32) -> Self {
        Self { width, height, pixels: vec![[0.0; 3]; width as usize * height as usize] }
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
}
