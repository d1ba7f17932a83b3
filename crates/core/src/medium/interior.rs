//! What a path is inside of.
//!
//! Light that goes a distance d through glass or a liquid keeps exp(−σₐ d) of itself (Bouguer 1729, Lambert 1760, Beer 1852).
//!
//! Where shapes are filled, they may overlap: water that reaches a little into its glass leaves no gap, and no film of air.
//! The filling of the highest priority is the one that is there; surfaces of others within it are passed as if there were none, and
//! where two fillings meet, light is refracted by the ratio of their indices (Schmidt & Budge 2002, "Simple Nested Dielectrics
//! in Ray Traced Images", doi:10.1080/10867651.2002.10487555).

use glam::Vec3;

use crate::color::{Rgb, Spectrum};
use crate::interaction::SurfaceInteraction;
use crate::light::{LightSample, Target};
use crate::material::{Bsdf, BsdfSample};
use crate::scene::Scene;

/// What is inside a shape.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Filling {
    /// Absorption coefficient σₐ, 1/m.
    pub sigma_a: Spectrum,
    /// Index of refraction.
    pub eta: f32,
    /// Above 0 the filling takes the place of those of lower priority; at 0 surfaces are what they are, and `eta` is relative
    /// to whatever is around.
    pub priority: u32,
}

impl Filling {
    /// The strongest absorption, 1/m: a micrometre is opaque.
    pub(crate) const DARKEST: f32 = 1e6;

    /// Of which a distance, metres, leaves a colour of white light.
    pub(crate) fn of_color(color: Rgb, distance: f32, eta: f32, priority: u32) -> Self {
        let absorption =
            |share: f32| if share < 1.0 { (-libm::logf(share) / distance).min(Self::DARKEST) } else { 0.0 };
        Self { sigma_a: Spectrum::from_rgb(color.0.map(absorption)), eta, priority }
    }

    const NONE: Self = Self { sigma_a: Spectrum::BLACK, eta: 1.0, priority: 0 };
}

/// The most fillings at a point; more are not noticed.
const MOST: usize = 8;

/// The fillings that a path has entered and not left.
#[derive(Clone, Copy, Debug)]
pub struct Interior<'s> {
    /// Those of the scene, by the numbers of materials; empty if it does not matter.
    fillings: &'s [Option<Filling>],
    /// Materials in the order in which they were entered.
    entered: [u32; MOST],
    count: u32,
}

impl<'s> Interior<'s> {
    /// In the open, of a scene.
    #[inline]
    pub fn new(scene: &'s Scene) -> Self {
        Self::open(scene.fillings())
    }

    /// In the open, where nothing is filled.
    pub(crate) const EMPTY: Self = Self::open(&[]);

    #[inline]
    const fn open(fillings: &'s [Option<Filling>]) -> Self {
        Self { fillings, entered: [0; MOST], count: 0 }
    }

    /// Takes from light what is absorbed on its way between two points.
    #[inline]
    pub fn absorb(&self, light: &mut Spectrum, from: Vec3, to: Vec3) {
        if self.count > 0 {
            *light *= self.transmittance(from.distance(to));
        }
    }

    /// The same, of light on its way from one of the lights to a surface that a path through here has met. Light that comes from
    /// outside of the scene has not been inside of anything.
    #[inline]
    pub(crate) fn absorb_from(&self, l: &mut Spectrum, light: &LightSample, si: &SurfaceInteraction<'_>) {
        if self.fillings.is_empty() {
            return;
        }
        if let Target::On { point, .. } = light.target {
            let here = if si.is_passed_along(light.wi) { self.behind(si) } else { *self };
            here.absorb(l, point, si.point().p);
        }
    }

    /// How a surface scatters light between what is on its sides.
    #[inline]
    pub fn bsdf(&self, si: &SurfaceInteraction<'_>) -> Bsdf {
        if self.fillings.is_empty() { si.bsdf() } else { self.between(si) }
    }

    /// Goes through a surface, if a sample does.
    #[inline]
    pub fn pass(&mut self, si: &SurfaceInteraction<'_>, sample: &BsdfSample) {
        if !self.fillings.is_empty() && si.is_passed(sample) {
            *self = self.behind(si);
        }
    }

    /// The share of light that is left after a distance, metres.
    #[inline(never)]
    fn transmittance(&self, distance: f32) -> Spectrum {
        let share = |sigma: f32| if sigma == 0.0 { 1.0 } else { libm::expf(-sigma * distance) };
        Spectrum::from_rgb(self.top().sigma_a.to_rgb().map(share))
    }

    #[inline(never)]
    fn between(&self, si: &SurfaceInteraction<'_>) -> Bsdf {
        let mut bsdf = si.bsdf();
        let material = si.shape_material();
        let Some(filling) = self.filling(material).filter(|filling| filling.priority > 0) else { return bsdf };
        let outside = if si.is_outside() { self.top() } else { self.without(material).top() };
        if outside.priority > filling.priority {
            return Bsdf::NOTHING;
        }
        bsdf.set_eta(filling.eta / outside.eta);
        bsdf
    }

    /// What is behind a surface, as seen from where the ray came from.
    #[inline(never)]
    fn behind(&self, si: &SurfaceInteraction<'_>) -> Self {
        if si.is_outside() { self.with(si.shape_material()) } else { self.without(si.shape_material()) }
    }

    fn filling(&self, material: u32) -> Option<Filling> {
        *self.fillings.get(material as usize)?
    }

    fn entered(&self) -> &[u32] {
        self.entered.get(..self.count as usize).unwrap_or_default()
    }

    /// That of the highest priority, the last of equal ones.
    fn top(&self) -> Filling {
        let fillings = self.entered().iter().filter_map(|&material| self.filling(material));
        fillings.max_by_key(|filling| filling.priority).unwrap_or(Filling::NONE)
    }

    /// With that of a material, if it has one.
    fn with(mut self, material: u32) -> Self {
        if self.filling(material).is_some()
            && let Some(place) = self.entered.get_mut(self.count as usize)
        {
            *place = material;
            self.count += 1;
        }
        self
    }

    /// Without the last of a material.
    fn without(mut self, material: u32) -> Self {
        if let Some(place) = self.entered().iter().rposition(|&other| other == material) {
            self.entered.copy_within(place + 1..self.count as usize, place);
            self.count -= 1;
        }
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn filling(priority: u32, sigma_a: f32) -> Option<Filling> {
        Some(Filling { sigma_a: Spectrum::from_rgb([sigma_a; 3]), eta: 1.5, priority })
    }

    #[test]
    fn the_highest_priority_counts_and_then_the_last() {
        let fillings = [None, filling(1, 1.0), filling(1, 2.0), filling(5, 3.0)];
        let [paper, water, ice, glass] = [0, 1, 2, 3];
        let left = |interior: &Interior<'_>| interior.transmittance(1.0).to_rgb()[0].ln();
        let mut interior = Interior::open(&fillings);
        assert_eq!(left(&interior), 0.0);
        for (step, expected) in [(water, -1.0), (glass, -3.0), (paper, -3.0), (ice, -3.0)] {
            interior = interior.with(step);
            assert!((left(&interior) - expected).abs() < 1e-6);
        }
        for (step, expected) in [(glass, -2.0), (water, -2.0), (water, -2.0), (ice, 0.0)] {
            interior = interior.without(step);
            assert!((left(&interior) - expected).abs() < 1e-6, "{expected}");
        }
        assert!((left(&(0..20).fold(interior, |i, _| i.with(ice))) + 2.0).abs() < 1e-6);
    }

    #[test]
    fn nothing_is_absorbed_where_nothing_absorbs() {
        let fillings = [filling(0, 0.0)];
        for interior in [Interior::open(&fillings).with(0), Interior::open(&[])] {
            assert_eq!(interior.transmittance(f32::INFINITY).to_rgb(), [1.0; 3]);
        }
    }
}
