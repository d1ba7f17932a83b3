//! The quad: rectangles and other parallelograms.
//!
//! ```toml
//! [[shape.quad]]
//! corner = [-1, 0, 1]
//! u = [2, 0, 0]
//! v = [0, 0, -2]
//! material = "floor"
//! ```

use eyebeam_bvh::{Primitive, Quad};
use glam::Vec3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::array::{array, optional_array};
use crate::motion::{MotionDesc, MotionKey};
use crate::shape::{Plane, ShapeDesc, Single};
use crate::validate::Checker;

/// A parallelogram: a corner and two edges. Its normal is u × v.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct QuadDesc {
    /// A corner, metres.
    #[serde(deserialize_with = "array")]
    pub corner: [f32; 3],
    /// Edge from the corner, metres.
    #[serde(deserialize_with = "array")]
    pub u: [f32; 3],
    /// The other edge from the corner, metres.
    #[serde(deserialize_with = "array")]
    pub v: [f32; 3],
    /// Name of a material; grey matte if absent.
    #[serde(default)]
    pub material: Option<String>,
    /// Where it is at some times; it rests if absent.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub motion: Vec<MotionKey>,
    /// About what its `motion` turns it, and from where it grows, metres, where it is without motion; its corner if absent.
    #[serde(default, deserialize_with = "optional_array", skip_serializing_if = "Option::is_none")]
    pub pivot: Option<[f32; 3]>,
}

impl ShapeDesc for QuadDesc {
    fn check(&self, c: &mut Checker) {
        c.finite("corner", &self.corner);
        c.nonzero("u", self.u);
        c.nonzero("v", self.v);
        let area = Vec3::from(self.u).as_dvec3().cross(Vec3::from(self.v).as_dvec3()).length();
        if area == 0.0 && self.u != [0.0; 3] && self.v != [0.0; 3] {
            c.problem("v", "`u` and `v` are parallel, so the quad has no area", Some("turn one of them".to_owned()));
        }
    }

    fn push_primitives(&self, primitives: &mut Vec<Primitive>) {
        let quad = Quad { corner: Vec3::from(self.corner), u: Vec3::from(self.u), v: Vec3::from(self.v) };
        primitives.push(Primitive::Quad(quad));
    }

    fn single(&self) -> Option<Single> {
        let [corner, u, v] = [self.corner, self.u, self.v].map(|v| Vec3::from(v).as_dvec3());
        Some(Single::Plane(Plane::new(corner, [u, v])))
    }

    fn origin(&self) -> Vec3 {
        self.corner.into()
    }

    fn material(&self) -> Option<&str> {
        self.material.as_deref()
    }

    fn motion(&self) -> MotionDesc<'_> {
        MotionDesc { keys: &self.motion, pivot: self.pivot }
    }
}
