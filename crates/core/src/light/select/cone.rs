//! Angles and cones of directions, without a single arc cosine.
//!
//! An angle is its cosine and sine; differences and sums come from the addition theorems. Together they keep small
//! angles and right angles alike, where a cosine alone would lose the one or a sine the other.

use std::f32::consts::PI;

use glam::Vec3;

/// An angle in 0..π.
#[derive(Clone, Copy, Debug)]
pub(super) struct Angle {
    pub(super) cos: f32,
    pub(super) sin: f32,
}

impl Angle {
    const ZERO: Self = Self { cos: 1.0, sin: 0.0 };
    pub(super) const STRAIGHT: Self = Self { cos: -1.0, sin: 0.0 };

    #[inline]
    pub(super) fn from_cos(cos: f32) -> Self {
        Self { cos, sin: (1.0 - cos * cos).max(0.0).sqrt() }
    }

    /// Between unit vectors, exact to a few units of the last place of 1 from 0 to π.
    #[inline]
    fn between(a: Vec3, b: Vec3) -> Self {
        Self { cos: a.dot(b), sin: a.cross(b).length() }
    }

    /// Whether it is not above another. Near 0 sines tell, and at π against 0, where sines are the same, cosines.
    #[inline]
    fn within(self, other: Self) -> bool {
        self.sin * other.cos <= self.cos * other.sin && self.cos >= other.cos
    }

    /// The difference, 0 where it would be negative.
    #[inline]
    fn minus(self, other: Self) -> Self {
        if self.within(other) {
            return Self::ZERO;
        }
        Self {
            cos: self.cos * other.cos + self.sin * other.sin,
            sin: (self.sin * other.cos - self.cos * other.sin).max(0.0),
        }
    }

    /// The sum; its sine is negative where it is above π.
    pub(super) fn plus(self, other: Self) -> Self {
        Self { cos: self.cos * other.cos - self.sin * other.sin, sin: self.sin * other.cos + self.cos * other.sin }
    }

    fn half(self) -> Self {
        if self.cos < 0.0 {
            return Self { cos: 0.5 * self.sin / (0.5 - 0.5 * self.cos).sqrt(), sin: (0.5 - 0.5 * self.cos).sqrt() };
        }
        let cos = (0.5 + 0.5 * self.cos).sqrt();
        Self { cos, sin: 0.5 * self.sin / cos }
    }
}

/// The directions within an angle of an axis.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cone {
    pub(super) axis: Vec3,
    pub(super) spread: Angle,
}

impl Cone {
    pub(super) const ALL: Self = Self { axis: Vec3::Z, spread: Angle::STRAIGHT };

    /// Wider than this by rounding only, a direction counts as inside.
    const ROUNDING: f32 = 5e-7;
    /// By how much a cone that grows grows more, so that the rounding of many unions does not add up.
    const MARGIN: Angle = Angle { cos: 1.0, sin: 1e-6 };

    /// A cone that holds both: the wider one, turned towards the other and opened as far as it takes.
    ///
    /// Pharr, Jakob & Humphreys 2023, §3.8.4.
    pub(super) fn union(self, other: Self) -> Self {
        let (a, b) = if other.spread.within(self.spread) { (self, other) } else { (other, self) };
        if a.spread.cos <= -1.0 {
            return Self::ALL;
        }
        // How far the edge of `b` is outside of `a`.
        let apart = Angle::between(a.axis, b.axis);
        let lead = a.spread.minus(b.spread);
        let outside = Angle {
            cos: apart.cos * lead.cos + apart.sin * lead.sin,
            sin: apart.sin * lead.cos - apart.cos * lead.sin,
        };
        if outside.sin <= Self::ROUNDING && outside.cos > 0.0 {
            return a;
        }
        let turn = outside.half();
        let spread = a.spread.plus(turn).plus(Self::MARGIN);
        let side = (b.axis - a.axis * apart.cos).try_normalize();
        match side {
            Some(side) if spread.sin > 0.0 => {
                Self { axis: (a.axis * turn.cos + side * turn.sin).normalize_or(a.axis), spread }
            }
            _ => Self::ALL,
        }
    }

    /// ∫ cos(max(θ - θₒ, 0)) dω up to θₒ + θₑ, in steradians: what the light of all normals in the cone would cover.
    /// π for a flat surface, 4π for a sphere.
    ///
    /// M_Ω of Conty Estevez & Kulla 2018, eq. 1, integrated in another form.
    pub(super) fn solid_angle(self, cos_theta_e: f32) -> f32 {
        let Angle { cos, sin } = self.spread;
        // The beam ends at θₑ beyond the cone, or where the sphere of directions does.
        let end = Angle::from_cos(cos_theta_e.max(-cos));
        let theta = libm::acosf(end.cos);
        let beyond = 0.5 * (sin * (theta + end.sin * end.cos) + cos * end.sin * end.sin);
        2.0 * PI * (1.0 - cos + beyond).max(f32::EPSILON)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use proptest::test_runner::RngSeed;

    fn angle_between(a: Vec3, b: Vec3) -> f64 {
        let (a, b) = (a.as_dvec3().normalize(), b.as_dvec3().normalize());
        a.cross(b).length().atan2(a.dot(b))
    }

    fn theta(angle: Angle) -> f64 {
        f64::from(angle.sin).atan2(f64::from(angle.cos))
    }

    proptest! {
        #![proptest_config(ProptestConfig { rng_seed: RngSeed::Fixed(1), failure_persistence: None, ..Default::default() })]

        #[test]
        fn differences_and_halves(a in 0.0f64..std::f64::consts::PI, b in 0.0f64..std::f64::consts::PI) {
            let angle = |t: f64| Angle { cos: t.cos() as f32, sin: t.sin() as f32 };
            prop_assert!((theta(angle(a).minus(angle(b))) - (a - b).max(0.0)).abs() < 1e-6);
            prop_assert!((theta(angle(a).half()) - 0.5 * a).abs() < 1e-6);
        }

        /// Every cone is within the union of all of them, which is not much wider than it must be for two.
        #[test]
        fn union_holds_every_cone(
            cones in prop::collection::vec((prop::array::uniform3(-1.0f32..1.0), 0.0f32..1.5), 2..20),
            near in prop::sample::select(vec![1e-7f32, 1e-4, 0.1, 1.0]),
        ) {
            let cones: Vec<Cone> = cones
                .into_iter()
                .map(|(axis, t)| Cone {
                    axis: (Vec3::Y + near * Vec3::from(axis)).normalize(),
                    spread: Angle { cos: (near * t).cos(), sin: (near * t).sin() },
                })
                .collect();
            let all = cones.iter().copied().reduce(Cone::union).unwrap();
            for cone in &cones {
                let needed = angle_between(all.axis, cone.axis) + theta(cone.spread);
                prop_assert!(needed <= theta(all.spread) + 2e-6 || all.spread.cos <= -1.0, "{cone:?} outside {all:?}");
            }
            let (a, b) = (cones[0], cones[1]);
            let (apart, union) = (angle_between(a.axis, b.axis), theta(a.union(b).spread));
            let least = (0.5 * (apart + theta(a.spread) + theta(b.spread))).max(theta(a.spread)).max(theta(b.spread));
            prop_assert!(union <= least + 5e-6, "{union} where {least} would do");
        }
    }

    #[test]
    fn union_of_the_same_is_the_same() {
        let a = Cone { axis: Vec3::new(0.6, 0.0, 0.8), spread: Angle::ZERO };
        let union = a.union(a);
        assert_eq!((union.axis, union.spread.cos, union.spread.sin), (a.axis, 1.0, 0.0));
        assert_eq!(a.union(Cone { axis: -a.axis, ..a }).spread.cos, -1.0);
    }

    #[test]
    fn solid_angle_is_the_integral() {
        for (theta_o, theta_e) in [(0.0, 0.5), (0.0, 1.0), (0.25, 0.5), (0.5, 0.5), (0.75, 0.1), (0.8, 0.5), (1.0, 0.5)]
        {
            let (theta_o, theta_e) = (theta_o * std::f64::consts::PI, theta_e * std::f64::consts::PI);
            let end = (theta_o + theta_e.min(0.5 * std::f64::consts::PI)).min(std::f64::consts::PI);
            let integral: f64 = (0..100_000)
                .map(|i| end * (f64::from(i) + 0.5) / 1e5)
                .map(|t| 2.0 * std::f64::consts::PI * t.sin() * (t - theta_o).max(0.0).cos() * end / 1e5)
                .sum();
            let spread = Angle { cos: theta_o.cos() as f32, sin: theta_o.sin() as f32 };
            let cos_theta_e = (theta_e.cos() as f32).max(0.0);
            let value = f64::from(Cone { axis: Vec3::Z, spread }.solid_angle(cos_theta_e));
            assert!((value - integral).abs() < 1e-4, "{theta_o}, {theta_e}: {value}, {integral}");
        }
    }
}
