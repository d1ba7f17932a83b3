//! All lights of a scene: which one a point asks, and with what chance.
//!
//! One light is drawn for each point: one of those in the scene by the light tree, or one that is infinitely far away, by
//! about how much light each brings. What a surface finds by its own directions is weighed against what the lights would
//! have sent: multiple importance sampling with the power heuristic (Veach & Guibas 1995, doi:10.1145/218380.218498).
//! Even environments are not drawn at all; see [`Environment::sampled`](super::environment::Environment::sampled).

use std::f32::consts::PI;
use std::sync::Arc;

use eyebeam_bvh::Slot;
use glam::{Vec2, Vec3};

use crate::color::{Rgb, Spectrum};
use crate::light::area::AreaLight;
use crate::light::directional::Disk;
use crate::light::environment::Environment;
use crate::light::luminaire::Luminaire;
use crate::light::projector::Projector;
use crate::light::select::{LightBounds, LightSelection, LightSelector};
use crate::light::spot::Spot;
use crate::light::{LightSample, Target};
use crate::math::BELOW_ONE;
use crate::sampling::power_heuristic;

/// A light that is somewhere.
#[derive(Clone, Debug)]
pub(crate) enum Light {
    Area(AreaLight),
    Point { position: Vec3, intensity: Spectrum },
    Spot { spot: Spot, intensity: Spectrum },
    Luminaire(Arc<Luminaire>),
    Projector(Arc<Projector>),
}

impl Light {
    fn bounds(&self) -> LightBounds {
        let luminance = |s: &Spectrum| Rgb(s.to_rgb()).luminance();
        match self {
            Self::Area(light) => light.bounds(),
            Self::Point { position, intensity } => LightBounds::sphere(*position, 0.0, 4.0 * PI * luminance(intensity)),
            Self::Spot { spot, intensity } => spot.bounds(luminance(intensity)),
            Self::Luminaire(luminaire) => luminaire.bounds(),
            Self::Projector(projector) => projector.bounds(),
        }
    }

    #[inline]
    pub(crate) fn sample(&self, p: Vec3, u: Vec2) -> Option<LightSample> {
        match self {
            Self::Area(light) => light.sample(p, u),
            Self::Point { position, intensity } => from_point(*position, p, |_| *intensity),
            Self::Spot { spot, intensity } => from_point(spot.position, p, |w| *intensity * spot.falloff(w)),
            Self::Luminaire(luminaire) => from_point(luminaire.position, p, |w| luminaire.intensity(w)),
            Self::Projector(projector) => from_point(projector.position(), p, |w| projector.intensity(w)),
        }
    }
}

/// What `p` gets from a light without size at `position`, whose intensity (W / sr) depends on the direction away from it.
#[inline]
fn from_point(position: Vec3, p: Vec3, intensity: impl FnOnce(Vec3) -> Spectrum) -> Option<LightSample> {
    let to = position - p;
    let wi = to.try_normalize()?;
    let l = intensity(-wi) * (1.0 / to.length_squared());
    (!l.is_black()).then_some(LightSample {
        wi,
        target: Target::On { point: position, on: Slot::NONE },
        l,
        pdf: 1.0,
        delta: true,
        varies: None,
    })
}

/// Where the last direction was drawn by a surface, and how: what its light is weighed by.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Scattered {
    pub(crate) p: Vec3,
    pub(crate) n: Vec3,
    /// Density of the direction, 1/sr.
    pub(crate) pdf: f32,
}

/// All lights of a scene.
#[derive(Clone, Debug)]
pub(crate) struct Lights {
    lights: Vec<Light>,
    selector: LightSelector,
    environment: Environment,
    disks: Vec<Disk>,
    /// Luminances of irradiances: of each disk, and of the environment if it is sampled.
    weights: Vec<f32>,
    weights_sum: f32,
}

impl Lights {
    /// The number of lights that are found by the directions of surfaces alone.
    pub(crate) const UNSAMPLED: u32 = u32::MAX;

    /// Those that are infinitely far away.
    pub(crate) fn far(environment: Environment, disks: Vec<Disk>) -> Self {
        let luminance = |s: Spectrum| Rgb(s.to_rgb()).luminance();
        let far = environment.sampled().map_or(0.0, |map| luminance(map.mean_irradiance()));
        let weights: Vec<_> = disks.iter().map(|disk| luminance(disk.irradiance())).chain([far]).collect();
        let weights_sum = weights.iter().sum();
        let selector = LightSelector::new(LightSelection::default(), &[]);
        Self { lights: Vec::new(), selector, environment, disks, weights, weights_sum }
    }

    /// With others that are infinitely far away.
    pub(crate) fn surrounded(self, environment: Environment, disks: Vec<Disk>) -> Self {
        let Self { lights, selector, .. } = self;
        Self { lights, selector, ..Self::far(environment, disks) }
    }

    /// With those that are somewhere.
    pub(crate) fn with_near(self, lights: Vec<Light>, selection: LightSelection) -> Self {
        let bounds: Vec<_> = lights.iter().map(Light::bounds).collect();
        Self { lights, selector: LightSelector::new(selection, &bounds), ..self }
    }

    /// Whether [`sample`](Self::sample) can draw anything.
    #[inline]
    pub(crate) fn is_sampled(&self) -> bool {
        !self.lights.is_empty() || self.weights_sum > 0.0
    }

    /// Chance that a light in the scene is asked at a point.
    #[inline]
    fn near_chance(&self, p: Vec3, n: Vec3) -> f32 {
        if self.lights.is_empty() {
            return 0.0;
        }
        if self.weights_sum == 0.0 {
            return 1.0;
        }
        // At most half of the largest number, so that the sum is one.
        let near = self.selector.importance(p, n).min(0.5 * f32::MAX);
        near / (near + self.weights_sum)
    }

    /// Draws a light for a point with normal `n`, and a direction to it.
    #[inline(always)]
    pub(crate) fn sample(&self, p: Vec3, n: Vec3, uc: f32, u: Vec2) -> Option<LightSample> {
        let near = self.near_chance(p, n);
        if uc < near {
            let selected = self.selector.sample(p, n, (uc / near).min(BELOW_ONE))?;
            let sample = self.lights[selected.index as usize].sample(p, u)?;
            return Some(sample.chosen(near * selected.pmf));
        }
        let mut rest = (uc - near) / (1.0 - near) * self.weights_sum;
        let last = self.weights.iter().rposition(|&w| w > 0.0)?;
        let index = self.weights[..last].iter().position(|&w| {
            let found = rest < w;
            rest -= if found { 0.0 } else { w };
            found
        });
        let index = index.unwrap_or(last);
        let sample = match self.disks.get(index) {
            Some(disk) => {
                let (wi, l) = disk.sample(u);
                LightSample { wi, target: Target::Infinity, l, pdf: disk.pdf(), delta: disk.is_delta(), varies: None }
            }
            None => {
                let (wi, l, pdf) = self.environment.sampled()?.sample(u)?;
                LightSample { wi, target: Target::Infinity, l, pdf, delta: false, varies: None }
            }
        };
        Some(sample.chosen((1.0 - near) * self.weights[index] / self.weights_sum))
    }

    /// The share that light from a surface's own direction counts for, where it met `point` of light `index`.
    #[inline]
    pub(crate) fn weight(&self, scattered: Option<Scattered>, index: u32, point: Vec3) -> f32 {
        let Some(Scattered { p, n, pdf }) = scattered else {
            return 1.0;
        };
        let Some(Light::Area(light)) = self.lights.get(index as usize) else {
            return 1.0;
        };
        let chance = self.near_chance(p, n) * self.selector.pmf(p, n, index);
        power_heuristic(pdf, chance * light.pdf(p, point))
    }

    /// Light from outside along `w`, each part by the share that it counts for.
    #[inline]
    pub(crate) fn le(&self, w: Vec3, scattered: Option<Scattered>) -> Spectrum {
        let mut chance = None;
        let mut weight = |index: usize, density: f32| match scattered {
            Some(Scattered { p, n, pdf }) => {
                let far = *chance.get_or_insert_with(|| 1.0 - self.near_chance(p, n));
                power_heuristic(pdf, far * self.weights[index] / self.weights_sum * density)
            }
            None => 1.0,
        };
        let mut l = self.environment.le(w);
        if let Some(map) = self.environment.sampled() {
            l = l * weight(self.disks.len(), map.pdf(w));
        }
        for (index, disk) in self.disks.iter().enumerate() {
            let seen = disk.le(w);
            if !seen.is_black() {
                l += seen * weight(index, disk.pdf());
            }
        }
        l
    }
}
