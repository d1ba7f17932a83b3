//! Gradient: from one colour to another, along an axis or away from a point.
//!
//! With t = x of the mapped place, or its length |p| if `radial`: t = 0 and less is `from`, 1 and more is `to`, and between them
//! they are mixed evenly.
//!
//! ```toml
//! [texture.dusk.gradient]
//! from = "#e76f51"
//! to = "#264653"
//! mapping = { rotation = -90, scale = [0.5, 1, 1] }   # upwards, over two metres
//!
//! [texture.glow.gradient]
//! from = 1
//! to = 0
//! radial = true
//! mapping = { space = "uv", scale = [2, 2, 1], offset = [-1, -1, 0] }
//! ```

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::color::{Rgb, Spectrum};
use crate::texture::{Color, Mapping, Space, TexturesAt};
use crate::validate::Checker;

/// One colour that becomes another.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(rename = "GradientTexture")]
#[serde(deny_unknown_fields, default)]
pub struct Gradient {
    /// At 0.
    pub from: Color,
    /// At 1.
    pub to: Color,
    /// By the distance from the origin, instead of the first coordinate.
    pub radial: bool,
    /// Where it lies; in the world by default.
    pub mapping: Mapping,
}

impl Default for Gradient {
    fn default() -> Self {
        let (from, to) = (Rgb::grey(0.0).into(), Rgb::grey(1.0).into());
        Self { from, to, radial: false, mapping: Mapping::default() }
    }
}

impl Gradient {
    pub(super) fn check(&self, c: &mut Checker) {
        self.from.check_amount("from", c);
        self.to.check_amount("to", c);
        self.mapping.check(c);
    }

    pub(super) fn color(&self, textures: &TexturesAt<'_>) -> Spectrum {
        let place = self.mapping.place(&textures.at, Space::World);
        let t = if self.radial { place.length() } else { place.x };
        self.from.mixed(&self.to, t.clamp(0.0, 1.0), textures)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::texture::TexturePoint;
    use glam::Vec3;

    fn at(gradient: &Gradient, p: Vec3) -> f32 {
        gradient.color(&TexturesAt { textures: &[], at: TexturePoint { p, ..TexturePoint::default() } }).to_rgb()[0]
    }

    #[test]
    fn along_an_axis_and_away_from_a_point() {
        let along = Gradient::default();
        for (x, value) in [(-3.0, 0.0), (0.0, 0.0), (0.25, 0.25), (1.0, 1.0), (9.0, 1.0)] {
            assert_eq!(at(&along, Vec3::new(x, 5.0, -7.0)), value);
        }
        let radial = Gradient { radial: true, ..Gradient::default() };
        for (p, value) in [(Vec3::ZERO, 0.0), (Vec3::new(0.0, 0.3, 0.4), 0.5), (Vec3::splat(1e30), 1.0)] {
            assert!((at(&radial, p) - value).abs() < 1e-6, "{p}");
        }
        // Turned by -90 degrees, what was up is along.
        let mapping = Mapping { rotation: -90.0, ..Mapping::default() };
        assert!((at(&Gradient { mapping, ..along }, Vec3::new(9.0, 0.75, 0.0)) - 0.75).abs() < 1e-5);
    }
}
