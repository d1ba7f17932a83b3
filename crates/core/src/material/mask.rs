//! Mask: a material with holes.
//!
//! At each point a ray meets the surface with chance `opacity`, and passes it else as if there were none: shadow rays too, so
//! leaves cut out of quads by a picture cast shadows of leaves. Where opacity is 0 or 1 nothing is left to chance. The chance
//! is a hash of the ray, so the same ray meets the same surfaces whenever it is traced. As in Pharr, Jakob & Humphreys, Physically Based Rendering,
//! 4th ed. 2023, §7.1.1.
//!
//! What is `one_sided` is there only for rays that come from its front, to where its normal points.
//!
//! ```toml
//! [material.green.diffuse-transmission]
//! reflectance = [0.1, 0.2, 0.05]
//! transmittance = [0.2, 0.3, 0.05]
//!
//! [texture.outline.checker]
//! even = 1
//! odd = 0
//!
//! [material.leaf.mask]
//! of = "green"
//! opacity = "outline"
//! ```

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::names::Name;
use crate::texture::Scalar;
use crate::validate::Checker;

/// There only in part.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Mask {
    /// The material that is seen where there is any.
    pub of: Name,
    /// Chance that a ray meets it, 0..1.
    #[serde(default = "whole")]
    pub opacity: Scalar,
    /// Whether rays that come from behind pass: what is seen through the backs of walls.
    #[serde(default)]
    pub one_sided: bool,
}

fn whole() -> Scalar {
    1.0.into()
}

impl Mask {
    /// With holes for rays of all sides.
    pub fn new(of: Name, opacity: Scalar) -> Self {
        Self { of, opacity, one_sided: false }
    }

    /// Only the front.
    pub fn one_sided(of: Name) -> Self {
        Self { of, opacity: whole(), one_sided: true }
    }

    pub(crate) fn check(&self, c: &mut Checker) {
        self.opacity.check_range("opacity", 0.0, 1.0, c);
    }
}
