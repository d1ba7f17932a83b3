//! Wrong lights and wrong choices among them.

use std::f32::consts::FRAC_PI_2;

use eyebeam_core::color::Spectrum;
use eyebeam_core::desc::SceneDesc;
use eyebeam_core::light::select::SelectedLight;
use eyebeam_core::light::{LightSample, Target};
use eyebeam_core::scene::Slot;
use eyebeam_core::shape::QuadDesc;
use eyebeam_core::testing::{LightChoice, LightSampling, lights_of};
use glam::{Vec2, Vec3};

use crate::mistake::Mistake;

/// The lights of a scene, wrong if the mistake is about them.
pub(crate) fn wrong(mistake: Mistake, desc: &SceneDesc) -> Vec<Box<dyn LightSampling>> {
    let lights = lights_of(desc).into_iter();
    if let (Mistake::AreaDensityAsSolidAngle, [quad]) = (mistake, &desc.shape.quad[..]) {
        return lights.map(|inner| Box::new(ByArea::new(quad, inner)) as Box<_>).collect();
    }
    lights.map(|inner| Box::new(Wrong(mistake, inner)) as Box<_>).collect()
}

struct Wrong(Mistake, Box<dyn LightSampling>);

impl Wrong {
    /// What the density is wrong by.
    fn factor(&self, wi: Vec3) -> f32 {
        // The density in the picture over 4π, as if all its pixels were as large.
        if self.0 == Mistake::DensityWithoutSine { FRAC_PI_2 * wi.x.hypot(wi.z) } else { 1.0 }
    }
}

impl LightSampling for Wrong {
    fn sample(&self, p: Vec3, u: Vec2) -> Option<LightSample> {
        let u = if self.0 == Mistake::HalfOfALampSampled { Vec2::new(0.5 * u.x, u.y) } else { u };
        let sample = self.1.sample(p, u)?;
        Some(LightSample { pdf: sample.pdf * self.factor(sample.wi), ..sample })
    }

    fn pdf(&self, p: Vec3, wi: Vec3) -> f32 {
        self.1.pdf(p, wi) * self.factor(wi)
    }

    fn le(&self, p: Vec3, wi: Vec3) -> Spectrum {
        self.1.le(p, wi)
    }
}

/// A quad whose points are drawn uniformly, with 1 / area for the density of their directions.
struct ByArea {
    corner: Vec3,
    edges: [Vec3; 2],
    inner: Box<dyn LightSampling>,
}

impl ByArea {
    fn new(quad: &QuadDesc, inner: Box<dyn LightSampling>) -> Self {
        Self { corner: quad.corner.into(), edges: [quad.u.into(), quad.v.into()], inner }
    }

    fn density(&self) -> f32 {
        1.0 / self.edges[0].cross(self.edges[1]).length()
    }
}

impl LightSampling for ByArea {
    fn sample(&self, p: Vec3, u: Vec2) -> Option<LightSample> {
        let target = self.corner + u.x * self.edges[0] + u.y * self.edges[1];
        let wi = (target - p).normalize();
        let l = self.inner.le(p, wi);
        Some(LightSample {
            wi,
            target: Target::On { point: target, on: Slot::NONE },
            l,
            pdf: self.density(),
            delta: false,
            varies: None,
        })
    }

    fn pdf(&self, p: Vec3, wi: Vec3) -> f32 {
        if self.inner.le(p, wi).is_black() { 0.0 } else { self.density() }
    }

    fn le(&self, p: Vec3, wi: Vec3) -> Spectrum {
        self.inner.le(p, wi)
    }
}

pub(crate) struct Choice(pub(crate) Mistake, pub(crate) Box<dyn LightChoice>);

impl Choice {
    fn wrong(&self, pmf: f32) -> f32 {
        match self.0 {
            Mistake::ChanceDoubled => 2.0 * pmf,
            Mistake::ChanceForgotten if pmf > 0.0 => 1.0 / 9.0,
            _ => pmf,
        }
    }
}

impl LightChoice for Choice {
    fn sample(&self, p: Vec3, n: Vec3, uc: f32) -> Option<SelectedLight> {
        let light = self.1.sample(p, n, uc)?;
        Some(SelectedLight { pmf: self.wrong(light.pmf), ..light })
    }

    fn pmf(&self, p: Vec3, n: Vec3, index: u32) -> f32 {
        self.wrong(self.1.pmf(p, n, index))
    }
}
