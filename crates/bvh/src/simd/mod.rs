//! Eight numbers side by side, on whatever the processor has for it.
//!
//! What is computed here only *rules out*: boxes and primitives that a ray cannot meet. The bounds are conservative, so
//! paths may round differently (with or without fused operations) and yet every hit is the same bits: hits are computed
//! elsewhere, one at a time, in double precision.

#[cfg(target_arch = "x86_64")]
mod avx2;
#[cfg(target_arch = "aarch64")]
mod neon;
mod scalar;

#[cfg(target_arch = "x86_64")]
pub(crate) use avx2::Avx2;
#[cfg(target_arch = "aarch64")]
pub(crate) use neon::Neon;
pub(crate) use scalar::Scalar;

/// The lanes of a vector.
pub(crate) const LANES: usize = 8;

/// A processor's way to compute with eight numbers. A value of the type is the proof that the processor has it.
pub(crate) trait Simd: Copy {
    /// Eight numbers.
    type F32: Copy;

    fn load(self, values: &[f32; LANES]) -> Self::F32;
    fn store(self, a: Self::F32) -> [f32; LANES];
    fn splat(self, value: f32) -> Self::F32;
    fn add(self, a: Self::F32, b: Self::F32) -> Self::F32;
    fn sub(self, a: Self::F32, b: Self::F32) -> Self::F32;
    fn mul(self, a: Self::F32, b: Self::F32) -> Self::F32;
    /// a b + c, fused or not.
    fn mul_add(self, a: Self::F32, b: Self::F32, c: Self::F32) -> Self::F32;
    /// a b − c, fused or not.
    fn mul_sub(self, a: Self::F32, b: Self::F32, c: Self::F32) -> Self::F32;
    /// The smaller; of NaN and a number, `b`.
    fn min(self, a: Self::F32, b: Self::F32) -> Self::F32;
    /// The larger; of NaN and a number, `b`.
    fn max(self, a: Self::F32, b: Self::F32) -> Self::F32;
    fn abs(self, a: Self::F32) -> Self::F32;
    /// `a`, negated where `sign` is negative.
    fn flip(self, a: Self::F32, sign: Self::F32) -> Self::F32;
    /// Bit i: not a > b in lane i, so set for NaN: what cannot be compared is not ruled out.
    fn not_gt(self, a: Self::F32, b: Self::F32) -> u32;
    /// Says that an element of a list will be read soon.
    fn prefetch<T>(self, list: &[T], index: usize);
}

/// The best that this processor has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Isa {
    /// Plain loops that a compiler may turn into what every processor of the target has.
    Scalar,
    /// x86-64 with AVX2 and FMA.
    #[cfg(target_arch = "x86_64")]
    Avx2,
    /// 64-bit ARM with NEON, which nearly all have.
    #[cfg(target_arch = "aarch64")]
    Neon,
}

impl Isa {
    /// Finds out what this processor has.
    pub fn detect() -> Self {
        #[cfg(target_arch = "x86_64")]
        if Avx2::detect().is_some() {
            return Self::Avx2;
        }
        #[cfg(target_arch = "aarch64")]
        if Neon::detect().is_some() {
            return Self::Neon;
        }
        Self::Scalar
    }
}
