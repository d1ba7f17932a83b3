//! What a path is inside of.
//!
//! Light that goes a distance d through glass or a liquid keeps exp(−σₐ d) of itself (Bouguer 1729, Lambert 1760, Beer 1852).
//!
//! Where shapes are filled, they may overlap: water that reaches a little into its glass leaves no gap, and no film of air.
//! The filling of the highest priority is the one that is there; surfaces of others within it are passed as if there were none, and
//! where two fillings meet, light is refracted by the ratio of their indices (Schmidt & Budge 2002, "Simple Nested Dielectrics
//! in Ray Traced Images", doi:10.1080/10867651.2002.10487555).
//!
//! Most fillings bend blue light more than red light. With n the index at Fraunhofer's line d and V Abbe's number,
//!
//! n(λ) = n + (n − 1) / V · (λ⁻² − λd⁻²) / (λF⁻² − λC⁻²)
//!
//! (Cauchy 1836; the lines d, F and C are at 587.56, 486.13 and 656.27 nm). A path draws one [`Wavelength`]; where it is first bent
//! by such a filling its light gets the colour of it, and keeps it. What is reflected before stays white: that indices differ makes
//! it coloured by a few thousandths, for the same energy in all.

use glam::Vec3;

use crate::color::{Rgb, Spectrum, Wavelength};
use crate::interaction::SurfaceInteraction;
use crate::light::{LightSample, Target};
use crate::material::{Bsdf, BsdfSample};
use crate::sampler::Sampler;
use crate::scene::Scene;

/// What is inside a shape.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Filling {
    /// Absorption coefficient σₐ, 1/m.
    pub sigma_a: Spectrum,
    /// Index of refraction, at 587.56 nm.
    pub eta: f32,
    /// How much the index changes with the wavelength: one over Abbe's number, 0..1.
    pub dispersion: f32,
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
        Self { sigma_a: Spectrum::from_rgb(color.0.map(absorption)), eta, dispersion: 0.0, priority }
    }

    /// Whether it matters to paths that they are inside.
    pub(crate) fn matters(&self) -> bool {
        self.priority > 0 || !self.sigma_a.is_black() || self.disperses()
    }

    /// Whether colours are bent differently.
    #[inline]
    pub(crate) fn disperses(&self) -> bool {
        self.dispersion > 0.0
    }

    /// The index at a wavelength, nanometres, over `eta`.
    fn bend(&self, nm: f32) -> f32 {
        let inverse_square = |nm: f32| 1.0 / (nm * nm);
        let middle = inverse_square(Self::LINE_D);
        let change = (inverse_square(nm) - middle) / (inverse_square(Self::LINE_F) - inverse_square(Self::LINE_C));
        let n = self.eta.max(1.0 / self.eta);
        let bend = 1.0 + (n - 1.0) * self.dispersion * change / n;
        // A bubble is in what it is not.
        if self.eta < 1.0 { 1.0 / bend } else { bend }
    }

    /// Fraunhofer's lines, nanometres; indices are stated at the first.
    const LINE_D: f32 = 587.56;
    const LINE_F: f32 = 486.13;
    const LINE_C: f32 = 656.27;

    const NONE: Self = Self { sigma_a: Spectrum::BLACK, eta: 1.0, dispersion: 0.0, priority: 0 };
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
    /// What the path is of where colours are bent differently; none if they are not.
    wavelength: Option<Wavelength>,
}

impl<'s> Interior<'s> {
    /// In the open, of a scene.
    #[inline]
    pub fn new(scene: &'s Scene, sampler: &mut Sampler<'_>) -> Self {
        let wavelength = scene.disperses().then(|| Wavelength::sample(sampler.get_1d()));
        Self { wavelength, ..Self::open(scene.fillings()) }
    }

    /// In the open, where nothing is filled.
    pub(crate) const EMPTY: Self = Self::open(&[]);

    #[inline]
    const fn open(fillings: &'s [Option<Filling>]) -> Self {
        Self { fillings, entered: [0; MOST], count: 0, wavelength: None }
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
            let bent = sample.eta != 1.0 && self.sides(si).is_some_and(|sides| sides.iter().any(Filling::disperses));
            *self = self.behind(si);
            if let Some(wavelength) = self.wavelength.as_mut().filter(|_| bent) {
                wavelength.color = Spectrum::ONE;
            }
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
        let Some([filling, outside]) = self.sides(si) else { return bsdf };
        if outside.priority > filling.priority {
            return Bsdf::NOTHING;
        }
        let eta = filling.eta / outside.eta;
        if filling.priority > 0 {
            bsdf.set_eta(eta);
        }
        if let Some(Wavelength { nm, color }) = self.wavelength
            && (filling.disperses() || outside.disperses())
        {
            let bend = filling.bend(nm) / outside.bend(nm);
            // What goes straight on has not shown its colour.
            if eta * bend != 1.0 {
                bsdf.disperse(bend, color);
            }
        }
        bsdf
    }

    /// What is inside of a surface's shape, if that is filled, and what is outside, if that matters.
    fn sides(&self, si: &SurfaceInteraction<'_>) -> Option<[Filling; 2]> {
        let material = si.shape_material();
        let filling = self.filling(material)?;
        let outside = match filling.priority {
            0 => Filling::NONE,
            _ if si.is_outside() => self.top(),
            _ => self.without(material).top(),
        };
        Some([filling, outside])
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
        Some(Filling { sigma_a: Spectrum::from_rgb([sigma_a; 3]), eta: 1.5, dispersion: 0.0, priority })
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

    /// Abbe's number is (n − 1) / (n_F − n_C), and bubbles bend as what is around them.
    #[test]
    fn indices_are_those_of_an_abbe_number() {
        for (eta, abbe) in [(1.5, 60.0), (1.62, 36.0), (2.42, 55.0), (1.5, 1.0)] {
            let glass = Filling { eta, dispersion: 1.0 / abbe, ..Filling::NONE };
            let n = |nm| eta * glass.bend(nm);
            let found = (eta - 1.0) / (n(486.13) - n(656.27));
            assert!((found / abbe - 1.0).abs() < 1e-3 && n(587.56) == eta, "{found}, not {abbe}");
            assert!(n(390.0) > n(550.0) && n(550.0) > n(710.0) && n(710.0) > 1.0);
            let bubble = Filling { eta: 1.0 / eta, ..glass };
            assert!((bubble.bend(450.0) * glass.bend(450.0) - 1.0).abs() < 1e-6);
        }
        assert_eq!(Filling::NONE.bend(400.0), 1.0);
    }

    #[test]
    fn nothing_is_absorbed_where_nothing_absorbs() {
        let fillings = [filling(0, 0.0)];
        for interior in [Interior::open(&fillings).with(0), Interior::open(&[])] {
            assert_eq!(interior.transmittance(f32::INFINITY).to_rgb(), [1.0; 3]);
        }
    }
}
