//! A camera in motion, and things in motion before a camera.
//!
//! Keys say where the eye is, where it looks and what is upwards at some times; between them, each of these points and
//! directions moves on a straight line. Every ray has its own time while the shutter is open (Cook, Porter & Carpenter 1984,
//! doi:10.1145/800031.808590).
//!
//! ```toml
//! [camera]
//! look_at = [0, 1, 0]
//!
//! [[camera.motion]]
//! time = 0
//! look_from = [-1, 1, 6]
//!
//! [[camera.motion]]
//! time = 1
//! look_from = [1, 1, 6]
//! ```

use glam::{DVec3, Vec3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::array::optional_array;
use crate::camera::{CameraDesc, Kind};
use crate::motion::check_times;
use crate::validate::Checker;

/// Where the camera is at a time.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CameraKey {
    /// When, in the time of `shutter`. Each key is later than the one before it.
    pub time: f32,
    /// The eye, metres; that of the camera if absent.
    #[serde(default, deserialize_with = "optional_array")]
    pub look_from: Option<[f32; 3]>,
    /// A point in the middle of the picture, metres; that of the camera if absent.
    #[serde(default, deserialize_with = "optional_array")]
    pub look_at: Option<[f32; 3]>,
    /// What is upwards in the picture; that of the camera if absent.
    #[serde(default, deserialize_with = "optional_array")]
    pub up: Option<[f32; 3]>,
}

/// Where a camera stands, and how.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Stand {
    look_from: [f32; 3],
    look_at: [f32; 3],
    up: [f32; 3],
}

impl Stand {
    fn line_of_sight(&self) -> DVec3 {
        Vec3::from(self.look_at).as_dvec3() - Vec3::from(self.look_from).as_dvec3()
    }

    /// On the way to another.
    fn lerp(&self, to: &Self, share: f32) -> Self {
        let between = |a: [f32; 3], b: [f32; 3]| Vec3::from(a).lerp(b.into(), share).to_array();
        Self {
            look_from: between(self.look_from, to.look_from),
            look_at: between(self.look_at, to.look_at),
            up: between(self.up, to.up),
        }
    }
}

/// A camera by its keys.
#[derive(Clone, Debug)]
struct Ride {
    /// At rest.
    camera: CameraDesc,
    keys: Vec<(f32, Stand)>,
}

impl Ride {
    fn new(desc: &CameraDesc) -> Self {
        let stand = |key: &CameraKey| Stand {
            look_from: key.look_from.unwrap_or(desc.look_from),
            look_at: key.look_at.unwrap_or(desc.look_at),
            up: key.up.unwrap_or(desc.up),
        };
        let keys = desc.motion.iter().map(|key| (key.time, stand(key))).collect();
        Self { camera: CameraDesc { motion: Vec::new(), ..desc.clone() }, keys }
    }

    /// Where it is at a time.
    fn at(&self, time: f32) -> CameraDesc {
        let next = self.keys.partition_point(|&(start, _)| start <= time);
        let Some(&(start, a)) = self.keys.get(next.saturating_sub(1)) else {
            return self.camera.clone();
        };
        let (end, b) = self.keys.get(next).copied().unwrap_or((start, a));
        let share = if start < end && start < time { (time - start) / (end - start) } else { 0.0 };
        let Stand { look_from, look_at, up } = a.lerp(&b, share);
        CameraDesc { look_from, look_at, up, ..self.camera.clone() }
    }
}

impl CameraDesc {
    /// Notes keys at which, or between which, it looks nowhere.
    pub(super) fn check_motion(&self, c: &mut Checker) {
        let keys = Ride::new(self).keys;
        c.within("motion", |c| {
            check_times(keys.iter().map(|&(time, _)| time), c);
            for (i, (_, stand)) in keys.iter().enumerate() {
                c.within(i, |c| Self::check_pose(stand.look_from, stand.look_at, stand.up, c));
            }
            for (i, pair) in keys.windows(2).enumerate() {
                if let [(_, a), (_, b)] = pair {
                    c.within(i + 1, |c| check_between(a.line_of_sight(), b.line_of_sight(), c));
                }
            }
        });
    }

    /// At rest where it is in the middle of the time while the shutter is open.
    pub(super) fn halfway(&self, [open, close]: [f32; 2]) -> Self {
        Ride::new(self).at(open + 0.5 * (close - open))
    }
}

/// Notes that the eye comes to the point that it looks at, on the way from one key to the next.
fn check_between(a: DVec3, b: DVec3, c: &mut Checker) {
    /// Of the distances at the keys.
    const NEAREST: f64 = 1e-3;
    let way = b - a;
    let nearest = a + way * (-a.dot(way) / way.length_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
    let shortest = NEAREST * a.length().max(b.length());
    if nearest.length() < shortest && a.length() >= shortest && b.length() >= shortest {
        let hint = "add a key between them, where it looks aside".to_owned();
        c.problem("time", "since the key before, the camera comes to the point that it looks at", Some(hint));
    }
}

/// The time of a picture in which something moves.
#[derive(Clone, Debug)]
pub(super) struct Exposure {
    shutter: [f32; 2],
    /// The camera, if it moves.
    ride: Option<Ride>,
    size: [u32; 2],
}

impl Exposure {
    /// None if nothing moves while the shutter is open. `moves` says whether shapes do.
    pub(super) fn new(desc: &CameraDesc, size: [u32; 2], shutter: [f32; 2], moves: bool) -> Option<Self> {
        let [open, close] = shutter;
        let ride = Ride::new(desc);
        let mut times =
            desc.motion.iter().map(|key| key.time).filter(|&time| open < time && time < close).chain([close]);
        let ride = times.any(|time| ride.at(time) != ride.at(open)).then_some(ride);
        (open < close && (moves || ride.is_some())).then_some(Self { shutter, ride, size })
    }

    /// The time of a ray, by a number in [0, 1).
    pub(super) fn time(&self, u: f32) -> f32 {
        let [open, close] = self.shutter;
        (open + (close - open) * u).min(close)
    }

    /// The camera at a time, if it moves.
    pub(super) fn kind(&self, time: f32) -> Option<Kind> {
        let [width, height] = self.size;
        self.ride.as_ref().map(|ride| Kind::new(&ride.at(time), width, height))
    }
}
