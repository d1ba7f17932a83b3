//! Motion: where shapes are while the shutter is open.
//!
//! A shape says by keys how it is moved, turned and grown at some times. Between two keys it moves on a straight line at constant
//! speed, turns evenly and grows evenly; before the first it is as at the first, after the last as at the last. A key takes a
//! point p of the shape to
//!
//! ```text
//! pivot + offset + scale · R(axis, angle) (p − pivot)
//! ```
//!
//! Keys about the same axis turn from angle to angle, however many turns that is; between keys about different axes the turn
//! is the shortest (Shoemake 1985, "Animating rotation with quaternion curves", doi:10.1145/325165.325242).
//!
//! A path lives at one time, drawn uniformly from the shutter's: distribution ray tracing (Cook, Porter & Carpenter 1984,
//! doi:10.1145/800031.808590). Rays know only straight motion, so turns are cut into pieces of at most 5 degrees, within
//! which a shape is smaller by 1 − cos 2.5° = 0.1 % at most.
//!
//! ```toml
//! [[shape.quad]]
//! corner = [-1, 0, 0]
//! u = [2, 0, 0]
//! v = [0, 0.3, 0]
//! motion = [
//!   { time = 0 },
//!   { time = 1, offset = [0, 1, 0], rotation = { axis = [0, 0, 1], angle = 90 }, scale = 1.5 },
//! ]
//! ```

mod course;

use glam::Vec3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::array::array;
use crate::validate::Checker;

pub(crate) use course::{Course, Motion};

/// How a shape is moved at a time.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MotionKey {
    /// When, in the time of `shutter`. Each key is later than the one before it.
    pub time: f32,
    /// How far it is moved, metres; nowhere if absent.
    #[serde(default, deserialize_with = "array")]
    pub offset: [f32; 3],
    /// How far it is turned about the shape's `pivot`; not at all if absent.
    #[serde(default)]
    pub rotation: Option<Rotation>,
    /// How many times as large it is, from the shape's `pivot`, 1e-6..1e6; 1 if absent.
    #[serde(default = "one")]
    #[schemars(range(min = 1e-6, max = 1e6))]
    pub scale: f32,
}

fn one() -> f32 {
    1.0
}

impl Default for MotionKey {
    fn default() -> Self {
        Self { time: 0.0, offset: [0.0; 3], rotation: None, scale: 1.0 }
    }
}

/// A turn.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Rotation {
    /// The direction of the axis, of any length.
    #[serde(deserialize_with = "array")]
    pub axis: [f32; 3],
    /// Degrees, counter-clockwise seen from where the axis points to, -1e6..1e6: more than 360 is more than one turn.
    #[schemars(range(min = -1e6, max = 1e6))]
    pub angle: f32,
}

impl MotionKey {
    fn check(&self, c: &mut Checker) {
        c.finite("offset", &self.offset);
        c.in_range("scale", self.scale, 1e-6, 1e6);
        if let Some(rotation) = &self.rotation {
            c.within("rotation", |c| {
                c.nonzero("axis", rotation.axis);
                c.in_range("angle", rotation.angle, -1e6, 1e6);
            });
        }
    }
}

/// What a shape says of its motion.
#[derive(Clone, Copy, Debug)]
pub(crate) struct MotionDesc<'d> {
    pub(crate) keys: &'d [MotionKey],
    pub(crate) pivot: Option<[f32; 3]>,
}

impl MotionDesc<'_> {
    /// The most straight pieces of a shape's motion while the shutter is open.
    const MOST_PIECES: f64 = 10_000.0;

    /// Notes what is wrong; returns the number of pieces.
    pub(crate) fn check(&self, shutter: [f32; 2], c: &mut Checker) -> f64 {
        if let Some(pivot) = self.pivot {
            c.finite("pivot", &pivot);
            if self.keys.is_empty() {
                let hint = "give it a `motion`, or take the `pivot` out".to_owned();
                c.problem("pivot", "the shape does not move, so nothing turns about its `pivot`", Some(hint));
            }
        }
        c.within("motion", |c| {
            check_times(self.keys.iter().map(|key| key.time), c);
            for (i, key) in self.keys.iter().enumerate() {
                c.within(i, |c| key.check(c));
            }
        });
        let pieces = Course::new(self, Vec3::ZERO).pieces(shutter);
        if pieces > Self::MOST_PIECES {
            let message = format!("the motion has {pieces} straight pieces while the shutter is open");
            let hint = format!(
                "at most {} are allowed: one for each key, and one for each 5 degrees of a turn",
                Self::MOST_PIECES
            );
            c.problem("motion", message, Some(hint));
        }
        pieces
    }
}

/// Notes times of keys that are not later than the one before.
pub(crate) fn check_times(times: impl Iterator<Item = f32>, c: &mut Checker) {
    let mut last = None;
    for (i, time) in times.enumerate() {
        c.within(i, |c| {
            c.finite("time", &[time]);
            if let Some(last) = last.filter(|&last| time <= last) {
                let message = format!("the key at {time} is not later than the one before it, at {last}");
                c.problem("time", message, Some("sort the keys by their times, one for each".to_owned()));
            }
        });
        last = Some(time);
    }
}

/// That a shutter opens before it closes.
pub(crate) fn check_shutter([open, close]: [f32; 2], c: &mut Checker) {
    c.finite("shutter", &[open, close]);
    if open < 0.0 {
        c.problem("shutter", format!("the shutter opens at {open}, before 0"), Some("times count from 0".to_owned()));
    } else if close < open {
        let hint = Some(format!("turn them round: [{close}, {open}]"));
        c.problem("shutter", format!("the shutter closes at {close}, before it opens at {open}"), hint);
    }
}
