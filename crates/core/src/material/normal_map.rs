//! Normal map: a picture of small slopes.
//!
//! Red, green and blue from 0 to 1 are a direction (x, y, z) from -1 to 1: x along growing u, y along growing v, z off the
//! surface, as in glTF and OpenGL. It takes the place of the shading normal. Where it would mirror the view into the surface it is bent
//! back, as that of a smooth mesh is. Pictures of normals are data: their numbers are not sRGB.
//!
//! ```toml
//! [texture.waves.checker]
//! even = [0.6, 0.5, 1]
//! odd = [0.4, 0.5, 1]
//!
//! [material.smooth.conductor]
//! roughness = 0.2
//!
//! [material.wavy.normal-map]
//! of = "smooth"
//! map = "waves"
//! strength = 0.5
//! ```

use glam::Vec3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::names::Name;
use crate::texture::{Color, Textures};
use crate::validate::Checker;

/// A material whose normals come from a texture.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct NormalMap {
    /// The material that gets them.
    pub of: Name,
    /// The normals, as colours.
    pub map: Color,
    /// Factor on the slopes, -100..100; 1 if absent.
    #[serde(default = "one")]
    #[schemars(range(min = -100.0, max = 100.0))]
    pub strength: f32,
}

fn one() -> f32 {
    1.0
}

impl NormalMap {
    pub(crate) fn check(&self, c: &mut Checker) {
        c.in_range("strength", self.strength, -100.0, 100.0);
    }

    /// The normal in the frame of growing u and v; none if it has no length.
    pub(crate) fn normal(&self, textures: &impl Textures) -> Option<Vec3> {
        let n = 2.0 * Vec3::from(self.map.share_at(textures).to_rgb()) - 1.0;
        (n * Vec3::new(self.strength, self.strength, 1.0)).try_normalize()
    }
}
