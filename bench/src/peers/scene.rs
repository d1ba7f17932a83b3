//! Scenes in the plain format that several renderers are compared on: a JSON file with spheres, quads and PLY meshes.
//!
//! As in the other renderers' drivers: a pixel is a box, nothing is clamped or adaptive, `max_depth` counts the edges of a
//! path, a metal is a GGX conductor of constant Fresnel, the width `alpha` as given, and single scattering.

use std::collections::BTreeMap;
use std::error::Error;
use std::f32::consts::PI;
use std::fs;
use std::path::{Path, PathBuf};

use eyebeam_core::camera::CameraDesc;
use eyebeam_core::color::Rgb;
use eyebeam_core::desc::{RenderDesc, SceneDesc};
use eyebeam_core::film::{BoxFilter, FilterDesc};
use eyebeam_core::light::{DirectionalLight, EnvironmentDesc, Gradient, NoLight};
use eyebeam_core::material::{Conductor, Dielectric, Emissive, Lambertian, MaterialDesc};
use eyebeam_core::shape::{MeshDesc, QuadDesc, SphereDesc};
use serde::Deserialize;

#[derive(Deserialize)]
struct Scene {
    width: u32,
    height: u32,
    max_depth: u32,
    camera: Camera,
    environment: Option<Environment>,
    materials: BTreeMap<String, Material>,
    shapes: Vec<Shape>,
}

#[derive(Deserialize)]
struct Camera {
    from: [f32; 3],
    at: [f32; 3],
    up: [f32; 3],
    vfov: f32,
    defocus_angle: f32,
    focus_dist: f32,
}

#[derive(Deserialize)]
struct Environment {
    bottom: [f32; 3],
    top: [f32; 3],
    #[serde(flatten)]
    sun: Option<Sun>,
}

#[derive(Deserialize)]
struct Sun {
    sun_dir: [f32; 3],
    sun_radius_deg: f32,
    sun_radiance: f32,
}

#[derive(Deserialize)]
#[serde(tag = "type", rename_all = "kebab-case")]
enum Material {
    Lambertian { albedo: [f32; 3] },
    Metal { albedo: [f32; 3], alpha: f32 },
    Dielectric { ior: f32, alpha: f32 },
}

#[derive(Deserialize)]
#[serde(tag = "type", rename_all = "kebab-case")]
enum Shape {
    Sphere { center: [f32; 3], radius: f32, material: String },
    Quad { corner: [f32; 3], u: [f32; 3], v: [f32; 3], material: String, emission: Option<[f32; 3]> },
    Ply { file: PathBuf, material: String },
}

/// The sun's colour in these scenes.
const SUNLIGHT: [f32; 3] = [1.0, 0.95, 0.85];

/// The scene in a JSON file.
///
/// # Errors
/// If it, or a mesh that it names, cannot be read.
pub fn read_scene(path: &Path) -> Result<SceneDesc, Box<dyn Error>> {
    let scene: Scene = serde_json::from_slice(&fs::read(path)?)?;
    let mut desc = SceneDesc {
        render: RenderDesc {
            width: scene.width,
            height: scene.height,
            max_depth: scene.max_depth,
            filter: FilterDesc::Box(BoxFilter::default()),
            ..RenderDesc::default()
        },
        camera: scene.camera.into(),
        environment: EnvironmentDesc::None(NoLight {}),
        material: scene.materials.into_iter().map(|(name, m)| (name, m.into())).collect(),
        ..SceneDesc::default()
    };
    if let Some(Environment { bottom, top, sun }) = scene.environment {
        desc.environment = EnvironmentDesc::Gradient(Gradient { bottom: Rgb(bottom), top: Rgb(top) });
        desc.light.directional.extend(sun.map(DirectionalLight::from));
    }
    for shape in scene.shapes {
        add(&mut desc, shape, path.parent().unwrap_or(Path::new(".")))?;
    }
    Ok(desc)
}

fn add(desc: &mut SceneDesc, shape: Shape, folder: &Path) -> Result<(), Box<dyn Error>> {
    match shape {
        Shape::Sphere { center, radius, material } => {
            desc.shape.sphere.push(SphereDesc { center, radius, material: Some(material), ..SphereDesc::default() });
        }
        Shape::Quad { corner, u, v, material, emission } => {
            let material = match emission {
                Some(radiance) => {
                    let name = format!("lamp {}", desc.shape.quad.len());
                    let lamp = Emissive { radiance: Rgb(radiance).into(), ..Emissive::default() };
                    desc.material.insert(name.clone(), MaterialDesc::Emissive(lamp));
                    name
                }
                None => material,
            };
            desc.shape.quad.push(QuadDesc { corner, u, v, material: Some(material), ..QuadDesc::default() });
        }
        Shape::Ply { file, material } => {
            let (mesh, _) = eyebeam_io::scene::ply::read_ply(&folder.join(file))?;
            let (vertices, triangles, normals) = (mesh.vertices, mesh.triangles, mesh.normals);
            let material = Some(material);
            desc.shape.mesh.push(MeshDesc { vertices, triangles, normals, material, ..MeshDesc::default() });
        }
    }
    Ok(())
}

impl From<Camera> for CameraDesc {
    fn from(camera: Camera) -> Self {
        Self {
            look_from: camera.from,
            look_at: camera.at,
            up: camera.up,
            vfov: Some(camera.vfov),
            defocus_angle: (camera.defocus_angle > 0.0).then_some(camera.defocus_angle),
            focus_distance: Some(camera.focus_dist),
            ..Self::default()
        }
    }
}

impl From<Sun> for DirectionalLight {
    fn from(sun: Sun) -> Self {
        let sin = sun.sun_radius_deg.to_radians().sin();
        let irradiance = SUNLIGHT.map(|c| c * sun.sun_radiance * PI * sin * sin);
        Self { direction: sun.sun_dir, irradiance: Rgb(irradiance), angle: 2.0 * sun.sun_radius_deg }
    }
}

impl From<Material> for MaterialDesc {
    fn from(material: Material) -> Self {
        match material {
            Material::Lambertian { albedo } => Self::Lambertian(Lambertian { albedo: Rgb(albedo).into() }),
            Material::Metal { albedo, alpha } => Self::Conductor(Conductor {
                reflectance: Some(Rgb(albedo).into()),
                roughness: alpha.sqrt().into(),
                compensation: false,
                ..Conductor::default()
            }),
            Material::Dielectric { ior, alpha } => {
                Self::Dielectric(Dielectric { eta: ior, roughness: alpha.sqrt().into(), ..Dielectric::default() })
            }
        }
    }
}
