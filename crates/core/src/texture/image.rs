//! Image: a picture on a surface.
//!
//! Between the middles of its pixels it is interpolated in two directions. Row 0 is at v = 1, so that pictures stand upright.
//! Its pixels stay in memory as they are in the file ([`Pixels`]).
//!
//! With `triplanar` the picture is projected along the three axes of space, upright and not mirrored, and the three are mixed by
//! the normal n: by |n|⁴ of each axis, so that a surface which faces an axis shows one of them alone. It needs no coordinates
//! on the shape and has no seams. Geiss 2007, "Generating Complex Procedural Terrains Using the GPU", GPU Gems 3, ch. 1.
//!
//! ```toml
//! [texture.globe.image]
//! file = "earth.jpg"
//!
//! [texture.rock.image]
//! file = "granite.png"
//! triplanar = true
//! mapping = { scale = [2, 2, 1] }     # half a metre wide and high
//! ```

use std::sync::Arc;

use glam::{Vec2, Vec3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::color::Spectrum;
use crate::film::Wrap;
use crate::texture::pixels::Lookup;
use crate::texture::{Encoding, Filter, Mapping, Pixels, Space, TexturePoint};
use crate::validate::Checker;

/// A picture.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ImageTexture {
    /// The picture (.png, .jpg, .hdr, .exr). A relative name is looked for beside the scene file that says it.
    pub file: String,
    /// What its numbers mean.
    #[serde(default)]
    pub encoding: Encoding,
    /// How it is looked up between its pixels.
    #[serde(default)]
    pub filter: Filter,
    /// What lies beyond its edges.
    #[serde(default)]
    pub wrap: Wrap,
    /// The same above and below alone; as at the sides if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub wrap_v: Option<Wrap>,
    /// Its alpha as a grey instead of its colour; white if it has none.
    #[serde(default)]
    pub alpha: bool,
    /// Projected along three axes instead of lying on the shape; in the world, unless its mapping says otherwise.
    #[serde(default)]
    pub triplanar: bool,
    /// Where it lies; on the shape by default.
    #[serde(default)]
    pub mapping: Mapping,
    /// The picture, once a reader has loaded it.
    #[serde(skip)]
    pub pixels: Option<Arc<Pixels>>,
}

impl ImageTexture {
    /// The picture in a file, as it lies on a shape if nothing is said.
    pub fn new(file: &str, pixels: Option<Arc<Pixels>>) -> Self {
        Self {
            file: file.to_owned(),
            encoding: Encoding::default(),
            filter: Filter::default(),
            wrap: Wrap::default(),
            wrap_v: None,
            alpha: false,
            triplanar: false,
            mapping: Mapping::default(),
            pixels,
        }
    }

    pub(super) fn check(&self, c: &mut Checker) {
        self.mapping.check(c);
        if self.triplanar && matches!(self.mapping.space, Some(Space::Uv | Space::Uv1)) {
            let hint = "leave `space` out, or use \"world\" or \"object\"".to_owned();
            c.problem("triplanar", "what is projected along three axes lies in no `space = \"uv\"`", Some(hint));
        }
        match &self.pixels {
            None => c.not_loaded(&self.file),
            Some(pixels) if self.encoding == Encoding::Srgb && pixels.is_light() => {
                let message = format!("`{}` holds light, and no sRGB signals", self.file);
                c.problem("encoding", message, Some("leave `encoding` out".to_owned()));
            }
            Some(_) => {}
        }
    }

    /// Whether its numbers are taken for colours of a screen.
    pub(crate) fn is_srgb(&self) -> bool {
        let has_signals = self.pixels.as_ref().is_some_and(|pixels| !pixels.is_light());
        has_signals && self.encoding != Encoding::Linear && !self.alpha
    }

    pub(super) fn color(&self, at: &TexturePoint) -> Spectrum {
        if self.triplanar {
            return self.three(at);
        }
        self.look_up(self.mapping.place(at, Space::Uv))
    }

    /// Along each axis that the surface faces at all.
    fn three(&self, at: &TexturePoint) -> Spectrum {
        let p = self.mapping.origin(at, Space::World);
        let n = if self.mapping.space == Some(Space::Object) { at.n_object } else { at.n };
        let weights = (n * n) * (n * n);
        let total = weights.element_sum().max(f32::MIN_POSITIVE);
        // Seen from where the surface faces, x goes to the right, and y upwards or, on floors and ceilings, to the back.
        let side = n.map(|c| 1.0_f32.copysign(c));
        let places = [(-side.x * p.z, p.y), (p.x, -side.y * p.z), (side.z * p.x, p.y)];
        let mut sum = Spectrum::BLACK;
        for ((x, y), weight) in places.into_iter().zip(weights.to_array()).filter(|(_, weight)| *weight > 0.0) {
            sum += self.look_up(self.mapping.lay(Vec3::new(x, y, 0.0))) * (weight / total);
        }
        sum
    }

    fn look_up(&self, place: Vec3) -> Spectrum {
        let Some(pixels) = &self.pixels else { return Spectrum::BLACK };
        let Self { encoding, filter, alpha, .. } = *self;
        let wrap = [self.wrap, self.wrap_v.unwrap_or(self.wrap)];
        pixels.at(Vec2::new(place.x, 1.0 - place.y), Lookup { wrap, filter, encoding, alpha })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::texture::Samples;

    /// Red, green; blue, white: as it is written from the top left.
    fn four(wrap: Wrap) -> ImageTexture {
        let bytes = [[255, 0, 0], [0, 255, 0], [0, 0, 255], [255; 3]].as_flattened().to_vec();
        let pixels = Pixels::new(2, 2, 3, Samples::Byte(bytes)).map(Arc::new);
        ImageTexture { wrap, ..ImageTexture::new("", pixels) }
    }

    fn color(texture: &ImageTexture, u: f32, v: f32) -> [f32; 3] {
        texture.color(&TexturePoint { uv: Vec2::new(u, v), ..TexturePoint::default() }).to_rgb()
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
        // To the left like the right end, above like the upper row.
        let both = ImageTexture { wrap_v: Some(Wrap::Clamp), ..four(Wrap::Repeat) };
        assert_eq!(color(&both, -0.25, 1.25), color(&both, 0.75, 0.75));
        assert_ne!(color(&both, -0.25, 1.25), color(&four(Wrap::Repeat), -0.25, 1.25));
        for wrap in [Wrap::Repeat, Wrap::Mirror, Wrap::Clamp] {
            for filter in [Filter::Bilinear, Filter::Nearest] {
                let far = color(&ImageTexture { filter, ..four(wrap) }, f32::MAX, f32::MIN);
                assert!(far.iter().all(|c| (0.0..=1.0).contains(c)), "{far:?}");
            }
        }
    }

    /// On each side of a cube the picture stands as on a quad that is seen from outside.
    #[test]
    fn three_projections_are_upright_and_not_mirrored() {
        let texture = ImageTexture { triplanar: true, ..four(Wrap::Clamp) };
        let [red, green, blue, white] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0; 3]];
        for (n, right, up) in [
            (Vec3::Z, Vec3::X, Vec3::Y),
            (Vec3::NEG_Z, Vec3::NEG_X, Vec3::Y),
            (Vec3::X, Vec3::NEG_Z, Vec3::Y),
            (Vec3::NEG_X, Vec3::Z, Vec3::Y),
            (Vec3::Y, Vec3::X, Vec3::NEG_Z),
            (Vec3::NEG_Y, Vec3::X, Vec3::Z),
        ] {
            for (x, y, expected) in [(0.25, 0.75, red), (0.75, 0.75, green), (0.25, 0.25, blue), (0.75, 0.25, white)] {
                let at = TexturePoint { p: right * x + up * y + 7.0 * n, n, ..TexturePoint::default() };
                assert_eq!(texture.color(&at).to_rgb(), expected, "facing {n}");
            }
        }
    }

    /// Between the axes the three are mixed, and weigh 1 together.
    #[test]
    fn three_projections_are_mixed() {
        let white = Pixels::new(1, 1, 1, Samples::Byte(vec![255])).map(Arc::new);
        let texture = ImageTexture { triplanar: true, ..ImageTexture::new("", white) };
        for n in [Vec3::ONE.normalize(), Vec3::new(0.6, 0.0, -0.8), Vec3::Y, Vec3::ZERO] {
            let at = TexturePoint { p: Vec3::new(0.3, 0.4, 0.5), n, ..TexturePoint::default() };
            let expected = if n == Vec3::ZERO { 0.0 } else { 1.0 };
            assert!(texture.color(&at).to_rgb().iter().all(|c| (c - expected).abs() < 1e-6), "{n}");
        }
    }

    #[test]
    fn light_is_no_srgb() {
        let problems = |encoding, samples| {
            let pixels = Pixels::new(1, 1, 1, samples).map(Arc::new);
            let mut c = Checker::default();
            ImageTexture { encoding, ..ImageTexture::new("a", pixels) }.check(&mut c);
            c.into_problems().len()
        };
        for encoding in [Encoding::Auto, Encoding::Linear, Encoding::Srgb] {
            assert_eq!(problems(encoding, Samples::Word(vec![1])), 0);
            assert_eq!(problems(encoding, Samples::Half(vec![1])), usize::from(encoding == Encoding::Srgb));
        }
    }
}
