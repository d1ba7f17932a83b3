//! Scenes that are made of numbers alone.

use eyebeam_core::camera::CameraDesc;
use eyebeam_core::color::Rgb;
use eyebeam_core::desc::{RenderDesc, SceneDesc};
use eyebeam_core::light::{EnvironmentDesc, NoLight};
use eyebeam_core::material::{Emissive, MaterialDesc};
use eyebeam_core::render::Settings;
use eyebeam_core::sampler::Independent;
use eyebeam_core::shape::SphereDesc;
use glam::{UVec2, Vec3};

/// How everything is rendered but for what is varied.
pub(super) fn settings() -> Settings {
    Settings::from(&RenderDesc::default().plain())
}

/// The inside of a ball that shines and reflects: no path ends before the maximum depth.
pub(super) fn closed_room() -> SceneDesc {
    const WALL: &str = "wall";
    let mut desc = SceneDesc {
        camera: CameraDesc { look_from: [0.0; 3], look_at: [0.0, 0.0, -1.0], ..CameraDesc::default() },
        environment: EnvironmentDesc::None(NoLight {}),
        ..SceneDesc::default()
    };
    let wall = Emissive { radiance: Rgb::grey(0.2).into(), albedo: Rgb::grey(0.8).into(), two_sided: true };
    desc.material.insert(WALL.to_owned(), MaterialDesc::Emissive(wall));
    desc.shape.sphere.push(SphereDesc {
        center: [0.0; 3],
        radius: 1.0,
        material: Some(WALL.to_owned()),
        ..SphereDesc::default()
    });
    desc
}

/// Grey spheres in random places of a cube that fills the view. They take up the same share of it whatever `n` is, so
/// that a ray ends after as many distances from sphere to sphere.
pub(super) fn crowd(n: u32) -> SceneDesc {
    /// Of the cube, metres.
    const HALF_SIDE: f32 = 2.0;
    let radius = 0.4 * 2.0 * HALF_SIDE / (n as f32).cbrt();
    let mut desc = SceneDesc::default();
    desc.camera = CameraDesc { look_from: [0.0, 0.0, 6.0], look_at: [0.0; 3], ..desc.camera };
    desc.shape.sphere = (0..n)
        .map(|i| {
            let mut numbers = Independent::new(0, UVec2::ZERO, i);
            let u: Vec3 = numbers.get_2d().extend(numbers.get_1d());
            SphereDesc { center: (HALF_SIDE * (2.0 * u - 1.0)).to_array(), radius, ..SphereDesc::default() }
        })
        .collect();
    desc
}
