//! Bump: relief by a texture of heights.
//!
//! Heights tilt the shading normal as the slopes of the relief would; the shape itself stays as it is:
//! n' ∝ n − ∇h, with the gradient of h along the surface by differences over a short step. Blinn 1978,
//! doi:10.1145/800248.507101; in terms of the surface gradient, Mikkelsen 2010, "Bump Mapping Unparametrized Surfaces on
//! the GPU".
//!
//! ```toml
//! [texture.dents.noise]
//! mapping = { scale = [30, 30, 30] }
//!
//! [material.smooth.conductor]
//! metal = "copper"
//!
//! [material.hammered.bump]
//! of = "smooth"
//! height = "dents"
//! scale = 0.01
//! ```

use glam::Vec3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::names::Name;
use crate::texture::{Scalar, Textures};
use crate::validate::Checker;

/// A material with a relief.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Bump {
    /// The material that gets it.
    pub of: Name,
    /// Heights, in multiples of `scale`.
    pub height: Scalar,
    /// Metres from height 0 to 1, -1000..1000: below 0, what was high is low. 0.01 if absent.
    #[serde(default = "centimetre")]
    #[schemars(range(min = -1000.0, max = 1000.0))]
    pub scale: f32,
}

fn centimetre() -> f32 {
    0.01
}

impl Bump {
    pub(crate) fn check(&self, c: &mut Checker) {
        c.in_range("scale", self.scale, -1000.0, 1000.0);
        self.height.check_range("height", -Self::HIGHEST, Self::HIGHEST, c);
    }

    const HIGHEST: f32 = 1e6;

    /// Height at a point, metres.
    fn height(&self, textures: &impl Textures) -> f32 {
        self.scale * self.height.at(textures, -Self::HIGHEST, Self::HIGHEST)
    }

    /// The normal of the relief in a frame around that of the surface; `textures` are those of the point and of points a
    /// `step`, metres, along the frame's first two axes.
    pub(crate) fn normal(&self, textures: [&impl Textures; 3], step: f32) -> Option<Vec3> {
        let [here, along_x, along_y] = textures.map(|textures| self.height(textures));
        Vec3::new((here - along_x) / step, (here - along_y) / step, 1.0).try_normalize()
    }
}
