//! How long renders take on one thread.

use std::num::NonZeroUsize;
use std::sync::atomic::Ordering::Relaxed;
use std::time::{Duration, Instant};

use eyebeam_core::render::{Monitor, Settings};
use eyebeam_core::scene::Scene;

use super::finished;

/// A render to be timed.
pub(super) struct Job<'a> {
    pub(super) scene: &'a Scene,
    pub(super) settings: Settings,
}

/// What a render took.
#[derive(Clone, Copy, Debug)]
pub(super) struct Timing {
    pub(super) seconds: f64,
    pub(super) rays: u64,
}

/// Times each job once a round, for `rounds` rounds, and returns the medians: what disturbs the machine for a while
/// disturbs one round of all jobs, not all rounds of one.
pub(super) fn medians(jobs: &[Job<'_>], rounds: usize, least: Duration, mut done: impl FnMut(usize)) -> Vec<Timing> {
    let mut timings = vec![Vec::new(); jobs.len()];
    for round in 1..=rounds {
        for (timings, job) in timings.iter_mut().zip(jobs) {
            timings.push(job.time(least));
        }
        done(round);
    }
    timings.into_iter().filter_map(median).collect()
}

fn median(mut timings: Vec<Timing>) -> Option<Timing> {
    timings.sort_by(|a, b| a.seconds.total_cmp(&b.seconds));
    timings.get(timings.len() / 2).copied()
}

impl Job<'_> {
    /// The mean over as many repetitions as fill the time.
    fn time(&self, least: Duration) -> Timing {
        let clock = Instant::now();
        let mut repetitions = 0;
        loop {
            let rays = self.render();
            repetitions += 1;
            let elapsed = clock.elapsed();
            if elapsed >= least {
                return Timing { seconds: elapsed.as_secs_f64() / f64::from(repetitions), rays };
            }
        }
    }

    /// Renders on one thread; returns the number of rays.
    fn render(&self) -> u64 {
        let monitor = Monitor::default();
        finished(self.scene, Settings { threads: NonZeroUsize::MIN, ..self.settings.clone() }, &monitor);
        monitor.rays.load(Relaxed)
    }
}
