//! Image: a picture on a surface.
//!
//! Between the middles of its pixels it is interpolated in two directions. Row 0 is at v = 1, so that pictures stand upright.
//!
//! ```toml
//! [texture.globe.image]
//! file = "earth.jpg"
//! ```

use std::sync::Arc;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::color::Spectrum;
use crate::film::Image;
use crate::texture::{Mapping, Space, TexturePoint};
use crate::validate::Checker;

/// A picture.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ImageTexture {
    /// The picture (.png, .jpg, .hdr, .exr). A relative name is looked for beside the scene file that says it.
    pub file: String,
    /// What lies beyond its edges.
    #[serde(default)]
    pub wrap: Wrap,
    /// Where it lies; on the shape by default.
    #[serde(default)]
    pub mapping: Mapping,
    /// The picture, once a reader has loaded it.
    #[serde(skip)]
    pub image: Option<Arc<Image>>,
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
    fn index(self, i: i64, n: i64) -> i64 {
        match self {
            Self::Repeat => i.rem_euclid(n),
            Self::Mirror => {
                let i = i.rem_euclid(2 * n);
                i.min(2 * n - 1 - i)
            }
            Self::Clamp => i.clamp(0, n - 1),
        }
    }
}

impl ImageTexture {
    pub(super) fn check(&self, c: &mut Checker) {
        self.mapping.check(c);
        if self.image.is_none() {
            c.not_loaded(&self.file);
        }
    }

    pub(super) fn color(&self, at: &TexturePoint) -> Spectrum {
        let Some(image) = &self.image else { return Spectrum::BLACK };
        let place = self.mapping.place(at, Space::Uv);
        let (width, height) = (image.width(), image.height());
        // In pixels from the middle of the first one.
        let (x, y) = (place.x * width as f32 - 0.5, (1.0 - place.y) * height as f32 - 0.5);
        let (column, row) = (x.floor(), y.floor());
        let (right, below) = (x - column, y - row);
        let pixel = |dx: i64, dy: i64| {
            let x = self.wrap.index(column as i64 + dx, width.into());
            let y = self.wrap.index(row as i64 + dy, height.into());
            Spectrum::from_rgb(image.pixel(x as u32, y as u32))
        };
        let in_row = |dy: i64| pixel(0, dy).lerp(pixel(1, dy), right);
        in_row(0).lerp(in_row(1), below)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{Vec2, Vec3};

    /// Red, green; blue, white: as it is written from the top left.
    fn four(wrap: Wrap) -> ImageTexture {
        let mut image = Image::new(2, 2);
        for (x, y, rgb) in [(0, 0, [1.0, 0.0, 0.0]), (1, 0, [0.0, 1.0, 0.0]), (0, 1, [0.0, 0.0, 1.0]), (1, 1, [1.0; 3])]
        {
            image.set_pixel(x, y, rgb);
        }
        ImageTexture { file: String::new(), wrap, mapping: Mapping::default(), image: Some(Arc::new(image)) }
    }

    fn color(texture: &ImageTexture, u: f32, v: f32) -> [f32; 3] {
        texture.color(&TexturePoint { uv: Vec2::new(u, v), p: Vec3::ZERO }).to_rgb()
    }

    #[test]
    fn stands_upright_and_is_interpolated() {
        let texture = four(Wrap::Clamp);
        assert_eq!(color(&texture, 0.25, 0.75), [1.0, 0.0, 0.0]);
        assert_eq!(color(&texture, 0.75, 0.75), [0.0, 1.0, 0.0]);
        assert_eq!(color(&texture, 0.25, 0.25), [0.0, 0.0, 1.0]);
        assert_eq!(color(&texture, 0.5, 0.75), [0.5, 0.5, 0.0]);
        assert_eq!(color(&texture, 0.5, 0.5), [0.5, 0.5, 0.5]);
    }

    #[test]
    fn beyond_the_edges() {
        for (wrap, expected) in
            [(Wrap::Repeat, [1.0, 0.0, 0.0]), (Wrap::Mirror, [0.0, 1.0, 0.0]), (Wrap::Clamp, [0.0, 1.0, 0.0])]
        {
            assert_eq!(color(&four(wrap), 1.25, 0.75), expected, "{wrap:?}");
        }
        assert_eq!(color(&four(Wrap::Mirror), -0.25, 0.75), [1.0, 0.0, 0.0]);
        assert_eq!(color(&four(Wrap::Mirror), 1.75, 0.75), [1.0, 0.0, 0.0]);
        for wrap in [Wrap::Repeat, Wrap::Mirror, Wrap::Clamp] {
            let far = color(&four(wrap), f32::MAX, f32::MIN);
            assert!(far.iter().all(|c| (0.0..=1.0).contains(c)), "{far:?}");
        }
    }
}
