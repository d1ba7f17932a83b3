//! `eyebeam render`: a scene to a picture.

mod hash;
mod stats;

use std::path::PathBuf;
use std::sync::atomic::Ordering::Relaxed;
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;
use std::time::{Duration, Instant};

use eyebeam_core::desc::RenderDesc;
use eyebeam_core::film::{ErrorEstimate, Film};
use eyebeam_core::integrator::IntegratorKind;
use eyebeam_core::render::{Monitor, Render, Settings};
use eyebeam_core::scene::Scene;
use eyebeam_io::Warning;
use eyebeam_io::image::ImageFormat;
use eyebeam_io::output::check_writable;
use eyebeam_io::scene::{Override, SceneFile};
use stats::{Phases, Provenance, Stats};

use crate::args::RenderArgs;
use crate::command::{is_standard, read_scene, write};
use crate::error::Error;
use crate::progress::{Progress, State, duration, say};
use crate::signals::Signals;

pub(super) fn run(args: &RenderArgs) -> Result<(), Error> {
    let output = Output::new(args)?;
    let mut phases = Phases::default();
    let clock = Instant::now();
    let SceneFile { desc, warnings } = describe(args)?;
    let scene_hash = hash::scene_hash(&desc);
    phases.load = clock.elapsed().as_secs_f64();

    let mut settings = Settings::from(&desc.render);
    settings.threads = args.threads.unwrap_or(settings.threads);
    check_memory(&settings, args.memory)?;
    output.check()?;
    if let Some(path) = args.stats.as_deref().filter(|path| !is_standard(path)) {
        check_writable(path)?;
    }

    let clock = Instant::now();
    let scene = Scene::build(&desc).map_err(|mut problems| Error::Scene(problems.remove(0)))?;
    let described = desc.render.clone();
    // The scene has what it needs of the meshes.
    drop(desc);
    phases.build = clock.elapsed().as_secs_f64();
    if args.verbose {
        let Settings { width, height, spp, threads, .. } = settings;
        say(&format!("{} primitives · {width} x {height} · {spp} spp · {threads} threads", scene.primitive_count()));
    }

    let signals = Signals::listen().map_err(Error::Listen)?;
    let render = Render::new(&scene, settings);
    let scene = Described { settings: &described, hash: &scene_hash, warnings: &warnings };
    let mut session = Session { render, scene, args, output: &output, error: None };
    let clock = Instant::now();
    let rays = session.run(&signals)?;
    phases.render = clock.elapsed().as_secs_f64();
    session.error = session.render.film().error();

    let clock = Instant::now();
    session.write_picture()?;
    phases.write = clock.elapsed().as_secs_f64();
    // A signal that came too late to stop anything is no news.
    let signal = signals.end().filter(|_| !session.render.is_done());
    session.report(&phases, rays, signal)?;
    signal.map_or(Ok(()), |signal| Err(Error::Signal(signal)))
}

/// The scene with the command line's settings in it.
fn describe(args: &RenderArgs) -> Result<SceneFile, Error> {
    let mut settings = args.set.clone();
    // Which lights are found depends on it, so the reader is to know.
    let named = args.integrator.and_then(|kind| IntegratorKind::NAMES.iter().find(|(_, named)| *named == kind));
    settings
        .extend(named.map(|(name, _)| Override { path: "render.integrator".to_owned(), value: (*name).to_owned() }));
    let mut file = read_scene(&args.scene, &settings, args.strict, args.quiet)?;
    let render = &mut file.desc.render;
    (render.width, render.height) = args.resolution.unwrap_or((render.width, render.height));
    render.spp = args.spp.unwrap_or(render.spp);
    render.max_depth = args.max_depth.unwrap_or(render.max_depth);
    render.seed = args.seed.unwrap_or(render.seed);
    Ok(file)
}

/// Film and picture, and the encoded file.
fn check_memory(settings: &Settings, allowed: u64) -> Result<(), Error> {
    // 16 bytes a pixel and format at most, and as much again while the file grows or its pixels are copied.
    const ENCODING: u64 = 32;
    let pixels = u64::from(settings.width) * u64::from(settings.height);
    let needed = Film::bytes(settings.width, settings.height) + ENCODING * pixels;
    if needed > allowed { Err(Error::Memory { needed, allowed }) } else { Ok(()) }
}

/// Where the picture goes.
struct Output {
    path: PathBuf,
    format: ImageFormat,
}

impl Output {
    fn new(args: &RenderArgs) -> Result<Self, Error> {
        let path = args.output.clone().unwrap_or_else(|| {
            let stem = args.scene.file_stem().filter(|_| !is_standard(&args.scene)).unwrap_or("out".as_ref());
            let mut name = stem.to_owned();
            name.push(".png");
            name.into()
        });
        let format = if is_standard(&path) { ImageFormat::Png } else { ImageFormat::from_path(&path)? };
        let is_scene = |stats: &PathBuf| *stats == args.scene && !is_standard(stats);
        if args.stats.as_ref().is_some_and(|stats| *stats == path || is_scene(stats)) {
            return Err(Error::Usage("--stats needs a name of its own".to_owned()));
        }
        Ok(Self { path, format })
    }

    fn check(&self) -> Result<(), Error> {
        if is_standard(&self.path) { Ok(()) } else { Ok(check_writable(&self.path)?) }
    }
}

/// What is told of the scene.
struct Described<'a> {
    settings: &'a RenderDesc,
    hash: &'a str,
    warnings: &'a [Warning],
}

/// A render with all that watches it.
struct Session<'a> {
    render: Render<'a>,
    scene: Described<'a>,
    args: &'a RenderArgs,
    output: &'a Output,
    /// The picture's error when it was last estimated.
    error: Option<ErrorEstimate>,
}

impl Session<'_> {
    /// Renders until done or told to end; returns the number of rays.
    fn run(&mut self, signals: &Signals) -> Result<u64, Error> {
        let monitor = Monitor::default();
        let mut progress = Progress::new(self.args.progress, self.args.quiet);
        let mut estimated = Instant::now();
        while !self.render.is_done() && signals.end().is_none() {
            let error = self.error.map(|e| e.mean);
            self.watched_step(&monitor, signals, &mut progress, error);
            monitor.pause.store(false, Relaxed);
            // A short step ends before anything has looked.
            progress.update(self.state(&monitor, error));
            if signals.take_write() {
                self.error = self.render.film().error();
                // What can be written later is not to be lost now.
                self.write_picture().unwrap_or_else(|e| say(&e.to_string()));
            }
            if estimated.elapsed() > Duration::from_secs(1) {
                self.error = self.render.film().error();
                estimated = Instant::now();
            }
        }
        progress.finish(self.state(&monitor, self.error.map(|e| e.mean)));
        Ok(monitor.rays.load(Relaxed))
    }

    /// One step, with another thread that shows progress and passes signals on.
    fn watched_step(&mut self, monitor: &Monitor, signals: &Signals, progress: &mut Progress, error: Option<f64>) {
        let (units, spp) = (self.render.units(), self.render.settings().spp);
        let (done, is_done) = channel::<()>();
        thread::scope(|scope| {
            scope.spawn(move || {
                while let Err(RecvTimeoutError::Timeout) = is_done.recv_timeout(Duration::from_millis(20)) {
                    progress.update(state(monitor, units, spp, error));
                    if signals.any() {
                        monitor.pause.store(true, Relaxed);
                    }
                }
            });
            self.render.step(monitor);
            drop(done);
        });
    }

    fn state(&self, monitor: &Monitor, error: Option<f64>) -> State {
        state(monitor, self.render.units(), self.render.settings().spp, error)
    }

    fn provenance(&self) -> Provenance<'_> {
        Provenance::new(self.args, &self.scene, self.render.film(), self.error)
    }

    fn write_picture(&self) -> Result<(), Error> {
        let image = self.render.film().develop();
        write(&self.output.path, &self.output.format.encode(&image, &self.provenance().to_json())?)
    }

    /// What was done, for a person and for a program.
    fn report(&self, phases: &Phases, rays: u64, signal: Option<u8>) -> Result<(), Error> {
        let settings = self.render.settings();
        let stats = Stats::new(self.provenance(), self.scene.warnings, settings.threads.get(), phases, rays, signal);
        if !self.args.quiet {
            let error = self.error.map(|e| format!(" · error {:.1} %", 100.0 * e.mean)).unwrap_or_default();
            let seconds =
                if phases.render < 10.0 { format!("{:.2} s", phases.render) } else { duration(phases.render) };
            say(&format!(
                "{}: {} x {} · {:.0} spp · {seconds} · {:.1} Mray/s{error}",
                self.output.path.display(),
                settings.width,
                settings.height,
                stats.mean_spp(),
                rays as f64 / phases.render / 1e6,
            ));
            stats.dropped().iter().for_each(|warning| say(&format!("warning: {warning}")));
        }
        match &self.args.stats {
            Some(path) => write(path, stats.to_json().as_bytes()),
            None => Ok(()),
        }
    }
}

fn state(monitor: &Monitor, units: u64, spp: u32, error: Option<f64>) -> State {
    State { rays: monitor.rays.load(Relaxed), done: monitor.units.load(Relaxed) as f64 / units as f64, spp, error }
}
