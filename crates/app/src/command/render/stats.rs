//! What a picture says of itself, and what a render says of its work: JSON in the file, and in `--stats`.

use eyebeam_core::desc::RenderDesc;
use eyebeam_core::film::{ErrorEstimate, Film, SampleCounts};
use eyebeam_core::look::Look;
use eyebeam_io::Warning;
use serde::Serialize;

use crate::args::PictureArgs;
use crate::command::render::aov::About;
use crate::command::render::session::Described;
use crate::command::report::{self, Told};
use crate::limits::peak_memory;

/// What made a picture; enough to make the same bits again.
#[derive(Debug, Serialize)]
pub(super) struct Provenance<'a> {
    schema: &'static str,
    version: &'static str,
    /// The scene file, as it was named.
    scene: String,
    /// Which picture of a turn it is.
    #[serde(skip_serializing_if = "Option::is_none")]
    turntable: Option<Frame>,
    /// Settings of the command line that changed the scene.
    overrides: Vec<String>,
    /// SHA-256 of the scene with all that was included, changed and loaded, but for `settings`.
    scene_hash: &'a str,
    settings: &'a RenderDesc,
    /// What the picture tells besides light.
    aov: About,
    spp: Spp,
    error: Option<Error>,
    #[serde(skip)]
    dropped: u64,
}

/// A picture of a turn; the scene's hash is that of the first.
#[derive(Clone, Copy, Debug, Serialize)]
pub(crate) struct Frame {
    /// From 0.
    pub(crate) frame: u32,
    /// How many there are.
    pub(crate) of: u32,
}

#[derive(Debug, Serialize)]
struct Spp {
    min: u32,
    mean: f64,
    max: u32,
}

#[derive(Debug, Serialize)]
struct Error {
    mean: f64,
    p95: f64,
}

impl<'a> Provenance<'a> {
    pub(super) fn new(
        args: &PictureArgs,
        scene: &Described<'a>,
        aov: About,
        film: &Film,
        error: Option<ErrorEstimate>,
    ) -> Self {
        let SampleCounts { min, mean, max, dropped } = film.sample_counts();
        Self {
            schema: "eyebeam-render-1",
            version: env!("CARGO_PKG_VERSION"),
            scene: scene.file.display().to_string(),
            turntable: scene.frame,
            overrides: args.set.iter().map(|o| format!("{}={}", o.path, o.value)).collect(),
            scene_hash: scene.hash,
            settings: scene.settings,
            aov,
            spp: Spp { min, mean, max },
            error: error.map(|ErrorEstimate { mean, p95 }| Error { mean, p95 }),
            dropped,
        }
    }

    pub(super) fn to_json(&self) -> String {
        serde_json::to_string(self).unwrap_or_default()
    }
}

/// Seconds of each phase.
#[derive(Clone, Debug, Default, Serialize)]
pub(super) struct Phases {
    pub(super) load: f64,
    pub(super) build: f64,
    pub(super) aov: f64,
    pub(super) render: f64,
    pub(super) write: f64,
}

/// Work in numbers.
pub(super) struct Done {
    pub(super) rays: u64,
    pub(super) threads: usize,
    pub(super) clamped_energy: f64,
    /// What ended it early.
    pub(super) signal: Option<u8>,
}

/// What was done and how long it took.
#[derive(Debug, Serialize)]
pub(super) struct Stats<'a> {
    #[serde(flatten)]
    provenance: Provenance<'a>,
    /// None of a picture that stays linear.
    look: Option<&'a Look>,
    stop_reason: &'static str,
    nan_count: u64,
    /// Luminance that clamping has taken from the picture, in the mean over its pixels.
    clamped_energy: f64,
    seconds: Phases,
    rays: u64,
    rays_per_s: f64,
    peak_rss_bytes: Option<u64>,
    threads: usize,
    /// What was ignored or approximated, and what is hardly meant.
    warnings: Vec<Told<'a>>,
    /// A word about samples that do not count; the others have been told before the render.
    #[serde(skip)]
    dropped_warning: Option<String>,
}

impl<'a> Stats<'a> {
    pub(super) fn new(
        provenance: Provenance<'a>,
        look: Option<&'a Look>,
        warnings: &'a [Warning],
        phases: &Phases,
        work: &Done,
    ) -> Self {
        let Done { rays, threads, clamped_energy, signal } = *work;
        let dropped = provenance.dropped;
        let dropped_warning =
            (dropped > 0).then(|| format!("{dropped} samples were no finite numbers and do not count"));
        Self {
            provenance,
            look,
            stop_reason: if signal.is_some() { "signal" } else { "spp" },
            nan_count: dropped,
            clamped_energy,
            seconds: phases.clone(),
            rays,
            rays_per_s: rays as f64 / phases.render,
            peak_rss_bytes: peak_memory(),
            threads,
            warnings: report::told(warnings),
            dropped_warning,
        }
    }

    pub(super) fn mean_spp(&self) -> f64 {
        self.provenance.spp.mean
    }

    /// A word about samples that do not count.
    pub(super) fn dropped(&self) -> Option<&str> {
        self.dropped_warning.as_deref()
    }

    pub(super) fn to_json(&self) -> String {
        serde_json::to_string_pretty(self).unwrap_or_default() + "\n"
    }
}
