//! `eyebeam render`: a scene to a picture.

mod aov;
mod hash;
mod stats;

use std::path::PathBuf;
use std::sync::atomic::Ordering::Relaxed;
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;
use std::time::{Duration, Instant};

use eyebeam_core::desc::RenderDesc;
use eyebeam_core::film::{Aov, ErrorEstimate, Film};
use eyebeam_core::integrator::IntegratorKind;
use eyebeam_core::look::Exposure;
use eyebeam_core::render::{Monitor, Render, Settings};
use eyebeam_core::scene::Scene;
use eyebeam_core::setup::{Assumed, Given};
use eyebeam_io::Warning;
use eyebeam_io::image::ImageFormat;
use eyebeam_io::output::check_writable;
use eyebeam_io::scene::{Override, SceneFile, read_with};

use aov::Aovs;
use stats::{Done, Phases, Provenance, Stats};

use crate::args::RenderArgs;
use crate::command::report::{self, Talk};
use crate::command::target::Target;
use crate::command::{is_standard, setup, write};
use crate::error::Error;
use crate::progress::{Progress, State, duration, say};
use crate::signals::Signals;

pub(super) fn run(args: &RenderArgs) -> Result<(), Error> {
    let mut target = target(args)?;
    let mut phases = Phases::default();
    let clock = Instant::now();
    let (SceneFile { desc, warnings, given, .. }, Assumed { what, is_studio }) = describe(args)?;
    if !what.is_empty() && !args.quiet {
        say(&format!("made up: {}", what.join(", ")));
    }
    if given != Given::ALL && !is_studio && args.look.exposure.is_none() {
        target.encoding.look.exposure = Exposure::Auto;
    }
    let scene_hash = hash::scene_hash(&desc);
    phases.load = clock.elapsed().as_secs_f64();

    let mut settings = Settings::from(&desc.render);
    settings.threads = args.threads.unwrap_or(settings.threads);
    let aovs = args.aovs();
    settings.film.variance = aovs.contains(&Aov::Variance);
    check_format(&target, &settings, &aovs)?;
    check_memory(&settings, &aovs, target.lens_bytes(), args.memory)?;
    target.check_writable()?;
    if let Some(path) = args.stats.as_deref().filter(|path| !is_standard(path)) {
        check_writable(path)?;
    }

    let clock = Instant::now();
    let scene = Scene::build(&desc).map_err(|mut problems| Error::Scene(problems.remove(0)))?;
    let described = desc.render.clone();
    let aovs = Aovs::new(&scene, &desc, &settings, aovs, args.aov_through);
    // The scene has what it needs of the meshes.
    drop(desc);
    phases.build = clock.elapsed().as_secs_f64();
    if args.verbose {
        let Settings { width, height, spp, threads, .. } = settings;
        say(&format!("{} primitives · {width} x {height} · {spp} spp · {threads} threads", scene.primitive_count()));
    }

    let signals = Signals::listen().map_err(Error::Listen)?;
    let mut session = Session {
        aovs,
        render: Render::new(&scene, settings),
        scene: Described { settings: &described, hash: &scene_hash, warnings: &warnings },
        args,
        target: &target,
        error: None,
    };
    let clock = Instant::now();
    session.run_aovs(&signals);
    phases.aov = clock.elapsed().as_secs_f64();

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

/// The scene with the command line's settings in it, and what was made up for it.
fn describe(args: &RenderArgs) -> Result<(SceneFile, Assumed), Error> {
    let mut settings = args.set.clone();
    // Which lights are found depends on it, so the reader is to know.
    let named = args.integrator.and_then(|kind| IntegratorKind::NAMES.iter().find(|(_, named)| *named == kind));
    settings
        .extend(named.map(|(name, _)| Override { path: "render.integrator".to_owned(), value: (*name).to_owned() }));
    let mut file = read_with(&args.scene, &args.setup.options(&args.model, &settings))?;
    let render = &mut file.desc.render;
    (render.width, render.height) = args.resolution.unwrap_or((render.width, render.height));
    render.spp = args.spp.unwrap_or(render.spp);
    render.max_depth = args.max_depth.unwrap_or(render.max_depth);
    render.seed = args.seed.unwrap_or(render.seed);
    render.transparent |= args.transparent;
    render.clamp = args.clamp.unwrap_or(render.clamp);
    let assumed = setup::complete(&mut file, &args.setup)?;
    Ok((report::say_of(file, args.strict, Talk::new(args.quiet, args.verbose))?, assumed))
}

/// Film and picture, what the lens needs for each pixel, and the encoded file.
fn check_memory(settings: &Settings, aovs: &[Aov], lens: u64, allowed: u64) -> Result<(), Error> {
    // 16 bytes a pixel and format at most, and as much again while the file grows or its pixels are copied.
    const ENCODING: u64 = 32;
    let pixels = u64::from(settings.width) * u64::from(settings.height);
    let film = Film::bytes(settings.width, settings.height, &settings.film);
    let needed = film + (ENCODING + lens) * pixels + Aovs::bytes(settings, aovs);
    if needed > allowed { Err(Error::Memory { needed, allowed }) } else { Ok(()) }
}

/// Where the picture goes; nothing else may go there.
fn target(args: &RenderArgs) -> Result<Target, Error> {
    let path = args.output.clone().unwrap_or_else(|| {
        let stem = args.scene.file_stem().filter(|_| !is_standard(&args.scene)).unwrap_or("out".as_ref());
        let mut name = stem.to_owned();
        name.push(".png");
        name.into()
    });
    let target = Target::new(path, args.look.encoding())?;
    let is_scene = |stats: &PathBuf| *stats == args.scene && !is_standard(stats);
    if args.stats.as_ref().is_some_and(|stats| *stats == target.path || is_scene(stats)) {
        return Err(Error::Usage("--stats needs a name of its own".to_owned()));
    }
    Ok(target)
}

/// That the format takes all that there is to write.
fn check_format(target: &Target, settings: &Settings, aovs: &[Aov]) -> Result<(), Error> {
    if !aovs.is_empty() && target.format != ImageFormat::Exr {
        return Err(target.unfit("--aov needs a file of many channels", "is not", ".exr"));
    }
    target.check_picture(settings.width, settings.height, settings.film.transparent)
}

/// What is told of the scene.
struct Described<'a> {
    settings: &'a RenderDesc,
    hash: &'a str,
    warnings: &'a [Warning],
}

/// A render with all that watches it.
struct Session<'a> {
    aovs: Aovs<'a>,
    render: Render<'a>,
    scene: Described<'a>,
    args: &'a RenderArgs,
    target: &'a Target,
    /// The picture's error when it was last estimated.
    error: Option<ErrorEstimate>,
}

impl Session<'_> {
    /// Finds what the picture tells besides light, until done or told to end.
    fn run_aovs(&mut self, signals: &Signals) {
        let (monitor, mut progress) = (Monitor::default(), self.progress());
        let of = Work { phase: "aov", units: self.render.settings().height.into(), spp: self.aovs.spp() };
        while !self.aovs.is_done() && signals.end().is_none() {
            watched(&monitor, signals, || progress.update(of.state(&monitor, None)), || self.aovs.step(&monitor));
            if signals.take_write() {
                self.write_picture_now();
            }
        }
        if monitor.units.load(Relaxed) > 0 {
            progress.finish(of.state(&monitor, None));
        }
    }

    /// Renders until done or told to end; returns the number of rays.
    fn run(&mut self, signals: &Signals) -> Result<u64, Error> {
        let (monitor, mut progress) = (Monitor::default(), self.progress());
        let of = Work { phase: "render", units: self.render.units(), spp: self.render.settings().spp };
        let mut estimated = Instant::now();
        while !self.render.is_done() && signals.end().is_none() {
            let error = self.error.map(|e| e.mean);
            watched(&monitor, signals, || progress.update(of.state(&monitor, error)), || self.render.step(&monitor));
            // A short step ends before anything has looked.
            progress.update(of.state(&monitor, error));
            if signals.take_write() {
                self.error = self.render.film().error();
                self.write_picture_now();
            }
            if estimated.elapsed() > Duration::from_secs(1) {
                self.error = self.render.film().error();
                estimated = Instant::now();
            }
        }
        progress.finish(of.state(&monitor, self.error.map(|e| e.mean)));
        Ok(monitor.rays.load(Relaxed))
    }

    fn progress(&self) -> Progress {
        Progress::new(self.args.progress, self.args.quiet)
    }

    fn provenance(&self) -> Provenance<'_> {
        Provenance::new(self.args, &self.scene, self.aovs.about(), self.render.film(), self.error)
    }

    fn write_picture(&self) -> Result<(), Error> {
        let provenance = self.provenance().to_json();
        let file = self.aovs.encode(self.render.film(), self.target, &provenance)?;
        write(&self.target.path, &file)
    }

    /// Writes the picture as it is: what can be written later is not to be lost now.
    fn write_picture_now(&self) {
        self.write_picture().unwrap_or_else(|e| say(&e.to_string()));
    }

    /// What was done, for a person and for a program.
    fn report(&self, phases: &Phases, rays: u64, signal: Option<u8>) -> Result<(), Error> {
        let settings = self.render.settings();
        let look = self.target.format.is_for_screens().then_some(&self.target.encoding.look);
        let clamped_energy = self.render.film().clamped();
        let done = Done { rays, threads: settings.threads.get(), clamped_energy, signal };
        let stats = Stats::new(self.provenance(), look, self.scene.warnings, phases, &done);
        if !self.args.quiet {
            let error = self.error.map(|e| format!(" · error {:.1} %", 100.0 * e.mean)).unwrap_or_default();
            let seconds =
                if phases.render < 10.0 { format!("{:.2} s", phases.render) } else { duration(phases.render) };
            say(&format!(
                "{}: {} x {} · {:.0} spp · {seconds} · {:.1} Mray/s{error}",
                self.target.path.display(),
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

/// A phase of the work.
struct Work {
    phase: &'static str,
    units: u64,
    /// Samples per pixel.
    spp: u32,
}

impl Work {
    fn state(&self, monitor: &Monitor, error: Option<f64>) -> State {
        let done = monitor.units.load(Relaxed) as f64 / self.units as f64;
        State { phase: self.phase, rays: monitor.rays.load(Relaxed), done, spp: self.spp, error }
    }
}

/// Works until done or told to pause, with another thread that shows progress and passes signals on.
fn watched(monitor: &Monitor, signals: &Signals, mut show: impl FnMut() + Send, work: impl FnOnce()) {
    let (done, is_done) = channel::<()>();
    thread::scope(|scope| {
        scope.spawn(move || {
            while let Err(RecvTimeoutError::Timeout) = is_done.recv_timeout(Duration::from_millis(20)) {
                show();
                if signals.any() {
                    monitor.pause.store(true, Relaxed);
                }
            }
        });
        work();
        drop(done);
    });
    monitor.pause.store(false, Relaxed);
}
