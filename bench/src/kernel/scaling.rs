//! Nearest hits of the first bounce on one and on two threads, by the clock; the fastest round counts.

use std::io::Write;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};
use std::thread;
use std::time::Instant;

use eyebeam_bvh::{Bvh, Quality, Ray};

use super::embree::{BuildQuality, Embree, EmbreeScene};
use super::meshes::{MeshName, Model};
use super::rays::sets;
use super::table::{header, mega, row};
use super::tracer::{Batched, OneByOne, Tracer};
use super::{Outcome, Plan};

/// Rays that a thread takes at once.
const CHUNK: usize = 2048;

/// Ours of balanced quality, and Embree of high quality.
pub(super) fn run(meshes: &[(MeshName, Model)], plan: Plan, embree: Option<&Embree>, out: &mut dyn Write) -> Outcome {
    writeln!(out, "\n### Threads: nearest hits of the first bounce, by the clock\n")?;
    let columns = ["kernel", "1 thread, Mrays/s", "2 threads, Mrays/s", "speed-up"];
    header(out, "mesh", columns.map(str::to_owned).into_iter())?;
    for (name, model) in meshes {
        let bvh = Bvh::build(&model.mesh(), Quality::Balanced)?.with_rays_in_flight(true);
        let [_, bounce, ..] = sets(model, &bvh, plan.resolution);
        let high = embree.map(|embree| EmbreeScene::build(embree, model, BuildQuality::High)).transpose()?;
        let (one, batched) = (OneByOne(&bvh), Batched(&bvh));
        let mut subjects: Vec<(&str, &dyn Tracer)> = vec![("balanced", &one), ("balanced, batch", &batched)];
        if let Some(high) = &high {
            subjects.push(("Embree high", high));
        }
        for (subject, [one, two]) in subjects.iter().zip(measure(&bounce.rays, &subjects, plan.rounds)) {
            let rate = |seconds| format!("{:.2}", mega(bounce.rays.len(), seconds));
            row(
                out,
                name.label(),
                [subject.0.to_owned(), rate(one), rate(two), format!("{:.2}", one / two)].into_iter(),
            )?;
        }
    }
    Ok(())
}

/// The shortest time of each subject on one and on two threads.
fn measure(rays: &[Ray], subjects: &[(&str, &dyn Tracer)], rounds: usize) -> Vec<[f64; 2]> {
    let mut fastest = vec![[f64::INFINITY; 2]; subjects.len()];
    for _ in 0..rounds {
        for ((_, tracer), fastest) in subjects.iter().zip(&mut fastest) {
            for (threads, fastest) in (1..).zip(fastest) {
                *fastest = fastest.min(trace(rays, *tracer, threads));
            }
        }
    }
    fastest
}

/// The seconds that the threads take together, from before the first starts until the last has ended.
fn trace(rays: &[Ray], tracer: &dyn Tracer, threads: usize) -> f64 {
    let next = AtomicUsize::new(0);
    let work = || {
        let mut distances = [0.0; CHUNK];
        while let Some(rays) = rays.chunks(CHUNK).nth(next.fetch_add(1, Relaxed)) {
            tracer.closest(rays, &mut distances);
        }
    };
    let start = Instant::now();
    thread::scope(|scope| {
        for _ in 1..threads {
            scope.spawn(work);
        }
        work();
    });
    start.elapsed().as_secs_f64()
}
