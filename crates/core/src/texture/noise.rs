//! Noise: clouds, stains and creases, mixed of a dark and a light colour.
//!
//! Layers of gradient noise, each twice as fine and half as strong as the one before (fractional Brownian motion), or of
//! its absolute value (turbulence). Perlin 1985, "An Image Synthesizer", doi:10.1145/325165.325247.
//!
//! ```toml
//! [texture.clouds.noise]
//! dark = "#4477aa"
//! light = 0.95
//! octaves = 6
//! ```

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::color::{Rgb, Spectrum};
use crate::texture::perlin::{fbm, turbulence};
use crate::texture::{Color, Mapping, Space, TexturesAt};
use crate::validate::Checker;

/// Clouds of size 1.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Noise {
    /// Where there is least.
    pub dark: Color,
    /// Where there is most.
    pub light: Color,
    /// Layers, 1..16.
    #[schemars(range(min = 1, max = 16))]
    pub octaves: u32,
    /// Creases instead of clouds.
    pub turbulence: bool,
    /// Where it lies; in the world by default.
    pub mapping: Mapping,
}

impl Default for Noise {
    fn default() -> Self {
        let (dark, light) = (Rgb::grey(0.0).into(), Rgb::grey(1.0).into());
        Self { dark, light, octaves: 4, turbulence: false, mapping: Mapping::default() }
    }
}

impl Noise {
    pub(super) fn check(&self, c: &mut Checker) {
        self.dark.check_amount("dark", c);
        self.light.check_amount("light", c);
        c.count("octaves", self.octaves, 16);
        self.mapping.check(c);
    }

    pub(super) fn color(&self, textures: &TexturesAt<'_>) -> Spectrum {
        let place = self.mapping.place(&textures.at, Space::World);
        let amount =
            if self.turbulence { turbulence(place, self.octaves) } else { 0.5 + 0.5 * fbm(place, self.octaves) };
        self.dark.at(textures).lerp(self.light.at(textures), amount.clamp(0.0, 1.0))
    }
}
