//! Scenes whose picture is known beforehand: the luminance that all its pixels have, as they look at the same point, or that
//! they have in the mean.

pub mod build;
mod facets;
mod facing;
mod far;
mod glass;
mod lamps;
mod moving;
mod room;
mod sky;
mod thin;
mod worn;

use std::num::NonZeroUsize;
use std::ops::Range;
use std::sync::OnceLock;

use crate::color::luminance;
use crate::desc::{RenderDesc, SceneDesc};
use crate::film::{PixelSum, Tile};
use crate::integrator::Integrator;
use crate::render::{Monitor, Render, Settings};
use crate::sampler::SamplerKind;
use crate::scene::Scene;
use crate::testing::Estimate;

/// A scene with the luminance of its picture.
#[derive(Clone, Debug)]
pub struct KnownScene {
    /// What it is.
    pub name: String,
    /// The scene.
    pub desc: SceneDesc,
    /// The most edges of a path.
    pub max_depth: u32,
    /// The mean luminance of a square picture.
    pub expected: f64,
    /// Whether surfaces' own directions find the light. Otherwise only integrators that sample lights see it.
    pub by_chance: bool,
}

/// All of them.
pub fn all() -> Vec<KnownScene> {
    /// Some of the numbers take a while to compute: once is enough.
    static ALL: OnceLock<Vec<KnownScene>> = OnceLock::new();
    let build = || {
        let surfaces =
            [room::scenes(), glass::scenes(), thin::scenes(), facets::scenes(), worn::scenes(), moving::scenes()];
        let lights = [lamps::scenes(), facing::scenes(), far::scenes(), sky::scenes()];
        [surfaces.concat(), lights.concat()].concat()
    };
    ALL.get_or_init(build).clone()
}

impl KnownScene {
    fn new(name: impl Into<String>, desc: SceneDesc, max_depth: u32, expected: f64) -> Self {
        Self { name: name.into(), desc, max_depth, expected, by_chance: true }
    }

    /// With light that only light sampling finds.
    fn hidden(self) -> Self {
        Self { by_chance: false, ..self }
    }

    /// Pixels along a side of the pictures that are rendered.
    const SIDE: u32 = 6;

    /// Renders a small picture for each of at least two seeds. Pixels are independent, also with Sobol points, which each
    /// pixel shifts by random numbers of its own: so the scatter of each from seed to seed tells the error of their mean.
    ///
    /// # Errors
    /// If the scene cannot be built, or samples were no numbers.
    pub fn render(
        &self,
        integrator: impl Fn() -> Box<dyn Integrator>,
        sampler: SamplerKind,
        spp: u32,
        seeds: Range<u64>,
    ) -> Result<Estimate, String> {
        let scene = Scene::build(&self.desc).map_err(|problems| format!("{problems:?}"))?;
        let mut pictures = Vec::new();
        for seed in seeds {
            let (width, height, max_depth) = (Self::SIDE, Self::SIDE, self.max_depth);
            let plain = RenderDesc { width, height, spp, max_depth, seed, ..RenderDesc::default() }.plain();
            let settings = Settings { sampler, threads: NonZeroUsize::MIN, ..Settings::from(&plain) };
            let mut render = Render::with_integrator(&scene, settings, integrator());
            render.finish(&Monitor::default());
            if render.film().sample_counts().dropped > 0 {
                return Err("samples are no numbers".to_owned());
            }
            let mean = |sum: &PixelSum| luminance(sum.mean().map(f64::from));
            pictures.push(render.film().tiles().iter().flat_map(Tile::pixels).map(|(_, sum)| mean(sum)).collect());
        }
        Ok(Estimate::of_pictures(&pictures))
    }

    /// Renders it and compares the luminance with what is known: a z-test at
    /// [`SIGNIFICANCE`](crate::testing::SIGNIFICANCE) over the number of tests that are run together.
    ///
    /// # Errors
    /// If it is farther off than noise and single precision allow.
    pub fn check(
        &self,
        integrator: impl Fn() -> Box<dyn Integrator>,
        sampler: SamplerKind,
        spp: u32,
    ) -> Result<(), String> {
        const TESTS: u32 = 200;
        const ROUNDING: f64 = 2e-5;
        self.render(integrator, sampler, spp, 0..8)?.z_test(self.expected, ROUNDING, TESTS)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::integrator::Weekend;

    #[test]
    fn scenes_are_sound_and_have_names_of_their_own() {
        let scenes = all();
        let mut names: Vec<_> = scenes.iter().map(|s| s.name.clone()).collect();
        names.sort();
        names.dedup();
        assert_eq!(names.len(), scenes.len());
        for scene in scenes {
            assert_eq!(scene.desc.check(), [], "{}", scene.name);
            assert!(scene.expected.is_finite() && scene.expected >= 0.0, "{}: {}", scene.name, scene.expected);
        }
    }

    #[test]
    fn a_wrong_number_is_found() {
        let mut scene = all().into_iter().find(|scene| scene.expected == 1.0).unwrap();
        let integrator = |max_depth| move || Box::new(Weekend { max_depth }) as Box<dyn Integrator>;
        scene.check(integrator(scene.max_depth), SamplerKind::Sobol, 16).unwrap();
        scene.expected *= 1.001;
        scene.check(integrator(scene.max_depth), SamplerKind::Sobol, 16).unwrap_err();
    }
}
