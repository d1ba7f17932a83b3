//! The lights of a scene, one by one.

use eyebeam_bvh::{Bvh, Primitive, Ray, Slot};
use glam::{Vec2, Vec3};

use super::LightSampling;
use crate::color::Spectrum;
use crate::desc::SceneDesc;
use crate::light::{AreaLight, Disk, Environment, EnvironmentSampling, Light, LightSample, Target};
use crate::material::{Emissive, MaterialDesc};
use crate::shape::SurfacePoint;
use crate::texture::NoTextures;

/// Every light of a scene, alone: surfaces that shine and rest, primitive by primitive, then lamps without size, suns, and the
/// environment, also one that is never sampled.
pub fn lights_of(desc: &SceneDesc) -> Vec<Box<dyn LightSampling>> {
    let mut lights: Vec<Box<dyn LightSampling>> = Vec::new();
    for (_, _, shape) in desc.shape.iter().filter(|(_, _, shape)| shape.motion().keys.is_empty()) {
        if let Some(MaterialDesc::Emissive(emissive)) = shape.material().and_then(|name| desc.material.get(name)) {
            let mut primitives = Vec::new();
            shape.push_primitives(&mut primitives);
            lights.extend(primitives.into_iter().filter_map(|p| Some(Box::new(Lamp::new(p, emissive)?) as Box<_>)));
        }
    }
    lights.extend(desc.light.near().map(|light| Box::new(light) as Box<_>));
    let (environment, sun) = desc.environment.compile(EnvironmentSampling::default());
    lights.extend(desc.light.far().chain(sun).map(|disk| Box::new(disk) as Box<_>));
    lights.push(Box::new(environment));
    lights
}

/// A primitive that shines.
struct Lamp {
    light: AreaLight,
    /// The primitive alone.
    shape: Bvh,
    emissive: Emissive,
}

impl Lamp {
    fn new(primitive: Primitive, emissive: &Emissive) -> Option<Self> {
        let light =
            AreaLight::new(&primitive, Slot::NONE, emissive.radiance.amount_at(&NoTextures), emissive.two_sided, None)?;
        Some(Self { light, shape: Bvh::list([primitive].as_slice()).ok()?, emissive: emissive.clone() })
    }

    /// Where a ray from `p` meets it, if it shines there.
    fn seen(&self, p: Vec3, wi: Vec3) -> Option<SurfacePoint> {
        let ray = Ray::new(p, wi);
        let hit = self.shape.intersect(&ray)?;
        let point = SurfacePoint::new(&self.shape.surface(&hit, 0.0), &ray, &hit, None, 0);
        (self.emissive.two_sided || wi.dot(point.n) < 0.0).then_some(point)
    }
}

impl LightSampling for Lamp {
    fn sample(&self, p: Vec3, u: Vec2) -> Option<LightSample> {
        self.light.sample(p, u)
    }

    fn pdf(&self, p: Vec3, wi: Vec3) -> f32 {
        self.seen(p, wi).map_or(0.0, |point| self.light.pdf(p, point.p))
    }

    fn le(&self, p: Vec3, wi: Vec3) -> Spectrum {
        self.seen(p, wi).map_or(Spectrum::BLACK, |_| self.emissive.radiance.amount_at(&NoTextures))
    }
}

/// Without size.
impl LightSampling for Light {
    fn sample(&self, p: Vec3, u: Vec2) -> Option<LightSample> {
        self.sample(p, u)
    }

    fn pdf(&self, _: Vec3, _: Vec3) -> f32 {
        0.0
    }

    fn le(&self, _: Vec3, _: Vec3) -> Spectrum {
        Spectrum::BLACK
    }
}

impl LightSampling for Disk {
    fn sample(&self, _: Vec3, u: Vec2) -> Option<LightSample> {
        let (wi, l) = self.sample(u);
        Some(LightSample { wi, target: Target::Infinity, l, pdf: self.pdf(), delta: self.is_delta(), varies: None })
    }

    fn pdf(&self, _: Vec3, wi: Vec3) -> f32 {
        if self.le(wi).is_black() { 0.0 } else { self.pdf() }
    }

    fn le(&self, _: Vec3, wi: Vec3) -> Spectrum {
        self.le(wi)
    }
}

impl LightSampling for Environment {
    fn sample(&self, _: Vec3, u: Vec2) -> Option<LightSample> {
        let (wi, l, pdf) = self.sampled()?.sample(u)?;
        Some(LightSample { wi, target: Target::Infinity, l, pdf, delta: false, varies: None })
    }

    fn pdf(&self, _: Vec3, wi: Vec3) -> f32 {
        self.sampled().map_or(0.0, |map| map.pdf(wi))
    }

    fn le(&self, _: Vec3, wi: Vec3) -> Spectrum {
        self.le(wi)
    }
}
