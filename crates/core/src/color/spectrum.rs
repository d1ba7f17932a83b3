//! The amount of light that transport computes with.

use std::ops::{Add, AddAssign, Mul, MulAssign};

use glam::Vec4;

/// A radiance, or a factor on one, in four lanes: red, green and blue of linear Rec. 709, the fourth unused.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spectrum(Vec4);

impl Spectrum {
    /// No light.
    pub const BLACK: Self = Self(Vec4::ZERO);
    /// One in every lane.
    pub const ONE: Self = Self(Vec4::ONE);

    /// From linear red, green and blue.
    #[inline]
    pub fn from_rgb([r, g, b]: [f32; 3]) -> Self {
        Self(Vec4::new(r, g, b, 0.0))
    }

    /// Linear red, green and blue.
    #[inline]
    pub fn to_rgb(self) -> [f32; 3] {
        [self.0.x, self.0.y, self.0.z]
    }

    /// Whether there is no light in it at all.
    #[inline]
    pub fn is_black(self) -> bool {
        self.0 == Vec4::ZERO
    }

    /// The largest of red, green and blue.
    #[inline]
    pub fn max_component(self) -> f32 {
        self.0.x.max(self.0.y).max(self.0.z)
    }

    /// Each lane, from `lo` to `hi`.
    #[inline]
    pub fn clamp(self, lo: f32, hi: f32) -> Self {
        Self(self.0.clamp(Vec4::splat(lo), Vec4::splat(hi)))
    }

    /// `self` at t = 0, `other` at t = 1, mixed evenly between.
    #[inline]
    pub fn lerp(self, other: Self, t: f32) -> Self {
        Self(self.0 * (1.0 - t) + other.0 * t)
    }
}

impl Add for Spectrum {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        Self(self.0 + other.0)
    }
}

impl AddAssign for Spectrum {
    #[inline]
    fn add_assign(&mut self, other: Self) {
        self.0 += other.0;
    }
}

impl Mul for Spectrum {
    type Output = Self;
    #[inline]
    fn mul(self, other: Self) -> Self {
        Self(self.0 * other.0)
    }
}

impl MulAssign for Spectrum {
    #[inline]
    fn mul_assign(&mut self, other: Self) {
        self.0 *= other.0;
    }
}

impl Mul<f32> for Spectrum {
    type Output = Self;
    #[inline]
    fn mul(self, factor: f32) -> Self {
        Self(self.0 * factor)
    }
}
