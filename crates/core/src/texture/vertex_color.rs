//! Vertex colour: what the vertices of a mesh say, interpolated over its triangles.
//!
//! ```toml
//! [texture.painted.vertex-color]
//!
//! [material.paint.lambertian]
//! albedo = "painted"
//!
//! [[shape.mesh]]
//! vertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]
//! triangles = [[0, 1, 2]]
//! colors = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]
//! material = "paint"
//! ```

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::color::{Rgb, Spectrum};
use crate::texture::TexturePoint;
use crate::validate::Checker;

/// The colours of vertices.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct VertexColor {
    /// Of shapes that are no meshes, or whose vertices have no colours.
    pub otherwise: Rgb,
    /// The `alphas` of vertices, as a grey, instead of their colours.
    pub alpha: bool,
}

impl Default for VertexColor {
    fn default() -> Self {
        Self { otherwise: Rgb::grey(0.8), alpha: false }
    }
}

impl VertexColor {
    pub(super) fn check(&self, c: &mut Checker) {
        c.radiance("otherwise", self.otherwise);
    }

    pub(super) fn color(&self, at: &TexturePoint) -> Spectrum {
        let said = if self.alpha { at.vertex_alpha.map(Rgb::grey) } else { at.vertex_color };
        said.unwrap_or(self.otherwise).into()
    }
}
