//! Where on a texture a point of a surface lies.

use glam::Vec3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::array::array;
use crate::math::sin_cos_degrees;
use crate::texture::TexturePoint;
use crate::validate::Checker;

/// By what a texture is laid out, and how it is turned, stretched and moved: first the rotation, then the scale, then the
/// offset; between these it can be turned once more, which makes every shear of coordinates.
///
/// ```toml
/// [texture.planks.wood]
/// mapping = { space = "world", rotation = 90, scale = [2, 2, 0.2] }
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Mapping {
    /// Coordinates on the shape, places in the world or within the shape; each texture has a default.
    pub space: Option<Space>,
    /// Turns about the third axis, counter-clockwise, degrees.
    pub rotation: f32,
    /// Factors on the coordinates: at 2 everything is half as large.
    #[serde(deserialize_with = "array")]
    pub scale: [f32; 3],
    /// Turns them once more, after the scale, degrees.
    #[serde(skip_serializing_if = "is_zero")]
    pub rotation_after: f32,
    /// Added in the end.
    #[serde(deserialize_with = "array")]
    pub offset: [f32; 3],
}

fn is_zero(angle: &f32) -> bool {
    *angle == 0.0
}

/// What coordinates are.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Space {
    /// On the shape: each 0..1 over a quad, a sphere or as a mesh says; the third is 0.
    Uv,
    /// The same by the second coordinates of a mesh, `uvs_1`; where there are none, by the first ones.
    #[serde(rename = "uv-1")]
    Uv1,
    /// In the world, metres.
    World,
    /// From the shape's own origin, metres: the centre of a sphere, the corner of a quad, where a mesh counts from.
    Object,
}

impl Default for Mapping {
    fn default() -> Self {
        Self { space: None, rotation: 0.0, scale: [1.0; 3], rotation_after: 0.0, offset: [0.0; 3] }
    }
}

impl Mapping {
    pub(super) fn check(&self, c: &mut Checker) {
        c.within("mapping", |c| {
            c.in_range("rotation", self.rotation, -1e4, 1e4);
            c.in_range("rotation_after", self.rotation_after, -1e4, 1e4);
            c.finite("scale", &self.scale);
            c.finite("offset", &self.offset);
        });
    }

    /// The place on the texture. Finite, whatever the numbers are.
    #[inline]
    pub(super) fn place(&self, at: &TexturePoint, default: Space) -> Vec3 {
        self.lay(self.origin(at, default))
    }

    /// The coordinates that it turns, stretches and moves.
    #[inline]
    pub(super) fn origin(&self, at: &TexturePoint, default: Space) -> Vec3 {
        match self.space.unwrap_or(default) {
            Space::Uv => at.uv.extend(0.0),
            Space::Uv1 => at.uv_1.unwrap_or(at.uv).extend(0.0),
            Space::World => at.p,
            Space::Object => at.p_object,
        }
    }

    /// Turns, stretches and moves coordinates. Finite, whatever the numbers are.
    #[inline]
    pub fn lay(&self, p: Vec3) -> Vec3 {
        /// Single precision tells nothing apart beyond.
        const FARTHEST: Vec3 = Vec3::splat(1e9);
        let place = turned(p, self.rotation) * Vec3::from(self.scale);
        (turned(place, self.rotation_after) + Vec3::from(self.offset)).clamp(-FARTHEST, FARTHEST)
    }
}

/// Turned about the third axis, counter-clockwise.
#[inline]
fn turned(p: Vec3, degrees: f32) -> Vec3 {
    if degrees == 0.0 {
        return p;
    }
    let (sin, cos) = sin_cos_degrees(degrees);
    Vec3::new(cos * p.x - sin * p.y, sin * p.x + cos * p.y, p.z)
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec2;

    #[test]
    fn turns_stretches_and_moves_in_this_order() {
        let mapping = Mapping { rotation: 90.0, scale: [2.0, 3.0, 4.0], offset: [1.0, 0.0, 0.0], ..Mapping::default() };
        let at = TexturePoint {
            uv: Vec2::new(1.0, 0.0),
            p: Vec3::new(0.0, 1.0, 1.0),
            p_object: Vec3::new(0.0, 2.0, 3.0),
            ..TexturePoint::default()
        };
        assert!((mapping.place(&at, Space::Uv) - Vec3::new(1.0, 3.0, 0.0)).length() < 1e-5);
        assert!((mapping.place(&at, Space::World) - Vec3::new(-1.0, 0.0, 4.0)).length() < 1e-5);
        let again = Mapping { rotation_after: 90.0, offset: [0.0; 3], ..mapping.clone() };
        assert!((again.place(&at, Space::Uv) - Vec3::new(-3.0, 0.0, 0.0)).length() < 1e-5);
        let world = Mapping { space: Some(Space::World), ..Mapping::default() };
        assert_eq!(world.place(&at, Space::Uv), at.p);
        let second = Mapping { space: Some(Space::Uv1), ..Mapping::default() };
        assert_eq!(second.place(&at, Space::World), Vec3::X, "there are no other coordinates");
        let both = TexturePoint { uv_1: Some(Vec2::new(0.5, 0.25)), ..at };
        assert_eq!(second.place(&both, Space::World), Vec3::new(0.5, 0.25, 0.0));
        assert_eq!(Mapping::default().place(&both, Space::Uv), Vec3::X);
        let object = Mapping { space: Some(Space::Object), ..Mapping::default() };
        assert_eq!(object.place(&at, Space::World), at.p_object);
    }
}
