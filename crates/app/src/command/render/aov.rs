//! What a picture tells besides light: `--aov`.

use eyebeam_core::desc::SceneDesc;
use eyebeam_core::film::{Aov, Film, channels};
use eyebeam_core::first_hits::FirstHits;
use eyebeam_core::render::{Monitor, Settings};
use eyebeam_core::scene::Scene;
use eyebeam_io::image::encode_channels;
use serde::Serialize;

use crate::command::target::Target;
use crate::error::Error;

/// The quantities that are asked for, in the making.
pub(super) struct Aovs<'s> {
    list: Vec<Aov>,
    through: bool,
    /// Names of ids, as JSON.
    names: String,
    /// None if nothing of the list needs it.
    hits: Option<FirstHits<'s>>,
}

/// What a picture says of its quantities.
#[derive(Debug, Serialize)]
pub(super) struct About {
    names: Vec<&'static str>,
    /// Whether albedo and normals are those of what mirrors and glass show.
    through: bool,
    /// Samples a pixel of what is seen first.
    spp: u32,
}

impl<'s> Aovs<'s> {
    /// Those of the list; `names` are those of ids, as JSON.
    pub(super) fn new(scene: &'s Scene, settings: &Settings, list: Vec<Aov>, through: bool, names: &str) -> Self {
        let needed = list.iter().any(|aov| aov.is_of_first_hit());
        let hits = needed.then(|| FirstHits::new(scene, settings.clone(), through));
        Self { list, through, names: names.to_owned(), hits }
    }

    /// Bytes that they take, in the making and in the file.
    pub(super) fn bytes(settings: &Settings, list: &[Aov]) -> u64 {
        let Settings { width, height, .. } = *settings;
        let hits = if list.iter().any(|aov| aov.is_of_first_hit()) { FirstHits::bytes(width, height) } else { 0 };
        let channels: usize = list.iter().map(|aov| aov.channel_count()).sum();
        // Colours are channels like the others then. Each is there as such, and in the file, and once more while that grows.
        let colors = if list.is_empty() { 0 } else { 4 };
        let numbers = 4 * (channels + colors) as u64;
        hits + 3 * numbers * u64::from(width) * u64::from(height)
    }

    pub(super) fn is_done(&self) -> bool {
        self.hits.as_ref().is_none_or(FirstHits::is_done)
    }

    pub(super) fn step(&mut self, monitor: &Monitor) {
        if let Some(hits) = &mut self.hits {
            hits.step(monitor);
        }
    }

    /// Samples a pixel.
    pub(super) fn spp(&self) -> u32 {
        self.hits.as_ref().map_or(0, FirstHits::spp)
    }

    pub(super) fn about(&self) -> About {
        About { names: self.list.iter().map(|aov| aov.name()).collect(), through: self.through, spp: self.spp() }
    }

    /// The picture's file.
    pub(super) fn encode(&self, film: &Film, target: &Target, provenance: &str) -> Result<Vec<u8>, Error> {
        let image = film.develop();
        if self.list.is_empty() {
            return Ok(target.format.encode(&image, provenance, &target.encoding)?);
        }
        let hits = self.hits.as_ref().map_or(&[][..], FirstHits::pixels);
        Ok(encode_channels(&image, channels(&self.list, hits, film), &self.names, provenance, target.encoding.half)?)
    }
}

/// Names of the ids in a scene, as JSON, if they are asked for.
pub(super) fn names(desc: &SceneDesc, list: &[Aov]) -> String {
    let names = if list.contains(&Aov::Id) { Names::of(desc) } else { Names::default() };
    serde_json::to_string(&names).unwrap_or_default()
}

/// Names of ids: that of id 3 is the third after the empty one.
#[derive(Debug, Default, Serialize)]
struct Names<'d> {
    object: Vec<String>,
    material: Vec<&'d str>,
}

impl<'d> Names<'d> {
    fn of(desc: &'d SceneDesc) -> Self {
        let nothing = String::new();
        Self {
            object: std::iter::once(nothing).chain(desc.object_names()).collect(),
            material: std::iter::once("").chain(desc.material_names()).collect(),
        }
    }
}
