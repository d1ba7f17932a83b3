//! The perspective camera with a thin lens.
//!
//! A ray starts at a uniform point of the lens and goes through the point where the pinhole's ray meets the plane of
//! focus: what lies there is sharp, the rest blurs. Cook, Porter & Carpenter 1984, doi:10.1145/800031.808590.
//!
//! ```toml
//! [camera]
//! look_from = [13, 2, 3]
//! look_at = [0, 0, 0]
//! vfov = 20
//! defocus_angle = 0.6
//! focus_distance = 10
//! ```

use eyebeam_bvh::Ray;
use glam::{Vec2, Vec3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::array::array;
use crate::sampler::Sampler;
use crate::sampling::uniform_disk;
use crate::validate::Checker;

/// Where the eye is, where it looks, and its lens.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct CameraDesc {
    /// The eye, metres.
    #[serde(deserialize_with = "array")]
    pub look_from: [f32; 3],
    /// A point in the middle of the picture, metres.
    #[serde(deserialize_with = "array")]
    pub look_at: [f32; 3],
    /// What is upwards in the picture.
    #[serde(deserialize_with = "array")]
    pub up: [f32; 3],
    /// Vertical field of view, degrees, 0..180.
    #[schemars(range(min = 0.001, max = 179.0))]
    pub vfov: f32,
    /// Diameter of the lens, metres; 0 is a pinhole, with which everything is sharp.
    #[schemars(range(min = 0.0))]
    pub aperture: Option<f32>,
    /// The lens as the angle of the cone of rays that meet in a point in focus, degrees; instead of `aperture`.
    #[schemars(range(min = 0.0, max = 179.0))]
    pub defocus_angle: Option<f32>,
    /// Distance from the eye to the plane in focus, metres; that of `look_at` if absent.
    pub focus_distance: Option<f32>,
}

impl Default for CameraDesc {
    fn default() -> Self {
        Self {
            look_from: [0.0, 1.0, 6.0],
            look_at: [0.0, 0.0, 0.0],
            up: [0.0, 1.0, 0.0],
            vfov: 40.0,
            aperture: None,
            defocus_angle: None,
            focus_distance: None,
        }
    }
}

impl CameraDesc {
    pub(crate) fn check(&self, c: &mut Checker) {
        c.finite("look_from", &self.look_from);
        c.finite("look_at", &self.look_at);
        c.nonzero("up", self.up);
        c.in_range("vfov", self.vfov, 0.001, 179.0);
        let (from, at, up) = (Vec3::from(self.look_from), Vec3::from(self.look_at), Vec3::from(self.up));
        if from == at {
            c.problem(
                "look_at",
                "`look_from` and `look_at` are the same point, so the camera looks nowhere",
                Some("move one of them".to_owned()),
            );
        } else if from.is_finite()
            && at.is_finite()
            && up != Vec3::ZERO
            && (at - from).normalize_or_zero().cross(up.normalize_or_zero()).length() < 1e-6
        {
            c.problem("up", "`up` points along the line of sight", Some("try up = [0, 0, 1]".to_owned()));
        }
        if let Some(aperture) = self.aperture.filter(|&a| a != 0.0) {
            c.positive("aperture", aperture);
        }
        if let Some(angle) = self.defocus_angle {
            c.in_range("defocus_angle", angle, 0.0, 179.0);
        }
        if self.aperture.is_some() && self.defocus_angle.is_some() {
            c.problem(
                "defocus_angle",
                "`aperture` and `defocus_angle` both say how wide the lens is",
                Some("keep one of them".to_owned()),
            );
        }
        if let Some(distance) = self.focus_distance {
            c.positive("focus_distance", distance);
        }
    }
}

/// A camera ready to make rays for a picture of a given size.
#[derive(Clone, Debug)]
pub struct ThinLens {
    eye: Vec3,
    /// From the eye to the top left corner of the picture on the plane of focus.
    top_left: Vec3,
    /// From a pixel to its neighbour on the right and below, on the plane of focus.
    pixel_x: Vec3,
    pixel_y: Vec3,
    /// Half axes of the lens; zero for a pinhole.
    lens_x: Vec3,
    lens_y: Vec3,
}

impl ThinLens {
    /// The camera for `width` × `height` pixels; they are square.
    pub fn new(desc: &CameraDesc, width: u32, height: u32) -> Self {
        let (eye, at) = (Vec3::from(desc.look_from), Vec3::from(desc.look_at));
        let forward = (at - eye).normalize();
        let right = forward.cross(Vec3::from(desc.up).normalize()).normalize();
        let down = forward.cross(right);
        let focus = desc.focus_distance.unwrap_or_else(|| at.distance(eye));
        let half_tan = |degrees: f32| libm::tanf(0.5 * degrees.to_radians());
        let pixel = 2.0 * focus * half_tan(desc.vfov) / height as f32;
        let radius = desc.defocus_angle.map_or(0.5 * desc.aperture.unwrap_or(0.0), |angle| focus * half_tan(angle));
        Self {
            eye,
            top_left: focus * forward - 0.5 * pixel * (width as f32 * right + height as f32 * down),
            pixel_x: pixel * right,
            pixel_y: pixel * down,
            lens_x: radius * right,
            lens_y: radius * down,
        }
    }

    /// The ray through a point of the film, in pixels from the top left corner.
    #[inline]
    pub fn ray(&self, film: Vec2, sampler: &mut Sampler) -> Ray {
        let target = self.top_left + film.x * self.pixel_x + film.y * self.pixel_y;
        if self.lens_x == Vec3::ZERO {
            return Ray::new(self.eye, target.normalize());
        }
        let lens = uniform_disk(sampler.get_2d());
        let start = lens.x * self.lens_x + lens.y * self.lens_y;
        Ray::new(self.eye + start, (target - start).normalize())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampler::Independent;

    fn sampler(i: u32) -> Sampler {
        Sampler::Independent(Independent::new(0, glam::UVec2::ZERO, i))
    }

    #[test]
    fn looks_where_it_is_told() {
        let desc = CameraDesc { look_from: [0.0, 0.0, 5.0], look_at: [0.0; 3], vfov: 90.0, ..CameraDesc::default() };
        let camera = ThinLens::new(&desc, 200, 100);
        let ray = |x, y| camera.ray(Vec2::new(x, y), &mut sampler(0)).d;
        assert!((ray(100.0, 50.0) - Vec3::NEG_Z).length() < 1e-6);
        assert!((ray(100.0, 0.0) - Vec3::new(0.0, 1.0, -1.0).normalize()).length() < 1e-6, "45 degrees up");
        assert!((ray(200.0, 50.0) - Vec3::new(2.0, 0.0, -1.0).normalize()).length() < 1e-6, "twice as wide as high");
    }

    /// Whatever the point on the lens, rays of one film point meet on the plane of focus, and starts fill the lens.
    #[test]
    fn rays_meet_in_focus() {
        let desc = CameraDesc {
            look_from: [0.0; 3],
            look_at: [0.0, 0.0, -1.0],
            aperture: Some(0.5),
            focus_distance: Some(4.0),
            ..CameraDesc::default()
        };
        let camera = ThinLens::new(&desc, 100, 100);
        let mut widest = 0.0_f32;
        let meet = |i| {
            let ray = camera.ray(Vec2::new(20.0, 70.0), &mut sampler(i));
            (ray.o, ray.o + ray.d * (-4.0 - ray.o.z) / ray.d.z)
        };
        for i in 0..1000 {
            let (start, p) = meet(i);
            assert!((p - meet(0).1).length() < 1e-5);
            widest = widest.max(start.length());
        }
        assert!(widest > 0.24 && widest <= 0.2501);
    }
}
