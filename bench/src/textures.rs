//! What textures cost: a lookup of each kind beside a plain colour, and pictures of a plane that goes to the horizon by what
//! their filters leave of aliasing.

use std::error::Error;
use std::num::NonZeroUsize;
use std::sync::Arc;

use eyebeam_core::camera::CameraDesc;
use eyebeam_core::color::Rgb;
use eyebeam_core::desc::SceneDesc;
use eyebeam_core::film::Image;
use eyebeam_core::light::sky::SkyDesc;
use eyebeam_core::light::{Constant, EnvironmentDesc};
use eyebeam_core::material::{Lambertian, MaterialDesc};
use eyebeam_core::names::Name;
use eyebeam_core::sampler::Independent;
use eyebeam_core::scene::Scene;
use eyebeam_core::shape::MeshDesc;
use eyebeam_core::texture::{
    Channel, ChannelOf, Checker, Color, Filter, Gradient, ImageTexture, Invert, Mapping, Marble, Mix, Multiply, Noise,
    Pixels, Ramp, Samples, TextureDesc, VertexColor, Wood,
};
use glam::UVec2;

use crate::measure::{median, nanoseconds_a_sample, render, thread_time};

/// Prints all tables.
///
/// # Errors
/// If a scene cannot be built.
pub fn run(rounds: usize) -> Result<(), Box<dyn Error>> {
    costs(rounds)?;
    println!();
    filters(rounds)
}

/// Samples of a floor that fills the picture under an even sky, with each texture in turn.
fn costs(rounds: usize) -> Result<(), Box<dyn Error>> {
    println!("| texture | ns a sample | over a plain colour, ns |");
    println!("|---|---|---|");
    let kinds = kinds()?;
    let mut scenes = Vec::new();
    for (_, texture) in &kinds {
        let mut desc = floor(texture.clone());
        (desc.camera.look_from, desc.camera.look_at) = ([0.1, 5.0, 0.1], [0.0, 0.0, 0.0]);
        (desc.render.width, desc.render.height, desc.render.spp, desc.render.max_depth) = (128, 128, 16, 2);
        scenes.push((build(&desc)?, desc));
    }
    let times = nanoseconds_a_sample(&scenes, rounds);
    for ((name, _), time) in kinds.iter().zip(&times) {
        println!("| {name} | {time:.0} | {:.0} |", time - times[0]);
    }
    Ok(())
}

/// A texture, or a plain colour, by its name.
type Kind = (&'static str, Option<TextureDesc>);

/// A texture of each kind; the first one is a plain colour.
fn kinds() -> Result<Vec<Kind>, Box<dyn Error>> {
    let noise = |octaves| TextureDesc::Noise(Noise { octaves, ..Noise::default() });
    let grey = |value| Color::Rgb(Rgb::grey(value));
    let image = |samples: Samples, channels| image(samples, channels).map(|t| Some(TextureDesc::Image(t)));
    let byte = image(photograph(3), 3)?;
    let triplanar = byte.clone().map(|texture| match texture {
        TextureDesc::Image(t) => TextureDesc::Image(ImageTexture { triplanar: true, ..t }),
        other => other,
    });
    let nearest = byte.clone().map(|texture| match texture {
        TextureDesc::Image(t) => TextureDesc::Image(ImageTexture { filter: Filter::Nearest, ..t }),
        other => other,
    });
    Ok(vec![
        ("none: a plain colour", None),
        ("image, 8 bit colour", byte),
        ("image, 8 bit colour, nearest", nearest),
        ("image, 8 bit colour, triplanar", triplanar),
        ("image, 8 bit grey", image(photograph(1), 1)?),
        ("image, 16 bit colour", image(widened(|byte| u16::from(byte) * 257), 3)?),
        ("image, half colour", image(halves(), 3)?),
        ("image, float colour", image(floats(), 3)?),
        ("checker", Some(TextureDesc::Checker(Checker::default()))),
        ("gradient", Some(TextureDesc::Gradient(Gradient { from: grey(0.2), to: grey(0.8), ..Gradient::default() }))),
        ("noise, 1 octave", Some(noise(1))),
        ("noise, 4 octaves", Some(noise(4))),
        ("marble", Some(TextureDesc::Marble(Marble::default()))),
        ("wood", Some(TextureDesc::Wood(Wood::default()))),
        ("vertex-color", Some(TextureDesc::VertexColor(VertexColor::default()))),
        (
            "ramp of a number",
            Some(TextureDesc::Ramp(Ramp { input: 0.3.into(), stops: ramp_stops(), interpolation: Default::default() })),
        ),
        ("mix of colours", Some(TextureDesc::Mix(Mix { a: grey(0.2), b: grey(0.8), share: 0.5.into() }))),
        ("multiply of colours", Some(TextureDesc::Multiply(Multiply { a: grey(0.5), b: grey(0.8) }))),
        ("invert of a colour", Some(TextureDesc::Invert(Invert { input: grey(0.5) }))),
        ("channel of a colour", Some(TextureDesc::Channel(ChannelOf { input: grey(0.5), channel: Channel::Green }))),
    ])
}

fn ramp_stops() -> Vec<eyebeam_core::texture::Stop> {
    (0..5).map(|i| eyebeam_core::texture::Stop { at: 0.25 * i as f32, color: Rgb::grey(0.2 * i as f32) }).collect()
}

/// Pixels along a side of the pictures.
const SIDE: u32 = 1024;

/// Something like a photograph: clouds, grain and sharp edges.
fn photograph(channels: usize) -> Samples {
    let mut bytes = Vec::new();
    for (y, x) in (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| (y, x))) {
        let mut numbers = Independent::new(1, UVec2::new(x, y), 0);
        let wave = |scale: f32| (x as f32 * scale).sin() * (y as f32 * scale * 1.3).cos();
        let edge = if (x / 64 + y / 48) % 2 == 0 { 60.0 } else { -60.0 };
        let light = 110.0 + 30.0 * wave(0.02) + 15.0 * wave(0.11) + edge + 40.0 * (numbers.get_1d() - 0.5);
        bytes.extend((0..channels).map(|c| (light + 12.0 * c as f32) as u8));
    }
    Samples::Byte(bytes)
}

fn widened(word: impl Fn(u8) -> u16) -> Samples {
    match photograph(3) {
        Samples::Byte(bytes) => Samples::Word(bytes.into_iter().map(word).collect()),
        other => other,
    }
}

/// Bits of numbers from 1 to 2.
fn halves() -> Samples {
    match widened(|byte| 0x3c00 | u16::from(byte) << 2) {
        Samples::Word(words) => Samples::Half(words),
        other => other,
    }
}

fn floats() -> Samples {
    match photograph(3) {
        Samples::Byte(bytes) => Samples::Float(bytes.into_iter().map(|byte| f32::from(byte) / 255.0).collect()),
        other => other,
    }
}

fn image(samples: Samples, channels: usize) -> Result<ImageTexture, Box<dyn Error>> {
    let pixels = Pixels::new(SIDE, SIDE, channels, samples).ok_or("the picture has a wrong size")?;
    let mapping = Mapping { scale: [100.0, 100.0, 1.0], ..Mapping::default() };
    Ok(ImageTexture { mapping, ..ImageTexture::new("", Some(Arc::new(pixels))) })
}

/// A large floor under an even sky, seen to the horizon.
fn floor(texture: Option<TextureDesc>) -> SceneDesc {
    let mut desc = SceneDesc {
        camera: CameraDesc { look_from: [0.0, 1.6, 0.0], look_at: [0.0, 0.9, -4.0], ..CameraDesc::default() },
        environment: EnvironmentDesc::Constant(Constant { radiance: Rgb::grey(1.0) }),
        ..SceneDesc::default()
    };
    let albedo = match texture {
        None => Color::Rgb(Rgb::grey(0.5)),
        Some(texture) => {
            desc.texture.insert("t".to_owned(), texture);
            Color::Texture(Name::new("t"))
        }
    };
    desc.material.insert(SceneDesc::DEFAULT_MATERIAL.to_owned(), MaterialDesc::Lambertian(Lambertian { albedo }));
    desc.shape.mesh.push(MeshDesc {
        vertices: vec![[-200.0, 0.0, 200.0], [200.0, 0.0, 200.0], [200.0, 0.0, -200.0], [-200.0, 0.0, -200.0]],
        uvs: vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]],
        colors: vec![[0.5; 3]; 4],
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        ..MeshDesc::default()
    });
    desc
}

/// Pictures of the floor by each filter, beside one of many samples.
fn filters(rounds: usize) -> Result<(), Box<dyn Error>> {
    println!("| light | filter | spp | seconds | error | seconds · error |");
    println!("|---|---|---|---|---|---|");
    let sky = SkyDesc { sun_elevation: Some(40.0), scale: 0.3, ..SkyDesc::default() };
    let lights = [
        ("even", EnvironmentDesc::Constant(Constant { radiance: Rgb::grey(1.0) })),
        ("sun and sky", EnvironmentDesc::Sky(sky)),
    ];
    for (light, environment) in lights {
        let scene = |texture| {
            let mut desc = SceneDesc { environment: environment.clone(), ..floor(texture) };
            (desc.render.width, desc.render.height, desc.render.max_depth) = (192, 108, 3);
            desc
        };
        let filtered = |filter| -> Result<_, Box<dyn Error>> {
            Ok(scene(Some(TextureDesc::Image(ImageTexture { filter, ..image(photograph(3), 3)? }))))
        };
        let mut ways = vec![("a plain colour", scene(None))];
        for (name, filter) in FILTERS {
            ways.push((name, filtered(filter)?));
        }
        for (name, mut desc) in ways {
            let built = build(&desc)?;
            (desc.render.spp, desc.render.seed) = (2048, 99);
            let reference = render(&built, &desc, NonZeroUsize::MIN).0.develop();
            for spp in [4, 16, 64, 256] {
                desc.render.spp = spp;
                let (mut seconds, mut errors) = (Vec::new(), Vec::new());
                for seed in 0..rounds as u64 {
                    desc.render.seed = seed;
                    let mut picture = None;
                    let time = thread_time(|| picture = Some(render(&built, &desc, NonZeroUsize::MIN).0.develop()));
                    seconds.push(time.as_secs_f64());
                    errors.extend(picture.map(|picture| error(&picture, &reference)));
                }
                let (seconds, error) = (median(seconds), median(errors));
                println!("| {light} | {name} | {spp} | {seconds:.3} | {error:.2e} | {:.2e} |", seconds * error);
            }
        }
    }
    Ok(())
}

const FILTERS: [(&str, Filter); 2] = [("bilinear", Filter::Bilinear), ("nearest", Filter::Nearest)];

/// Relative squared error.
fn error(picture: &Image, reference: &Image) -> f64 {
    let channels = |image: &Image| image.pixels().as_flattened().iter().map(|&c| f64::from(c)).collect::<Vec<_>>();
    let (picture, reference) = (channels(picture), channels(reference));
    let relative = |(p, r): (&f64, &f64)| (p - r).powi(2) / (r * r + 0.01);
    picture.iter().zip(&reference).map(relative).sum::<f64>() / reference.len() as f64
}

fn build(desc: &SceneDesc) -> Result<Scene, String> {
    Scene::build(desc).map_err(|problems| format!("{problems:?}"))
}
