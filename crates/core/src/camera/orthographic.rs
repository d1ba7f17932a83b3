//! The orthographic camera: all rays are parallel, so sizes do not shrink with distance.
//!
//! Rays start on the plane through the eye, at right angles to the direction of view; what lies behind it is not seen.
//!
//! ```toml
//! [camera]
//! look_from = [10, 10, 10]
//! look_at = [0, 0, 0]
//! [camera.orthographic]
//! height = 4
//! ```

use eyebeam_bvh::Ray;
use glam::{Vec2, Vec3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::camera::{CameraDesc, half_size};
use crate::math::Pose;
use crate::validate::Checker;

/// Parallel rays: `[camera.orthographic]`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct OrthographicDesc {
    /// From the bottom to the top of the picture, metres.
    pub height: f32,
}

impl Default for OrthographicDesc {
    fn default() -> Self {
        Self { height: 4.0 }
    }
}

impl OrthographicDesc {
    pub(super) fn check(&self, c: &mut Checker) {
        c.positive("height", self.height);
    }
}

/// An orthographic camera ready to make rays for a picture of a given size.
#[derive(Clone, Copy, Debug)]
pub struct Orthographic {
    pose: Pose,
    /// The middle of the picture, pixels.
    center: Vec2,
    /// A pixel's side, metres.
    pixel: f32,
}

impl Orthographic {
    pub(super) fn new(desc: &CameraDesc, kind: &OrthographicDesc, width: u32, height: u32) -> Self {
        Self {
            pose: Pose::new(desc.look_from, desc.look_at, desc.up),
            center: half_size(width, height),
            pixel: kind.height / height as f32,
        }
    }

    pub(super) fn pose(&self) -> &Pose {
        &self.pose
    }

    #[inline]
    pub(super) fn ray(&self, film: Vec2) -> Ray {
        let start = (self.pixel * (film - self.center)).extend(0.0);
        Ray::new(self.pose.eye + self.pose.to_world(start), self.pose.forward)
    }

    pub(super) fn project(&self, p: Vec3) -> Option<Vec2> {
        (p.z > 0.0).then(|| p.truncate() / self.pixel + self.center)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn has_the_height_that_is_said() {
        let desc = CameraDesc { look_from: [1.0, 2.0, 5.0], look_at: [1.0, 2.0, 0.0], ..CameraDesc::default() };
        let camera = Orthographic::new(&desc, &OrthographicDesc { height: 3.0 }, 200, 100);
        let start = |x, y| camera.ray(Vec2::new(x, y)).o;
        assert!((start(100.0, 50.0) - Vec3::new(1.0, 2.0, 5.0)).length() < 1e-6, "the middle");
        assert!((start(0.0, 0.0) - Vec3::new(-2.0, 3.5, 5.0)).length() < 1e-6, "top left");
        assert!((start(200.0, 100.0) - Vec3::new(4.0, 0.5, 5.0)).length() < 1e-6, "bottom right");
        assert!((start(0.5, 0.5) - Vec3::new(-1.985, 3.485, 5.0)).length() < 1e-6, "the first pixel's centre");
        assert_eq!(camera.ray(Vec2::new(3.0, 4.0)).d, Vec3::NEG_Z);
    }
}
