//! The importance of a light, or of a group of lights, for a point: how much light it may send there.
//!
//! importance = I · cos θ'ᵢ · cos θ' / d²
//!
//! with the peak intensity I (power per steradian), the mean square d² of the distances to all places in the lights' box,
//! which also tells apart groups that the point is within, the angle θ' at
//! which the lights send light to the point and the angle θ'ᵢ at which it arrives. Both are as small as the bounds
//! allow: θ' = max(θ - θₒ - θᵤ, 0), where θ is the angle between the axis and the direction to the point, θₒ the spread
//! of the normals and θᵤ the half-angle under which the point sees the sphere; θ'ᵢ = max(θᵢ - θᵤ, 0). So importance is
//! 0 only where no light can arrive.
//!
//! Conty Estevez & Kulla 2018, doi:10.1145/3233305, §3.2; with the receiver's cosine of both sides, and differences of
//! angles by the addition theorems, of Pharr, Jakob & Humphreys, Physically Based Rendering, 4th ed. 2023, §12.6.3. I
//! instead of power makes lights of different kinds comparable: a lamp that shines one way is brighter there.

use glam::Vec3;

use super::bounds::LightBounds;
use super::cone::{Angle, Cone};

/// The bounds of one or many lights, as they grow while a tree is built.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cluster {
    pub(super) lo: Vec3,
    pub(super) hi: Vec3,
    normals: Cone,
    cos_theta_e: f32,
    /// The sum of the lights' peak intensities.
    intensity: f64,
    two_sided: bool,
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

    pub(super) fn emitter(&self) -> Emitter {
        let center = 0.5 * self.lo + 0.5 * self.hi;
        // From the centre as it is rounded.
        let radius = (self.hi - center).max(center - self.lo).length() * (1.0 + 4.0 * f32::EPSILON);
        Emitter {
            center,
            radius: radius.clamp(Emitter::SMALLEST, Emitter::LARGEST),
            variance: ((self.hi - self.lo).length_squared() / 12.0)
                .clamp(Emitter::SMALLEST * Emitter::SMALLEST, Emitter::LARGEST * Emitter::LARGEST),
            axis: self.normals.axis,
            spread: self.normals.spread,
            // A beam has the rounding of the cosine it is compared with.
            cos_theta_e: self.cos_theta_e * (1.0 - 8.0 * f32::EPSILON),
            intensity: (self.intensity as f32).clamp(f32::MIN_POSITIVE, f32::MAX),
            two_sided: self.two_sided,
        }
    }
}

/// One or many lights, as a point sees them.
#[derive(Clone, Copy, Debug)]
pub(super) struct Emitter {
    /// The sphere around them.
    center: Vec3,
    radius: f32,
    /// Mean squared distance of a place in the box from its middle.
    variance: f32,
    /// The cone of their normals.
    axis: Vec3,
    spread: Angle,
    cos_theta_e: f32,
    /// In the unit of power per steradian.
    intensity: f32,
    two_sided: bool,
}

impl Emitter {
    /// Radii whose squares are numbers of single precision.
    const SMALLEST: f32 = 1e-18;
    const LARGEST: f32 = 1e19;
    /// Above the rounding of the angles here, below anything that is seen.
    const SLACK: f32 = 4e-6;

    /// An estimate of the irradiance at `p`; 0 only where none is possible. `n` is the unit normal there, of either
    /// side, as light may go through a surface; zero where light counts from all directions alike.
    ///
    /// In double precision, which holds every quotient of numbers of single precision.
    #[inline]
    pub(super) fn importance(&self, p: Vec3, n: Vec3) -> f64 {
        let to_p = p - self.center;
        let (d_sq, r_sq) = (to_p.length_squared(), self.radius * self.radius);
        // The mean over the box.
        let mean_d_sq = f64::from(d_sq) + f64::from(self.variance);
        // Among the lights anything is possible; so it is where the distance is none.
        if !(d_sq > r_sq && d_sq < f32::INFINITY) {
            let mean_d_sq = if mean_d_sq.is_finite() { mean_d_sq } else { f64::from(f32::MAX) };
            return f64::from(self.intensity) / mean_d_sq;
        }
        let d_inv = 1.0 / d_sq.sqrt();
        let w = to_p * d_inv;
        let subtended = Angle::from_sin(self.radius * d_inv + Self::SLACK);

        let mut theta = Angle::between(self.axis, w);
        if self.two_sided {
            theta.cos = theta.cos.abs();
        }
        let cos_emitted = theta.minus(self.spread).minus(subtended).cos;
        if cos_emitted <= self.cos_theta_e {
            return 0.0;
        }
        let cos_received = if n == Vec3::ZERO { 1.0 } else { Angle::from_cos(n.dot(w).abs()).minus(subtended).cos };
        f64::from(self.intensity) * f64::from(cos_emitted) * f64::from(cos_received) / mean_d_sq
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::light::select::{LightSelection, LightSelector};
    use crate::sampler::Independent;
    use crate::sampling::uniform_sphere;
    use glam::{DVec3, UVec2};
    use std::f32::consts::PI;

    fn importance(light: LightBounds, p: Vec3, n: Vec3) -> f64 {
        Cluster::new(&light).emitter().importance(p, n)
    }

    /// Far from a small light, importance is the irradiance.
    #[test]
    fn is_the_irradiance_of_a_small_light() {
        let (p, n) = (Vec3::new(3.0, 4.0, 0.0), Vec3::NEG_X);
        let size = Vec3::splat(1e-4);
        let lamp = LightBounds::flat(-size, size, Vec3::Y, PI);
        // L A cos θ cos θᵢ / d² with L A = power / π = 1.
        assert!((importance(lamp, p, n) - 0.8 * 0.6 / 25.0).abs() < 1e-5);
        assert!((importance(lamp, p, Vec3::ZERO) - 0.8 / 25.0).abs() < 1e-5);
        assert_eq!(importance(lamp, -p, n), 0.0);
        let both = LightBounds::flat_two_sided(-size, size, Vec3::Y, 2.0 * PI);
        assert!((importance(both, -p, n) - 0.8 * 0.6 / 25.0).abs() < 1e-5);
        let point = LightBounds::sphere(Vec3::ZERO, 0.0, 4.0 * PI);
        assert!((importance(point, p, n) - 0.6 / 25.0).abs() < 1e-5);
        let beam = LightBounds { cos_theta_e: 0.9, ..lamp };
        assert_eq!(importance(beam, p, n), 0.0);
        assert!((importance(beam, Vec3::Y, Vec3::Y) - 1.0 / (1.0 - 0.9 * 0.9)).abs() < 1e-3);
    }

    #[test]
    fn is_finite_everywhere() {
        for power in [1e-38, 1.0, 1e38] {
            for size in [0.0, 1e-20, 1.0, 1e15] {
                let light = LightBounds::sphere(Vec3::ZERO, size, power);
                for distance in [0.0, 1e-30, 1e-10, 1.0, 1e15, 1e25, 1e38] {
                    let value = importance(light, Vec3::new(distance, 0.0, 0.0), Vec3::X);
                    assert!(value > 0.0 && value.is_finite(), "{power} {size} {distance}: {value}");
                }
            }
        }
    }

    /// A random flat or spherical lamp, with one of its points and the normal there.
    fn lamp(numbers: &mut Independent, place: Vec3, scale: f32) -> (LightBounds, DVec3, DVec3) {
        let center = place + scale * uniform_sphere(numbers.get_2d());
        let u = numbers.get_2d();
        if numbers.get_1d() < 0.3 {
            let (n, radius) = (uniform_sphere(u), 0.5 * scale * numbers.get_1d());
            let on_it = center.as_dvec3() + f64::from(radius) * n.as_dvec3();
            return (LightBounds::sphere(center, radius, 1.0), on_it, n.as_dvec3());
        }
        let size = scale * numbers.get_1d().powi(4);
        let corners = [0, 1, 2].map(|_| center + size * uniform_sphere(numbers.get_2d()));
        let [a, b, c] = corners.map(|v| v.as_dvec3());
        let n = (b - a).cross(c - a).normalize_or(DVec3::Y);
        let (lo, hi) = (corners[0].min(corners[1]).min(corners[2]), corners[0].max(corners[1]).max(corners[2]));
        let on_it = a + f64::from(u.x) * (b - a) + f64::from(u.y * (1.0 - u.x)) * (c - a);
        (LightBounds::flat(lo, hi, n.as_vec3(), 1.0), on_it, n)
    }

    /// Wherever a point of a lamp shines, however grazingly, the lamp can be chosen: neither it nor a group of it is ruled out.
    #[test]
    fn is_never_0_where_light_arrives() {
        let mut tried = 0;
        for i in 0..50_000 {
            let mut numbers = Independent::new(5, UVec2::ZERO, i);
            let scale = [1e-5, 1.0, 1e5][(i % 3) as usize];
            let place = [0.0, 10.0, 100.0][(i / 3 % 3) as usize] * scale * Vec3::new(1.0, -0.7, 0.4);
            let (light, on_it, normal) = lamp(&mut numbers, place, scale);
            // Along the lamp and a little up, by 1 or much less than that.
            let along = normal.cross(uniform_sphere(numbers.get_2d()).as_dvec3()).normalize_or_zero();
            let up = 10_f64.powf(-9.0 * f64::from(numbers.get_1d()));
            let distance = f64::from(scale) * 10_f64.powf(8.0 * f64::from(numbers.get_1d()) - 4.0);
            let p = (on_it + distance * (along + up * normal)).as_vec3();
            let n =
                along.cross(normal).lerp(normal, f64::from(numbers.get_1d() > 0.5)).normalize_or(DVec3::Z).as_vec3();
            if (p.as_dvec3() - on_it).dot(normal) <= 0.0 {
                continue;
            }
            tried += 1;
            let mut lights = vec![light];
            lights.extend((0..i % 8).map(|_| lamp(&mut numbers, place, scale).0));
            let pmf = LightSelector::new(LightSelection::Tree, &lights).pmf(p, n, 0);
            assert!(pmf > 0.0, "{light:?} among {lights:?} from {p}, up {up}");
        }
        assert!(tried > 20_000, "{tried}");
    }
}
