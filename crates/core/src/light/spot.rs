//! A cone of light from a point, with a soft rim.
//!
//! Full intensity up to the angle `inner` from the axis, none beyond `outer`, and in between 3t² − 2t³ of
//! t = (cos θ − cos outer) / (cos inner − cos outer).
//!
//! ```toml
//! [[light.spot]]
//! position = [0, 4, 0]
//! look_at = [0, 0, 0]
//! intensity = 200
//! inner = 20
//! outer = 25
//! ```

use std::f32::consts::TAU;

use glam::Vec3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::array::array;
use crate::color::Rgb;
use crate::light::one;
use crate::light::select::LightBounds;
use crate::validate::Checker;

/// A lamp without size that shines into a cone.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SpotLight {
    /// Where it is, metres.
    #[serde(deserialize_with = "array")]
    pub position: [f32; 3],
    /// A point on the cone's axis, metres.
    #[serde(deserialize_with = "array")]
    pub look_at: [f32; 3],
    /// Radiant intensity within the inner cone, W / sr, not negative.
    #[serde(default = "one")]
    pub intensity: Rgb,
    /// Angle from the axis to where the light begins to fall off, degrees; 80 % of `outer` if absent.
    #[schemars(range(min = 0.0, max = 180.0))]
    pub inner: Option<f32>,
    /// Angle from the axis to where it ends, degrees, 0..180.
    #[serde(default = "thirty")]
    #[schemars(range(min = 0.01, max = 180.0))]
    pub outer: f32,
}

fn thirty() -> f32 {
    30.0
}

impl SpotLight {
    pub(super) fn check(&self, c: &mut Checker) {
        c.line_of_sight("position", self.position, self.look_at, "it points");
        c.radiance("intensity", self.intensity);
        c.in_range("outer", self.outer, 0.01, 180.0);
        if let Some(inner) = self.inner {
            c.in_range("inner", inner, 0.0, self.outer);
        }
    }

    pub(super) fn compile(&self) -> Spot {
        let cos = |degrees: f32| libm::cosf(degrees.to_radians());
        let position = Vec3::from(self.position);
        Spot {
            position,
            axis: (Vec3::from(self.look_at) - position).normalize(),
            cos_inner: cos(self.inner.unwrap_or(0.8 * self.outer)),
            cos_outer: cos(self.outer),
        }
    }
}

/// A spot's light without its colour.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Spot {
    pub(super) position: Vec3,
    axis: Vec3,
    cos_inner: f32,
    cos_outer: f32,
}

impl Spot {
    /// Share of the full intensity along the unit direction `w` away from it.
    #[inline]
    pub(super) fn falloff(&self, w: Vec3) -> f32 {
        let cos = w.dot(self.axis);
        if cos <= self.cos_outer {
            return 0.0;
        }
        let t = ((cos - self.cos_outer) / (self.cos_inner - self.cos_outer).max(1e-9)).min(1.0);
        t * t * (3.0 - 2.0 * t)
    }

    /// Where it is and how much it shines, at an intensity of this luminance.
    pub(super) fn bounds(&self, intensity: f32) -> LightBounds {
        // The integral of 3t² − 2t³ over the rim is half its width.
        let solid_angle = TAU * (1.0 - self.cos_inner + 0.5 * (self.cos_inner - self.cos_outer));
        let bounds = LightBounds::sphere(self.position, 0.0, intensity * solid_angle);
        if self.cos_outer > 0.0 {
            LightBounds { axis: self.axis, cos_theta_o: 1.0, cos_theta_e: self.cos_outer, ..bounds }
        } else {
            bounds
        }
    }
}
