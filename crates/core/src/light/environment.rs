//! The environment: the global illumination that a ray finds where it hits nothing.
//!
//! ```toml
//! [environment.gradient]
//! bottom = [1, 1, 1]
//! top = [0.5, 0.7, 1]
//! ```

use glam::Vec3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::color::{Rgb, Spectrum};
use crate::validate::Checker;

/// The sky as a scene states it: `[environment.KIND]`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum EnvironmentDesc {
    /// Two colours over the direction's height; the default.
    Gradient(Gradient),
    /// The same from everywhere.
    Constant(Constant),
    /// No light: only surfaces shine.
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
            Self::None(NoLight {}) => {}
        }
    }

    /// Radiance that arrives from the unit direction `w`.
    #[inline]
    pub fn le(&self, w: Vec3) -> Spectrum {
        match self {
            Self::Gradient(g) => Spectrum::from(g.bottom).lerp(g.top.into(), 0.5 * (w.y + 1.0)),
            Self::Constant(k) => k.radiance.into(),
            Self::None(NoLight {}) => Spectrum::BLACK,
        }
    }
}
