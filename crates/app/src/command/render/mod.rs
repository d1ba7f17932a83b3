//! `eyebeam render`: a scene to a picture. What makes one is shared with `eyebeam turntable`: a [`Job`].

mod aov;
mod hash;
mod session;
mod stats;

use std::panic::resume_unwind;
use std::path::{Path, PathBuf};
use std::thread;
use std::time::Instant;

use eyebeam_core::desc::SceneDesc;
use eyebeam_core::film::{Aov, Film};
use eyebeam_core::integrator::IntegratorKind;
use eyebeam_core::render::{Render, Settings};
use eyebeam_core::scene::Scene;
use eyebeam_core::setup::Turntable;
use eyebeam_io::Warning;
use eyebeam_io::image::ImageFormat;
use eyebeam_io::output::check_writable;
use eyebeam_io::scene::{Override, ReadOptions, read_with};

use aov::Aovs;
pub(super) use session::Outcome;
use session::{Described, Session};
pub(super) use stats::Frame;
use stats::Phases;

use crate::args::{CameraArg, PictureArgs, RenderArgs};
use crate::command::report::{self, Talk};
use crate::command::target::Target;
use crate::command::{is_standard, setup, write};
use crate::error::Error;
use crate::progress::say;
use crate::signals::Signals;

pub(super) fn run(args: &RenderArgs) -> Result<(), Error> {
    let mut target = Target::new(output(args), args.picture.look.encoding())?;
    let mut job = Job::load(&args.picture, &args.scene, &mut target, false)?;
    let scene = job.build()?;
    let signals = Signals::listen().map_err(Error::Listen)?;
    let Outcome { stats, signal, .. } = job.picture(&scene, target, &signals, None)?;
    job.write_stats(&stats)?;
    signal.map_or(Ok(()), |signal| Err(Error::Signal(signal)))
}

/// The name of the picture.
fn output(args: &RenderArgs) -> PathBuf {
    args.output.clone().unwrap_or_else(|| {
        let mut name = stem(&args.scene).to_owned();
        name.push(".png");
        name.into()
    })
}

/// The name of a scene without its ending.
pub(super) fn stem(scene: &Path) -> &std::ffi::OsStr {
    scene.file_stem().filter(|_| !is_standard(scene)).unwrap_or("out".as_ref())
}

/// A scene, and all that is to be known to make pictures of it.
pub(super) struct Job<'a> {
    args: &'a PictureArgs,
    /// The scene file, as it was named.
    file: &'a Path,
    /// Without its shapes once it is built.
    pub(super) desc: SceneDesc,
    /// If it is to turn.
    pub(super) turntable: Option<Turntable>,
    warnings: Vec<Warning>,
    /// Of the scene, once that is built.
    hash: String,
    settings: Settings,
    aovs: Vec<Aov>,
    /// Names of ids, as JSON.
    names: String,
    phases: Phases,
}

impl<'a> Job<'a> {
    /// Reads a scene with the command line's settings in it, adds what it lacks, and finds out whether pictures can be made of it and
    /// written to the target, whose exposure may depend on the scene.
    pub(super) fn load(args: &'a PictureArgs, file: &'a Path, target: &mut Target, turns: bool) -> Result<Self, Error> {
        check_stats(args, file, target)?;
        let clock = Instant::now();
        let mut settings = args.set.clone();
        // Which lights are found depends on it, so the reader is to know.
        let named = args.integrator.and_then(|kind| IntegratorKind::NAMES.iter().find(|(_, named)| *named == kind));
        settings.extend(
            named.map(|(name, _)| Override { path: "render.integrator".to_owned(), value: (*name).to_owned() }),
        );
        let options = args.setup.options(&args.model, &settings);
        let mut scene = read_with(file, &ReadOptions { memory: Some(args.memory), ..options })?;
        let render = &mut scene.desc.render;
        (render.width, render.height) = args.resolution.unwrap_or((render.width, render.height));
        render.spp = args.spp.unwrap_or(render.spp);
        render.max_depth = args.max_depth.unwrap_or(render.max_depth);
        render.seed = args.seed.unwrap_or(render.seed);
        render.transparent |= args.transparent;
        render.clamp = args.clamp.unwrap_or(render.clamp);
        let aspect = render.width as f32 / render.height.max(1) as f32;
        let turntable = if turns { Turntable::around(&scene.desc) } else { None };
        let assumed = setup::complete(&mut scene, &args.setup)?;
        let is_made_up = args.setup.camera == Some(CameraArg::Auto) || !scene.given.camera;
        if let Some(turntable) = turntable.as_ref().filter(|_| is_made_up) {
            turntable.fit(&mut scene.desc.camera, aspect);
        }
        let scene = report::say_of(scene, args.strict, Talk::new(args.quiet, args.verbose))?;
        if !args.quiet {
            setup::say_of(&assumed);
        }
        let look = &mut target.encoding.look;
        let made_up = setup::look_of(look.clone(), scene.given, &assumed);
        look.view = args.look.view.unwrap_or(made_up.view);
        look.exposure = args.look.exposure.unwrap_or(made_up.exposure);
        let (desc, memory, aovs) = (scene.desc, scene.memory, args.aovs());
        let mut settings = Settings::from(&desc.render);
        settings.threads = args.threads.unwrap_or(settings.threads);
        settings.film.variance = aovs.contains(&Aov::Variance);
        let (hash, names) = (String::new(), aov::names(&desc, &aovs));
        let phases = Phases { load: clock.elapsed().as_secs_f64(), ..Phases::default() };
        let warnings = scene.warnings;
        let job = Self { args, file, desc, turntable, warnings, hash, settings, aovs, names, phases };
        job.check(target, memory)?;
        Ok(job)
    }

    /// That the format takes all that there is to write, that there is memory for it, and that files can be written. The scene's files take so much memory.
    fn check(&self, target: &Target, files: u64) -> Result<(), Error> {
        let Self { settings, aovs, args, .. } = self;
        if !aovs.is_empty() && target.format != ImageFormat::Exr {
            return Err(target.unfit("--aov needs a file of many channels", "is not", ".exr"));
        }
        target.check_picture(settings.width, settings.height, settings.film.transparent)?;
        check_memory(settings, aovs, target.lens_bytes(), files, args.memory)?;
        target.check_writable()?;
        match args.stats.as_deref().filter(|path| !is_standard(path)) {
            Some(path) => Ok(check_writable(path)?),
            None => Ok(()),
        }
    }

    /// Prepares the scene for rays. It has what it needs of shapes then.
    pub(super) fn build(&mut self) -> Result<Scene, Error> {
        let clock = Instant::now();
        let desc = &self.desc;
        let (scene, hash) = thread::scope(|scope| {
            let hash = scope.spawn(|| hash::scene_hash(desc));
            (Scene::build(desc), hash.join())
        });
        let scene = scene.map_err(|mut problems| Error::Scene(problems.remove(0)))?;
        self.hash = hash.unwrap_or_else(|panic| resume_unwind(panic));
        self.desc.shape = Default::default();
        self.desc.texture.clear();
        self.desc.material.clear();
        self.phases.build = clock.elapsed().as_secs_f64();
        if self.args.verbose {
            let Settings { width, height, spp, threads, .. } = self.settings;
            let count = scene.primitive_count();
            say(&format!("{count} primitives · {width} x {height} · {spp} spp · {threads} threads"));
        }
        Ok(scene)
    }

    /// Makes a picture of the scene, as the camera in it sees it, and writes it.
    pub(super) fn picture(
        &self,
        scene: &Scene,
        target: Target,
        signals: &Signals,
        frame: Option<Frame>,
    ) -> Result<Outcome, Error> {
        let Self { args, file, desc, warnings, hash, settings, aovs, names, phases, .. } = self;
        let session = Session {
            aovs: Aovs::new(scene, settings, aovs.clone(), args.aov_through, names),
            render: Render::new(scene, settings.clone()),
            scene: Described { file, settings: &desc.render, hash, warnings, frame },
            args,
            target,
            error: None,
        };
        session.make(phases.clone(), signals)
    }

    /// Writes what was done, if that was asked for.
    pub(super) fn write_stats(&self, stats: &str) -> Result<(), Error> {
        match &self.args.stats {
            Some(path) => write(path, stats.as_bytes()),
            None => Ok(()),
        }
    }
}

/// That nothing else goes where the statistics go.
fn check_stats(args: &PictureArgs, scene: &Path, target: &Target) -> Result<(), Error> {
    let is_taken = |stats: &PathBuf| *stats == target.path || (stats == scene && !is_standard(stats));
    if args.stats.as_ref().is_some_and(is_taken) {
        return Err(Error::Usage("--stats needs a name of its own".to_owned()));
    }
    Ok(())
}

/// What the scene's files take, film and picture, what the lens needs for each pixel, and the encoded file.
fn check_memory(settings: &Settings, aovs: &[Aov], lens: u64, files: u64, allowed: u64) -> Result<(), Error> {
    // 16 bytes a pixel and format at most, and as much again while the file grows or its pixels are copied.
    const ENCODING: u64 = 32;
    let pixels = u64::from(settings.width) * u64::from(settings.height);
    let film = Film::bytes(settings.width, settings.height, &settings.film);
    let needed = files + film + (ENCODING + lens) * pixels + Aovs::bytes(settings, aovs);
    if needed > allowed { Err(Error::Memory { needed, allowed }) } else { Ok(()) }
}
