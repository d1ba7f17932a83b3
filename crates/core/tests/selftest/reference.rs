//! A path tracer of its own, to make mistakes in.
//!
//! At each surface every light is asked. What is found by chance counts only where no light is sampled: after a mirror, or
//! from directions of which the light's density is 0. That is the plainest way to count all light once.

use eyebeam_core::color::Spectrum;
use eyebeam_core::desc::SceneDesc;
use eyebeam_core::film::{Seen, Tile};
use eyebeam_core::integrator::{Integrator, Unit};
use eyebeam_core::interaction::SurfaceInteraction;
use eyebeam_core::material::MaterialDesc;
use eyebeam_core::sampler::Sampler;
use eyebeam_core::scene::{Ray, Scene};
use eyebeam_core::testing::{LightSampling, lights_of};

use crate::mistake::Mistake;

pub(crate) struct Reference {
    mistake: Mistake,
    max_depth: u32,
    lights: Vec<Box<dyn LightSampling>>,
}

impl Integrator for Reference {
    fn render(&self, scene: &Scene, unit: &Unit<'_>, tile: &mut Tile) -> u64 {
        unit.for_each_sample(tile, |ray, sampler| Seen::surface(self.radiance(scene, ray, sampler)));
        0
    }
}

impl Reference {
    pub(crate) fn new(mistake: Mistake, max_depth: u32, desc: &SceneDesc) -> Self {
        let max_depth = if mistake == Mistake::OneEdgeTooMany { max_depth + 1 } else { max_depth };
        Self { mistake, max_depth, lights: lights_of(desc) }
    }

    fn radiance(&self, scene: &Scene, mut ray: Ray, sampler: &mut Sampler<'_>) -> Spectrum {
        let (mut l, mut beta, mut eta_sq) = (Spectrum::BLACK, Spectrum::ONE, 1.0);
        let mut by_chance = true;
        for depth in 1..=self.max_depth {
            let Some(si) = scene.intersect(&ray) else {
                for light in &self.lights {
                    if by_chance || light.pdf(ray.o, ray.d) == 0.0 {
                        l += beta * light.le(ray.o, ray.d);
                    }
                }
                break;
            };
            if by_chance {
                l += beta * si.le();
            }
            if depth == self.max_depth {
                break;
            }
            let bsdf = si.bsdf();
            if !bsdf.is_delta() && self.mistake != Mistake::LightsForgotten {
                for light in &self.lights {
                    l += beta * self.direct(scene, &si, &**light, sampler);
                }
            }
            let Some((sample, next)) = si.scatter(&bsdf, sampler) else {
                break;
            };
            beta *= sample.weight;
            eta_sq *= sample.eta * sample.eta;
            by_chance = sample.delta || self.mistake == Mistake::LightCountedTwice;
            ray = next;
            let survival = (beta.max_component() * eta_sq).min(1.0);
            if depth >= 3 && sampler.get_1d() >= survival {
                break;
            }
            if depth >= 3 && self.mistake != Mistake::RouletteWithoutWeight {
                beta = beta * (1.0 / survival);
            }
        }
        l
    }

    fn direct(
        &self,
        scene: &Scene,
        si: &SurfaceInteraction<'_>,
        light: &dyn LightSampling,
        sampler: &mut Sampler<'_>,
    ) -> Spectrum {
        let Some(light) = light.sample(si.point().p, sampler.get_2d()) else {
            return Spectrum::BLACK;
        };
        let (f, _) = si.eval_pdf(&si.bsdf(), light.wi);
        let seen = self.mistake == Mistake::NoShadows || !scene.occluded(&si.shadow_ray(&light));
        if seen && !f.is_black() { f * light.l * (1.0 / light.pdf) } else { Spectrum::BLACK }
    }
}

/// An integrator that sees another scene than it is given.
pub(crate) struct OtherScene {
    scene: Scene,
    inner: Box<dyn Integrator>,
}

impl OtherScene {
    pub(crate) fn new(mistake: Mistake, desc: &SceneDesc, inner: Box<dyn Integrator>) -> Self {
        let mut desc = desc.clone();
        for material in desc.material.values_mut() {
            match material {
                MaterialDesc::Emissive(lamp) if mistake == Mistake::BothSidesShine => lamp.two_sided = true,
                MaterialDesc::Dielectric(glass) if mistake == Mistake::GlassInsideOut => glass.eta = 1.0 / glass.eta,
                _ => {}
            }
        }
        Self { scene: Scene::build(&desc).unwrap(), inner }
    }
}

impl Integrator for OtherScene {
    fn render(&self, _: &Scene, unit: &Unit<'_>, tile: &mut Tile) -> u64 {
        self.inner.render(&self.scene, unit, tile)
    }
}
