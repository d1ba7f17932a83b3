//! What the selftest is about: the parts of a renderer.

use glam::UVec2;

use crate::camera::{Camera, CameraDesc};
use crate::desc::SceneDesc;
use crate::film::{Filter, FilterDesc};
use crate::integrator::{Integrator, IntegratorKind};
use crate::light::select::{LightBounds, LightSelection, LightSelector};
use crate::material::MaterialDesc;
use crate::sampler::Samples;
use crate::testing::{CameraRays, LightChoice, LightSampling, Lobe, Numbers, PixelFilter, lights_of};
use crate::texture::NoTextures;

/// The parts of a renderer, each Eyebeam's own if nothing else is said.
pub trait Implementation {
    /// The numbers of one sample of one pixel.
    fn numbers<'s>(&self, samples: &'s Samples, pixel: UVec2, sample: u32) -> Box<dyn Numbers + 's> {
        Box::new(samples.sampler(pixel, sample))
    }

    /// A pixel filter.
    fn filter(&self, desc: &FilterDesc) -> Box<dyn PixelFilter> {
        Box::new(Filter::new(desc))
    }

    /// A camera for a picture of this size.
    fn camera(&self, desc: &CameraDesc, width: u32, height: u32) -> Box<dyn CameraRays> {
        Box::new(Camera::new(desc, width, height))
    }

    /// How a material scatters light.
    fn lobe(&self, material: &MaterialDesc) -> Box<dyn Lobe> {
        Box::new(material.bsdf(&NoTextures))
    }

    /// All lights of a scene, one by one.
    fn lights(&self, desc: &SceneDesc) -> Vec<Box<dyn LightSampling>> {
        lights_of(desc)
    }

    /// How one of many lights is chosen.
    fn light_choice(&self, selection: LightSelection, lights: &[LightBounds]) -> Box<dyn LightChoice> {
        Box::new(LightSelector::new(selection, lights))
    }

    /// The integrator for paths of at most `max_depth` edges through a scene.
    fn integrator(&self, kind: IntegratorKind, max_depth: u32, _scene: &SceneDesc) -> Box<dyn Integrator> {
        kind.build(max_depth)
    }
}

/// Eyebeam as it is.
#[derive(Clone, Copy, Debug, Default)]
pub struct Eyebeam;

impl Implementation for Eyebeam {}
