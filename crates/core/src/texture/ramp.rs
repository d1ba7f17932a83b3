//! Ramp: a colour for each number, given at some of them.
//!
//! Between two stops the colour is mixed evenly (`linear`), or by t² (3 − 2 t), which has no kinks (`smooth`), or stays that
//! of the stop before (`constant`). Before the first stop and after the last one it is theirs.
//!
//! ```toml
//! [texture.height.noise]
//! octaves = 8
//!
//! [texture.map.ramp]
//! input = "height"
//! stops = [
//!   { at = 0.45, color = "#1d4e89" },
//!   { at = 0.5, color = "#f2e6c9" },
//!   { at = 0.55, color = "#5b8e3e" },
//!   { at = 0.8, color = "#ffffff" },
//! ]
//! ```

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::color::{Rgb, Spectrum};
use crate::texture::{Scalar, TexturesAt};
use crate::validate::Checker;

/// Colours for numbers.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Ramp {
    /// The number; of a texture, its luminance.
    pub input: Scalar,
    /// Colours by ascending numbers, 1 to 256; from black at 0 to white at 1 if absent.
    #[serde(default = "black_to_white")]
    pub stops: Vec<Stop>,
    /// What lies between them.
    #[serde(default)]
    pub interpolation: Interpolation,
}

/// A colour at a number.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Stop {
    /// The number.
    pub at: f32,
    /// Its colour.
    pub color: Rgb,
}

/// What lies between two stops.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Interpolation {
    /// Mixed evenly.
    #[default]
    Linear,
    /// Mixed without kinks.
    Smooth,
    /// The colour of the one before.
    Constant,
}

fn black_to_white() -> Vec<Stop> {
    [0.0, 1.0].map(|at| Stop { at, color: Rgb::grey(at) }).into()
}

impl Ramp {
    /// Numbers beyond are as far as these.
    const FARTHEST: f32 = 1e9;
    /// The most stops.
    const MOST: usize = 256;

    pub(super) fn check(&self, c: &mut Checker) {
        self.input.check_range("input", -Self::FARTHEST, Self::FARTHEST, c);
        if self.stops.is_empty() || self.stops.len() > Self::MOST {
            let message = format!("there are {} stops", self.stops.len());
            c.problem("stops", message, Some(format!("give 1 to {} of them", Self::MOST)));
        }
        c.within("stops", |c| {
            for (i, stop) in self.stops.iter().enumerate().take(Self::MOST) {
                c.within(i, |c| {
                    c.in_range("at", stop.at, -Self::FARTHEST, Self::FARTHEST);
                    c.radiance("color", stop.color);
                    let before = self.stops.get(i.wrapping_sub(1)).map_or(f32::NEG_INFINITY, |before| before.at);
                    if stop.at < before {
                        let message = format!("the stop at {} comes after that at {before}", stop.at);
                        c.problem("at", message, Some("sort the stops by `at`".to_owned()));
                    }
                });
            }
        });
    }

    pub(super) fn color(&self, textures: &TexturesAt<'_>) -> Spectrum {
        let x = self.input.at(textures, -Self::FARTHEST, Self::FARTHEST);
        let after = self.stops.partition_point(|stop| stop.at <= x);
        let (Some(a), b) = (self.stops.get(after.saturating_sub(1)), self.stops.get(after)) else {
            return Spectrum::BLACK;
        };
        let (Some(b), true) = (b, after > 0) else { return a.color.into() };
        let t = (x - a.at) / (b.at - a.at);
        let share = match self.interpolation {
            Interpolation::Linear => t,
            Interpolation::Smooth => t * t * (3.0 - 2.0 * t),
            Interpolation::Constant => 0.0,
        };
        Spectrum::from(a.color).lerp(b.color.into(), share)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::texture::TexturePoint;

    fn ramp(interpolation: Interpolation, stops: &[(f32, f32)]) -> Ramp {
        let stops = stops.iter().map(|&(at, grey)| Stop { at, color: Rgb::grey(grey) }).collect();
        Ramp { input: 0.0.into(), stops, interpolation }
    }

    fn at(ramp: &Ramp, x: f32) -> f32 {
        let ramp = Ramp { input: x.into(), ..ramp.clone() };
        ramp.color(&TexturesAt { textures: &[], at: TexturePoint::default() }).to_rgb()[0]
    }

    #[test]
    fn between_stops() {
        let stops = [(-1.0, 0.2), (0.0, 1.0), (2.0, 0.0)];
        for (interpolation, expected) in [
            (Interpolation::Linear, [0.2, 0.2, 0.6, 1.0, 0.75, 0.0, 0.0]),
            (Interpolation::Smooth, [0.2, 0.2, 0.6, 1.0, 0.84375, 0.0, 0.0]),
            (Interpolation::Constant, [0.2, 0.2, 0.2, 1.0, 1.0, 0.0, 0.0]),
        ] {
            let found = [-9.0, -1.0, -0.5, 0.0, 0.5, 2.0, 1e8].map(|x| at(&ramp(interpolation, &stops), x));
            assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-6), "{interpolation:?}: {found:?}");
        }
    }

    /// Two stops at one place are a step; one stop is a colour; none are black.
    #[test]
    fn few_stops() {
        let step = ramp(Interpolation::Linear, &[(0.0, 0.0), (0.5, 0.5), (0.5, 0.9), (1.0, 1.0)]);
        assert!((at(&step, 0.4999) - 0.4999).abs() < 1e-6 && at(&step, 0.5) == 0.9);
        assert_eq!([-1.0, 3.0, 5.0].map(|x| at(&ramp(Interpolation::Smooth, &[(3.0, 0.7)]), x)), [0.7; 3]);
        assert_eq!(at(&ramp(Interpolation::Linear, &[]), 1.0), 0.0);
    }

    #[test]
    fn problems() {
        let problems = |stops: &[(f32, f32)]| {
            let mut c = Checker::default();
            ramp(Interpolation::Linear, stops).check(&mut c);
            c.into_problems().into_iter().map(|p| p.path.join(".")).collect::<Vec<_>>()
        };
        assert_eq!(problems(&[(0.0, 0.0), (0.0, 1.0), (1.0, 2.0)]), [""; 0]);
        assert_eq!(problems(&[]), ["stops"]);
        assert_eq!(problems(&[(0.0, 0.0); 257]), ["stops"]);
        assert_eq!(
            problems(&[(1.0, 0.0), (0.5, -1.0), (f32::NAN, 0.0)]),
            ["stops.1.color", "stops.1.at", "stops.2.at"]
        );
    }
}
