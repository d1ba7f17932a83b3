//! Numbers of twice double precision: an unevaluated sum of two (Dekker 1971, doi:10.1007/BF01397083).

use std::ops::{Add, Div, Mul, Neg, Sub};

use glam::Vec3;

#[derive(Clone, Copy, Debug)]
pub(crate) struct Double {
    hi: f64,
    lo: f64,
}

fn two_sum(a: f64, b: f64) -> Double {
    let hi = a + b;
    let of_b = hi - a;
    Double { hi, lo: (a - (hi - of_b)) + (b - of_b) }
}

impl Double {
    pub(crate) fn to_f64(self) -> f64 {
        self.hi
    }

    pub(crate) fn sqrt(self) -> Self {
        let root = Self::from(self.hi.sqrt());
        if root.hi == 0.0 { root } else { root + (self - root * root) / (root + root) }
    }
}

impl From<f64> for Double {
    fn from(hi: f64) -> Self {
        Self { hi, lo: 0.0 }
    }
}

impl From<f32> for Double {
    fn from(x: f32) -> Self {
        Self::from(f64::from(x))
    }
}

impl Add for Double {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let (high, low) = (two_sum(self.hi, other.hi), two_sum(self.lo, other.lo));
        let sum = two_sum(high.hi, high.lo + low.hi);
        two_sum(sum.hi, sum.lo + low.lo)
    }
}

impl Neg for Double {
    type Output = Self;
    fn neg(self) -> Self {
        Self { hi: -self.hi, lo: -self.lo }
    }
}

impl Sub for Double {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Double {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let hi = self.hi * other.hi;
        let lo = self.hi.mul_add(other.hi, -hi) + (self.hi * other.lo + self.lo * other.hi);
        two_sum(hi, lo)
    }
}

impl Div for Double {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let first = Self::from(self.hi / other.hi);
        let rest = self - first * other;
        first + Self::from(rest.hi / other.hi)
    }
}

/// A vector of three.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Double3([Double; 3]);

impl Double3 {
    pub(crate) fn dot(self, other: Self) -> Double {
        let [x, y, z] = [0, 1, 2].map(|i| self.0[i] * other.0[i]);
        x + y + z
    }

    pub(crate) fn cross(self, other: Self) -> Self {
        Self([(1, 2), (2, 0), (0, 1)].map(|(i, j)| self.0[i] * other.0[j] - self.0[j] * other.0[i]))
    }

    pub(crate) fn length(self) -> f64 {
        self.dot(self).sqrt().to_f64()
    }
}

impl From<Vec3> for Double3 {
    fn from(v: Vec3) -> Self {
        Self(v.to_array().map(Double::from))
    }
}

impl Add for Double3 {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self([0, 1, 2].map(|i| self.0[i] + other.0[i]))
    }
}

impl Sub for Double3 {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self([0, 1, 2].map(|i| self.0[i] - other.0[i]))
    }
}

impl Mul<Double> for Double3 {
    type Output = Self;
    fn mul(self, factor: Double) -> Self {
        Self(self.0.map(|x| x * factor))
    }
}
