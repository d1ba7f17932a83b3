//! Many boxes or primitives at once: which of them can a ray meet at all, and which does it meet for certain?
//!
//! The tests are those of the exact ones, in single precision, with a bound on what single precision can lose. What can be met
//! is tested again, exactly; what cannot is missed for certain. Most hits are far from every edge: they are certain, and so is
//! that their distance lies between two bounds.

mod boxes;
mod flats;
mod outline;
mod spheres;

pub(crate) use boxes::BoxLanes;
pub(crate) use flats::{Block, Flats};
pub(crate) use outline::{Outline, View};
pub(crate) use spheres::meets_spheres;

use crate::ray::RayF64;

/// More than products lose that are too small for single precision, for factors up to 1e14.
const UNDERFLOW: f32 = 1e-30;

/// A ray as the tests take it.
#[derive(Clone, Copy)]
pub(crate) struct FilterRay {
    o: [f32; 3],
    d: [f32; 3],
    /// Largest component of the direction, by size.
    d_max: f32,
    /// The axes, that of the largest component last.
    order: &'static [usize; 3],
    /// The origin, with its coordinates in that order.
    turned_o: [f32; 3],
    /// The first two components of the direction in that order, divided by the last, and the inverse of that.
    shear: [f32; 2],
    along_inv: f32,
    /// Shapes of more than this size look large: their corners are at quite different distances, and the areas that the ray
    /// spans with them are far above their roundings.
    large: f32,
    /// The origin is off by at most a rounding of this: 0 if it is exact.
    o_error: f32,
}

impl FilterRay {
    /// A ray in a scene whose coordinates are at most `reach` in size.
    #[inline(always)]
    pub(crate) fn new(ray: &RayF64, reach: f32) -> Self {
        let d = ray.d.as_vec3();
        Self {
            o: ray.o.as_vec3().to_array(),
            d: d.to_array(),
            d_max: d.abs().max_element(),
            order: ray.order,
            turned_o: ray.turned_o.as_vec3().to_array(),
            shear: ray.shear.as_vec2().to_array(),
            along_inv: ray.along_inv as f32,
            large: reach / 128.0,
            o_error: ray.o_error,
        }
    }
}

/// One value for each axis. The standard library's `map` is not always inlined, and then nothing below it can be: instructions
/// beyond the target's own are inlined only where they are enabled.
#[inline(always)]
pub(crate) fn each<T>(f: impl Fn(usize) -> T) -> [T; 3] {
    [f(0), f(1), f(2)]
}
