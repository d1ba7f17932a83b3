//! Mask: a material with holes.
//!
//! At each point a ray meets the surface with chance `opacity`, and passes it else as if there were none: shadow rays too, so
//! leaves cut out of quads by a picture cast shadows of leaves. Where opacity is 0 or 1 nothing is left to chance. The chance
//! is a hash of the ray, so the same ray meets the same surfaces whenever it is traced. As in Pharr, Jakob & Humphreys, Physically Based Rendering,
//! 4th ed. 2023, §7.1.1.
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
    pub opacity: Scalar,
}

impl Mask {
    pub(crate) fn check(&self, c: &mut Checker) {
        self.opacity.check_range("opacity", 0.0, 1.0, c);
    }
}
