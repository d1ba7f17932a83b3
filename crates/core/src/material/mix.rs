//! Mix: of two materials one or the other, by chance or by a texture.
//!
//! f = (1 − share) fₐ + share f_b. At each hit one of the two is taken, `b` with chance `share`, so that a mix costs no more
//! than a material; a texture that is black and white makes a pattern of both. As `mix` of Pharr, Jakob & Humphreys,
//! Physically Based Rendering, 4th ed. 2023, §10.5.1.
//!
//! ```toml
//! [material.paint.lambertian]
//! albedo = [0.1, 0.2, 0.5]
//!
//! [material.iron.conductor]
//! metal = "iron"
//! roughness = 0.4
//!
//! [texture.flakes.noise]
//! dark = 0
//! light = 1
//!
//! [material.worn.mix]
//! a = "paint"
//! b = "iron"
//! share = "flakes"
//! ```

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::names::Name;
use crate::texture::Scalar;
use crate::validate::Checker;

/// Part one material, part another.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Mix {
    /// The material that there is where `share` is 0.
    pub a: Name,
    /// The material that there is where `share` is 1.
    pub b: Name,
    /// Share of `b`, 0..1; a half if absent.
    #[serde(default = "half")]
    pub share: Scalar,
}

fn half() -> Scalar {
    0.5.into()
}

impl Mix {
    pub(crate) fn check(&self, c: &mut Checker) {
        self.share.check_range("share", 0.0, 1.0, c);
    }
}
