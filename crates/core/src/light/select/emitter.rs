//! The importance of a light, or of a group of lights, for a point: how much light it may send there.
//!
//! importance = I · cos θ'ᵢ · cos θ' / d²
//!
//! with the peak intensity I (power per steradian), the mean square d² of the distances to all places in the lights' box,
//! which also tells apart groups that the point is within, the angle θ' at which the lights send light to the point and
//! the angle θ'ᵢ at which it arrives. Both are as small as the bounds allow: θ' = max(θ - θₒ - θᵤ, 0), where θ is the
//! angle between the axis and the direction to the point, θₒ the spread of the normals and θᵤ the half-angle under which
//! the point sees the sphere; θ'ᵢ = max(θᵢ - θᵤ, 0). So importance is 0 only where no light can arrive.
//!
//! Conty Estevez & Kulla 2018, doi:10.1145/3233305, §3.2; with the receiver's cosine of both sides, and differences of
//! angles by the addition theorems, of Pharr, Jakob & Humphreys, Physically Based Rendering, 4th ed. 2023, §12.6.3. I
//! instead of power makes lights of different kinds comparable: a lamp that shines one way is brighter there.

use glam::{Vec3, Vec4};

use super::cluster::Cluster;
use super::cone::Angle;

/// Four emitters, each one light or many, as a point sees them: side by side, as they are looked at in one go.
#[derive(Clone, Copy, Debug)]
pub(super) struct Emitters {
    /// The spheres around them.
    center: [Vec4; 3],
    radius: Vec4,
    /// The cones of their normals.
    axis: [Vec4; 3],
    cos_spread: Vec4,
    sin_spread: Vec4,
    cos_theta_e: Vec4,
    /// -1 if they shine from the back as well, otherwise 1.
    back: Vec4,
    /// Power per steradian, in a unit of their own.
    intensity: Vec4,
}

impl Emitters {
    /// Radii whose squares, and their inverses, are numbers of single precision.
    const SMALLEST: f32 = 1e-15;
    const LARGEST: f32 = 1e18;
    /// Above the rounding of the angles here, below anything that is seen.
    const SLACK: Angle = Angle { cos: 1.0, sin: 4e-6 };

    /// Of up to four groups, whose intensities are told in the given unit. What is left of the four is dark, and far.
    pub(super) fn new(clusters: &[Cluster], unit: f64) -> Self {
        let four = |value: fn(&Cluster) -> f32, dark| {
            Vec4::from_array([0, 1, 2, 3].map(|i| clusters.get(i).map_or(dark, value)))
        };
        let intensity = [0, 1, 2, 3].map(|i| clusters.get(i).map_or(0.0, |cluster| cluster.intensity / unit) as f32);
        Self {
            center: [four(|c| c.center().x, 0.0), four(|c| c.center().y, 0.0), four(|c| c.center().z, 0.0)],
            radius: four(|c| c.radius().clamp(Self::SMALLEST, Self::LARGEST), Self::LARGEST),
            axis: [four(|c| c.normals.axis.x, 0.0), four(|c| c.normals.axis.y, 0.0), four(|c| c.normals.axis.z, 0.0)],
            cos_spread: four(|c| c.normals.spread.plus(Self::SLACK).cos, 0.0),
            sin_spread: four(|c| c.normals.spread.plus(Self::SLACK).sin, 0.0),
            // A beam has the rounding of the cosine it is compared with. No cosine is above 2.
            cos_theta_e: four(|c| c.cos_theta_e * (1.0 - 8.0 * f32::EPSILON), 2.0),
            back: four(|c| if c.two_sided { -1.0 } else { 1.0 }, 1.0),
            intensity: Vec4::from_array(intensity).clamp(Vec4::splat(f32::MIN_POSITIVE), Vec4::MAX),
        }
    }

    /// cos θ' · cos θ'ᵢ, 0 only where no light can arrive, and d².
    ///
    /// All lengths are taken squared or in products of two, so that a single division makes cosines of them.
    #[inline]
    fn cosines(&self, p: Vec3, n: Vec3) -> (Vec4, Vec4) {
        let to_p = [p.x - self.center[0], p.y - self.center[1], p.z - self.center[2]];
        let (d_sq, r_sq) = (dot(to_p, to_p), self.radius * self.radius);
        // Among the lights anything is possible; so it is where the distance is too much for its square.
        let outside = d_sq.cmpgt(r_sq) & d_sq.cmplt(Vec4::splat(Self::LARGEST * Self::LARGEST));
        let d_sq_inv = 1.0 / d_sq;
        // The sphere as it is seen: d sin θᵤ is its radius.
        let d_cos_u = (d_sq - r_sq).max(Vec4::ZERO).sqrt();

        // θₒ + θᵤ; its sine is negative above π.
        let d_cos_ou = self.cos_spread * d_cos_u - self.sin_spread * self.radius;
        let d_sin_ou = self.sin_spread * d_cos_u + self.cos_spread * self.radius;
        let along = dot(self.axis, to_p);
        let d_cos = along.max(self.back * along);
        let across = cross(self.axis, to_p);
        let d_sin = dot(across, across).sqrt();
        let best = d_cos.cmpge(d_cos_ou) | d_sin_ou.cmplt(Vec4::ZERO);
        let emitted = (d_cos * d_cos_ou + d_sin * d_sin_ou) * d_sq_inv;
        let emitted = Vec4::select(best | !outside, Vec4::ONE, emitted);

        // Without a surface light counts from all directions alike.
        let any = if n == Vec3::ZERO { f32::MAX } else { 0.0 };
        let d_cos = (n.x * to_p[0] + n.y * to_p[1] + n.z * to_p[2]).abs().max(Vec4::splat(any));
        let d_sin = (d_sq - d_cos * d_cos).max(Vec4::ZERO).sqrt();
        let received = (d_cos * d_cos_u + d_sin * self.radius) * d_sq_inv;
        let received = Vec4::select(d_cos.cmpge(d_cos_u) | !outside, Vec4::ONE, received);

        let least = Vec4::splat(Self::SLACK.sin);
        let cosines =
            Vec4::select(emitted.cmpgt(self.cos_theta_e), emitted.max(least) * received.max(least), Vec4::ZERO);
        // The mean over a box is that of its middle and its variance, a third of the square of half the diagonal.
        (cosines, (d_sq + r_sq * (1.0 / 3.0)).min(Vec4::MAX))
    }

    /// The importance of each, in a unit that is the same for all four: at most 1, and 0 only where no light can
    /// arrive. `n` is the unit normal at `p`, of either side, as light may go through a surface; zero where light counts
    /// from all directions alike.
    ///
    /// The intensities are at most 1, and distances count by that of the nearest, so nothing is too large or too small.
    #[inline]
    pub(super) fn importances(&self, p: Vec3, n: Vec3) -> Vec4 {
        let (cosines, d_sq) = self.cosines(p, n);
        let importances = self.intensity * cosines * (d_sq.min_element() / d_sq);
        Vec4::select(cosines.cmpgt(Vec4::ZERO), importances.max(Vec4::splat(f32::MIN_POSITIVE)), Vec4::ZERO)
    }

    /// The importance of the first: an estimate of the irradiance at `p`, in the unit of the intensities per square
    /// metre.
    ///
    /// In double precision, which holds every quotient of numbers of single precision.
    #[inline]
    pub(super) fn irradiance(&self, p: Vec3, n: Vec3) -> f64 {
        let (cosines, d_sq) = self.cosines(p, n);
        f64::from(self.intensity.x) * f64::from(cosines.x) / f64::from(d_sq.x)
    }
}

#[inline]
fn dot(a: [Vec4; 3], b: [Vec4; 3]) -> Vec4 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline]
fn cross(a: [Vec4; 3], b: [Vec4; 3]) -> [Vec4; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::light::select::{LightBounds, LightSelection, LightSelector};
    use crate::sampler::Independent;
    use crate::sampling::uniform_sphere;
    use glam::{DVec3, UVec2};
    use std::f32::consts::PI;

    fn importance(light: LightBounds, p: Vec3, n: Vec3) -> f64 {
        Emitters::new(&[Cluster::new(&light)], 1.0).irradiance(p, n)
    }

    fn angle(a: DVec3, b: DVec3) -> f64 {
        a.cross(b).length().atan2(a.dot(b))
    }

    /// cos θ', cos θ'ᵢ and d² as the formula has them; `None` where rounding or margins may tell more than the formula.
    fn formula(cluster: &Cluster, p: Vec3, n: Vec3) -> Option<([f64; 2], f64)> {
        let (lo, hi, n) = (cluster.lo.as_dvec3(), cluster.hi.as_dvec3(), n.as_dvec3());
        let (to_p, radius) = (p.as_dvec3() - 0.5 * (lo + hi), 0.5 * (hi - lo).length());
        let (d, d_sq) = (to_p.length(), to_p.length_squared() + (hi - lo).length_squared() / 12.0);
        if d < 0.99 * radius {
            return Some(([1.0, 1.0], d_sq));
        }
        let subtended = (radius / d).asin();
        let theta = angle(cluster.normals.axis.as_dvec3(), to_p);
        let theta = if cluster.two_sided { theta.min(std::f64::consts::PI - theta) } else { theta };
        let spread = f64::from(cluster.normals.spread.sin).atan2(f64::from(cluster.normals.spread.cos));
        let emitted = (theta - spread - subtended).max(0.0).cos();
        let theta_i = angle(n, to_p);
        let received = (theta_i.min(std::f64::consts::PI - theta_i) - subtended).max(0.0).cos();
        let end = f64::from(cluster.cos_theta_e);
        let emitted_or_0 = if emitted > end { emitted } else { 0.0 };
        (d > 1.01 * radius && (emitted - end).abs() > 1e-4).then_some(([emitted_or_0, received], d_sq))
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

    /// One lamp or two, of any kind.
    fn group(numbers: &mut Independent, kind: u32, scale: f32) -> Cluster {
        let mut lamp = || lamp(numbers, scale * Vec3::X, 0.5 * scale).0;
        let cos_theta_e = if kind & 1 == 0 { 0.0 } else { 0.3 };
        let power = 1.0 + kind as f32;
        let one = Cluster::new(&LightBounds { two_sided: kind & 2 != 0, cos_theta_e, power, ..lamp() });
        if kind & 4 == 0 { one } else { one.union(Cluster::new(&lamp())) }
    }

    /// All four are the formula, and dark where there are fewer.
    #[test]
    fn four_are_the_formula() {
        let mut compared = 0;
        for i in 0..20_000 {
            let mut numbers = Independent::new(9, UVec2::ZERO, i);
            let scale = [1e-5, 1.0, 1e5][(i % 3) as usize];
            let groups: Vec<_> = (0..1 + i / 3 % 4).map(|k| group(&mut numbers, (i / 5 + k) % 8, scale)).collect();
            let far = if i % 5 == 0 { 0.0 } else { 2.0 * scale * numbers.get_1d() };
            let (p, n) = (far * uniform_sphere(numbers.get_2d()), uniform_sphere(numbers.get_2d()));
            let brightest = groups.iter().map(|group| group.intensity).fold(0.0, f64::max);
            let emitters = Emitters::new(&groups, brightest);
            let ((cosines, d_sq), importances) = (emitters.cosines(p, n), emitters.importances(p, n));
            let alone: Vec<_> = groups.iter().map(|&group| Emitters::new(&[group], 1.0).irradiance(p, n)).collect();
            for (k, group) in groups.iter().enumerate() {
                // In proportion to what each is alone.
                let [a, b] = [0, k].map(|k| f64::from(importances[k]));
                assert!((a * alone[k] - b * alone[0]).abs() <= 2e-6 * a * alone[k], "{importances}, {alone:?}");
                let Some(([emitted, received], mean_d_sq)) = formula(group, p, n) else { continue };
                compared += 1;
                let cosine = f64::from(cosines[k]);
                assert!((cosine - emitted * received).abs() < 3e-5 && (cosine > 0.0) == (emitted > 0.0), "{cosine}");
                assert!((f64::from(d_sq[k]) / mean_d_sq - 1.0).abs() < 1e-5);
                assert!((alone[k] - group.intensity * cosine / mean_d_sq).abs() <= 1e-5 * alone[k]);
            }
            assert!((groups.len()..4).all(|k| importances[k] == 0.0));
        }
        assert!(compared > 40_000, "{compared}");
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
