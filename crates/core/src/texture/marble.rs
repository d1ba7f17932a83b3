//! Marble: veins, which turbulence has bent.
//!
//! ½ + ½ cos 2π(x + distortion · turbulence(p)), sharpened, mixes the colours. Perlin 1985, "An Image Synthesizer",
//! doi:10.1145/325165.325247.
//!
//! ```toml
//! [texture.slab.marble]
//! dark = "#5b5f66"
//! light = "#f2efe9"
//! distortion = 1.5
//! ```

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::color::{Rgb, Spectrum};
use crate::math::sin_cos_turns;
use crate::texture::perlin::Layers;
use crate::texture::{Color, Mapping, Space, TexturesAt};
use crate::validate::Checker;

/// Stone with veins across the first axis, one a metre.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Marble {
    /// The veins.
    pub dark: Color,
    /// The stone.
    pub light: Color,
    /// How far veins are bent, in the distance between them.
    pub distortion: f32,
    /// How thin veins are: 1 is a wave, 8 a hair; 0.1..100.
    #[schemars(range(min = 0.1, max = 100.0))]
    pub sharpness: f32,
    /// Layers of the turbulence that bends them, each twice as fine, 1..16.
    #[schemars(range(min = 1, max = 16))]
    pub octaves: u32,
    /// Where it lies; in the world by default.
    pub mapping: Mapping,
}

impl Default for Marble {
    fn default() -> Self {
        let (dark, light) = (Rgb([0.15, 0.16, 0.18]).into(), Rgb([0.86, 0.84, 0.8]).into());
        Self { dark, light, distortion: 1.5, sharpness: 4.0, octaves: 7, mapping: Mapping::default() }
    }
}

impl Marble {
    pub(super) fn check(&self, c: &mut Checker) {
        self.dark.check_amount("dark", c);
        self.light.check_amount("light", c);
        c.in_range("distortion", self.distortion, 0.0, 1000.0);
        c.in_range("sharpness", self.sharpness, 0.1, 100.0);
        c.count("octaves", self.octaves, 16);
        self.mapping.check(c);
    }

    pub(super) fn color(&self, textures: &TexturesAt<'_>) -> Spectrum {
        let place = self.mapping.place(&textures.at, Space::World);
        let phase = place.x + self.distortion * Layers::halves(self.octaves).turbulence(place);
        let (_, cos) = sin_cos_turns(phase - phase.floor());
        let vein = libm::powf((0.5 + 0.5 * cos).clamp(0.0, 1.0), self.sharpness);
        self.light.mixed(&self.dark, vein, textures)
    }
}
