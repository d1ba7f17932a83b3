//! Time and memory of builds, by the clock. The fastest round counts: other programs can only slow one down.

use std::io::Write;
use std::time::Instant;

use eyebeam_bvh::{Bvh, Quality};

use super::embree::{BuildQuality, Embree, EmbreeScene};
use super::meshes::{MeshName, Model};
use super::table::{header, row};
use super::{Outcome, Plan};

/// Ours and Embree's qualities that have the same purpose.
const PAIRS: [(&str, Quality, BuildQuality); 3] = [
    ("fast / low", Quality::Fast, BuildQuality::Low),
    ("balanced / medium", Quality::Balanced, BuildQuality::Medium),
    ("best / high", Quality::Best, BuildQuality::High),
];

/// Seconds of the fastest build, and the bytes of its tree.
#[derive(Clone, Copy)]
struct Build {
    seconds: f64,
    bytes: usize,
}

impl Build {
    const NONE: Self = Self { seconds: f64::INFINITY, bytes: 0 };

    /// Times `build`, which returns the tree's bytes.
    fn measure<E>(&mut self, build: impl FnOnce() -> Result<usize, E>) -> Result<(), E> {
        let start = Instant::now();
        self.bytes = build()?;
        self.seconds = self.seconds.min(start.elapsed().as_secs_f64());
        Ok(())
    }
}

/// Every quality on one and on two threads.
pub(super) fn run(meshes: &[(MeshName, Model)], plan: Plan, embree: Option<&Embree>, out: &mut dyn Write) -> Outcome {
    writeln!(out, "\n### Builds, by the clock\n")?;
    let columns =
        ["quality", "threads", "Eyebeam, s", "Embree, s", "speed ratio", "Eyebeam, B/triangle", "Embree, B/triangle"];
    header(out, "mesh", columns.map(str::to_owned).into_iter())?;
    for (name, model) in meshes {
        for (label, quality, embree_quality) in PAIRS {
            for threads in [1, 2] {
                let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build()?;
                let (mut ours, mut theirs) = (Build::NONE, embree.map(|_| Build::NONE));
                for _ in 0..plan.build_rounds() {
                    let build = || Bvh::build(&model.mesh(), quality).map(|bvh| bvh.stats().bytes);
                    pool.install(|| ours.measure(build))?;
                    if let (Some(embree), Some(theirs)) = (embree, &mut theirs) {
                        let mut scene = EmbreeScene::new(embree, model, embree_quality, threads)?;
                        theirs.measure(|| scene.commit())?;
                    }
                }
                let cells = cells(label, threads, model.triangles.len(), ours, theirs);
                row(out, name.label(), cells.into_iter())?;
            }
        }
    }
    Ok(())
}

fn cells(label: &str, threads: usize, triangles: usize, ours: Build, theirs: Option<Build>) -> [String; 7] {
    let seconds = |build: Build| format!("{:.3}", build.seconds);
    let bytes = |build: Build| format!("{:.1}", build.bytes as f64 / triangles as f64);
    let theirs_or_dash = |f: &dyn Fn(Build) -> String| theirs.map_or_else(|| "-".to_owned(), f);
    [
        label.to_owned(),
        threads.to_string(),
        seconds(ours),
        theirs_or_dash(&seconds),
        theirs_or_dash(&|theirs| format!("{:.2}", theirs.seconds / ours.seconds)),
        bytes(ours),
        theirs_or_dash(&bytes),
    ]
}
