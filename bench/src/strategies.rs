//! What each way of sampling is worth: seconds times relative squared error, each beside the plainest.
//!
//! The error is that between two pictures of different seeds, so no reference is needed, and no bias is seen: that ways agree
//! is what the tests are for.

use std::error::Error;
use std::num::NonZeroUsize;
use std::sync::Arc;

use eyebeam_core::camera::CameraDesc;
use eyebeam_core::color::Rgb;
use eyebeam_core::desc::SceneDesc;
use eyebeam_core::film::Image;
use eyebeam_core::integrator::IntegratorKind;
use eyebeam_core::light::select::LightSelection;
use eyebeam_core::light::{EnvironmentDesc, EnvironmentSampling, ImageEnvironment, NoLight};
use eyebeam_core::material::{Emissive, Lambertian, MaterialDesc, Metal};
use eyebeam_core::sampler::{Independent, SamplerKind};
use eyebeam_core::scene::{BuildOptions, Scene};
use eyebeam_core::shape::{MeshDesc, QuadDesc, SphereDesc};
use eyebeam_io::image::read_image;
use glam::UVec2;

use crate::measure::{corpus, median, read_scene, render, thread_time};

const SPP: u32 = 64;

/// One way to render a scene.
struct Way {
    name: &'static str,
    desc: SceneDesc,
    options: BuildOptions,
}

impl Way {
    fn new(name: &'static str, desc: &SceneDesc, change: impl FnOnce(&mut SceneDesc)) -> Self {
        let mut desc = desc.clone();
        desc.render.spp = SPP;
        change(&mut desc);
        Self { name, desc, options: BuildOptions::default() }
    }
}

/// Prints all tables.
///
/// # Errors
/// If a scene cannot be read.
pub fn run(rounds: usize) -> Result<(), Box<dyn Error>> {
    println!("| scene | way | seconds | error | seconds · error | ratio |");
    println!("|---|---|---|---|---|---|");
    let mut cornell = read_scene("cornell")?;
    (cornell.render.width, cornell.render.height) = (128, 128);
    let mut spheres = read_scene("spheres")?;
    (spheres.render.width, spheres.render.height) = (192, 108);
    for (name, desc) in [("cornell", &cornell), ("spheres", &spheres)] {
        table(name, integrators(desc), rounds)?;
        table(name, samplers(desc), rounds)?;
    }
    for count in [1, 10, 100, 1000, 10_000, 100_000] {
        table(&format!("{count} lamps"), selections(&hall(count)), rounds)?;
    }
    for (name, image) in [("even sky", even_sky()), ("cloudy sky", cloudy_sky()), ("sky with a sun", sunny_sky())] {
        table(name, environments(&garden(image)), rounds)?;
    }
    let photographs = corpus("hdri");
    if photographs.is_empty() {
        println!("No photographs of skies: set EYEBEAM_CORPUS to the folder that holds `hdri/*.hdr`.");
    }
    for path in photographs {
        let name = path.file_stem().unwrap_or_default().to_string_lossy();
        table(&name, environments(&garden(read_image(&path)?.0)), rounds)?;
    }
    Ok(())
}

fn integrators(desc: &SceneDesc) -> Vec<Way> {
    let independent = |desc: &mut SceneDesc| desc.render.sampler = SamplerKind::Independent;
    let weekend = Way::new("weekend", desc, |desc| {
        independent(desc);
        desc.render.integrator = IntegratorKind::Weekend;
    });
    vec![weekend, Way::new("path", desc, independent)]
}

fn samplers(desc: &SceneDesc) -> Vec<Way> {
    let kinds = [("independent", SamplerKind::Independent), ("sobol", SamplerKind::Sobol)];
    kinds.map(|(name, kind)| Way::new(name, desc, |desc| desc.render.sampler = kind)).into()
}

fn selections(desc: &SceneDesc) -> Vec<Way> {
    let kinds =
        [("uniform", LightSelection::Uniform), ("power", LightSelection::Power), ("tree", LightSelection::Tree)];
    kinds.map(|(name, kind)| Way::new(name, desc, |desc| desc.render.light_selection = kind)).into()
}

fn environments(desc: &SceneDesc) -> Vec<Way> {
    let kinds = [
        ("surfaces alone", EnvironmentSampling::Never),
        ("sky in proportion", EnvironmentSampling::Proportional),
        ("compensated", EnvironmentSampling::Compensated),
        ("as chosen", EnvironmentSampling::Auto),
    ];
    kinds
        .map(|(name, environment)| {
            let options = BuildOptions { environment, ..BuildOptions::default() };
            Way { options, ..Way::new(name, desc, |_| ()) }
        })
        .into()
}

/// All ways in turn, round by round; the ratio is to the first.
fn table(scene: &str, ways: Vec<Way>, rounds: usize) -> Result<(), Box<dyn Error>> {
    let mut built = Vec::new();
    for way in &ways {
        built.push(Scene::build_with(&way.desc, way.options).map_err(|problems| format!("{problems:?}"))?);
    }
    let mut runs = vec![(Vec::new(), Vec::new()); ways.len()];
    for round in 0..rounds as u64 {
        for ((way, scene), (seconds, errors)) in ways.iter().zip(&built).zip(&mut runs) {
            let mut pictures = Vec::new();
            for seed in [2 * round, 2 * round + 1] {
                let mut desc = way.desc.clone();
                desc.render.seed = seed;
                let time = thread_time(|| pictures.push(render(scene, &desc, NonZeroUsize::MIN).0.develop()));
                seconds.push(time.as_secs_f64());
            }
            errors.push(error(&pictures[0], &pictures[1]));
        }
    }
    let mut first = None;
    for (way, (seconds, errors)) in ways.iter().zip(runs) {
        let (seconds, error) = (median(seconds), median(errors));
        let cost = seconds * error;
        let ratio = cost / *first.get_or_insert(cost);
        println!("| {scene} | {} | {seconds:.2} | {error:.2e} | {cost:.2e} | {ratio:.3} |", way.name);
    }
    Ok(())
}

/// Relative squared error of one of two pictures, from their difference.
fn error(a: &Image, b: &Image) -> f64 {
    let channels = |image: &Image| image.pixels().as_flattened().iter().map(|&c| f64::from(c)).collect::<Vec<_>>();
    let (a, b) = (channels(a), channels(b));
    let relative = |(a, b): (&f64, &f64)| (a - b).powi(2) / 2.0 / ((a + b).powi(2) / 4.0 + 0.01);
    a.iter().zip(&b).map(relative).sum::<f64>() / a.len() as f64
}

fn matte(albedo: f32) -> MaterialDesc {
    MaterialDesc::Lambertian(Lambertian { albedo: Rgb::grey(albedo).into() })
}

/// A floor with balls below many small lamps, all together as bright, of which some are much brighter than others.
fn hall(count: u32) -> SceneDesc {
    let mut desc = SceneDesc {
        // The lamps are above of what is seen.
        camera: CameraDesc {
            look_from: [0.0, 3.0, 14.0],
            look_at: [0.0, 0.5, 0.0],
            vfov: Some(20.0),
            ..CameraDesc::default()
        },
        environment: EnvironmentDesc::None(NoLight {}),
        ..SceneDesc::default()
    };
    (desc.render.width, desc.render.height, desc.render.max_depth) = (160, 90, 3);
    desc.material.insert("floor".to_owned(), matte(0.6));
    desc.shape.quad.push(QuadDesc {
        corner: [-20.0, 0.0, 20.0],
        u: [40.0, 0.0, 0.0],
        v: [0.0, 0.0, -40.0],
        material: Some("floor".to_owned()),
        ..QuadDesc::default()
    });
    for x in -2..=2 {
        let center = [3.0 * x as f32, 1.0, 0.0];
        desc.shape.sphere.push(SphereDesc {
            center,
            radius: 1.0,
            material: Some("floor".to_owned()),
            ..SphereDesc::default()
        });
    }
    // Three classes of lamps, each a mesh of one radiance.
    for class in 0..3 {
        let mut mesh = MeshDesc { material: Some(format!("lamp {class}")), ..MeshDesc::default() };
        for i in (class..count).step_by(3) {
            let mut numbers = Independent::new(1, UVec2::ZERO, i);
            let (place, height) = (numbers.get_2d(), numbers.get_1d());
            let center = [20.0 * place.x - 10.0, 3.5 + 2.0 * height, 20.0 * place.y - 10.0];
            let size = 2.0 / (f64::from(count) as f32).sqrt();
            let corner = |dx: f32, dz: f32| [center[0] + size * dx, center[1], center[2] + size * dz];
            let first = mesh.vertices.len() as u32;
            mesh.vertices.extend([corner(0.0, 0.0), corner(1.0, 0.0), corner(0.0, 1.0)]);
            mesh.triangles.push([first, first + 1, first + 2]);
        }
        let radiance = Rgb::grey(2.0 * 8.0_f32.powi(class as i32));
        desc.material.insert(
            format!("lamp {class}"),
            MaterialDesc::Emissive(Emissive { radiance: radiance.into(), ..Emissive::default() }),
        );
        if !mesh.triangles.is_empty() {
            desc.shape.mesh.push(mesh);
        }
    }
    desc
}

/// Matte and metal balls on a floor under a picture of the sky.
fn garden(image: Image) -> SceneDesc {
    let image = ImageEnvironment { file: String::new(), rotation: 0.0, scale: 1.0, image: Some(Arc::new(image)) };
    let mut desc = hall(0);
    desc.environment = EnvironmentDesc::Image(image);
    desc.material.insert(
        "metal".to_owned(),
        MaterialDesc::Metal(Metal { albedo: Rgb::grey(0.8).into(), roughness: 0.3.into() }),
    );
    desc.shape.sphere.iter_mut().step_by(2).for_each(|ball| ball.material = Some("metal".to_owned()));
    desc
}

/// A sky of radiance `f(u, v)`.
fn sky(f: impl Fn(f32, f32) -> f32) -> Image {
    let (width, height) = (512, 256);
    let mut image = Image::new(width, height);
    for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
        let (u, v) = ((x as f32 + 0.5) / width as f32, (y as f32 + 0.5) / height as f32);
        image.set_pixel(x, y, [f(u, v); 3]);
    }
    image
}

fn even_sky() -> Image {
    sky(|_, v| 1.0 - 0.5 * v)
}

fn cloudy_sky() -> Image {
    sky(|u, v| 0.3 + 3.0 * (-20.0 * ((u - 0.3).powi(2) + (v - 0.3).powi(2))).exp())
}

fn sunny_sky() -> Image {
    sky(|u, v| 0.5 + 5000.0 * f32::from(u8::from((2.0 * u - 0.6).hypot(v - 0.3) < 0.008)))
}
