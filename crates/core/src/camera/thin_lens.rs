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

use crate::camera::aperture::Aperture;
use crate::camera::{CameraDesc, half_size};
use crate::math::Pose;
use crate::sampler::Sampler;

/// A perspective camera ready to make rays for a picture of a given size.
#[derive(Clone, Copy, Debug)]
pub struct ThinLens {
    pose: Pose,
    /// The middle of the picture, pixels.
    center: Vec2,
    /// A pixel's side on the plane at distance 1.
    pixel: f32,
    /// Distance of the plane of focus, metres.
    focus: f32,
    /// Half axes of the lens in focus distances; zero for a pinhole.
    lens: Vec2,
    aperture: Aperture,
}

impl ThinLens {
    pub(super) fn new(desc: &CameraDesc, width: u32, height: u32) -> Self {
        let focus = desc.focus();
        let half_tan = |degrees: f32| libm::tanf(0.5 * degrees.to_radians());
        let radius = desc.defocus_angle.map_or(0.5 * desc.aperture.unwrap_or(0.0) / focus, half_tan);
        let bokeh = desc.bokeh.clone().unwrap_or_default();
        Self {
            pose: Pose::new(desc.look_from, desc.look_at, desc.up),
            center: half_size(width, height),
            pixel: 2.0 * half_tan(desc.vfov.unwrap_or(CameraDesc::DEFAULT_VFOV)) / height as f32,
            focus,
            lens: radius * Vec2::new(1.0 / bokeh.ratio, 1.0),
            aperture: Aperture::new(&bokeh),
        }
    }

    pub(super) fn pose(&self) -> &Pose {
        &self.pose
    }

    #[inline]
    pub(super) fn ray(&self, film: Vec2, sampler: &mut Sampler) -> Ray {
        if self.lens == Vec2::ZERO {
            return self.central_ray(film);
        }
        let target = self.target(film);
        let start = (self.lens * self.aperture.sample(sampler.get_2d())).extend(0.0);
        let o = self.pose.eye + self.focus * self.pose.to_world(start);
        Ray::new(o, self.pose.to_world(target - start).normalize())
    }

    /// As that of a pinhole.
    #[inline]
    pub(super) fn central_ray(&self, film: Vec2) -> Ray {
        Ray::new(self.pose.eye, self.pose.to_world(self.target(film)).normalize())
    }

    /// The local point on the plane at distance 1 that the pinhole shows there.
    #[inline]
    fn target(&self, film: Vec2) -> Vec3 {
        (self.pixel * (film - self.center)).extend(1.0)
    }

    /// Where the pinhole shows a local point.
    pub(super) fn project(&self, p: Vec3) -> Option<Vec2> {
        (p.z > 0.0).then(|| p.truncate() / p.z / self.pixel + self.center)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::BokehDesc;
    use crate::camera::tests::sampler;

    #[test]
    fn looks_where_it_is_told() {
        let desc =
            CameraDesc { look_from: [0.0, 0.0, 5.0], look_at: [0.0; 3], vfov: Some(90.0), ..CameraDesc::default() };
        let camera = ThinLens::new(&desc, 200, 100);
        let ray = |x, y| camera.ray(Vec2::new(x, y), &mut sampler(0)).d;
        assert!((ray(100.0, 50.0) - Vec3::NEG_Z).length() < 1e-6);
        assert!((ray(100.0, 0.0) - Vec3::new(0.0, 1.0, -1.0).normalize()).length() < 1e-6, "45 degrees up");
        assert!((ray(200.0, 50.0) - Vec3::new(2.0, 0.0, -1.0).normalize()).length() < 1e-6, "twice as wide as high");
    }

    fn lens(blades: u32, ratio: f32) -> ThinLens {
        let desc = CameraDesc {
            look_from: [0.0; 3],
            look_at: [0.0, 0.0, -1.0],
            aperture: Some(0.5),
            focus_distance: Some(4.0),
            bokeh: Some(BokehDesc { blades, ratio, rotation: 10.0 }),
            ..CameraDesc::default()
        };
        ThinLens::new(&desc, 100, 100)
    }

    /// Whatever the point on the lens, rays of one film point meet on the plane of focus, and starts fill the lens.
    #[test]
    fn rays_meet_in_focus() {
        for (blades, ratio, width, height) in [(0, 1.0, 0.25, 0.25), (12, 1.0, 0.25, 0.25), (0, 2.0, 0.125, 0.25)] {
            let camera = lens(blades, ratio);
            let meet = |i| {
                let ray = camera.ray(Vec2::new(20.0, 70.0), &mut sampler(i));
                (ray.o, ray.o + ray.d * (-4.0 - ray.o.z) / ray.d.z)
            };
            let mut widest = Vec3::ZERO;
            for i in 0..2000 {
                let (start, p) = meet(i);
                assert!((p - meet(0).1).length() < 1e-5);
                widest = widest.max(start.abs());
            }
            let share = widest / Vec3::new(width, height, 1.0);
            assert!(share.x > 0.94 && share.x < 1.0001 && share.y > 0.94 && share.y < 1.0001, "{blades}: {widest}");
        }
    }

    /// The triangle's corner points to the left in what lies behind the plane in focus, to the right before it.
    #[test]
    fn bokeh_is_upright_in_the_background() {
        const P: Vec3 = Vec3::new(0.0, 0.0, -4.0);
        // How far to the left and to the right of the middle a ray of the film meets a point at distance 4.
        let extent = |focus: f32| {
            let desc = CameraDesc {
                look_from: [0.0; 3],
                look_at: [0.0, 0.0, -1.0],
                aperture: Some(0.5),
                focus_distance: Some(focus),
                bokeh: Some(BokehDesc { blades: 3, ..BokehDesc::default() }),
                ..CameraDesc::default()
            };
            let camera = ThinLens::new(&desc, 100, 100);
            let sees = |x: f32| {
                let meets = |ray: Ray| (ray.o + ray.d * (P.z / ray.d.z)).distance(P) < 0.01;
                (0..3000).any(|i| meets(camera.ray(Vec2::new(x, 50.0), &mut sampler(i))))
            };
            let farthest = |side: f32| (0..30).rev().find(|&i| sees(50.0 + side * 0.5 * i as f32)).unwrap();
            [farthest(-1.0), farthest(1.0)]
        };
        let [left, right] = extent(2.0);
        assert!(2 * left > 3 * right, "background: {left} {right}");
        let [left, right] = extent(8.0);
        assert!(2 * right > 3 * left, "foreground: {left} {right}");
    }

    /// A pinhole takes no numbers from the sampler, a lens one pair.
    #[test]
    fn takes_the_numbers_of_a_lens() {
        let (mut pinhole, mut wide, mut fresh) = (sampler(3), sampler(3), sampler(3));
        ThinLens::new(&CameraDesc::default(), 8, 8).ray(Vec2::ONE, &mut pinhole);
        lens(5, 1.0).ray(Vec2::ONE, &mut wide);
        assert_eq!(pinhole.get_2d(), fresh.get_2d());
        assert_eq!(wide.get_2d(), fresh.get_2d());
    }
}
