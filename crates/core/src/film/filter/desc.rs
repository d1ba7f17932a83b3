//! What a scene says of its pixel filter, and the filters as functions of one axis.

use std::f64::consts::PI;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::validate::Checker;

/// The pixel filter as a scene states it: `[render.filter.KIND]`. Lengths are in pixels.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum FilterDesc {
    /// All alike: the plain mean of a pixel's square at radius 0.5.
    Box(BoxFilter),
    /// Falls linearly.
    Tent(Tent),
    /// A bell curve, cut off.
    Gaussian(Gaussian),
    /// A cubic that sharpens a little: its rim is negative.
    Mitchell(Mitchell),
    /// Nearly a bell curve, with almost nothing at its end; the default.
    BlackmanHarris(BlackmanHarris),
}

/// f(x) = 1.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct BoxFilter {
    /// Half the width, pixels, up to 16.
    #[schemars(range(max = 16.0))]
    pub radius: f32,
}

/// f(x) = 1 − |x| / radius.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Tent {
    /// Half the width, pixels, up to 16.
    #[schemars(range(max = 16.0))]
    pub radius: f32,
}

/// f(x) = exp(−x² / 2σ²) less its value at the end, which is the radius, or 6 σ if that is nearer.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Gaussian {
    /// Half the width, pixels, up to 16.
    #[schemars(range(max = 16.0))]
    pub radius: f32,
    /// Standard deviation, pixels, above 0.
    pub sigma: f32,
}

/// The cubics of Mitchell & Netravali 1988, doi:10.1145/54852.378514, stretched to the radius; at 2 they are as
/// published.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Mitchell {
    /// Half the width, pixels, up to 16.
    #[schemars(range(max = 16.0))]
    pub radius: f32,
    /// Blur, 0..1.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub b: f32,
    /// Ringing, 0..1. b + 2c = 1 looks best.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub c: f32,
}

/// Four cosines: the 4-term window of Harris 1978, doi:10.1109/PROC.1978.10837.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct BlackmanHarris {
    /// Half the width, pixels, up to 16.
    #[schemars(range(max = 16.0))]
    pub radius: f32,
}

impl Default for BoxFilter {
    fn default() -> Self {
        Self { radius: 0.5 }
    }
}

impl Default for Tent {
    fn default() -> Self {
        Self { radius: 1.0 }
    }
}

impl Default for Gaussian {
    fn default() -> Self {
        Self { radius: 1.5, sigma: 0.5 }
    }
}

impl Default for Mitchell {
    fn default() -> Self {
        Self { radius: 2.0, b: 1.0 / 3.0, c: 1.0 / 3.0 }
    }
}

impl Default for BlackmanHarris {
    fn default() -> Self {
        Self { radius: 1.5 }
    }
}

impl Default for FilterDesc {
    fn default() -> Self {
        Self::BlackmanHarris(BlackmanHarris::default())
    }
}

impl FilterDesc {
    pub(crate) fn check(&self, c: &mut Checker) {
        match self {
            Self::Box(f) => c.within("box", |c| check_radius(f.radius, c)),
            Self::Tent(f) => c.within("tent", |c| check_radius(f.radius, c)),
            Self::Gaussian(f) => c.within("gaussian", |c| {
                check_radius(f.radius, c);
                c.positive("sigma", f.sigma);
            }),
            Self::Mitchell(f) => c.within("mitchell", |c| {
                check_radius(f.radius, c);
                c.in_range("b", f.b, 0.0, 1.0);
                c.in_range("c", f.c, 0.0, 1.0);
            }),
            Self::BlackmanHarris(f) => c.within("blackman-harris", |c| check_radius(f.radius, c)),
        }
    }

    /// Beyond this the filter is 0.
    pub(super) fn radius(&self) -> f32 {
        match self {
            Self::Box(f) => f.radius,
            Self::Tent(f) => f.radius,
            Self::Gaussian(f) => f.radius.min(6.0 * f.sigma),
            Self::Mitchell(f) => f.radius,
            Self::BlackmanHarris(f) => f.radius,
        }
    }

    /// The filter along one axis at `t` radii from the centre, 0..1, times some constant.
    pub(super) fn eval_axis(&self, t: f64) -> f64 {
        match self {
            Self::Box(_) => 1.0,
            Self::Tent(_) => 1.0 - t,
            Self::Gaussian(f) => {
                // exp(−x²) − exp(−end²) without cancellation, over exp(−end²) and, for flat ones, over end².
                let end = f64::from(self.radius()) / f64::from(f.sigma);
                let half_sq = 0.5 * end * end;
                libm::exp(-half_sq) * libm::expm1(half_sq * (1.0 - t * t)) / half_sq
            }
            Self::Mitchell(f) => f.cubic(2.0 * t),
            Self::BlackmanHarris(_) => {
                let cos = |k: f64| libm::cos(k * PI * t);
                0.35875 + 0.48829 * cos(1.0) + 0.14128 * cos(2.0) + 0.01168 * cos(3.0)
            }
        }
    }
}

fn check_radius(radius: f32, c: &mut Checker) {
    /// Pixels.
    const LARGEST: f32 = 16.0;
    if radius > LARGEST {
        c.in_range("radius", radius, 0.0, LARGEST);
    } else {
        c.positive("radius", radius);
    }
}

impl Mitchell {
    /// Six times the published cubic, x in 0..2.
    fn cubic(&self, x: f64) -> f64 {
        let (b, c) = (f64::from(self.b), f64::from(self.c));
        if x < 1.0 {
            ((12.0 - 9.0 * b - 6.0 * c) * x + (-18.0 + 12.0 * b + 6.0 * c)) * x * x + (6.0 - 2.0 * b)
        } else {
            (((-b - 6.0 * c) * x + (6.0 * b + 30.0 * c)) * x + (-12.0 * b - 48.0 * c)) * x + (8.0 * b + 24.0 * c)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_what_is_wrong() {
        let problems = |desc: FilterDesc| {
            let mut c = Checker::default();
            desc.check(&mut c);
            c.into_problems().iter().map(|p| p.path.join(".")).collect::<Vec<_>>()
        };
        for radius in [0.0, -1.0, 16.1, f32::NAN, f32::INFINITY] {
            assert_eq!(problems(FilterDesc::Box(BoxFilter { radius })), ["box.radius"]);
            assert_eq!(problems(FilterDesc::BlackmanHarris(BlackmanHarris { radius })), ["blackman-harris.radius"]);
        }
        let mitchell = Mitchell { radius: 17.0, b: -0.1, c: 1.1 };
        assert_eq!(problems(FilterDesc::Mitchell(mitchell)), ["mitchell.radius", "mitchell.b", "mitchell.c"]);
        assert_eq!(problems(FilterDesc::Gaussian(Gaussian { radius: 1.0, sigma: 0.0 })), ["gaussian.sigma"]);
        assert!(problems(FilterDesc::default()).is_empty());
        assert!(problems(FilterDesc::Gaussian(Gaussian { radius: 16.0, sigma: 1e6 })).is_empty());
    }
}
