//! Progress, on standard error: a bar, lines, or JSON.

use std::io::{IsTerminal, Write, stderr};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle as BarStyle};
use serde::Serialize;

use crate::args::ProgressStyle;

/// How far a render is.
#[derive(Clone, Copy, Debug)]
pub(crate) struct State {
    /// What the work is.
    pub(crate) phase: &'static str,
    pub(crate) rays: u64,
    /// Share of the work that is done, 0..1.
    pub(crate) done: f64,
    /// Samples per pixel that the work is.
    pub(crate) spp: u32,
    /// Mean relative error of the picture when it was last known.
    pub(crate) error: Option<f64>,
}

impl State {
    /// Samples per pixel so far.
    fn spp_done(&self) -> u32 {
        (self.done * f64::from(self.spp)) as u32
    }
}

/// A way to show it.
pub(crate) struct Progress {
    start: Instant,
    last: Option<Instant>,
    display: Display,
}

enum Display {
    Bar(ProgressBar),
    Lines,
    Json,
    None,
}

const BAR_STEPS: u64 = 1000;

/// One line of `--progress json`.
#[derive(Serialize)]
struct Line {
    t: f64,
    spp: u32,
    of: u32,
    rays_per_s: f64,
    error: Option<f64>,
    eta_s: Option<f64>,
    phase: &'static str,
}

impl Progress {
    pub(crate) fn new(style: ProgressStyle, quiet: bool) -> Self {
        let display = match style {
            ProgressStyle::Json => Display::Json,
            ProgressStyle::None => Display::None,
            ProgressStyle::Auto | ProgressStyle::Bar if quiet => Display::None,
            ProgressStyle::Auto if !stderr().is_terminal() => Display::Lines,
            ProgressStyle::Auto | ProgressStyle::Bar => {
                let bar = ProgressBar::with_draw_target(Some(BAR_STEPS), ProgressDrawTarget::stderr());
                if let Ok(style) = BarStyle::with_template("{percent:>3} % {wide_bar} {msg}") {
                    bar.set_style(style.progress_chars("━╸─"));
                }
                Display::Bar(bar)
            }
        };
        Self { start: Instant::now(), last: None, display }
    }

    /// Shows the state if it is time to.
    pub(crate) fn update(&mut self, state: State) {
        let every = Duration::from_millis(match self.display {
            Display::Bar(_) => 100,
            Display::Json => 500,
            Display::Lines => 5000,
            Display::None => return,
        });
        let now = Instant::now();
        if now.duration_since(self.last.unwrap_or(self.start)) >= every {
            self.last = Some(now);
            self.show(state);
        }
    }

    fn show(&self, state: State) {
        let seconds = self.start.elapsed().as_secs_f64();
        let rays_per_s = state.rays as f64 / seconds;
        let left = (state.done > 0.0).then(|| seconds / state.done - seconds);
        match &self.display {
            Display::Bar(bar) => {
                bar.set_position((state.done * BAR_STEPS as f64) as u64);
                bar.set_message(summary(state, rays_per_s, left));
            }
            Display::Lines => say(&format!("{:3.0} %  {}", 100.0 * state.done, summary(state, rays_per_s, left))),
            Display::Json => {
                let line = Line {
                    t: seconds,
                    spp: state.spp_done(),
                    of: state.spp,
                    rays_per_s,
                    error: state.error,
                    eta_s: left,
                    phase: state.phase,
                };
                say(&serde_json::to_string(&line).unwrap_or_default());
            }
            Display::None => {}
        }
    }

    /// Shows the last state, and takes the bar away.
    pub(crate) fn finish(&self, state: State) {
        match &self.display {
            Display::Bar(bar) => bar.finish_and_clear(),
            Display::Json => self.show(state),
            Display::Lines | Display::None => {}
        }
    }
}

fn summary(state: State, rays_per_s: f64, left: Option<f64>) -> String {
    let error = state.error.map(|e| format!(" · error {:.1} %", 100.0 * e)).unwrap_or_default();
    let left = left.map(|s| format!(" · {} left", duration(s))).unwrap_or_default();
    format!("{} of {} spp · {:.1} Mray/s{error}{left}", state.spp_done(), state.spp, rays_per_s / 1e6)
}

/// `1:02:03`, `4:05` or `6 s`.
pub(crate) fn duration(seconds: f64) -> String {
    let whole = seconds.round() as u64;
    match (whole / 3600, whole / 60 % 60, whole % 60) {
        (0, 0, s) => format!("{s} s"),
        (0, m, s) => format!("{m}:{s:02}"),
        (h, m, s) => format!("{h}:{m:02}:{s:02}"),
    }
}

/// A line on standard error; that it may be closed is no reason to stop.
pub(crate) fn say(line: &str) {
    let _ = writeln!(stderr(), "{line}");
}
