//! Multiply: the product of two colours, channel by channel.
//!
//! ```toml
//! [texture.weave.checker]
//! mapping = { scale = [50, 50, 50] }
//!
//! [texture.blue-weave.multiply]
//! a = "weave"
//! b = "#3355aa"
//! ```

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::color::Spectrum;
use crate::texture::{Color, TexturesAt};
use crate::validate::Checker;

/// A product.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Multiply {
    /// One factor.
    pub a: Color,
    /// The other.
    pub b: Color,
}

impl Multiply {
    /// As bright as a lamp may be, so that products of products stay finite.
    const BRIGHTEST: f32 = 1e9;

    pub(super) fn check(&self, c: &mut Checker) {
        self.a.check_amount("a", c);
        self.b.check_amount("b", c);
    }

    pub(super) fn color(&self, textures: &TexturesAt<'_>) -> Spectrum {
        (self.a.at(textures) * self.b.at(textures)).clamp(0.0, Self::BRIGHTEST)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::Rgb;
    use crate::texture::TexturePoint;

    #[test]
    fn channel_by_channel() {
        let product = |a, b| {
            let multiply = Multiply { a: Rgb(a).into(), b: Rgb(b).into() };
            multiply.color(&TexturesAt { textures: &[], at: TexturePoint::default() }).to_rgb()
        };
        assert_eq!(product([0.5, 2.0, 0.0], [0.5, 0.25, 7.0]), [0.25, 0.5, 0.0]);
        assert_eq!(product([1e8; 3], [1e8; 3]), [1e9; 3]);
    }
}
