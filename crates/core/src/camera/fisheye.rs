//! The fisheye: up to all directions in a circle, black around it.
//!
//! A direction at the angle θ to that of view lies at the distance r from the middle of the circle of radius R, which
//! touches the shorter sides of the picture:
//!
//! equidistant: r / R = θ / θmax, equisolid: r / R = sin(θ / 2) / sin(θmax / 2), θmax half the field of view.
//!
//! The first keeps angles as distances, the second solid angles as areas. Miyamoto 1964, "Fish Eye Lens", Journal of the
//! Optical Society of America 54(8), doi:10.1364/JOSA.54.001060.
//!
//! ```toml
//! [camera]
//! look_from = [0, 1, 0]
//! look_at = [0, 2, 0]
//! up = [0, 0, -1]
//! [camera.fisheye]
//! fov = 180
//! projection = "equisolid"
//! ```

use std::f32::consts::PI;

use eyebeam_bvh::Ray;
use glam::{Vec2, Vec3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::camera::{CameraDesc, half_size};
use crate::math::Pose;
use crate::math::sin_cos_turns;
use crate::validate::Checker;

/// A circle of directions: `[camera.fisheye]`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct FisheyeDesc {
    /// Field of view across the circle, degrees, 0..360.
    #[schemars(range(min = 0.001, max = 360.0))]
    pub fov: f32,
    /// How angles become distances from the middle.
    pub projection: FisheyeProjection,
}

/// How a fisheye turns angles into distances from the middle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum FisheyeProjection {
    /// In proportion to the angle.
    #[default]
    Equidistant,
    /// In proportion to the sine of half the angle: equal solid angles have equal areas.
    Equisolid,
}

impl Default for FisheyeDesc {
    fn default() -> Self {
        Self { fov: 180.0, projection: FisheyeProjection::default() }
    }
}

impl FisheyeDesc {
    pub(super) fn check(&self, c: &mut Checker) {
        c.in_range("fov", self.fov, 0.001, 360.0);
    }
}

/// A fisheye camera ready to make rays for a picture of a given size.
#[derive(Clone, Copy, Debug)]
pub struct Fisheye {
    pose: Pose,
    /// The middle of the picture, pixels.
    center: Vec2,
    /// Of the circle, pixels.
    radius: f32,
    /// From the middle to the rim, turns.
    half_fov: f32,
    projection: FisheyeProjection,
}

impl Fisheye {
    pub(super) fn new(desc: &CameraDesc, kind: &FisheyeDesc, width: u32, height: u32) -> Self {
        let center = half_size(width, height);
        Self {
            pose: Pose::new(desc.look_from, desc.look_at, desc.up),
            center,
            radius: center.min_element(),
            half_fov: kind.fov / 720.0,
            projection: kind.projection,
        }
    }

    pub(super) fn pose(&self) -> &Pose {
        &self.pose
    }

    /// None outside of the circle.
    #[inline]
    pub(super) fn ray(&self, film: Vec2) -> Option<Ray> {
        let at = (film - self.center) / self.radius;
        let r = at.length();
        if r > 1.0 {
            return None;
        }
        let (sin, cos) = match self.projection {
            FisheyeProjection::Equidistant => sin_cos_turns(r * self.half_fov),
            FisheyeProjection::Equisolid => {
                let sin_half = r * sin_of_half(self.half_fov);
                let cos_half_sq = (1.0 - sin_half * sin_half).max(0.0);
                (2.0 * sin_half * cos_half_sq.sqrt(), cos_half_sq - sin_half * sin_half)
            }
        };
        let d = (sin * at.normalize_or_zero()).extend(cos);
        Some(Ray::new(self.pose.eye, self.pose.to_world(d).normalize()))
    }

    /// None where its direction is farther from that of view than the field of view goes.
    pub(super) fn project(&self, p: Vec3) -> Option<Vec2> {
        let d = p.try_normalize()?;
        let across = d.truncate();
        let theta = libm::atan2f(across.length(), d.z) / (2.0 * PI);
        let r = match self.projection {
            FisheyeProjection::Equidistant => theta / self.half_fov,
            FisheyeProjection::Equisolid => sin_of_half(theta) / sin_of_half(self.half_fov),
        };
        (r <= 1.0).then(|| self.center + r * self.radius * across.normalize_or_zero())
    }
}

/// The sine of half an angle in turns.
#[inline]
fn sin_of_half(turns: f32) -> f32 {
    sin_cos_turns(0.5 * turns).0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampler::Independent;
    use crate::testing::chi2_counts;
    use glam::UVec2;

    const PROJECTIONS: [FisheyeProjection; 2] = [FisheyeProjection::Equidistant, FisheyeProjection::Equisolid];

    fn fisheye(fov: f32, projection: FisheyeProjection, width: u32, height: u32) -> Fisheye {
        let desc = CameraDesc { look_from: [0.0, 1.0, 5.0], look_at: [0.0, 1.0, 0.0], ..CameraDesc::default() };
        Fisheye::new(&desc, &FisheyeDesc { fov, projection }, width, height)
    }

    #[test]
    fn sees_half_its_field_at_the_rim() {
        for fov in [0.001, 1.0, 90.0, 180.0, 220.0, 359.0, 360.0] {
            for projection in PROJECTIONS {
                let camera = fisheye(fov, projection, 300, 200);
                let look = |x, y| camera.ray(Vec2::new(x, y)).unwrap().d;
                assert!((look(150.0, 100.0) - Vec3::NEG_Z).length() < 1e-6);
                let (sin, cos) = (0.5 * fov).to_radians().sin_cos();
                for (x, y, rim) in [
                    (250.0, 100.0, Vec3::new(sin, 0.0, -cos)),
                    (50.0, 100.0, Vec3::new(-sin, 0.0, -cos)),
                    (150.0, 0.0, Vec3::new(0.0, sin, -cos)),
                    (150.0, 200.0, Vec3::new(0.0, -sin, -cos)),
                ] {
                    // Close to the opposite of the direction of view, an error of sin² is one of its root.
                    assert!((look(x, y) - rim).length() < 1e-3, "{fov} {projection:?}: {} {rim}", look(x, y));
                }
            }
        }
    }

    #[test]
    fn half_way_is_half_the_angle_if_equidistant() {
        let look = |projection| fisheye(180.0, projection, 200, 200).ray(Vec2::new(150.0, 100.0)).unwrap().d;
        assert!((look(FisheyeProjection::Equidistant).x - 0.5_f32.sqrt()).abs() < 1e-6);
        let theta = 2.0 * (0.5 * 45.0_f32.to_radians().sin()).asin();
        assert!((look(FisheyeProjection::Equisolid).x - theta.sin()).abs() < 1e-6);
    }

    #[test]
    fn is_black_around_the_circle() {
        let camera = fisheye(180.0, FisheyeProjection::Equidistant, 300, 200);
        for (x, y) in [(0.0, 0.0), (49.0, 100.0), (251.0, 100.0), (300.0, 200.0), (221.0, 171.0)] {
            assert!(camera.ray(Vec2::new(x, y)).is_none(), "({x}, {y})");
        }
        assert!(camera.ray(Vec2::new(220.0, 170.0)).is_some());
        let beside = camera.pose.eye + Vec3::new(1.0, 0.0, 0.1);
        assert!(camera.project(camera.pose.to_local(beside)).is_none(), "behind the circle's rim");
    }

    /// Over uniform film points, the square of the angle is uniform if equidistant, the height if equisolid.
    #[test]
    fn has_its_density() {
        const N: u32 = 200_000;
        const BINS: usize = 20;
        const FOV: f32 = 200.0;
        for projection in PROJECTIONS {
            let camera = fisheye(FOV, projection, 100, 100);
            let mut counts = vec![0_u64; BINS * BINS];
            let points = (0..N).map(|i| Independent::new(3, UVec2::ZERO, i).get_2d() * 100.0);
            for d in points.filter_map(|film| camera.ray(film)).map(|ray| ray.d) {
                let theta = d.truncate().length().atan2(-d.z);
                let half = 0.5 * FOV.to_radians();
                let share = match projection {
                    FisheyeProjection::Equidistant => (theta / half).powi(2),
                    FisheyeProjection::Equisolid => (1.0 + d.z) / (1.0 - half.cos()),
                };
                let bin = |c: f32| ((c * BINS as f32) as usize).min(BINS - 1);
                counts[bin(share) * BINS + bin(d.y.atan2(d.x) / (2.0 * PI) + 0.5)] += 1;
            }
            let inside = counts.iter().sum::<u64>() as f64;
            assert!((inside / f64::from(N) - std::f64::consts::FRAC_PI_4).abs() < 0.005);
            chi2_counts(&counts, &vec![inside / (BINS * BINS) as f64; BINS * BINS]).unwrap();
        }
    }
}
