//! Cameras turn points of the film into rays. A camera has no body: rays never hit it.

mod thin_lens;

pub use thin_lens::{CameraDesc, ThinLens};
