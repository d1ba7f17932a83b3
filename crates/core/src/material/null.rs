//! Null: a surface that is not there.
//!
//! Rays pass it as if there were none, shadow rays too. It hides a shape without taking it out of the scene, and as a part of a
//! [`Mix`](super::Mix) it is a hole.
//!
//! ```toml
//! [material.nothing.null]
//! ```

use glam::Vec3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::color::Spectrum;
use crate::material::BsdfSample;

/// Invisible.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Null {}

/// The lobe of what light passes as if there were nothing.
#[derive(Clone, Copy, Debug)]
pub struct NullBsdf;

impl NullBsdf {
    #[inline]
    pub(crate) fn sample(wo: Vec3) -> BsdfSample {
        BsdfSample { wi: -wo, weight: Spectrum::ONE, pdf: 1.0, delta: true, eta: 1.0 }
    }
}
