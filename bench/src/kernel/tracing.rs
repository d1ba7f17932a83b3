//! Rays per second of one thread, by the processor time of the thread.

use std::io::Write;

use eyebeam_bvh::{Bvh, Quality};

use super::embree::{BuildQuality, Embree, EmbreeScene};
use super::meshes::{MeshName, Model};
use super::rays::{RaySet, sets};
use super::table::{mega, row};
use super::tracer::{Answers, Batched, OneByOne, Tracer};
use super::{Outcome, Plan};
use crate::measure::{median, thread_time};

/// Turns that all take in each round: what slows the processor for a while slows all.
const TURNS: usize = 4;

/// The first of the subjects.
const OURS: usize = 4;

/// A tracer and its name in the table.
struct Subject<'a> {
    name: &'static str,
    tracer: &'a dyn Tracer,
}

/// Both qualities of ours, ray by ray and in batches, against Embree of high quality; for information
/// medium, and high with the promise that ours makes: no ray passes between triangles that share an edge.
pub(super) fn run(meshes: &[(MeshName, Model)], plan: Plan, embree: Option<&Embree>, out: &mut dyn Write) -> Outcome {
    for (name, model) in meshes {
        let balanced = Bvh::build(&model.mesh(), Quality::Balanced)?.with_rays_in_flight(true);
        let best = Bvh::build(&model.mesh(), Quality::Best)?.with_rays_in_flight(true);
        let build = |quality| embree.map(|embree| EmbreeScene::build(embree, model, quality)).transpose();
        let (high, medium) = (build(BuildQuality::High)?, build(BuildQuality::Medium)?);
        let robust = embree.map(|embree| EmbreeScene::build_robust(embree, model)).transpose()?;
        let (balanced_1, balanced_n, best_1, best_n) =
            (OneByOne(&balanced), Batched(&balanced), OneByOne(&best), Batched(&best));
        let mut subjects = vec![
            Subject { name: "balanced", tracer: &balanced_1 },
            Subject { name: "balanced, batch", tracer: &balanced_n },
            Subject { name: "best", tracer: &best_1 },
            Subject { name: "best, batch", tracer: &best_n },
        ];
        if let (Some(high), Some(robust), Some(medium)) = (&high, &robust, &medium) {
            subjects.push(Subject { name: "Embree high", tracer: high });
            subjects.push(Subject { name: "Embree robust", tracer: robust });
            subjects.push(Subject { name: "Embree medium", tracer: medium });
        }
        let sets = sets(model, &balanced, plan.resolution);
        let results: Vec<_> = sets.iter().map(|set| measure(set, &subjects, plan.rounds)).collect();
        writeln!(out, "\n### {}, {} triangles\n", name.label(), model.triangles.len())?;
        rates(&sets, &subjects, &results, out)?;
        if embree.is_some() {
            ratios("Embree high", &subjects, &sets, &subjects, &results, out)?;
            ratios("Embree robust", &subjects[..OURS], &sets, &subjects, &results, out)?;
        }
        writeln!(out, "\nDiffering from the first column, of all rays:\n")?;
        differences(&sets, &subjects, &results, out)?;
    }
    Ok(())
}

/// What each subject took for each round, and what it answered last.
struct Measured {
    seconds: Vec<Vec<f64>>,
    answers: Vec<Answers>,
}

/// All subjects in turn, chunk by chunk, round by round.
fn measure(set: &RaySet, subjects: &[Subject<'_>], rounds: usize) -> Measured {
    let mut answers: Vec<_> = subjects.iter().map(|_| Answers::new(set)).collect();
    let mut seconds = vec![vec![0.0; rounds]; subjects.len()];
    let chunk = set.rays.len().div_ceil(TURNS).next_multiple_of(Batched::SIZE).max(Batched::SIZE);
    for round in 0..rounds {
        for (turn, rays) in set.rays.chunks(chunk).enumerate() {
            for ((subject, answers), seconds) in subjects.iter().zip(&mut answers).zip(&mut seconds) {
                let time = thread_time(|| answers.fill(subject.tracer, rays, turn * chunk));
                seconds[round] += time.as_secs_f64();
            }
        }
    }
    Measured { seconds, answers }
}

fn rates(sets: &[RaySet], subjects: &[Subject<'_>], results: &[Measured], out: &mut dyn Write) -> Outcome {
    header("Mrays/s", subjects, out)?;
    for (set, result) in sets.iter().zip(results) {
        let rate = |seconds: &Vec<f64>| format!("{:.2}", mega(set.rays.len(), median(seconds.clone())));
        row(out, set.name, result.seconds.iter().map(rate))?;
    }
    Ok(())
}

/// Medians of the ratios of each round to the yardstick's, for some of the subjects.
fn ratios(
    yardstick: &str,
    columns: &[Subject<'_>],
    sets: &[RaySet],
    subjects: &[Subject<'_>],
    results: &[Measured],
    out: &mut dyn Write,
) -> Outcome {
    let Some(position) = subjects.iter().position(|subject| subject.name == yardstick) else {
        return Ok(());
    };
    writeln!(out)?;
    header(&format!("over {yardstick}"), columns, out)?;
    let mut logs = vec![0.0; columns.len()];
    for (set, result) in sets.iter().zip(results) {
        let theirs = &result.seconds[position];
        let ratio = |ours: &Vec<f64>| median(theirs.iter().zip(ours).map(|(theirs, ours)| theirs / ours).collect());
        let ratios: Vec<f64> = result.seconds.iter().take(columns.len()).map(ratio).collect();
        for (log, ratio) in logs.iter_mut().zip(&ratios) {
            *log += ratio.ln() / sets.len() as f64;
        }
        row(out, set.name, ratios.iter().map(|ratio| format!("{ratio:.2}")))?;
    }
    row(out, "geometric mean", logs.iter().map(|log| format!("**{:.2}**", log.exp())))
}

/// Differences of a few rays in a hundred thousand are rays along edges, which kernels may round to either side.
fn differences(sets: &[RaySet], subjects: &[Subject<'_>], results: &[Measured], out: &mut dyn Write) -> Outcome {
    let names = subjects.iter().skip(1).map(|subject| subject.name.to_owned());
    super::table::header(out, "rays", [String::from("count")].into_iter().chain(names))?;
    for (set, result) in sets.iter().zip(results) {
        let others = result.answers.iter().skip(1);
        let counts = others.map(|answers| answers.differences(&result.answers[0]).to_string());
        row(out, set.name, [set.rays.len().to_string()].into_iter().chain(counts))?;
    }
    Ok(())
}

fn header(corner: &str, subjects: &[Subject<'_>], out: &mut dyn Write) -> Outcome {
    super::table::header(out, corner, subjects.iter().map(|subject| subject.name.to_owned()))
}
