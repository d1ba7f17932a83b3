//! Wood: rings about the third axis, with fibres along it.
//!
//! The distance from the axis, disturbed by noise, tells how far within a year's ring a point is: slowly from light to dark, and
//! at once back. Peachey 1985, "Solid texturing of complex surfaces", doi:10.1145/325165.325246.
//!
//! ```toml
//! [texture.oak.wood]
//! dark = "#7a4a22"
//! light = "#c99a5b"
//! rings = 8
//! ```

use glam::{Vec2, Vec3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::color::{Rgb, Spectrum};
use crate::texture::perlin::{Layers, noise};
use crate::texture::{Color, Mapping, Space, TexturesAt};
use crate::validate::Checker;

/// A trunk along the third axis.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Wood {
    /// Late in the year.
    pub dark: Color,
    /// Early in the year.
    pub light: Color,
    /// Rings in a metre, above 0.
    pub rings: f32,
    /// How far rings are off a circle, in their width.
    pub distortion: f32,
    /// Where it lies; in the world by default.
    pub mapping: Mapping,
}

impl Default for Wood {
    fn default() -> Self {
        let (dark, light) = (Rgb([0.2, 0.075, 0.025]).into(), Rgb([0.55, 0.3, 0.12]).into());
        Self { dark, light, rings: 8.0, distortion: 0.8, mapping: Mapping::default() }
    }
}

impl Wood {
    /// How strong fibres are.
    const FIBRE: f32 = 0.15;

    pub(super) fn check(&self, c: &mut Checker) {
        self.dark.check_amount("dark", c);
        self.light.check_amount("light", c);
        c.positive("rings", self.rings);
        c.in_range("distortion", self.distortion, 0.0, 1000.0);
        self.mapping.check(c);
    }

    pub(super) fn color(&self, textures: &TexturesAt<'_>) -> Spectrum {
        let place = self.mapping.place(&textures.at, Space::World);
        let radius = Vec2::new(place.x, place.y).length();
        let bent = self.distortion * Layers::halves(3).fbm(place * Vec3::new(1.0, 1.0, 0.3) * (0.25 * self.rings));
        let age = (radius * self.rings + bent).clamp(-1e9, 1e9);
        let within = age - age.floor();
        // From light to dark through the year, and back in its last tenth.
        let ring = if within < 0.9 { (within / 0.9) * (within / 0.9) } else { (1.0 - within) / 0.1 };
        let fibre = Self::FIBRE * noise(place * Vec3::new(12.0, 12.0, 1.0) * self.rings);
        self.light.mixed(&self.dark, (ring + fibre).clamp(0.0, 1.0), textures)
    }
}
