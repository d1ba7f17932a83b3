//! The sphere.
//!
//! ```toml
//! [[shape.sphere]]
//! center = [0, 1, 0]
//! radius = 1
//! material = "glass"
//! ```

use std::f32::consts::PI;

use eyebeam_bvh::{Hit, Primitive, Ray, Sphere};
use glam::{Vec2, Vec3, Vec3Swizzles};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::array::{array, optional_array};
use crate::motion::{MotionDesc, MotionKey};
use crate::shape::{ShapeDesc, Single, SurfacePoint};
use crate::validate::Checker;

/// A sphere; its normal points outwards.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
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
    /// Where it is at some times; it rests if absent.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub motion: Vec<MotionKey>,
    /// About what its `motion` turns it, and from where it grows, metres, where it is without motion; its centre if absent.
    #[serde(default, deserialize_with = "optional_array", skip_serializing_if = "Option::is_none")]
    pub pivot: Option<[f32; 3]>,
}

impl SphereDesc {
    fn sphere(&self) -> Sphere {
        Sphere { center: self.center.into(), radius: self.radius }
    }
}

impl ShapeDesc for SphereDesc {
    fn check(&self, c: &mut Checker) {
        c.finite("center", &self.center);
        c.positive("radius", self.radius);
    }

    fn push_primitives(&self, primitives: &mut Vec<Primitive>) {
        primitives.push(Primitive::Sphere(self.sphere()));
    }

    fn single(&self) -> Option<Single> {
        Some(Single::Sphere(self.sphere()))
    }

    fn origin(&self) -> Vec3 {
        self.center.into()
    }

    fn material(&self) -> Option<&str> {
        self.material.as_deref()
    }

    fn motion(&self) -> MotionDesc<'_> {
        MotionDesc { keys: &self.motion, pivot: self.pivot }
    }
}

/// Projects the point on the ray onto the sphere, in double precision.
#[inline]
pub(super) fn point(sphere: &Sphere, ray: &Ray, hit: &Hit) -> SurfacePoint {
    let center = sphere.center.as_dvec3();
    let on_ray = ray.o.as_dvec3() + ray.d.as_dvec3() * f64::from(hit.t);
    SurfacePoint::on_sphere(center, sphere.radius.into(), (on_ray - center).normalize())
}

/// Longitude and latitude of a unit normal, each in 0..1: eastwards from −x over +z, as seen from above against the clock,
/// and from the lowest point to the highest.
pub(crate) fn uv(n: Vec3) -> Vec2 {
    let longitude = 0.5 + libm::atan2f(-n.z, n.x) / (2.0 * PI);
    let latitude = 0.5 + libm::atan2f(n.y, n.xz().length()) / PI;
    Vec2::new(longitude, latitude)
}

/// How the point moves with [`uv`]'s longitude and latitude, on a sphere of radius 1; the first is 0 at the poles, the second is
/// not known there.
pub(crate) fn tangents(n: Vec3) -> [Vec3; 2] {
    let cos = n.xz().length();
    let [east, up] = [Vec3::new(n.z, 0.0, -n.x), Vec3::new(-n.x * n.y, cos * cos, -n.z * n.y)];
    [2.0 * PI * east, PI * up / cos.max(f32::MIN_POSITIVE)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tangents_are_differences() {
        for n in [Vec3::new(0.6, 0.5, 0.2), Vec3::new(-0.1, -0.9, 0.3), Vec3::new(0.3, 0.1, -0.8)].map(Vec3::normalize)
        {
            let [u, v] = tangents(n);
            for (along, expected) in [(u, Vec2::X), (v, Vec2::Y)] {
                let moved = uv((n + 1e-3 * along).normalize()) - uv((n - 1e-3 * along).normalize());
                assert!((moved / 2e-3 - expected).length() < 1e-2, "{n}: {moved}");
            }
        }
    }

    #[test]
    fn longitude_and_latitude() {
        for (n, at) in [
            (Vec3::Z, [0.25, 0.5]),
            (Vec3::X, [0.5, 0.5]),
            (Vec3::NEG_Z, [0.75, 0.5]),
            (Vec3::new(0.6, 0.8, 0.0), [0.5, 0.5 + 0.8_f32.asin() / PI]),
            (Vec3::new(1e-30, -1.0, 0.0), [0.5, 0.0]),
            (Vec3::new(1e-30, 1.0, 0.0), [0.5, 1.0]),
        ] {
            assert!((uv(n) - Vec2::from(at)).abs().max_element() < 1e-6, "{n}: {}", uv(n));
        }
    }
}
