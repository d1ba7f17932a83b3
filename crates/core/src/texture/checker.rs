//! Checker: two colours in turn, in squares or cubes of side 1.
//!
//! ```toml
//! [texture.squares.checker]
//! even = 0.9
//! odd = 0.1
//! mapping = { scale = [2, 2, 2] }
//! ```

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::color::{Rgb, Spectrum};
use crate::texture::{Color, Mapping, Space, TexturesAt};
use crate::validate::Checker as Check;

/// Squares of a chessboard; in the world, unless its mapping says otherwise, cubes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Checker {
    /// Where the whole parts of the coordinates add up to an even number.
    pub even: Color,
    /// Where they add up to an odd one.
    pub odd: Color,
    /// Where it lies; in the world by default.
    pub mapping: Mapping,
}

impl Default for Checker {
    fn default() -> Self {
        Self { even: Rgb::grey(0.8).into(), odd: Rgb::grey(0.2).into(), mapping: Mapping::default() }
    }
}

impl Checker {
    pub(super) fn check(&self, c: &mut Check) {
        self.even.check_amount("even", c);
        self.odd.check_amount("odd", c);
        self.mapping.check(c);
    }

    pub(super) fn color(&self, textures: &TexturesAt<'_>) -> Spectrum {
        /// Cubes begin a little before whole numbers, so that a floor at height 0 or 1 lies within one layer of them.
        const BEFORE: f32 = 1.0 / 1024.0;
        let place = self.mapping.place(&textures.at, Space::World) + BEFORE;
        let odd = place.floor().to_array().into_iter().filter(|whole| (*whole as i64) & 1 == 1).count() & 1 == 1;
        (if odd { &self.odd } else { &self.even }).at(textures)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::texture::TexturePoint;
    use glam::Vec3;

    #[test]
    fn squares_alternate_on_both_sides_of_zero() {
        let checker = Checker { even: Rgb::grey(1.0).into(), odd: Rgb::grey(0.0).into(), ..Checker::default() };
        let is_even = |x: f32, z: f32| {
            let at = TexturePoint { p: Vec3::new(x, 0.0, z), ..TexturePoint::default() };
            checker.color(&TexturesAt { textures: &[], at }).to_rgb()[0] == 1.0
        };
        for (x, z) in [(-3, -2), (-1, 0), (0, 0), (1, 2), (5, -7)] {
            assert_eq!(is_even(x as f32 + 0.5, z as f32 + 0.5), (x + z) % 2 == 0, "({x}, {z})");
        }
    }
}
