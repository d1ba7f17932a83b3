//! The sphere.
//!
//! ```toml
//! [[shape.sphere]]
//! center = [0, 1, 0]
//! radius = 1
//! material = "glass"
//! ```

use eyebeam_bvh::{Hit, Primitive, Ray, Sphere};
use glam::Vec3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::array::array;
use crate::shape::{ShapeDesc, SurfacePoint};
use crate::validate::Checker;

/// A sphere; its normal points outwards.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SphereDesc {
    /// Centre, metres.
    #[serde(default, deserialize_with = "array")]
    pub center: [f32; 3],
    /// Radius, metres, above 0. Large ones (1e5, for a ground) are as accurate as small ones.
    pub radius: f32,
    /// Name of a material; grey matte if absent.
    #[serde(default)]
    pub material: Option<String>,
}

impl ShapeDesc for SphereDesc {
    fn check(&self, c: &mut Checker) {
        c.finite("center", &self.center);
        c.positive("radius", self.radius);
    }

    fn push_primitives(&self, primitives: &mut Vec<Primitive>) {
        primitives.push(Primitive::Sphere(Sphere { center: Vec3::from(self.center), radius: self.radius }));
    }

    fn material(&self) -> Option<&str> {
        self.material.as_deref()
    }
}

/// Projects the point on the ray onto the sphere, in double precision.
#[inline]
pub(super) fn point(sphere: &Sphere, ray: &Ray, hit: &Hit) -> SurfacePoint {
    let center = sphere.center.as_dvec3();
    let on_ray = ray.o.as_dvec3() + ray.d.as_dvec3() * f64::from(hit.t);
    SurfacePoint::on_sphere(center, sphere.radius.into(), (on_ray - center).normalize())
}
