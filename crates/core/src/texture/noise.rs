//! Noise: clouds, stains and creases, mixed of a dark and a light colour.
//!
//! Σ gainⁱ noise(lacunarityⁱ p) over the octaves i: layers of gradient noise, each finer and weaker than the one before
//! (fractional Brownian motion), or of its absolute value (turbulence). Perlin 1985, "An Image Synthesizer",
//! doi:10.1145/325165.325247; the names of the factors are those of Musgrave, in Ebert et al., Texturing & Modeling, 3rd ed. 2002.
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
use crate::texture::perlin::Layers;
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
    /// How many times finer each layer is than the one before, 1..8.
    #[schemars(range(min = 1.0, max = 8.0))]
    pub lacunarity: f32,
    /// How many times as strong it is, 0..1: more is rougher.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub gain: f32,
    /// Creases instead of clouds.
    pub turbulence: bool,
    /// Where it lies; in the world by default.
    pub mapping: Mapping,
}

impl Default for Noise {
    fn default() -> Self {
        let (dark, light) = (Rgb::grey(0.0).into(), Rgb::grey(1.0).into());
        Self { dark, light, octaves: 4, lacunarity: 2.0, gain: 0.5, turbulence: false, mapping: Mapping::default() }
    }
}

impl Noise {
    pub(super) fn check(&self, c: &mut Checker) {
        self.dark.check_amount("dark", c);
        self.light.check_amount("light", c);
        c.count("octaves", self.octaves, 16);
        c.in_range("lacunarity", self.lacunarity, 1.0, 8.0);
        c.in_range("gain", self.gain, 0.0, 1.0);
        self.mapping.check(c);
    }

    pub(super) fn color(&self, textures: &TexturesAt<'_>) -> Spectrum {
        let place = self.mapping.place(&textures.at, Space::World);
        let Self { octaves, lacunarity, gain, .. } = *self;
        let layers = Layers { octaves, lacunarity, gain };
        let amount = if self.turbulence { layers.turbulence(place) } else { 0.5 + 0.5 * layers.fbm(place) };
        self.dark.mixed(&self.light, amount.clamp(0.0, 1.0), textures)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::texture::TexturePoint;
    use glam::Vec3;

    fn at(noise: &Noise, p: Vec3) -> f32 {
        let at = TexturePoint { p, ..TexturePoint::default() };
        noise.color(&TexturesAt { textures: &[], at }).to_rgb()[0]
    }

    /// Without gain, one layer is left; with more of it, neighbours differ more.
    #[test]
    fn gain_is_roughness() {
        let points = || (0..500).map(|i| Vec3::new(0.37 * i as f32, 0.61 * i as f32, 0.5));
        let [none, one] = [(6, 0.0), (1, 0.5)].map(|(octaves, gain)| Noise { octaves, gain, ..Noise::default() });
        assert!(points().all(|p| at(&none, p) == at(&one, p)));
        let step = |gain| {
            let noise = Noise { octaves: 8, gain, ..Noise::default() };
            points().map(|p| (at(&noise, p) - at(&noise, p + Vec3::splat(0.01))).abs()).sum::<f32>()
        };
        assert!(step(0.3) < step(0.5) && step(0.5) < step(0.8));
        let far = Noise { octaves: 16, lacunarity: 8.0, gain: 1.0, ..Noise::default() };
        assert!((0.0..=1.0).contains(&at(&far, Vec3::splat(1e12))));
    }
}
