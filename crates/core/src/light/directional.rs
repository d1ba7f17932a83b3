//! Light from one direction, or from a small disk of directions, such as the sun.
//!
//! ```toml
//! [[light.directional]]
//! direction = [0.6, 0.7, 0.45]
//! irradiance = [5, 4.6, 4]
//! angle = 0.53
//! ```

use glam::{Vec2, Vec3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::array::array;
use crate::color::{Rgb, Spectrum};
use crate::light::one;
use crate::math::Frame;
use crate::sampling::uniform_disk;
use crate::validate::Checker;

/// A light that is infinitely far away. With an angular size it is seen as a disk.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DirectionalLight {
    /// Towards the light; of any length.
    #[serde(deserialize_with = "array")]
    pub direction: [f32; 3],
    /// Irradiance of a surface that faces it, W / m², whatever the angle; not negative.
    #[serde(default = "one")]
    pub irradiance: Rgb,
    /// Angular diameter, degrees, 0..90: the sun's is 0.53. 0 makes sharp shadows, and nothing to be seen.
    #[serde(default)]
    #[schemars(range(min = 0.0, max = 90.0))]
    pub angle: f32,
}

impl DirectionalLight {
    pub(super) fn check(&self, c: &mut Checker) {
        c.nonzero("direction", self.direction);
        c.radiance("irradiance", self.irradiance);
        c.in_range("angle", self.angle, 0.0, 90.0);
    }

    pub(super) fn compile(&self) -> Disk {
        Disk::new(Vec3::from(self.direction), self.angle.to_radians(), self.irradiance.into())
    }
}

/// A disk of even radiance at infinity.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Disk {
    frame: Frame,
    direction: Vec3,
    /// 1 − cos of the angular radius; 0 for a single direction.
    one_minus_cos: f32,
    irradiance: Spectrum,
    /// 0 for a single direction.
    radiance: Spectrum,
}

impl Disk {
    /// Of an angular diameter in radians.
    pub(crate) fn new(direction: Vec3, angle: f32, irradiance: Spectrum) -> Self {
        let unit = Self::unit(angle);
        let (angle, radiance) = if unit > 1e-12 { (angle, irradiance * (1.0 / unit)) } else { (0.0, Spectrum::BLACK) };
        Self { irradiance, ..Self::of_radiance(direction, angle, radiance) }
    }

    /// Of an angular diameter in radians, and the radiance that is seen.
    pub(super) fn of_radiance(direction: Vec3, angle: f32, radiance: Spectrum) -> Self {
        let direction = direction.normalize();
        let sin = libm::sinf(0.25 * angle);
        let irradiance = radiance * Self::unit(angle);
        Self { frame: Frame::from_z(direction), direction, one_minus_cos: 2.0 * sin * sin, irradiance, radiance }
    }

    /// Irradiance of a disk of radiance 1: ∫ cos θ dω.
    fn unit(angle: f32) -> f32 {
        let sin = libm::sinf(0.5 * angle);
        std::f32::consts::PI * sin * sin
    }

    /// Irradiance of a surface that faces it.
    pub(super) fn irradiance(&self) -> Spectrum {
        self.irradiance
    }

    /// Whether it has no size.
    #[inline]
    pub(crate) fn is_delta(&self) -> bool {
        self.one_minus_cos == 0.0
    }

    /// Density in the disk per solid angle; 1 for a single direction.
    #[inline]
    pub(crate) fn pdf(&self) -> f32 {
        if self.is_delta() { 1.0 } else { 1.0 / (std::f32::consts::TAU * self.one_minus_cos) }
    }

    /// Radiance that is seen along the unit direction `w`.
    #[inline]
    pub(crate) fn le(&self, w: Vec3) -> Spectrum {
        // The chord, which does not cancel as the cosine does.
        let inside = (w - self.direction).length_squared() < 2.0 * self.one_minus_cos;
        if inside { self.radiance } else { Spectrum::BLACK }
    }

    /// A uniform direction of the disk, and the radiance; the irradiance for a single direction.
    #[inline]
    pub(crate) fn sample(&self, u: Vec2) -> (Vec3, Spectrum) {
        if self.is_delta() {
            return (self.direction, self.irradiance);
        }
        // The area-preserving map from the unit disk to the cap: r² of it is the share of 1 − cos θ.
        let d = uniform_disk(u);
        let z = self.one_minus_cos * d.length_squared();
        let xy = d * (self.one_minus_cos * (2.0 - z)).sqrt();
        (self.frame.to_world(xy.extend(1.0 - z)).normalize(), self.radiance)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampler::Independent;
    use crate::testing::chi2_counts;

    /// Rings of equal solid angle and sectors are hit equally often, all samples are seen, and the irradiance is right.
    #[test]
    fn disks_are_uniform() {
        for angle in [0.005_f32, 0.53, 30.0, 90.0] {
            let desc = DirectionalLight { direction: [0.6, 0.7, 0.45], irradiance: Rgb::grey(3.0), angle };
            let disk = desc.compile();
            let (n, bins) = (100_000, 10);
            let mut counts = vec![0_u64; bins * bins];
            let (mut seen, mut irradiance) = (0, 0.0);
            for i in 0..n {
                let (w, l) = disk.sample(Independent::new(1, glam::UVec2::ZERO, i).get_2d());
                let local = disk.frame.to_local(w);
                let ring = (w - disk.direction).as_dvec3().length_squared() / f64::from(2.0 * disk.one_minus_cos);
                let sector = f64::from(local.y).atan2(f64::from(local.x)) / std::f64::consts::TAU + 0.5;
                let bin = |x: f64| ((x * bins as f64) as usize).min(bins - 1);
                counts[bin(ring) * bins + bin(sector)] += 1;
                seen += u32::from(!disk.le(w).is_black());
                irradiance += f64::from(l.to_rgb()[0] * local.z / disk.pdf()) / f64::from(n);
            }
            // A disk of 0.005 degrees is some hundred roundings wide, which blur its bins.
            if angle > 0.1 {
                chi2_counts(&counts, &vec![f64::from(n) / (bins * bins) as f64; bins * bins]).unwrap();
            }
            assert!(seen as f32 > 0.99 * n as f32, "{seen} of {n} at {angle} degrees");
            assert!((irradiance - 3.0).abs() < 0.01, "{irradiance} at {angle} degrees");
        }
    }
}
