//! Light that comes from outside the scene.
//!
//! ```toml
//! [environment.gradient]
//! bottom = [1, 1, 1]
//! top = [0.5, 0.7, 1]
//! ```

use std::sync::Arc;

use glam::Vec3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::color::{Rgb, Spectrum};
use crate::film::Image;
use crate::light::directional::Disk;
use crate::light::lat_long::{EnvironmentSampling, LatLong};
use crate::light::sky::{Sky, SkyDesc, SunDisk};
use crate::light::unscaled;
use crate::validate::Checker;

/// The environment as a scene states it: `[environment.KIND]`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum EnvironmentDesc {
    /// Two colours over the direction's height; the default.
    Gradient(Gradient),
    /// The same from everywhere.
    Constant(Constant),
    /// A picture of latitude and longitude.
    Image(ImageEnvironment),
    /// A clear sky with its sun.
    Sky(SkyDesc),
    /// No light: only surfaces and lights shine.
    None(NoLight),
}

/// Radiance mixed by the height of the direction: L = lerp(bottom, top, (y + 1) / 2).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Gradient {
    /// Radiance from straight below, W / (m² sr).
    pub bottom: Rgb,
    /// Radiance from straight above, W / (m² sr).
    pub top: Rgb,
}

impl Default for Gradient {
    fn default() -> Self {
        Self { bottom: Rgb::grey(1.0), top: Rgb([0.5, 0.7, 1.0]) }
    }
}

/// One radiance.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Constant {
    /// Radiance, W / (m² sr).
    pub radiance: Rgb,
}

impl Default for Constant {
    fn default() -> Self {
        Self { radiance: Rgb::grey(1.0) }
    }
}

/// A panorama of what is around: an HDRI.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ImageEnvironment {
    /// The picture (.hdr, .exr, .png, .jpg), twice as wide as high: row 0 is straight above, the left edge looks along −z,
    /// and a quarter of the way to the right is +x. A relative name is looked for beside the scene file that says it.
    pub file: String,
    /// Turns the surroundings about the vertical, counter-clockwise seen from above, degrees.
    #[serde(default)]
    pub rotation: f32,
    /// Factor on the picture's radiance, not negative.
    #[serde(default = "unscaled")]
    pub scale: f32,
    /// The picture, once a reader has loaded it.
    #[serde(skip)]
    pub image: Option<Arc<Image>>,
}

/// Darkness; it has no settings.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct NoLight {}

impl Default for EnvironmentDesc {
    fn default() -> Self {
        Self::Gradient(Gradient::default())
    }
}

impl EnvironmentDesc {
    pub(crate) fn check(&self, c: &mut Checker) {
        match self {
            Self::Gradient(g) => c.within("gradient", |c| {
                c.radiance("bottom", g.bottom);
                c.radiance("top", g.top);
            }),
            Self::Constant(k) => c.within("constant", |c| c.radiance("radiance", k.radiance)),
            Self::Image(i) => c.within("image", |c| {
                c.in_range("rotation", i.rotation, -1e4, 1e4);
                c.in_range("scale", i.scale, 0.0, 1e9);
                if i.image.is_none() {
                    c.not_loaded(&i.file);
                }
            }),
            Self::Sky(sky) => c.within("sky", |c| sky.check(c)),
            Self::None(NoLight {}) => {}
        }
    }

    /// Whether no light comes from it.
    pub(crate) fn is_dark(&self) -> bool {
        let is_black = |rgb: &Rgb| rgb.0 == [0.0; 3];
        match self {
            Self::Gradient(g) => is_black(&g.bottom) && is_black(&g.top),
            Self::Constant(k) => is_black(&k.radiance),
            Self::Image(i) => i.scale == 0.0 || i.image.as_ref().is_none_or(|image| image.is_black()),
            Self::Sky(sky) => sky.scale == 0.0,
            Self::None(NoLight {}) => true,
        }
    }

    /// What is all around, and the sun in it.
    pub(crate) fn compile(&self, sampling: EnvironmentSampling) -> (Environment, Option<Disk>) {
        let environment = match self {
            Self::Gradient(g) => Environment::Gradient { bottom: g.bottom.into(), top: g.top.into() },
            Self::Constant(k) => Environment::Constant(k.radiance.into()),
            Self::Image(i) => match &i.image {
                Some(image) => {
                    Environment::Image(LatLong::new(image.clone(), i.rotation.to_radians(), i.scale, sampling))
                }
                None => Environment::Constant(Spectrum::BLACK),
            },
            Self::Sky(sky) => {
                let Sky { image, sun } = Sky::bake(sky);
                let disk =
                    |sun: SunDisk| Disk::of_radiance(sun.direction, 2.0 * sun.angular_radius, sun.radiance.into());
                return (Environment::Image(LatLong::new(Arc::new(image), 0.0, 1.0, sampling)), sun.map(disk));
            }
            Self::None(NoLight {}) => Environment::Constant(Spectrum::BLACK),
        };
        (environment, None)
    }
}

/// Light from outside, ready to be looked up.
#[derive(Clone, Debug)]
pub(crate) enum Environment {
    Gradient { bottom: Spectrum, top: Spectrum },
    Constant(Spectrum),
    Image(LatLong),
}

impl Environment {
    /// Radiance that arrives from the unit direction `w`.
    #[inline]
    pub(crate) fn le(&self, w: Vec3) -> Spectrum {
        match self {
            Self::Gradient { bottom, top } => bottom.lerp(*top, 0.5 * (w.y + 1.0)),
            Self::Constant(radiance) => *radiance,
            Self::Image(map) => map.le(w),
        }
    }

    /// What is sampled. Even light is not: surfaces' own directions find it with less noise, and at no cost.
    #[inline]
    pub(crate) fn sampled(&self) -> Option<&LatLong> {
        match self {
            Self::Image(map) => Some(map).filter(|map| map.is_sampled()),
            Self::Gradient { .. } | Self::Constant(_) => None,
        }
    }
}
