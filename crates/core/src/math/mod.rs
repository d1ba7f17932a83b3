//! Small mathematics that several rooms share.

mod frame;
mod half;
mod hash;
mod offset;
mod pose;
mod reflect;
mod renormalize;
mod steps;
mod trig;

pub use frame::Frame;
pub(crate) use half::half_to_f32;
pub use hash::mix;
pub(crate) use hash::{BELOW_ONE, GAMMA, unit};
pub use offset::clearance;
pub(crate) use pose::Pose;
pub use reflect::{reflect, reflect_at, refract};
pub use renormalize::renormalize;
pub(crate) use steps::{interpolate, place};
pub use trig::{sin_cos_degrees, sin_cos_eighth, sin_cos_turns};
