//! Light that the air scatters into a ray.
//!
//! Along a view ray, for a sun of unit irradiance at angle γ from it,
//!
//! L = p_m(γ) ∫ T σ_m V dt + p_a(γ) ∫ T σ_a V dt + ∫ T (σ_m + σ_a) Ψ dt,
//!
//! T the transmittance to the eye, V the sunlight that arrives, σ_m and σ_a the scattering of molecules and aerosol, Ψ
//! what arrives after two scatterings or more. γ is the same all along the ray, so the phase functions p stay outside:
//! molecules' is Rayleigh's, aerosol's that of Cornette & Shanks 1992, doi:10.1364/AO.31.003152, with asymmetry
//! parameter 0.7.
//!
//! Ψ is that of Hillaire 2020, doi:10.1111/cgf.14050: scattering from the second on is taken as equal in all directions
//! and the light around a point as equal all over, so Ψ = L₂ / (1 - f), L₂ the twice scattered light (with the
//! ground's), f the share of light that is scattered once more. It depends on the height and the sun's zenith angle
//! only.

use std::f64::consts::{PI, TAU};

use glam::DVec3;

use super::atmosphere::{Atmosphere, GROUND, TOP, between, density, radius_after, steps, way_to_ground, way_to_top};
use super::bands::Bands;

/// What a ray collects from a sun of unit irradiance. By what it was scattered last, if once; phase functions are
/// missing.
#[derive(Clone, Copy, Debug)]
pub(super) struct Inscatter {
    /// Once, by molecules.
    pub(super) molecules: Bands,
    /// Once, by aerosol.
    pub(super) aerosol: Bands,
    /// More than once.
    pub(super) multiple: Bands,
}

/// The air with its table of multiple scattering.
pub(super) struct Scattering {
    pub(super) air: Atmosphere,
    /// Ψ by height and the sun's zenith angle, which runs fastest.
    multiple: Vec<Bands>,
    /// The first of its zenith angles, radians.
    first_zenith: f64,
}

impl Scattering {
    const HEIGHTS: usize = 12;
    const SUNS: usize = 24;
    const MULTIPLE_STEPS: usize = 16;
    const VIEW_STEPS: usize = 32;

    /// The most by which the sun's zenith angle changes along a ray from the ground: out of the air along the horizon
    /// are 1132 km, seen from the planet's middle 10.2°.
    const ZENITH_RANGE: f64 = 10.5 * PI / 180.0;

    /// For a turbidity, a grey albedo of the ground, and the cosine of the sun's zenith angle on the ground.
    pub(super) fn new(turbidity: f64, ground_albedo: f64, sun: f64) -> Self {
        let air = Atmosphere::new(turbidity);
        let first_zenith = libm::acos(sun.clamp(-1.0, 1.0)) - Self::ZENITH_RANGE;
        let suns = std::array::from_fn(|i| {
            let zenith = first_zenith + 2.0 * Self::ZENITH_RANGE * i as f64 / (Self::SUNS - 1) as f64;
            [libm::sin(zenith), libm::cos(zenith)]
        });
        let rows = (0..Self::HEIGHTS).flat_map(|i| multiple_at(&air, ground_albedo, &suns, Self::radius(i)));
        let multiple = rows.collect();
        Self { air, multiple, first_zenith }
    }

    /// Dense near the ground.
    fn radius(i: usize) -> f64 {
        let x = i as f64 / (Self::HEIGHTS - 1) as f64;
        GROUND + (TOP - GROUND) * x * x
    }

    /// Ψ, interpolated.
    fn multiple(&self, r: f64, mu: f64) -> Bands {
        let zenith = libm::acos(mu.clamp(-1.0, 1.0));
        let ([r0, r1], rt) = between(((r - GROUND) / (TOP - GROUND)).sqrt(), Self::HEIGHTS);
        let ([s0, s1], st) = between((zenith - self.first_zenith) / (2.0 * Self::ZENITH_RANGE), Self::SUNS);
        let at_radius = |radius: usize| {
            self.multiple[radius * Self::SUNS + s0] * (1.0 - st) + self.multiple[radius * Self::SUNS + s1] * st
        };
        at_radius(r0) * (1.0 - rt) + at_radius(r1) * rt
    }

    /// What a ray from the ground collects. Unit directions, +Y up; `view` is not below the horizon.
    pub(super) fn inscatter(&self, view: DVec3, sun: DVec3) -> Inscatter {
        let mut sum = Inscatter { molecules: Bands::ZERO, aerosol: Bands::ZERO, multiple: Bands::ZERO };
        let mut transmittance = Bands::ONE;
        for (t, length) in steps(GROUND, view.y, way_to_top(GROUND, view.y), Self::VIEW_STEPS) {
            let r = radius_after(GROUND, view.y, t);
            let mu = (GROUND * sun.y + t * view.dot(sun)) / r;
            let amounts = density(r - GROUND);
            let (seen, passes) = pass(self.air.extinction(amounts), length);
            let seen = transmittance * seen;
            let (molecules, aerosol) = (self.air.molecules * amounts[0], self.air.aerosol * amounts[1]);
            let sunlight = seen * self.air.sunlight(r, mu);
            sum.molecules += sunlight * molecules;
            sum.aerosol += sunlight * aerosol;
            sum.multiple += seen * (molecules + aerosol) * self.multiple(r, mu);
            transmittance = transmittance * passes;
        }
        sum
    }
}

/// Through a step of even extinction: the step's length as seen from its start, ∫ T dt, and the transmittance.
fn pass(extinction: Bands, length: f64) -> (Bands, Bands) {
    let transmittance = (extinction * length).transmittance();
    let seen = extinction.zip(
        transmittance,
        |sigma, passes| {
            if sigma * length > 1e-6 { (1.0 - passes) / sigma } else { length }
        },
    );
    (seen, transmittance)
}

/// Sines and cosines of zenith angles.
type Suns = [[f64; 2]; Scattering::SUNS];

/// Ψ at a radius for all suns.
fn multiple_at(air: &Atmosphere, ground_albedo: f64, suns: &Suns, r: f64) -> [Bands; Scattering::SUNS] {
    const HEIGHTS: u32 = 16;
    const AZIMUTHS: u32 = 4;
    let mut twice = [Bands::ZERO; Scattering::SUNS];
    let mut again = Bands::ZERO;
    for i in 0..HEIGHTS * AZIMUTHS {
        // A direction of the half sphere on one side of the sun's meridian; the other side has the same light.
        let y = 2.0 * (f64::from(i / AZIMUTHS) + 0.5) / f64::from(HEIGHTS) - 1.0;
        let x = (1.0 - y * y).sqrt() * libm::cos(PI * (f64::from(i % AZIMUTHS) + 0.5) / f64::from(AZIMUTHS));
        let ground = way_to_ground(r, y);
        let length = ground.unwrap_or_else(|| way_to_top(r, y));
        // The cosine of the sun's zenith angle at a distance, for each sun.
        let mu = |t: f64, [sin, cos]: [f64; 2]| ((r + t * y) * cos + t * x * sin) / radius_after(r, y, t);
        let mut transmittance = Bands::ONE;
        for (t, step) in steps(r, y, length, Scattering::MULTIPLE_STEPS) {
            let at = radius_after(r, y, t);
            let amounts = density(at - GROUND);
            let (seen, passes) = pass(air.extinction(amounts), step);
            let scattered = transmittance * seen * (air.molecules * amounts[0] + air.aerosol * amounts[1]);
            again += scattered;
            for (&sun, sum) in suns.iter().zip(&mut twice) {
                *sum += scattered * air.sunlight(at, mu(t, sun)) * (0.5 / TAU);
            }
            transmittance = transmittance * passes;
        }
        if ground.is_some() {
            for (&sun, sum) in suns.iter().zip(&mut twice) {
                let mu = mu(length, sun);
                *sum += transmittance * air.sunlight(GROUND, mu) * (mu.max(0.0) * ground_albedo / PI);
            }
        }
    }
    let mean = 1.0 / f64::from(HEIGHTS * AZIMUTHS);
    twice.map(|sum| (sum * mean).zip(again * mean, |twice, again| twice / (1.0 - again)))
}

/// Share of light that molecules scatter by an angle, per steradian.
pub(super) fn rayleigh(cos: f64) -> f64 {
    3.0 / (16.0 * PI) * (1.0 + cos * cos)
}

/// Share of light that aerosol scatters by an angle, per steradian.
pub(super) fn cornette_shanks(cos: f64) -> f64 {
    const G: f64 = 0.7;
    let base = 1.0 + G * G - 2.0 * G * cos;
    3.0 / (8.0 * PI) * (1.0 - G * G) * (1.0 + cos * cos) / ((2.0 + G * G) * base * base.sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn phase_functions_integrate_to_1() {
        for phase in [rayleigh, cornette_shanks] {
            let sum: f64 = (0..20_000).map(|i| phase((f64::from(i) + 0.5) / 10_000.0 - 1.0)).sum();
            assert!((sum * TAU / 10_000.0 - 1.0).abs() < 1e-4, "{sum}");
        }
    }

    #[test]
    fn more_steps_change_little() {
        let scattering = Scattering::new(2.5, 0.3, 0.3_f64.sin());
        let (sin, cos) = 0.3_f64.sin_cos();
        let sun = DVec3::new(cos, sin, 0.0);
        for elevation in [0.005_f64, 0.05, 0.5, 1.5] {
            let view = DVec3::new(0.6 * elevation.cos(), elevation.sin(), 0.8 * elevation.cos());
            let sum = scattering.inscatter(view, sun);
            let (mut slow, mut transmittance) = (Bands::ZERO, Bands::ONE);
            for (t, length) in steps(GROUND, view.y, way_to_top(GROUND, view.y), 5000) {
                let r = radius_after(GROUND, view.y, t);
                let amounts = density(r - GROUND);
                let light = scattering.air.sunlight(r, (GROUND * sun.y + t * view.dot(sun)) / r);
                slow += transmittance * light * scattering.air.molecules * (amounts[0] * length);
                transmittance = transmittance * pass(scattering.air.extinction(amounts), length).1;
            }
            let off = sum.molecules.zip(slow, |fast, slow| fast / slow - 1.0);
            let far = off.map(|o| if o.abs() < 0.02 { 0.0 } else { 1.0 });
            assert_eq!(far, Bands::ZERO, "elevation {elevation}: {off:?}");
        }
    }
}
