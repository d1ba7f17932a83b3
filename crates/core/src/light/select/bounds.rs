//! What the choice of a light knows of it: where it is, whereto it shines, how much.

use glam::Vec3;

/// A light, or a piece of one, from the outside.
///
/// It may send light in every direction within θₒ + θₑ of `axis`: its normals lie within θₒ of the axis, and each sends
/// light within θₑ of itself, less with the cosine.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightBounds {
    /// The box around it: the corner of least coordinates.
    pub lo: Vec3,
    /// The box around it: the corner of greatest coordinates.
    pub hi: Vec3,
    /// The mean of its normals, a unit vector.
    pub axis: Vec3,
    /// cos θₒ, -1..1: 1 for a flat light, -1 where the normals go everywhere.
    pub cos_theta_o: f32,
    /// cos θₑ, 0..1: 0 for a surface, which shines up to 90° from its normal; more for a beam.
    pub cos_theta_e: f32,
    /// Emitted power, not negative, in a unit that is the same for all lights, such as watts of luminance.
    pub power: f32,
    /// Whether it shines from the back of its normals as well.
    pub two_sided: bool,
}

impl LightBounds {
    /// A flat surface with unit normal `n`, within the box from `lo` to `hi`; it shines from the side of the normal.
    pub fn flat(lo: Vec3, hi: Vec3, n: Vec3, power: f32) -> Self {
        Self { lo, hi, axis: n, cos_theta_o: 1.0, cos_theta_e: 0.0, power, two_sided: false }
    }

    /// A flat surface that shines from both sides; `power` is that of both.
    pub fn flat_two_sided(lo: Vec3, hi: Vec3, n: Vec3, power: f32) -> Self {
        Self { two_sided: true, ..Self::flat(lo, hi, n, power) }
    }

    /// A sphere, or with a `radius` of 0 a point, that shines in all directions.
    pub fn sphere(center: Vec3, radius: f32, power: f32) -> Self {
        Self {
            lo: center - radius,
            hi: center + radius,
            axis: Vec3::Z,
            cos_theta_o: -1.0,
            cos_theta_e: 0.0,
            power,
            two_sided: false,
        }
    }
}
