//! Groups of lights, as they grow while a tree is built.

use glam::Vec3;

use super::bounds::LightBounds;
use super::cone::{Angle, Cone};

/// The bounds of one or many lights.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cluster {
    pub(super) lo: Vec3,
    pub(super) hi: Vec3,
    pub(super) normals: Cone,
    pub(super) cos_theta_e: f32,
    /// The sum of the lights' peak intensities.
    pub(super) intensity: f64,
    pub(super) two_sided: bool,
}

impl Cluster {
    pub(super) fn new(light: &LightBounds) -> Self {
        let normals = match light.axis.try_normalize() {
            Some(axis) if light.cos_theta_e >= 0.0 => Cone { axis, spread: Angle::from_cos(light.cos_theta_o) },
            _ => Cone::ALL,
        };
        let cos_theta_e = light.cos_theta_e.max(0.0);
        let sides = if light.two_sided { 2.0 } else { 1.0 };
        let solid_angle = (sides * normals.solid_angle(cos_theta_e)).min(4.0 * std::f32::consts::PI);
        Self {
            lo: light.lo,
            hi: light.hi,
            normals,
            cos_theta_e,
            intensity: f64::from(light.power) / f64::from(solid_angle),
            two_sided: light.two_sided,
        }
    }

    #[inline]
    pub(super) fn union(self, other: Self) -> Self {
        Self {
            lo: self.lo.min(other.lo),
            hi: self.hi.max(other.hi),
            normals: self.normals.union(other.normals),
            cos_theta_e: self.cos_theta_e.min(other.cos_theta_e),
            intensity: self.intensity + other.intensity,
            two_sided: self.two_sided | other.two_sided,
        }
    }

    /// Twice the centre along an axis.
    #[inline]
    pub(super) fn center2(&self, axis: usize) -> f32 {
        self.lo[axis] + self.hi[axis]
    }

    /// What it costs to keep these lights together: intensity · solid angle · size, where the size is the square of the
    /// diagonal, as the importance sees the sphere around the box. A row of lamps has no surface.
    pub(super) fn cost(&self) -> f64 {
        let solid_angle = f64::from(self.normals.solid_angle(self.cos_theta_e));
        self.intensity * solid_angle * (self.hi - self.lo).as_dvec3().length_squared()
    }

    pub(super) fn center(&self) -> Vec3 {
        0.5 * self.lo + 0.5 * self.hi
    }

    /// Half the diagonal, from the centre as it is rounded.
    pub(super) fn radius(&self) -> f32 {
        let center = self.center();
        (self.hi - center).max(center - self.lo).length() * (1.0 + 4.0 * f32::EPSILON)
    }
}
