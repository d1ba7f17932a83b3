//! Pictures whose every pixel is known beforehand, and pictures that must be the same bits. Seeds are fixed, so a result
//! never changes without the code.

mod agreement;
mod analytic;
mod aov;
mod copies;
mod determinism;
mod directions;
mod error;
mod furnace;
mod lamps;
mod motion;
mod offset;
mod setup;
mod textures;
