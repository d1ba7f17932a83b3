//! Mix: two colours in shares that may change over the surface, (1 − share) a + share b.
//!
//! ```toml
//! [texture.spots.noise]
//!
//! [texture.rust.mix]
//! a = "#5b6770"
//! b = "#8a4b2a"
//! share = "spots"
//! ```

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::color::Spectrum;
use crate::texture::{Color, Scalar, TexturesAt};
use crate::validate::Checker;

/// Two colours in shares.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(rename = "MixTexture")]
#[serde(deny_unknown_fields)]
pub struct Mix {
    /// Where the share is 0.
    pub a: Color,
    /// Where it is 1.
    pub b: Color,
    /// How much of `b`, 0..1.
    #[serde(default = "half")]
    pub share: Scalar,
}

fn half() -> Scalar {
    0.5.into()
}

impl Mix {
    pub(super) fn check(&self, c: &mut Checker) {
        self.a.check_amount("a", c);
        self.b.check_amount("b", c);
        self.share.check_range("share", 0.0, 1.0, c);
    }

    pub(super) fn color(&self, textures: &TexturesAt<'_>) -> Spectrum {
        self.a.mixed(&self.b, self.share.at(textures, 0.0, 1.0), textures)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::Rgb;
    use crate::texture::TexturePoint;

    #[test]
    fn in_shares() {
        let (a, b) = (Rgb([1.0, 0.0, 0.5]), Rgb([0.0, 4.0, 0.5]));
        for (share, expected) in [(0.0, a.0), (1.0, b.0), (0.25, [0.75, 1.0, 0.5])] {
            let mix = Mix { a: a.into(), b: b.into(), share: share.into() };
            let textures = TexturesAt { textures: &[], at: TexturePoint::default() };
            assert_eq!(mix.color(&textures).to_rgb(), expected);
        }
    }
}
