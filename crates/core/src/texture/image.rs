//! Image: a picture on a surface.
//!
//! Between the middles of its pixels it is interpolated in two directions. Row 0 is at v = 1, so that pictures stand upright.
//!
//! ```toml
//! [texture.globe.image]
//! file = "earth.jpg"
//! ```

use std::sync::Arc;

use glam::Vec2;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::color::Spectrum;
use crate::film::{Image, Wrap};
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
        image.bilinear(Vec2::new(place.x, 1.0 - place.y), self.wrap)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;

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
