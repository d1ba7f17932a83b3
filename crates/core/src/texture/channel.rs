//! Channel: red, green, blue or the luminance of a colour, as a grey.
//!
//! Pictures often hold three amounts in one: those of glTF have roughness in green and metalness in blue. Tell such a picture
//! that it is no colour by `encoding = "linear"`.
//!
//! ```toml
//! [texture.packed.noise]
//! dark = [0, 0.2, 0]
//! light = [0, 0.6, 1]
//!
//! [texture.roughness.channel]
//! input = "packed"
//! channel = "green"
//! ```

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::color::{Rgb, Spectrum};
use crate::texture::{Color, TexturesAt};
use crate::validate::Checker;

/// A part of a colour.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ChannelOf {
    /// The colour.
    pub input: Color,
    /// Which part.
    #[serde(default)]
    pub channel: Channel,
}

/// Parts of a colour.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Channel {
    /// Red alone.
    Red,
    /// Green alone.
    Green,
    /// Blue alone.
    Blue,
    /// How bright it looks, by Rec. 709.
    #[default]
    Luminance,
}

impl ChannelOf {
    pub(super) fn check(&self, c: &mut Checker) {
        self.input.check_amount("input", c);
    }

    pub(super) fn color(&self, textures: &TexturesAt<'_>) -> Spectrum {
        let [r, g, b] = self.input.at(textures).to_rgb();
        let grey = match self.channel {
            Channel::Red => r,
            Channel::Green => g,
            Channel::Blue => b,
            Channel::Luminance => Rgb([r, g, b]).luminance(),
        };
        Spectrum::from_rgb([grey; 3])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::texture::TexturePoint;

    #[test]
    fn one_of_four() {
        for (channel, expected) in
            [(Channel::Red, 0.2), (Channel::Green, 0.4), (Channel::Blue, 0.8), (Channel::Luminance, 0.38636)]
        {
            let part = ChannelOf { input: Rgb([0.2, 0.4, 0.8]).into(), channel };
            let grey = part.color(&TexturesAt { textures: &[], at: TexturePoint::default() }).to_rgb();
            assert!(grey.iter().all(|c| (c - expected).abs() < 1e-6), "{channel:?}: {grey:?}");
        }
    }
}
