//! Invert: 1 − colour in each channel; what is brighter than 1 becomes black.
//!
//! It makes roughness of a picture of gloss.
//!
//! ```toml
//! [texture.gloss.noise]
//!
//! [texture.worn.invert]
//! input = "gloss"
//!
//! [material.brass.conductor]
//! metal = "brass"
//! roughness = "worn"
//! ```

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::color::Spectrum;
use crate::texture::{Color, TexturesAt};
use crate::validate::Checker;

/// The opposite of a colour.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Invert {
    /// The colour.
    pub input: Color,
}

impl Invert {
    pub(super) fn check(&self, c: &mut Checker) {
        self.input.check_amount("input", c);
    }

    pub(super) fn color(&self, textures: &TexturesAt<'_>) -> Spectrum {
        Spectrum::from_rgb(self.input.at(textures).to_rgb().map(|c| (1.0 - c).max(0.0)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::Rgb;
    use crate::texture::TexturePoint;

    #[test]
    fn nothing_below_black() {
        let invert = Invert { input: Rgb([0.0, 0.25, 5.0]).into() };
        let textures = TexturesAt { textures: &[], at: TexturePoint::default() };
        assert_eq!(invert.color(&textures).to_rgb(), [1.0, 0.75, 0.0]);
    }
}
