//! Pictures of the scenes that several renderers are compared on, by a command line that all their drivers share.

mod scene;

use std::error::Error;
use std::fs;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::time::Instant;

use clap::Args;
use eyebeam_core::film::Image;
use eyebeam_core::integrator::IntegratorKind;
use eyebeam_core::light::select::LightSelection;
use eyebeam_core::render::{Monitor, Render, Settings};
use eyebeam_core::sampler::SamplerKind;
use eyebeam_core::scene::Scene;
use eyebeam_io::image::{Encoding, ImageFormat};
use serde::de::DeserializeOwned;
use serde_json::{Value, json};

pub use scene::read_scene;

/// Which picture.
#[derive(Args)]
pub struct Peer {
    /// The scene, a JSON file
    #[arg(long)]
    scene: PathBuf,
    /// The picture: .exr, or .pfm
    #[arg(long)]
    out: PathBuf,
    /// Threads
    #[arg(long, default_value = "2")]
    threads: NonZeroUsize,
    /// Chooses the random numbers
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// How light is traced
    #[arg(long, value_parser = named::<IntegratorKind>)]
    integrator: Option<IntegratorKind>,
    /// Which random numbers
    #[arg(long, value_parser = named::<SamplerKind>)]
    sampler: Option<SamplerKind>,
    /// How one of many lights is chosen
    #[arg(long, value_parser = named::<LightSelection>)]
    light_selection: Option<LightSelection>,
}

/// A unit variant, by its name in scene files.
fn named<T: DeserializeOwned>(name: &str) -> Result<T, serde_json::Error> {
    serde_json::from_value(Value::from(name))
}

/// Renders a scene and prints what it took, as a last line that begins with `RESULT`.
///
/// # Errors
/// If the scene cannot be read or the picture not be written.
pub fn run(options: &Peer, spp: u32) -> Result<(), Box<dyn Error>> {
    let start = Instant::now();
    let mut desc = read_scene(&options.scene)?;
    desc.render.spp = spp;
    desc.render.seed = options.seed;
    desc.render.integrator = options.integrator.unwrap_or_default();
    desc.render.sampler = options.sampler.unwrap_or_default();
    desc.render.light_selection = options.light_selection.unwrap_or_default();
    let scene = Scene::build(&desc).map_err(|problems| format!("{problems:?}"))?;
    let load = start.elapsed();
    let start = Instant::now();
    let mut render = Render::new(&scene, Settings { threads: options.threads, ..Settings::from(&desc.render) });
    let monitor = Monitor::default();
    render.finish(&monitor);
    let time = start.elapsed();
    write(&options.out, &render.film().develop())?;
    let result = json!({
        "load_s": load.as_secs_f64(),
        "render_s": time.as_secs_f64(),
        "spp": spp,
        "threads": options.threads,
        "rays": monitor.rays.into_inner(),
        "version": concat!("eyebeam ", env!("CARGO_PKG_VERSION")),
    });
    println!("RESULT {result}");
    Ok(())
}

fn write(path: &Path, image: &Image) -> Result<(), Box<dyn Error>> {
    let bytes = if path.extension().is_some_and(|e| e == "pfm") {
        pfm(image)
    } else {
        ImageFormat::from_path(path)?.encode(image, "{}", &Encoding::default())?
    };
    Ok(fs::write(path, bytes)?)
}

/// Portable float map: the rows from the bottom up.
fn pfm(image: &Image) -> Vec<u8> {
    let mut bytes = format!("PF\n{} {}\n-1.0\n", image.width(), image.height()).into_bytes();
    let rows = image.pixels().chunks(image.width() as usize).rev();
    bytes.extend(rows.flatten().flatten().flat_map(|c| c.to_le_bytes()));
    bytes
}
