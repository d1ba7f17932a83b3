//! Four or eight numbers side by side, on whatever the processor has for it.
//!
//! What is computed here only *sorts out*: boxes and primitives that a ray cannot meet, and those that it meets for certain.
//! The bounds are conservative on both sides, so paths may round differently (with or without fused operations) and yet every
//! hit is the same bits: hits are computed elsewhere, one at a time, in double precision.

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

/// The children of a node, and the most primitives in a leaf.
pub(crate) const LANES: usize = 8;

/// A processor's way to compute with `N` numbers. A value of the type is the proof that the processor has it.
pub(crate) trait Simd<const N: usize>: Copy {
    /// The numbers.
    type F32: Copy;
    /// A truth value for each.
    type Mask: Copy;

    fn load(self, values: &[f32; N]) -> Self::F32;
    fn store(self, a: Self::F32) -> [f32; N];
    fn splat(self, value: f32) -> Self::F32;
    fn add(self, a: Self::F32, b: Self::F32) -> Self::F32;
    fn sub(self, a: Self::F32, b: Self::F32) -> Self::F32;
    fn mul(self, a: Self::F32, b: Self::F32) -> Self::F32;
    fn div(self, a: Self::F32, b: Self::F32) -> Self::F32;
    /// a b + c, fused or not.
    fn mul_add(self, a: Self::F32, b: Self::F32, c: Self::F32) -> Self::F32;
    /// a b − c, fused or not.
    fn mul_sub(self, a: Self::F32, b: Self::F32, c: Self::F32) -> Self::F32;
    /// c − a b, fused or not.
    fn neg_mul_add(self, a: Self::F32, b: Self::F32, c: Self::F32) -> Self::F32;
    /// The smaller; of NaN and a number, `b`.
    fn min(self, a: Self::F32, b: Self::F32) -> Self::F32;
    /// The larger; of NaN and a number, `b`.
    fn max(self, a: Self::F32, b: Self::F32) -> Self::F32;
    fn abs(self, a: Self::F32) -> Self::F32;
    /// `a`, negated where `sign` is negative.
    fn flip(self, a: Self::F32, sign: Self::F32) -> Self::F32;
    /// Not a > b, so true for NaN: what cannot be compared is not ruled out.
    fn not_gt(self, a: Self::F32, b: Self::F32) -> Self::Mask;
    /// a > b, so false for NaN: what cannot be compared is not certain.
    fn gt(self, a: Self::F32, b: Self::F32) -> Self::Mask;
    fn and(self, a: Self::Mask, b: Self::Mask) -> Self::Mask;
    fn or(self, a: Self::Mask, b: Self::Mask) -> Self::Mask;
    /// Bit i: lane i is true.
    fn bits(self, mask: Self::Mask) -> u32;
}

/// A processor's way to compute with four and with eight numbers.
pub(crate) trait Cpu: Simd<4> + Simd<LANES> {
    /// Runs a task in a function of its own that is compiled for the processor.
    fn call<T: Task>(self, task: T) -> T::Output;

    /// Says that an element of a list will be read soon.
    fn prefetch<T>(self, list: &[T], index: usize);
}

/// Work that is written once for every kind of processor.
pub(crate) trait Task {
    type Output;

    /// Must be inlined, and all that it calls with `cpu`, for instructions beyond the target's own are inlined only where they
    /// are enabled.
    fn run<C: Cpu>(self, cpu: C) -> Self::Output;
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

    /// What a walk computes with, if the processor has it.
    pub(crate) fn processor(self) -> Processor {
        #[cfg(target_arch = "x86_64")]
        if self == Self::Avx2
            && let Some(avx2) = Avx2::detect()
        {
            return Processor::Avx2(avx2);
        }
        #[cfg(target_arch = "aarch64")]
        if self == Self::Neon
            && let Some(neon) = Neon::detect()
        {
            return Processor::Neon(neon);
        }
        Processor::Scalar(Scalar)
    }
}

/// An [`Isa`] that this processor has.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Processor {
    Scalar(Scalar),
    #[cfg(target_arch = "x86_64")]
    Avx2(Avx2),
    #[cfg(target_arch = "aarch64")]
    Neon(Neon),
}

impl Processor {
    /// Runs a task.
    #[inline(always)]
    pub(crate) fn call<T: Task>(self, task: T) -> T::Output {
        match self {
            Self::Scalar(scalar) => scalar.call(task),
            #[cfg(target_arch = "x86_64")]
            Self::Avx2(avx2) => avx2.call(task),
            #[cfg(target_arch = "aarch64")]
            Self::Neon(neon) => neon.call(task),
        }
    }
}
