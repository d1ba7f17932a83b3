//! What a picture costs: time against its size W·H, samples S, depth D and the number of objects N.
//!
//! In a closed room every path has D edges, and time is proportional to W·H·S·D; in an open scene paths end in the sky, and
//! that is only an upper bound. With a list of N objects every ray tests them all, time ∝ N; with a bounding volume
//! hierarchy it grows as log N. All on one thread.

mod graph;
mod scenes;

use std::time::Duration;

use eyebeam_core::render::Settings;
use eyebeam_core::scene::{Acceleration, BuildOptions, Scene};
use graph::draw;
use scenes::{closed_room, crowd};

use super::fit::Fit;
use super::table::{Cell, Table};
use super::timing::{Job, Timing, medians};
use super::{Study, build, refused, scene};
use crate::error::Error;

pub(super) const NAME: &str = "complexity";

/// What is varied.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Variable {
    Pixels,
    Samples,
    Depth,
    Objects,
}

/// Times of renders that differ in one variable.
struct Sweep {
    variable: Variable,
    scene: &'static str,
    points: Vec<Point>,
}

struct Point {
    /// The variable's value.
    x: f64,
    /// W·H·S·D
    work: f64,
    timing: Timing,
}

impl Sweep {
    fn seconds(&self) -> Vec<(f64, f64)> {
        self.points.iter().map(|p| (p.x, p.timing.seconds)).collect()
    }

    /// What laws are fitted to. Lists so short that most of the time is not spent on their objects do not count.
    fn fitted_seconds(&self) -> Vec<(f64, f64)> {
        const SHORT: f64 = 256.0;
        let counts = |&(x, _): &(f64, f64)| self.scene != "list" || x >= SHORT;
        self.seconds().into_iter().filter(counts).collect()
    }

    fn power(&self) -> Fit {
        Fit::power(&self.fitted_seconds())
    }

    /// Time as a + b log₂ N, for the hierarchy.
    fn logarithm(&self) -> Option<Fit> {
        (self.scene == "bvh").then(|| Fit::logarithm(&self.fitted_seconds()))
    }
}

pub(super) fn make(study: &Study<'_>) -> Result<(), Error> {
    let closed = build(&closed_room())?;
    let open = build(&scene("spheres.toml", include_str!("../../../../../../scenes/spheres.toml"))?)?;
    let crowds = |acceleration| {
        let build = |n| {
            Ok((
                n,
                Scene::build_with(&crowd(n), BuildOptions { acceleration, ..BuildOptions::default() })
                    .map_err(refused)?,
            ))
        };
        (1..=study.pick(7, 5)).map(|k| build(4_u32.pow(k))).collect::<Result<Vec<_>, Error>>()
    };
    let (lists, trees) = (crowds(Acceleration::List)?, crowds(Acceleration::default())?);

    let mut plan = Plan::default();
    for (name, scene) in [("closed", &closed), ("open", &open)] {
        plan.sweep_settings(study, name, scene);
    }
    for (name, scenes) in [("list", &lists), ("bvh", &trees)] {
        plan.sweep_objects(study, name, scenes);
    }
    let sweeps = plan.measure(study);
    study.write(NAME, &draw(&sweeps)?, &table(&sweeps))
}

/// What will be measured.
#[derive(Default)]
struct Plan<'a> {
    jobs: Vec<Job<'a>>,
    /// Variable, scene, and the variable's value of each job.
    sweeps: Vec<(Variable, &'static str, Vec<f64>)>,
}

impl<'a> Plan<'a> {
    /// Varies size, samples and depth in turn.
    fn sweep_settings(&mut self, study: &Study<'_>, name: &'static str, scene: &'a Scene) {
        let side = study.pick(64, 16);
        let base = Settings { width: side, height: side, spp: 4, max_depth: 8, ..scenes::settings() };
        let powers = |count: u32| (0..count).map(|k| 1_u32 << k);
        let pixels = study.pick(5..10, 3..6).map(|k| 1 << k);
        let settings = pixels.map(|side| Settings { width: side, height: side, spp: 1, ..base.clone() });
        self.sweep(Variable::Pixels, name, settings.map(|s| (f64::from(s.width * s.height), scene, s)));
        let settings = powers(study.pick(8, 4)).map(|spp| Settings { spp, ..base.clone() });
        self.sweep(Variable::Samples, name, settings.map(|s| (f64::from(s.spp), scene, s)));
        let settings = powers(study.pick(8, 4)).map(|max_depth| Settings { max_depth, ..base.clone() });
        self.sweep(Variable::Depth, name, settings.map(|s| (f64::from(s.max_depth), scene, s)));
    }

    /// Varies the number of objects.
    fn sweep_objects(&mut self, study: &Study<'_>, name: &'static str, scenes: &'a [(u32, Scene)]) {
        let side = study.pick(64, 16);
        let settings = Settings { width: side, height: side, spp: 4, max_depth: 2, ..scenes::settings() };
        let jobs = scenes.iter().map(|(n, scene)| (f64::from(*n), scene, settings.clone()));
        self.sweep(Variable::Objects, name, jobs);
    }

    fn sweep(
        &mut self,
        variable: Variable,
        name: &'static str,
        jobs: impl Iterator<Item = (f64, &'a Scene, Settings)>,
    ) {
        let mut xs = Vec::new();
        for (x, scene, settings) in jobs {
            xs.push(x);
            self.jobs.push(Job { scene, settings });
        }
        self.sweeps.push((variable, name, xs));
    }

    fn measure(self, study: &Study<'_>) -> Vec<Sweep> {
        let (rounds, least) = study.pick((7, Duration::from_millis(25)), (1, Duration::from_millis(1)));
        let said = |round| study.say(&format!("complexity: round {round} of {rounds}"));
        let timings = medians(&self.jobs, rounds, least, said);
        let mut measured = self.jobs.iter().zip(timings);
        let mut point = |x| {
            let (Job { settings, .. }, timing) = measured.next()?;
            let work = [settings.width, settings.height, settings.spp, settings.max_depth].map(f64::from);
            Some(Point { x, work: work.iter().product(), timing })
        };
        let sweep = |(variable, scene, xs): (_, _, Vec<f64>)| Sweep {
            variable,
            scene,
            points: xs.into_iter().filter_map(&mut point).collect(),
        };
        self.sweeps.into_iter().map(sweep).collect()
    }
}

fn table(sweeps: &[Sweep]) -> Table {
    let columns = [
        "variable",
        "scene",
        "value",
        "seconds",
        "rays",
        "pixels_samples_depth",
        "exponent",
        "exponent_r2",
        "seconds_per_doubling",
        "logarithm_r2",
    ];
    let mut table = Table::new(&columns);
    for sweep in sweeps {
        let (power, logarithm) = (sweep.power(), sweep.logarithm());
        for &Point { x, work, timing } in &sweep.points {
            table.push([
                Cell::from(sweep.variable.name()),
                sweep.scene.into(),
                x.into(),
                timing.seconds.into(),
                timing.rays.into(),
                work.into(),
                power.slope.into(),
                power.r2.into(),
                logarithm.map(|fit| fit.slope).into(),
                logarithm.map(|fit| fit.r2).into(),
            ]);
        }
    }
    table
}

impl Variable {
    fn name(self) -> &'static str {
        match self {
            Self::Pixels => "pixels",
            Self::Samples => "samples",
            Self::Depth => "depth",
            Self::Objects => "objects",
        }
    }
}
