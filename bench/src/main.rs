//! `eyebeam-bench`: prints measurements as tables.
#![forbid(unsafe_code)]

use std::error::Error;
use std::io::stdout;
use std::num::NonZeroUsize;
use std::time::Instant;

use clap::{Parser, Subcommand};
use eyebeam_bench::kernel::{self, Embree, Options};
use eyebeam_bench::measure::{median, read_scene, render, samples, shrink, thread_time};
use eyebeam_bench::peers::{self, Peer};
use eyebeam_bench::textbook::Textbook;
use eyebeam_bench::textures;
use eyebeam_bench::{materials, strategies};
use eyebeam_core::desc::SceneDesc;
use eyebeam_core::scene::Scene;

/// Measures the renderer.
#[derive(Parser)]
struct Args {
    #[command(subcommand)]
    command: Command,
    /// Times that everything is measured, in turn
    #[arg(long, default_value_t = 9, global = true, value_parser = clap::value_parser!(u32).range(1..))]
    rounds: u32,
    /// Width of the picture
    #[arg(long, default_value_t = 400, global = true, value_parser = clap::value_parser!(u32).range(1..=8192))]
    width: u32,
    /// Samples per pixel
    #[arg(long, default_value_t = 8, global = true, value_parser = clap::value_parser!(u32).range(1..=65536))]
    spp: u32,
}

#[derive(Subcommand)]
enum Command {
    /// Samples per second of one core, against the textbook program's: medians
    Compare,
    /// Samples per second of several threads, against one's: the best of all rounds
    Threads,
    /// The ray kernel against Embree and against the textbook's ways to find a hit: rays, builds, threads
    Kernel(Options),
    /// What light sampling, Sobol points, the light tree and the choice of strategy are worth
    Strategies,
    /// What a sample of each material costs, beside a lambertian one
    Materials,
    /// What a lookup of each kind of texture costs, and what filters of pictures are worth
    Textures,
    /// A picture of a scene that several renderers are compared on (bench/peers)
    Peer(Peer),
}

fn main() -> Result<(), Box<dyn Error>> {
    let args = Args::parse();
    match &args.command {
        Command::Compare => compare(&args),
        Command::Threads => threads(&args),
        Command::Kernel(options) => {
            let embree = Embree::load().inspect_err(|message| eprintln!("{message}")).ok();
            kernel::run(options, args.rounds as usize, embree.as_ref(), &mut stdout())
        }
        Command::Strategies => strategies::run(args.rounds as usize),
        Command::Materials => materials::run(args.rounds as usize),
        Command::Textures => textures::run(args.rounds as usize),
        Command::Peer(options) => peers::run(options, args.spp),
    }
}

/// Both programs in turn, so that a busy machine slows both; each by the processor time of its thread.
fn compare(args: &Args) -> Result<(), Box<dyn Error>> {
    println!("| spheres | eyebeam, Msamples/s | Mrays/s | textbook, Msamples/s | ratio |");
    println!("|---|---|---|---|---|");
    let mut desc = read_scene("weekend")?;
    shrink(&mut desc, args.width, args.spp);
    // The ground and the large ones come first.
    for spheres in [4, desc.shape.sphere.len()] {
        let mut desc = desc.clone();
        desc.shape.sphere.truncate(spheres);
        let scene = build(&desc)?;
        let textbook = Textbook::new(&desc)?;
        let rays = render(&scene, &desc, NonZeroUsize::MIN).1.rays.into_inner();
        let (mut ours, mut theirs, mut ratios) = (Vec::new(), Vec::new(), Vec::new());
        for _ in 0..args.rounds {
            let our = thread_time(|| render(&scene, &desc, NonZeroUsize::MIN)).as_secs_f64();
            let their = thread_time(|| textbook.render()).as_secs_f64();
            ours.push(our);
            theirs.push(their);
            ratios.push(their / our);
        }
        let mega_per_second = |count: u64, seconds: f64| count as f64 * 1e-6 / seconds;
        let (our, their, samples) = (median(ours), median(theirs), samples(&desc));
        println!(
            "| {spheres} | {:.2} | {:.1} | {:.3} | {:.2} |",
            mega_per_second(samples, our),
            mega_per_second(rays, our),
            mega_per_second(samples, their),
            median(ratios)
        );
    }
    Ok(())
}

/// By the clock. The fastest round counts: other programs can only slow one down.
fn threads(args: &Args) -> Result<(), Box<dyn Error>> {
    let available = std::thread::available_parallelism()?.get();
    let counts: Vec<_> = (0..).map(|i| 1 << i).take_while(|&n| n <= available).filter_map(NonZeroUsize::new).collect();
    let mut desc = read_scene("weekend")?;
    shrink(&mut desc, args.width, args.spp);
    let scene = build(&desc)?;
    let mut seconds = vec![Vec::new(); counts.len()];
    for _ in 0..args.rounds {
        for (seconds, &threads) in seconds.iter_mut().zip(&counts) {
            let start = Instant::now();
            render(&scene, &desc, threads);
            seconds.push(start.elapsed().as_secs_f64());
        }
    }
    println!("| threads | Msamples/s | speed-up |");
    println!("|---|---|---|");
    let fastest = |seconds: &Vec<f64>| seconds.iter().copied().fold(f64::INFINITY, f64::min);
    let rates: Vec<_> = seconds.iter().map(|s| samples(&desc) as f64 * 1e-6 / fastest(s)).collect();
    for (threads, rate) in counts.iter().zip(&rates) {
        println!("| {threads} | {rate:.2} | {:.2} |", rate / rates[0]);
    }
    Ok(())
}

fn build(desc: &SceneDesc) -> Result<Scene, String> {
    Scene::build(desc).map_err(|problems| format!("{problems:?}"))
}
