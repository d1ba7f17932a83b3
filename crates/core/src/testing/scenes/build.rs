//! Scenes in few words.

use crate::camera::{CameraDesc, OrthographicDesc};
use crate::color::Rgb;
use crate::desc::SceneDesc;
use crate::light::{Constant, EnvironmentDesc, NoLight};
use crate::material::{Emissive, Lambertian, MaterialDesc, Metal};
use crate::shape::{QuadDesc, SphereDesc};

/// No light from outside.
pub const DARK: EnvironmentDesc = EnvironmentDesc::None(NoLight {});
/// The same light from everywhere.
pub const WHITE: EnvironmentDesc = EnvironmentDesc::Constant(Constant { radiance: Rgb([1.0; 3]) });

/// Share of light that the floor of [`lit_floor`] scatters.
pub(super) const ALBEDO: f32 = 0.8;

/// An eye with a field of view of so many degrees; y is up, or z if it looks along y.
pub fn look(from: [f32; 3], at: [f32; 3], vfov: f32) -> CameraDesc {
    let up = if from[0] == at[0] && from[2] == at[2] { [0.0, 0.0, 1.0] } else { [0.0, 1.0, 0.0] };
    CameraDesc { look_from: from, look_at: at, up, vfov: Some(vfov), ..CameraDesc::default() }
}

/// So narrow that all pixels look at the same point.
pub(super) fn stare(from: [f32; 3], at: [f32; 3]) -> CameraDesc {
    look(from, at, 0.002)
}

/// Parallel rays that show a square of a height, metres, around `at`.
pub(super) fn parallel(from: [f32; 3], at: [f32; 3], height: f32) -> CameraDesc {
    CameraDesc { vfov: None, orthographic: Some(OrthographicDesc { height }), ..look(from, at, 1.0) }
}

/// Nothing but surroundings, and an eye.
pub(super) fn empty(environment: EnvironmentDesc, camera: CameraDesc) -> SceneDesc {
    SceneDesc { environment, camera, ..SceneDesc::default() }
}

/// A matte floor around the origin, which is looked at from the side.
pub(super) fn lit_floor(environment: EnvironmentDesc) -> SceneDesc {
    let mut desc = empty(environment, stare([3.0, 0.4, 0.0], [0.0; 3]));
    add_quad(&mut desc, floor(0.0), "floor", matte(ALBEDO));
    desc
}

/// Luminance of that floor at an irradiance.
pub(super) fn floor_at(irradiance: f64) -> f64 {
    f64::from(ALBEDO) / std::f64::consts::PI * irradiance
}

/// Corner and edges of a large horizontal square at a height, whose normal is up. The origin is not on its diagonals.
pub(super) fn floor(y: f32) -> [[f32; 3]; 3] {
    [[-9.0, y, 10.0], [20.0, 0.0, 0.0], [0.0, 0.0, -20.0]]
}

pub(super) fn add_quad(desc: &mut SceneDesc, [corner, u, v]: [[f32; 3]; 3], name: &str, material: MaterialDesc) {
    desc.material.insert(name.to_owned(), material);
    desc.shape.quad.push(QuadDesc { corner, u, v, material: Some(name.to_owned()), ..QuadDesc::default() });
}

pub(super) fn add_sphere(desc: &mut SceneDesc, center: [f32; 3], radius: f32, name: &str, material: MaterialDesc) {
    desc.material.insert(name.to_owned(), material);
    desc.shape.sphere.push(SphereDesc { center, radius, material: Some(name.to_owned()), ..SphereDesc::default() });
}

/// Matte, of a grey albedo.
pub fn matte(albedo: f32) -> MaterialDesc {
    MaterialDesc::Lambertian(Lambertian { albedo: Rgb::grey(albedo).into() })
}

pub(super) fn metal(albedo: f32, roughness: f32) -> MaterialDesc {
    MaterialDesc::Metal(Metal { albedo: Rgb::grey(albedo).into(), roughness: roughness.into() })
}

/// A lamp that shines on the side of its normal.
pub fn lamp(radiance: f32) -> MaterialDesc {
    MaterialDesc::Emissive(Emissive { radiance: Rgb::grey(radiance).into(), ..Emissive::default() })
}
