//! Cameras turn points of the film into rays. A camera has no body: rays never hit it.
//!
//! The film has its origin in the picture's top left corner and counts in pixels, x to the right and y down, so the centre
//! of the first pixel is (0.5, 0.5).

mod aperture;
mod desc;
mod fisheye;
mod motion;
mod orthographic;
mod panorama;
mod thin_lens;

use std::sync::Arc;

use eyebeam_bvh::Ray;
use glam::{Vec2, Vec3};

use crate::math::Pose;
use crate::sampler::Sampler;

pub use aperture::BokehDesc;
pub use desc::CameraDesc;
pub use fisheye::{Fisheye, FisheyeDesc, FisheyeProjection};
pub use motion::CameraKey;
use motion::Exposure;
pub use orthographic::{Orthographic, OrthographicDesc};
pub use panorama::{Panorama, PanoramaDesc};
pub use thin_lens::ThinLens;

/// A camera ready to make rays for a picture of a given size.
#[derive(Clone, Debug)]
pub struct Camera {
    /// If it moves, in the middle of the time while the shutter is open.
    kind: Kind,
    /// If anything moves.
    exposure: Option<Arc<Exposure>>,
}

/// A camera at rest.
#[derive(Clone, Copy, Debug)]
enum Kind {
    /// Perspective, with a pinhole or a lens.
    ThinLens(ThinLens),
    /// Parallel rays.
    Orthographic(Orthographic),
    /// All directions, equirectangular.
    Panorama(Panorama),
    /// A circle of directions.
    Fisheye(Fisheye),
}

impl Camera {
    /// The camera for `width` × `height` pixels, which are square but in a panorama, at rest, whatever its keys say. The description
    /// must have passed [`SceneDesc::check`](crate::desc::SceneDesc::check).
    pub fn new(desc: &CameraDesc, width: u32, height: u32) -> Self {
        Self { kind: Kind::new(desc, width, height), exposure: None }
    }

    /// As [`new`](Self::new), in motion; its rays have times while the shutter is open, if it moves or shapes do.
    pub(crate) fn exposed(desc: &CameraDesc, width: u32, height: u32, shutter: [f32; 2], shapes_move: bool) -> Self {
        let exposure = Exposure::new(desc, [width, height], shutter, shapes_move).map(Arc::new);
        Self { kind: Kind::new(&desc.halfway(shutter), width, height), exposure }
    }

    /// The ray through a point of the film, its direction of length 1; none where the film is black, beside the circle of
    /// a fisheye. Where something moves, its time takes a dimension of the sampler; a lens takes two, a camera without one
    /// takes none.
    #[inline]
    pub fn ray(&self, film: Vec2, sampler: &mut Sampler) -> Option<Ray> {
        match &self.exposure {
            None => self.kind.ray(film, sampler),
            Some(exposure) => self.exposed_ray(exposure, film, sampler),
        }
    }

    #[inline(never)]
    fn exposed_ray(&self, exposure: &Exposure, film: Vec2, sampler: &mut Sampler) -> Option<Ray> {
        let time = exposure.time(sampler.get_1d());
        let ray = exposure.kind(time).unwrap_or(self.kind).ray(film, sampler)?;
        Some(Ray { time, ..ray })
    }

    /// As [`ray`](Self::ray), through the middle of the lens, in the middle of the time while the shutter is open.
    pub fn central_ray(&self, film: Vec2) -> Option<Ray> {
        let ray = match &self.kind {
            Kind::ThinLens(camera) => camera.central_ray(film),
            Kind::Orthographic(camera) => camera.ray(film),
            Kind::Panorama(camera) => camera.ray(film),
            Kind::Fisheye(camera) => camera.ray(film)?,
        };
        Some(Ray { time: self.exposure.as_ref().map_or(ray.time, |exposure| exposure.time(0.5)), ..ray })
    }

    /// The point of the film, perhaps outside of the picture, that shows a point of the world if the lens is a pinhole;
    /// none if the camera does not look there: behind the eye, or outside of the circle of a fisheye. If the camera moves, in
    /// the middle of the time while the shutter is open.
    pub fn project(&self, p: Vec3) -> Option<Vec2> {
        let p = self.kind.pose().to_local(p);
        let film = match &self.kind {
            Kind::ThinLens(camera) => camera.project(p),
            Kind::Orthographic(camera) => camera.project(p),
            Kind::Panorama(camera) => camera.project(p),
            Kind::Fisheye(camera) => camera.project(p),
        };
        film.filter(|film| film.is_finite())
    }

    /// Where it is, metres. If it moves, in the middle of the time while the shutter is open.
    pub fn eye(&self) -> Vec3 {
        self.kind.pose().eye
    }

    /// The unit direction in the middle of the picture, at that time.
    pub fn forward(&self) -> Vec3 {
        self.kind.pose().forward
    }

    /// Its eye and direction when it makes rays of this time.
    pub(crate) fn axis(&self, time: f32) -> (Vec3, Vec3) {
        let moved = self.exposure.as_ref().and_then(|exposure| exposure.kind(time));
        let kind = moved.unwrap_or(self.kind);
        (kind.pose().eye, kind.pose().forward)
    }
}

impl Kind {
    fn new(desc: &CameraDesc, width: u32, height: u32) -> Self {
        match (&desc.orthographic, &desc.panorama, &desc.fisheye) {
            (Some(kind), _, _) => Self::Orthographic(Orthographic::new(desc, kind, width, height)),
            (_, Some(PanoramaDesc {}), _) => Self::Panorama(Panorama::new(desc, width, height)),
            (_, _, Some(kind)) => Self::Fisheye(Fisheye::new(desc, kind, width, height)),
            (None, None, None) => Self::ThinLens(ThinLens::new(desc, width, height)),
        }
    }

    #[inline]
    fn ray(&self, film: Vec2, sampler: &mut Sampler) -> Option<Ray> {
        match self {
            Self::ThinLens(camera) => Some(camera.ray(film, sampler)),
            Self::Orthographic(camera) => Some(camera.ray(film)),
            Self::Panorama(camera) => Some(camera.ray(film)),
            Self::Fisheye(camera) => camera.ray(film),
        }
    }

    fn pose(&self) -> &Pose {
        match self {
            Self::ThinLens(camera) => camera.pose(),
            Self::Orthographic(camera) => camera.pose(),
            Self::Panorama(camera) => camera.pose(),
            Self::Fisheye(camera) => camera.pose(),
        }
    }
}

/// The middle of a picture, in pixels from its top left corner.
fn half_size(width: u32, height: u32) -> Vec2 {
    0.5 * Vec2::new(width as f32, height as f32)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampler::Independent;
    use proptest::prelude::*;
    use proptest::test_runner::RngSeed;

    pub(super) fn sampler(i: u32) -> Sampler<'static> {
        Sampler::Independent(Independent::new(0, glam::UVec2::ZERO, i))
    }

    /// Cameras of each kind at the same place, from narrow to wide.
    fn kinds(pose: &CameraDesc, vfov: &[f32], height: &[f32], fov: &[f32]) -> Vec<CameraDesc> {
        let vfov = vfov.iter().map(|&vfov| CameraDesc { vfov: Some(vfov), ..pose.clone() });
        let height = height.iter().map(|&height| {
            let orthographic = Some(OrthographicDesc { height });
            CameraDesc { orthographic, ..pose.clone() }
        });
        let projections = [FisheyeProjection::Equidistant, FisheyeProjection::Equisolid];
        let fisheye = fov.iter().flat_map(|&fov| projections.map(|projection| FisheyeDesc { fov, projection }));
        let fisheye = fisheye.map(|fisheye| CameraDesc { fisheye: Some(fisheye), ..pose.clone() });
        let panorama = CameraDesc { panorama: Some(PanoramaDesc {}), ..pose.clone() };
        vfov.chain(height).chain(fisheye).chain([panorama]).collect()
    }

    fn usual(pose: &CameraDesc) -> Vec<CameraDesc> {
        kinds(pose, &[10.0, 40.0, 179.0], &[3.0], &[90.0, 180.0, 360.0])
    }

    /// Also those through which single precision sees no pixels.
    fn extremes(pose: &CameraDesc) -> Vec<CameraDesc> {
        kinds(pose, &[0.001, 179.0], &[1e-6, 1e6], &[0.001, 180.0, 360.0])
    }

    proptest! {
        #![proptest_config(ProptestConfig { rng_seed: RngSeed::Fixed(1), failure_persistence: None, ..Default::default() })]

        /// What a ray meets appears where the ray went through the film.
        #[test]
        fn rays_and_projections_agree(
            look_from in prop::array::uniform3(-2.0f32..2.0),
            look_at in prop::array::uniform3(3.0f32..9.0),
            up in prop::array::uniform3(-1.0f32..1.0),
            x in 0.02f32..0.98,
            y in 0.02f32..0.98,
            t in 2.0f32..200.0,
        ) {
            let [from, at, upwards] = [look_from, look_at, up].map(Vec3::from);
            prop_assume!((at - from).normalize().cross(upwards).length() > 0.1);
            let pose = CameraDesc { look_from, look_at, up, ..CameraDesc::default() };
            for desc in usual(&pose) {
                let camera = Camera::new(&desc, 300, 200);
                let film = Vec2::new(300.0 * x, 200.0 * y);
                let Some(ray) = camera.ray(film, &mut sampler(0)) else {
                    prop_assert!(matches!(camera.kind, Kind::Fisheye(_)));
                    continue;
                };
                prop_assert!((ray.d.length() - 1.0).abs() < 1e-6);
                let seen = camera.project(ray.o + t * ray.d);
                prop_assert!(seen.is_some_and(|seen| seen.distance(film) < 0.05), "{desc:?}: {film} is seen at {seen:?}");
            }
        }
    }

    /// Whatever the picture's size, also beyond its edges.
    #[test]
    fn every_ray_is_finite() {
        const LONG: u32 = 1 << 24;
        let far = CameraDesc { look_from: [1e15; 3], look_at: [-1e15; 3], ..CameraDesc::default() };
        let near = CameraDesc { look_from: [0.0; 3], look_at: [1e-30, 0.0, -1e-30], ..CameraDesc::default() };
        let mut all: Vec<_> = [CameraDesc::default(), far.clone(), near.clone()].iter().flat_map(extremes).collect();
        all.extend([CameraDesc::default(), far, near].map(|pose| CameraDesc {
            vfov: Some(179.0),
            defocus_angle: Some(179.0),
            bokeh: Some(BokehDesc { blades: 5, rotation: 1e15, ratio: 0.01 }),
            ..pose
        }));
        for desc in all {
            for (width, height) in [(1, 1), (2, 1), (LONG, 1), (1, LONG), (LONG, LONG)] {
                let camera = Camera::new(&desc, width, height);
                let size = 2.0 * half_size(width, height);
                for at in [Vec2::ZERO, Vec2::splat(0.5), Vec2::splat(0.51), Vec2::new(0.0, 1.0), Vec2::ONE] {
                    let ray = camera.ray(at * size, &mut sampler(1));
                    let fine = |ray: Ray| ray.o.is_finite() && (ray.d.length() - 1.0).abs() < 1e-6;
                    assert!(ray.is_none_or(fine), "{width} x {height} at {at}: {desc:?} {ray:?}");
                    assert!(ray.is_some() || matches!(camera.kind, Kind::Fisheye(_)));
                }
            }
        }
    }

    #[test]
    fn projections_end() {
        for desc in usual(&CameraDesc::default()) {
            let camera = Camera::new(&desc, 300, 200);
            let [ahead, behind] = [1.0, -1.0].map(|side| camera.project(camera.eye() + side * camera.forward()));
            assert!(ahead.is_some_and(|film| film.distance(Vec2::new(150.0, 100.0)) < 1e-2), "{desc:?}: {ahead:?}");
            let all_around = desc.panorama.is_some() || desc.fisheye.as_ref().is_some_and(|f| f.fov == 360.0);
            assert!(behind.is_none() || all_around, "{desc:?}: {behind:?}");
            assert_eq!(camera.project(camera.eye()), None, "{desc:?}: the eye itself");
            assert_eq!(camera.project(Vec3::NAN), None, "{desc:?}");
        }
    }

    /// The picture is not mirrored, and not upside down.
    #[test]
    fn up_is_up_and_right_is_right() {
        let pose = CameraDesc { look_from: [0.0, 0.0, 5.0], look_at: [0.0; 3], ..CameraDesc::default() };
        for desc in extremes(&pose) {
            let ray = Camera::new(&desc, 300, 200).ray(Vec2::new(160.0, 90.0), &mut sampler(0)).unwrap();
            let p = ray.o + 5.0 * ray.d;
            assert!(p.x > 0.0 && p.y > 0.0, "{desc:?}: {p}");
        }
    }
}
