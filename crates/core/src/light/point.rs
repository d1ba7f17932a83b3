//! A point that shines evenly into all directions: radiance arrives as intensity / distance².
//!
//! ```toml
//! [[light.point]]
//! position = [0, 3, 0]
//! intensity = 40
//! ```

use glam::Vec3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::array::array;
use crate::color::Rgb;
use crate::light::one;
use crate::validate::Checker;

/// A lamp without size. Nothing that is seen: only what it lights is.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PointLight {
    /// Where it is, metres.
    #[serde(deserialize_with = "array")]
    pub position: [f32; 3],
    /// Radiant intensity, W / sr, not negative.
    #[serde(default = "one")]
    pub intensity: Rgb,
}

impl PointLight {
    pub(super) fn check(&self, c: &mut Checker) {
        c.finite("position", &self.position);
        c.radiance("intensity", self.intensity);
    }

    pub(super) fn position(&self) -> Vec3 {
        self.position.into()
    }
}
