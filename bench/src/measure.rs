//! What is measured, and on what.

use std::hint::black_box;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::time::Duration;

use cpu_time::ThreadTime;
use eyebeam_core::desc::SceneDesc;
use eyebeam_core::film::Film;
use eyebeam_core::render::{Monitor, Render, Settings};
use eyebeam_core::scene::Scene;
use eyebeam_io::Error;

/// A scene of this repository, by its name.
///
/// # Errors
/// If there is none, or it cannot be read.
pub fn read_scene(name: &str) -> Result<SceneDesc, Error> {
    let scenes = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../scenes"));
    Ok(eyebeam_io::scene::read(&scenes.join(name).with_extension("toml"), &[])?.desc)
}

/// The files in a folder of the corpus of other people's scenes, sorted by name: below `EYEBEAM_CORPUS`, or beside the
/// repository. None if it is not there.
pub fn corpus(folder: &str) -> Vec<PathBuf> {
    let beside = || Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../shared/scenes")).to_owned();
    let root = std::env::var_os("EYEBEAM_CORPUS").map_or_else(beside, PathBuf::from);
    let files = std::fs::read_dir(root.join(folder)).into_iter().flatten().flatten().map(|entry| entry.path());
    let mut files: Vec<_> = files.filter(|path| path.extension().is_some_and(|ending| ending == "hdr")).collect();
    files.sort();
    files
}

/// Makes a picture so small that measuring it takes little time: as wide as asked, of the scene's own proportions, and by
/// the means of the textbook program.
pub fn shrink(desc: &mut SceneDesc, width: u32, spp: u32) {
    desc.render = desc.render.plain();
    let render = &mut desc.render;
    render.height = (width * render.height).div_ceil(render.width);
    render.width = width;
    render.spp = spp;
}

/// Samples in the whole picture.
pub fn samples(desc: &SceneDesc) -> u64 {
    let render = &desc.render;
    u64::from(render.width) * u64::from(render.height) * u64::from(render.spp)
}

/// Renders the whole picture, as the command does.
pub fn render(scene: &Scene, desc: &SceneDesc, threads: NonZeroUsize) -> (Film, Monitor) {
    let mut render = Render::new(scene, Settings { threads, ..Settings::from(&desc.render) });
    let monitor = Monitor::default();
    render.finish(&monitor);
    (render.film().clone(), monitor)
}

/// The processor time that this thread spends in `work`, which other programs do not add to.
pub fn thread_time<T>(work: impl FnOnce() -> T) -> Duration {
    let start = ThreadTime::now();
    black_box(work());
    start.elapsed()
}

/// What a sample of each scene takes one thread, ns: medians of rounds in which all have their turn.
pub fn nanoseconds_a_sample(scenes: &[(Scene, SceneDesc)], rounds: usize) -> Vec<f64> {
    let mut times = vec![Vec::new(); scenes.len()];
    for _ in 0..rounds {
        for ((scene, desc), times) in scenes.iter().zip(&mut times) {
            let time = thread_time(|| render(scene, desc, NonZeroUsize::MIN));
            times.push(time.as_secs_f64() * 1e9 / samples(desc) as f64);
        }
    }
    times.into_iter().map(median).collect()
}

/// The value in the middle.
///
/// # Panics
/// If there is none.
pub fn median(mut values: Vec<f64>) -> f64 {
    let middle = values.len() / 2;
    *values.select_nth_unstable_by(middle, f64::total_cmp).1
}
