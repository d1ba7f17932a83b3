//! What a camera promises.

use std::f64::consts::{PI, TAU};

use eyebeam_bvh::Ray;
use glam::{UVec2, Vec2, Vec3};

use crate::camera::{Camera, CameraDesc};
use crate::sampler::{Independent, Sampler};

/// From points of the film to rays and back: what [`Camera`] does.
pub trait CameraRays {
    /// The ray through a point of the film; none where the film is black.
    fn ray(&self, film: Vec2, sampler: &mut Sampler<'_>) -> Option<Ray>;

    /// The point of the film that shows a point of the world through a pinhole.
    fn project(&self, p: Vec3) -> Option<Vec2>;
}

impl CameraRays for Camera {
    fn ray(&self, film: Vec2, sampler: &mut Sampler<'_>) -> Option<Ray> {
        self.ray(film, sampler)
    }

    fn project(&self, p: Vec3) -> Option<Vec2> {
        self.project(p)
    }
}

/// Directions have length 1; what a ray meets in focus appears where the ray went through the film; right is right and up is
/// up; and the picture shows the solid angle that the description says, an orthographic one the area.
///
/// # Errors
/// The first promise that is broken.
pub fn check_camera(camera: &dyn CameraRays, desc: &CameraDesc, width: u32, height: u32) -> Result<(), String> {
    let size = Vec2::new(width as f32, height as f32);
    let [eye, at, up] = [desc.look_from, desc.look_at, desc.up].map(Vec3::from);
    let forward = (at - eye).normalize();
    let right = forward.cross(up).normalize();
    let focus = desc.focus_distance.unwrap_or(at.distance(eye));
    for i in 0..2000 {
        let mut numbers = Independent::new(60, UVec2::ZERO, i);
        let film = numbers.get_2d() * size;
        let Some(ray) = camera.ray(film, &mut Sampler::Independent(numbers)) else {
            continue;
        };
        if (ray.d.length() - 1.0).abs() > 1e-5 {
            return Err(format!("a direction of length {}", ray.d.length()));
        }
        let cos = if is_perspective(desc) { ray.d.dot(forward) } else { 1.0 };
        let seen = camera.project(ray.o + ray.d * (focus / cos));
        if seen.is_none_or(|seen| seen.distance(film) > 0.05) {
            return Err(format!("a point that is seen at {film} appears at {seen:?}"));
        }
    }
    let numbers = || Sampler::Independent(Independent::new(61, UVec2::ZERO, 0));
    let aside = camera.ray(size * Vec2::new(0.55, 0.46), &mut numbers()).ok_or("the middle of the picture is black")?;
    let p = aside.o + aside.d * focus - eye;
    if p.dot(right) <= 0.0 || p.dot(forward.cross(right)) >= 0.0 || p.dot(forward) <= 0.0 {
        return Err(format!("to the right of the middle and above it there is {p}, from the eye"));
    }
    if desc.aperture.or(desc.defocus_angle).is_none_or(|lens| lens == 0.0) {
        let (expected, shown) = (extent(desc, width, height), extent_shown(camera, desc, size));
        if (shown / expected - 1.0).abs() > 0.01 {
            return Err(format!("the picture shows {shown} (sr, or m² if orthographic), not {expected}"));
        }
    }
    Ok(())
}

fn is_perspective(desc: &CameraDesc) -> bool {
    desc.orthographic.is_none() && desc.panorama.is_none() && desc.fisheye.is_none()
}

/// Solid angle that a picture shows; its area if it is orthographic.
fn extent(desc: &CameraDesc, width: u32, height: u32) -> f64 {
    let aspect = f64::from(width) / f64::from(height);
    match (&desc.orthographic, &desc.panorama, &desc.fisheye) {
        (Some(kind), _, _) => f64::from(kind.height).powi(2) * aspect,
        (_, Some(_), _) => 2.0 * TAU,
        (_, _, Some(kind)) => TAU * (1.0 - (f64::from(kind.fov) * PI / 360.0).cos()),
        (None, None, None) => {
            let y = (0.5 * f64::from(desc.vfov.unwrap_or(CameraDesc::DEFAULT_VFOV)).to_radians()).tan();
            let x = aspect * y;
            4.0 * (x * y / (x.hypot(1.0) * y.hypot(1.0))).asin()
        }
    }
}

/// The same by what the middles of many small squares of the film show.
fn extent_shown(camera: &dyn CameraRays, desc: &CameraDesc, size: Vec2) -> f64 {
    const SIDE: u32 = 200;
    /// Of a square's side.
    const STEP: f32 = 0.1;
    let ray = |film: Vec2| camera.ray(film, &mut Sampler::Independent(Independent::new(62, UVec2::ZERO, 0)));
    let at = |film: Vec2| ray(film).map(|ray| if desc.orthographic.is_some() { ray.o } else { ray.d }.as_dvec3());
    let square = size / SIDE as f32;
    let shown = |x: u32, y: u32| {
        let film = (Vec2::new(x as f32, y as f32) + 0.5) * square;
        let [right, left] = [STEP, -STEP].map(|s| at(film + Vec2::X * square * s));
        let [below, above] = [STEP, -STEP].map(|s| at(film + Vec2::Y * square * s));
        Some((right? - left?).cross(below? - above?).length() / (4.0 * f64::from(STEP * STEP)))
    };
    (0..SIDE * SIDE).filter_map(|i| shown(i % SIDE, i / SIDE)).sum()
}
