//! Small mathematics that several rooms share.

mod frame;
mod offset;
mod reflect;
mod trig;

pub use frame::Frame;
pub use offset::offset_ray_origin;
pub use reflect::{reflect, reflect_at, refract};
pub use trig::{sin_cos_eighth, sin_cos_turns};
