//! The command line.

mod look;
mod model;
mod template;

use std::num::NonZeroUsize;
use std::path::PathBuf;

use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{Args as ClapArgs, Parser, Subcommand, ValueEnum};
use eyebeam_core::desc::RenderDesc;
use eyebeam_core::film::Aov;
use eyebeam_core::integrator::IntegratorKind;
use eyebeam_io::scene::Override;

use look::LookArgs;
pub(crate) use model::{CameraArg, EnvironmentArg, ModelArgs, SetupArgs};
pub(crate) use template::Template;

/// Photorealistic pictures by backward ray tracing.
#[derive(Debug, Parser)]
#[command(name = "eyebeam", version, propagate_version = true, arg_required_else_help = true)]
pub(crate) struct Args {
    #[command(subcommand)]
    pub(crate) command: Command,
}

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Render a scene to a picture
    Render(RenderArgs),
    /// Render a model from all around, for a film in which it turns
    Turntable(TurntableArgs),
    /// Turn a picture of linear light (.exr, .hdr) into one for screens
    Develop(DevelopArgs),
    /// Report every problem of a scene without rendering it
    Check(CheckArgs),
    /// Tell what is in a scene or a model
    Info(InfoArgs),
    /// Make a scene file of a model or of another scene, to be edited
    Convert(ConvertArgs),
    /// Print the JSON Schema of scene files, for editors
    Schema,
    /// Make the figures and measurements of a study
    Figures(FiguresArgs),
    /// Check on this machine, in seconds, that pictures are right
    Selftest,
}

#[derive(Debug, ClapArgs)]
pub(crate) struct RenderArgs {
    /// Scene file (.toml) or model (.gltf, .glb, .obj, .ply, .stl); - reads a scene from standard input
    pub(crate) scene: PathBuf,
    /// Picture to write (.png, .jpg, .exr, .hdr); - writes a PNG to standard output [default: SCENE.png]
    #[arg(short, long)]
    pub(crate) output: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) picture: PictureArgs,
}

#[derive(Debug, ClapArgs)]
pub(crate) struct TurntableArgs {
    /// Model (.gltf, .glb, .obj, .ply, .stl) or scene file (.toml); - reads a scene from standard input
    pub(crate) scene: PathBuf,
    /// Pictures of a full turn
    #[arg(short = 'n', long, value_name = "N", default_value_t = 36, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    pub(crate) frames: u32,
    /// Pictures to write (.png, .jpg, .exr, .hdr): {frame} is the number from 0, {frame:04} has four digits, {model} the file's name
    #[arg(short, long, default_value = "{model}-{frame:04}.png")]
    pub(crate) output: Template,
    #[command(flatten)]
    pub(crate) picture: PictureArgs,
}

/// How pictures are made.
#[derive(Debug, ClapArgs)]
pub(crate) struct PictureArgs {
    /// Samples per pixel
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=i64::from(RenderDesc::MAX_SPP)))]
    pub(crate) spp: Option<u32>,
    /// The most edges of a path: 1 draws only what shines
    #[arg(long, value_name = "D", value_parser = clap::value_parser!(u32).range(0..=i64::from(RenderDesc::MAX_DEPTH)))]
    pub(crate) max_depth: Option<u32>,
    /// Chooses the random numbers
    #[arg(long)]
    pub(crate) seed: Option<u64>,
    /// Size of the picture
    #[arg(short, long, value_name = "WxH", value_parser = resolution)]
    pub(crate) resolution: Option<(u32, u32)>,
    /// How light is traced
    #[arg(long, value_parser = integrator())]
    pub(crate) integrator: Option<IntegratorKind>,
    /// Leave the background out where the camera sees it: the picture gets an alpha
    #[arg(long)]
    pub(crate) transparent: bool,
    /// Darken samples of higher luminance to this one: fewer bright specks, and less light [default: off]
    #[arg(long, value_name = "L", value_parser = clamp)]
    pub(crate) clamp: Option<f32>,
    /// More channels, for .exr: depth,normal and so on, or all
    #[arg(long, value_name = "NAMES", value_delimiter = ',', value_parser = aovs())]
    pub(crate) aov: Vec<AovChoice>,
    /// Albedo and normals of what perfect mirrors and smooth glass show, not theirs
    #[arg(long, requires = "aov")]
    pub(crate) aov_through: bool,
    /// Threads [default: the processors this process may use]
    #[arg(short, long, value_name = "N")]
    pub(crate) threads: Option<NonZeroUsize>,
    /// Refuse work that needs more memory than this
    #[arg(long, value_name = "BYTES", default_value = "8G", value_parser = memory)]
    pub(crate) memory: u64,
    /// Change a value of the scene, as in -D camera.vfov=30
    #[arg(short = 'D', value_name = "KEY=VALUE", value_parser = setting)]
    pub(crate) set: Vec<Override>,
    /// Take warnings about the scene for errors
    #[arg(long)]
    pub(crate) strict: bool,
    /// How to show progress
    #[arg(long, value_enum, default_value_t)]
    pub(crate) progress: ProgressStyle,
    /// Write what was done and how long it took as JSON; - writes to standard output
    #[arg(long, value_name = "FILE")]
    pub(crate) stats: Option<PathBuf>,
    /// Say nothing but errors
    #[arg(short, long)]
    pub(crate) quiet: bool,
    /// Say more
    #[arg(short, long, conflicts_with = "quiet")]
    pub(crate) verbose: bool,
    #[command(flatten)]
    pub(crate) look: LookArgs,
    #[command(flatten)]
    pub(crate) model: ModelArgs,
    #[command(flatten)]
    pub(crate) setup: SetupArgs,
}

impl PictureArgs {
    /// Each quantity that is asked for, once, in the order of their names' list.
    pub(crate) fn aovs(&self) -> Vec<Aov> {
        let asked = |aov: Aov| self.aov.iter().any(|choice| choice.0.is_none_or(|chosen| chosen == aov));
        Aov::NAMES.iter().map(|(_, aov)| *aov).filter(|aov| asked(*aov)).collect()
    }
}

/// A quantity, or all of them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct AovChoice(Option<Aov>);

#[derive(Debug, ClapArgs)]
pub(crate) struct DevelopArgs {
    /// Picture of linear light (.exr, .hdr); - reads standard input
    pub(crate) picture: PathBuf,
    /// Picture to write (.png, .jpg, .exr, .hdr), with colours and alpha alone; - writes a PNG to standard output
    #[arg(short, long)]
    pub(crate) output: PathBuf,
    /// Say nothing but errors
    #[arg(short, long)]
    pub(crate) quiet: bool,
    #[command(flatten)]
    pub(crate) look: LookArgs,
}

#[derive(Debug, ClapArgs)]
pub(crate) struct CheckArgs {
    /// Scene file (.toml) or model (.gltf, .glb, .obj, .ply, .stl); - reads a scene from standard input
    pub(crate) scene: PathBuf,
    #[command(flatten)]
    pub(crate) model: ModelArgs,
    /// Change a value of the scene, as in -D camera.vfov=30
    #[arg(short = 'D', value_name = "KEY=VALUE", value_parser = setting)]
    pub(crate) set: Vec<Override>,
    /// Take warnings about the scene for errors
    #[arg(long)]
    pub(crate) strict: bool,
    /// Refuse files that need more memory than this
    #[arg(long, value_name = "BYTES", default_value = "8G", value_parser = memory)]
    pub(crate) memory: u64,
}

#[derive(Debug, ClapArgs)]
pub(crate) struct InfoArgs {
    /// Scene file (.toml) or model (.gltf, .glb, .obj, .ply, .stl); - reads a scene from standard input
    pub(crate) file: PathBuf,
    /// Print it as one JSON object
    #[arg(long)]
    pub(crate) json: bool,
    #[command(flatten)]
    pub(crate) model: ModelArgs,
    /// Change a value of the scene, as in -D camera.vfov=30
    #[arg(short = 'D', value_name = "KEY=VALUE", value_parser = setting)]
    pub(crate) set: Vec<Override>,
}

#[derive(Debug, ClapArgs)]
pub(crate) struct ConvertArgs {
    /// Scene file (.toml) or model (.gltf, .glb, .obj, .ply, .stl); - reads a scene from standard input
    pub(crate) scene: PathBuf,
    /// Scene file to write (.toml); meshes and pictures go into a folder beside it
    pub(crate) output: PathBuf,
    /// Replace what is there
    #[arg(long)]
    pub(crate) force: bool,
    /// Size of the picture, which the camera in front of a model depends on
    #[arg(short, long, value_name = "WxH", value_parser = resolution)]
    pub(crate) resolution: Option<(u32, u32)>,
    /// Change a value of the scene, as in -D camera.vfov=30
    #[arg(short = 'D', value_name = "KEY=VALUE", value_parser = setting)]
    pub(crate) set: Vec<Override>,
    /// Take warnings about the scene for errors
    #[arg(long)]
    pub(crate) strict: bool,
    /// Say nothing but errors
    #[arg(short, long)]
    pub(crate) quiet: bool,
    /// Say more
    #[arg(short, long, conflicts_with = "quiet")]
    pub(crate) verbose: bool,
    #[command(flatten)]
    pub(crate) model: ModelArgs,
    #[command(flatten)]
    pub(crate) setup: SetupArgs,
}

#[derive(Debug, ClapArgs)]
pub(crate) struct FiguresArgs {
    /// Which study
    #[arg(value_enum)]
    pub(crate) study: Study,
    /// Folder for the pictures and numbers
    #[arg(short, long, value_name = "DIR")]
    pub(crate) output: PathBuf,
    /// Small pictures and few samples, in seconds
    #[arg(long)]
    pub(crate) quick: bool,
    /// Say nothing but errors
    #[arg(short, long)]
    pub(crate) quiet: bool,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum Study {
    /// Sample count, recursion depth, roughness and cost of backward ray tracing
    Paper,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum ProgressStyle {
    /// A bar on a terminal, lines elsewhere
    #[default]
    Auto,
    /// A bar
    Bar,
    /// One JSON object a line
    Json,
    /// Nothing
    None,
}

fn resolution(text: &str) -> Result<(u32, u32), String> {
    let side = |s: &str| s.trim().parse().ok().filter(|side| (1..=RenderDesc::MAX_SIDE).contains(side));
    let (width, height) = text.split_once(['x', 'X', '×']).ok_or("write it as WIDTHxHEIGHT, such as 1920x1080")?;
    let sides = side(width).zip(side(height));
    sides.ok_or_else(|| format!("width and height must be whole numbers from 1 to {}", RenderDesc::MAX_SIDE))
}

fn integrator() -> impl TypedValueParser<Value = IntegratorKind> {
    let named = |name: String| IntegratorKind::NAMES.iter().find(|(n, _)| *n == name).map(|(_, kind)| *kind);
    PossibleValuesParser::new(IntegratorKind::NAMES.iter().map(|(name, _)| name))
        .try_map(move |name| named(name).ok_or("there is no such integrator"))
}

fn aovs() -> impl TypedValueParser<Value = AovChoice> {
    let named = |name: String| Aov::NAMES.iter().find(|(n, _)| *n == name).map(|(_, aov)| *aov);
    PossibleValuesParser::new(Aov::NAMES.iter().map(|(name, _)| *name).chain(["all"])).map(move |n| AovChoice(named(n)))
}

fn clamp(text: &str) -> Result<f32, String> {
    let clamp = text.parse().ok().filter(|clamp| (0.0..=RenderDesc::MAX_CLAMP).contains(clamp));
    clamp.ok_or_else(|| format!("use a number from 0, which is off, to {:e}", RenderDesc::MAX_CLAMP))
}

/// `8G`: bytes, with a binary prefix.
fn memory(text: &str) -> Result<u64, String> {
    let digits = text.trim_end_matches(|c: char| !c.is_ascii_digit());
    let shift = match text[digits.len()..].trim().to_ascii_uppercase().trim_end_matches("IB").trim_end_matches('B') {
        "" => 0,
        "K" => 10,
        "M" => 20,
        "G" => 30,
        "T" => 40,
        _ => return Err("write it as 500M, 8G or 1T".to_owned()),
    };
    let number: u64 = digits.parse().map_err(|_| "write it as 500M, 8G or 1T")?;
    number.checked_mul(1 << shift).ok_or_else(|| "that is more than there can be".to_owned())
}

fn setting(text: &str) -> Result<Override, String> {
    let (path, value) = text.split_once('=').ok_or("write it as KEY=VALUE, such as camera.vfov=30")?;
    Ok(Override { path: path.trim().to_owned(), value: value.trim().to_owned() })
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn command_line_is_sound() {
        Args::command().debug_assert();
    }

    #[test]
    fn sizes() {
        assert_eq!(resolution("1920x1080"), Ok((1920, 1080)));
        for bad in ["0x0", "10", "10x", "-1x5", "99999999999x1", "axb"] {
            assert!(resolution(bad).is_err(), "{bad}");
        }
        assert_eq!(memory("8G"), Ok(8 << 30));
        assert_eq!(memory("500 MiB"), Ok(500 << 20));
        assert_eq!(memory("123"), Ok(123));
        for bad in ["", "G", "1X", "99999999999T", "-1"] {
            assert!(memory(bad).is_err(), "{bad}");
        }
    }
}
