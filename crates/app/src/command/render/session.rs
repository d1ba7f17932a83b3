//! A picture in the making, with all that watches it.

use std::path::Path;
use std::sync::atomic::Ordering::Relaxed;
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;
use std::time::{Duration, Instant};

use eyebeam_core::desc::RenderDesc;
use eyebeam_core::film::ErrorEstimate;
use eyebeam_core::look::Exposure;
use eyebeam_core::render::{Monitor, Render};
use eyebeam_io::Warning;

use crate::args::PictureArgs;
use crate::command::render::aov::Aovs;
use crate::command::render::stats::{Done, Frame, Phases, Provenance, Stats};
use crate::command::target::Target;
use crate::command::write;
use crate::error::Error;
use crate::progress::{Progress, State, duration, say};
use crate::signals::Signals;

/// What is told of the scene.
pub(super) struct Described<'a> {
    /// The file, as it was named.
    pub(super) file: &'a Path,
    pub(super) settings: &'a RenderDesc,
    pub(super) hash: &'a str,
    pub(super) warnings: &'a [Warning],
    /// Of a turn.
    pub(super) frame: Option<Frame>,
}

/// A render with all that watches it.
pub(super) struct Session<'a> {
    pub(super) aovs: Aovs<'a>,
    pub(super) render: Render<'a>,
    pub(super) scene: Described<'a>,
    pub(super) args: &'a PictureArgs,
    pub(super) target: Target,
    /// The picture's error when it was last estimated.
    pub(super) error: Option<ErrorEstimate>,
}

/// What came of it.
pub(in crate::command) struct Outcome {
    /// What was done, as JSON.
    pub(in crate::command) stats: String,
    /// The picture's exposure.
    pub(in crate::command) exposure: Exposure,
    /// What ended it early.
    pub(in crate::command) signal: Option<u8>,
}

impl Session<'_> {
    /// Makes the picture and writes it. One of several keeps the exposure that it finds, for those after it.
    pub(super) fn make(mut self, mut phases: Phases, signals: &Signals) -> Result<Outcome, Error> {
        let clock = Instant::now();
        self.run_aovs(signals);
        phases.aov = clock.elapsed().as_secs_f64();

        let clock = Instant::now();
        let rays = self.run(signals)?;
        phases.render = clock.elapsed().as_secs_f64();
        self.error = self.render.film().error();

        let clock = Instant::now();
        if self.scene.frame.is_some() && self.target.format.is_for_screens() {
            let (image, look) = (self.render.film().develop(), &mut self.target.encoding.look);
            look.exposure = Exposure::Ev(look.grade(&look.through_lens(&image)).ev());
        }
        self.write_picture()?;
        phases.write = clock.elapsed().as_secs_f64();
        // A signal that came too late to stop anything is no news.
        let signal = signals.end().filter(|_| !self.render.is_done());
        let stats = self.report(&phases, rays, signal);
        Ok(Outcome { stats, exposure: self.target.encoding.look.exposure, signal })
    }

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
        let file = self.aovs.encode(self.render.film(), &self.target, &provenance)?;
        write(&self.target.path, &file)
    }

    /// Writes the picture as it is: what can be written later is not to be lost now.
    fn write_picture_now(&self) {
        self.write_picture().unwrap_or_else(|e| say(&e.to_string()));
    }

    /// What was done, for a person and for a program.
    fn report(&self, phases: &Phases, rays: u64, signal: Option<u8>) -> String {
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
        stats.to_json()
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
