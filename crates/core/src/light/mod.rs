//! Where light comes from: shining surfaces, lamps without size, the sun, the surroundings.

mod area;
mod directional;
mod environment;
mod ies;
mod lat_long;
mod lights;
mod luminaire;
mod point;
mod projector;
pub mod select;
pub mod sky;
mod spot;

use std::sync::Arc;

use eyebeam_bvh::Slot;
use glam::Vec3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::color::{Rgb, Spectrum};
use crate::validate::Checker;

pub use directional::DirectionalLight;
pub use environment::{Constant, EnvironmentDesc, Gradient, ImageEnvironment, NoLight};
pub use ies::IesProfile;
pub use lat_long::EnvironmentSampling;
pub use luminaire::IesLight;
pub use point::PointLight;
pub use projector::ProjectorLight;
pub use spot::SpotLight;

pub(crate) use area::AreaLight;
pub(crate) use directional::Disk;
#[cfg(any(test, feature = "testing"))]
pub(crate) use environment::Environment;
pub(crate) use lights::{Light, Lights, Scattered};

/// Lights that are no shapes: `[[light.KIND]]` adds one.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct LightsDesc {
    /// Points that shine into all directions.
    pub point: Vec<PointLight>,
    /// Points that shine into a cone.
    pub spot: Vec<SpotLight>,
    /// Suns.
    pub directional: Vec<DirectionalLight>,
    /// Points that shine as a photometric file says.
    pub ies: Vec<IesLight>,
    /// Points that throw a picture.
    pub projector: Vec<ProjectorLight>,
}

impl LightsDesc {
    pub(crate) fn check(&self, c: &mut Checker) {
        fn each<T>(c: &mut Checker, kind: &str, lights: &[T], check: impl Fn(&T, &mut Checker)) {
            c.within(kind, |c| lights.iter().enumerate().for_each(|(i, light)| c.within(i, |c| check(light, c))));
        }
        each(c, "point", &self.point, PointLight::check);
        each(c, "spot", &self.spot, SpotLight::check);
        each(c, "directional", &self.directional, DirectionalLight::check);
        each(c, "ies", &self.ies, IesLight::check);
        each(c, "projector", &self.projector, ProjectorLight::check);
    }

    /// Those that are somewhere.
    pub(crate) fn near(&self) -> impl Iterator<Item = Light> {
        let points = self.point.iter();
        let points = points.map(|l| Light::Point { position: l.position(), intensity: l.intensity.into() });
        let spots = self.spot.iter();
        let spots = spots.map(|l| Light::Spot { spot: l.compile(), intensity: l.intensity.into() });
        let luminaires = self.ies.iter().filter_map(|l| Some(Light::Luminaire(Arc::new(l.compile()?))));
        let projectors = self.projector.iter().filter_map(|l| Some(Light::Projector(Arc::new(l.compile()?))));
        points.chain(spots).chain(luminaires).chain(projectors)
    }

    /// Those that are infinitely far away.
    pub(crate) fn far(&self) -> impl Iterator<Item = Disk> {
        self.directional.iter().map(DirectionalLight::compile)
    }
}

/// What a light has if nothing is said: white of strength 1.
fn one() -> Rgb {
    Rgb::grey(1.0)
}

/// A factor that nothing is said about.
fn unscaled() -> f32 {
    1.0
}

/// A direction from which light arrives at a point.
#[derive(Clone, Copy, Debug)]
pub struct LightSample {
    /// The unit direction.
    pub wi: Vec3,
    /// What must be seen from the point.
    pub target: Target,
    /// Radiance from there, W / (m² sr); irradiance (W / m²) facing the light if it is `delta`.
    pub l: Spectrum,
    /// Density per solid angle (1/sr) times the light's chance; the chance alone if it is `delta`.
    pub pdf: f32,
    /// Whether this is the only direction to the light.
    pub delta: bool,
    /// Of a light whose radiance is only known where a ray meets it, the number; `l` is about its mean then.
    pub varies: Option<u32>,
}

/// Where a light is.
#[derive(Clone, Copy, Debug)]
pub enum Target {
    /// Somewhere.
    On {
        /// The point, moved off the light's own surface.
        point: Vec3,
        /// That surface, which is not in the way.
        on: Slot,
    },
    /// Behind everything.
    Infinity,
}

impl LightSample {
    /// Of a light that was chosen with chance `pmf`.
    #[inline]
    fn chosen(self, pmf: f32) -> Self {
        Self { pdf: self.pdf * pmf, ..self }
    }
}
