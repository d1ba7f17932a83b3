//! The panorama: all directions in one picture, equirectangular.
//!
//! A column is a longitude, a row a latitude: 360 degrees from left to right, 180 from top to bottom. The direction of
//! view is in the middle, `up` at the top, so the horizon is straight if the camera looks level. Pixels are square where
//! the picture is twice as wide as high. Uniform film points have the density 1 / (2π² sin θ) over directions, θ from the
//! top.
//!
//! ```toml
//! [render]
//! width = 1000
//! height = 500
//! [camera]
//! look_from = [0, 1, 0]
//! look_at = [0, 1, -1]
//! [camera.panorama]
//! ```

use std::f32::consts::{PI, TAU};

use eyebeam_bvh::Ray;
use glam::{Vec2, Vec3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::camera::CameraDesc;
use crate::math::Pose;
use crate::math::sin_cos_turns;

/// All directions: `[camera.panorama]`. It has no settings.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PanoramaDesc {}

/// A panorama ready to make rays for a picture of a given size.
#[derive(Clone, Copy, Debug)]
pub struct Panorama {
    pose: Pose,
    /// Width and height of the picture, pixels.
    size: Vec2,
}

impl Panorama {
    pub(super) fn new(desc: &CameraDesc, width: u32, height: u32) -> Self {
        Self { pose: Pose::new(desc.look_from, desc.look_at, desc.up), size: Vec2::new(width as f32, height as f32) }
    }

    pub(super) fn pose(&self) -> &Pose {
        &self.pose
    }

    #[inline]
    pub(super) fn ray(&self, film: Vec2) -> Ray {
        let at = film / self.size;
        let (sin_phi, cos_phi) = sin_cos_turns(at.x - 0.5);
        let (sin_theta, cos_theta) = sin_cos_turns(0.5 * at.y);
        let d = Vec3::new(sin_theta * sin_phi, -cos_theta, sin_theta * cos_phi);
        Ray::new(self.pose.eye, self.pose.to_world(d).normalize())
    }

    pub(super) fn project(&self, p: Vec3) -> Option<Vec2> {
        let d = p.try_normalize()?;
        let phi = libm::atan2f(d.x, d.z);
        let theta = libm::atan2f((d.x * d.x + d.z * d.z).sqrt(), -d.y);
        Some(Vec2::new(phi / TAU + 0.5, theta / PI) * self.size)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampler::Independent;
    use crate::testing::chi2_counts;
    use glam::UVec2;

    fn level() -> CameraDesc {
        CameraDesc { look_from: [0.0, 1.0, 5.0], look_at: [0.0, 1.0, 0.0], ..CameraDesc::default() }
    }

    #[test]
    fn looks_everywhere() {
        let camera = Panorama::new(&level(), 200, 100);
        let look = |x, y| camera.ray(Vec2::new(x, y)).d;
        for (x, y, d) in [
            (100.0, 50.0, Vec3::NEG_Z),
            (150.0, 50.0, Vec3::X),
            (50.0, 50.0, Vec3::NEG_X),
            (0.0, 50.0, Vec3::Z),
            (200.0, 50.0, Vec3::Z),
            (70.0, 0.0, Vec3::Y),
            (20.0, 100.0, Vec3::NEG_Y),
            (100.0, 25.0, Vec3::new(0.0, 1.0, -1.0).normalize()),
        ] {
            assert!((look(x, y) - d).length() < 1e-6, "({x}, {y}) looks along {}", look(x, y));
        }
    }

    /// The share of film points that look into a bin is the integral of 1 / (2π² sin θ) over it.
    #[test]
    fn has_its_density() {
        const N: u32 = 200_000;
        const BINS: usize = 30;
        let camera = Panorama::new(&level(), 640, 320);
        let mut counts = vec![0_u64; BINS * BINS];
        for i in 0..N {
            let d = camera.ray(Independent::new(2, UVec2::ZERO, i).get_2d() * camera.size).d;
            let bin = |c: f32| ((c * BINS as f32) as usize).min(BINS - 1);
            counts[bin(0.5 * d.y + 0.5) * BINS + bin(d.z.atan2(d.x) / TAU + 0.5)] += 1;
        }
        let angle = |bin: usize| (2.0 * bin as f64 / BINS as f64 - 1.0).acos();
        let share = |bin: usize| (angle(bin) - angle(bin + 1)) / std::f64::consts::PI / BINS as f64;
        let expected: Vec<_> = (0..BINS * BINS).map(|i| f64::from(N) * share(i / BINS)).collect();
        chi2_counts(&counts, &expected).unwrap();
    }
}
