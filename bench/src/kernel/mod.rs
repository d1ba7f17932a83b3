//! The ray kernel by itself and in a small path tracer: against Embree on meshes, and against the textbook's list and tree on spheres.
//!
//! Everything that is compared gets the same rays and takes turns in short pieces of work, so that a busy or slow machine
//! slows all. One thread is timed by its processor time and medians count; more threads by the clock, and the fastest round
//! counts. How often the answers differ is printed with the times.

mod building;
mod embree;
pub(crate) mod few_spheres;
mod meshes;
mod paths;
mod random;
mod rays;
mod scaling;
mod table;
mod tracer;
mod tracing;

use std::error::Error;
use std::io::Write;

use clap::ValueEnum;

pub use embree::Embree;
pub use meshes::{MeshName, Model};

/// Nothing, or why it did not work.
type Outcome = Result<(), Box<dyn Error>>;

/// What is measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Section {
    /// Rays per second of one thread
    Rays,
    /// Time and memory of builds
    Build,
    /// Rays per second of two threads
    Threads,
    /// Rays per second on spheres, against the textbook's list and tree
    Spheres,
    /// Samples per second of a small path tracer, one path at a time and in batches
    Paths,
}

/// What is measured, and how thoroughly.
#[derive(Clone, Copy, Debug, clap::Args)]
pub struct Options {
    /// The only mesh to measure; without it, the three large ones
    #[arg(long)]
    pub mesh: Option<MeshName>,
    /// The only thing to measure; without it, everything
    #[arg(long)]
    pub section: Option<Section>,
    /// Primary rays in each direction; its square is their number
    #[arg(long, default_value_t = 512, value_parser = clap::value_parser!(u32).range(16..=8192))]
    pub resolution: u32,
    /// A few rays through the smallest mesh, once: to see that it works
    #[arg(long)]
    pub quick: bool,
}

/// How thoroughly things are measured.
#[derive(Clone, Copy)]
struct Plan {
    resolution: u32,
    rounds: usize,
}

impl Plan {
    /// A build takes as long as many rounds of rays.
    fn build_rounds(self) -> usize {
        self.rounds.div_ceil(3)
    }
}

/// Measures, and prints tables.
///
/// # Errors
/// What Embree reports, and what writing to `out` does.
pub fn run(
    options: &Options,
    rounds: usize,
    embree: Option<&Embree>,
    out: &mut dyn Write,
) -> Result<(), Box<dyn Error>> {
    let plan = if options.quick {
        Plan { resolution: 64, rounds: 1 }
    } else {
        Plan { resolution: options.resolution, rounds: rounds.max(1) }
    };
    let names = match options.mesh {
        Some(name) => vec![name],
        None if options.quick => vec![MeshName::Boxes],
        None => MeshName::LARGE.to_vec(),
    };
    let is_wanted = |section| options.section.is_none_or(|only| only == section);
    let needs_meshes = options.section != Some(Section::Spheres);
    let meshes: Vec<_> = names.into_iter().filter(|_| needs_meshes).map(|name| (name, name.model())).collect();
    if is_wanted(Section::Rays) {
        tracing::run(&meshes, plan, embree, out)?;
    }
    if is_wanted(Section::Build) {
        building::run(&meshes, plan, embree, out)?;
    }
    if is_wanted(Section::Threads) {
        scaling::run(&meshes, plan, embree, out)?;
    }
    if is_wanted(Section::Spheres) {
        few_spheres::run(plan, out)?;
    }
    if is_wanted(Section::Paths) {
        let boxes = MeshName::Boxes.model();
        let mut meshes: Vec<_> = meshes.iter().map(|(name, model)| (*name, model)).collect();
        // The Cornell box shows what each path costs without much traversal.
        if options.mesh.is_none() && !options.quick {
            meshes.insert(0, (MeshName::Boxes, &boxes));
        }
        paths::run(&meshes, plan, out)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use eyebeam_bvh::{Bvh, Quality};

    use super::tracer::{Answers, Batched, OneByOne, Tracer};
    use super::*;

    /// Rays one by one and in batches, through trees of every quality: what a test of every triangle finds.
    #[test]
    fn hits_are_those_of_brute_force() {
        let model = MeshName::Boxes.model();
        let list = Bvh::list(&model.mesh()).unwrap();
        let ask = |tracer: &dyn Tracer, set: &rays::RaySet| {
            let mut answers = Answers::new(set);
            answers.fill(tracer, &set.rays, 0);
            answers
        };
        for quality in Quality::ALL {
            let bvh = Bvh::build(&model.mesh(), quality).unwrap().with_rays_in_flight(true);
            for set in rays::sets(&model, &list, 48) {
                assert!(set.rays.len() > 100, "{}", set.name);
                let expected = ask(&OneByOne(&list), &set);
                let (one, batched) = (OneByOne(&bvh), Batched(&bvh));
                for tracer in [&one as &dyn Tracer, &batched] {
                    assert_eq!(ask(tracer, &set).differences(&expected), 0, "{} {quality:?}", set.name);
                }
            }
        }
    }

    #[test]
    fn quick_run_prints_every_table() {
        let options = Options { mesh: None, section: None, resolution: 512, quick: true };
        let mut out = Vec::new();
        run(&options, 9, None, &mut out).unwrap();
        let out = String::from_utf8(out).unwrap();
        for row in [
            "| primary |",
            "| shadow of bounce 1 |",
            "| best / high | 2 |",
            "| balanced, batch |",
            "| 485 |",
            "| 64, rays in flight |",
        ] {
            assert!(out.contains(row), "{row} is missing from\n{out}");
        }
    }
}
