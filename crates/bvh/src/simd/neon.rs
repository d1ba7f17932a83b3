//! NEON: two vectors of four.

use std::arch::aarch64::*;

use crate::simd::{LANES, Simd};

/// The proof that the processor has NEON: [`detect`](Self::detect) is the only way to get one.
#[derive(Clone, Copy)]
pub(crate) struct Neon(());

impl Neon {
    #[inline]
    pub(crate) fn detect() -> Option<Self> {
        std::arch::is_aarch64_feature_detected!("neon").then_some(Self(()))
    }
}

type F32 = [float32x4_t; 2];

#[inline(always)]
fn both(f: impl Fn(usize) -> float32x4_t) -> F32 {
    [f(0), f(1)]
}

// SAFETY: of every block below: `self` proves that the processor has the instructions, and loads and stores go to
// arrays of eight numbers.
impl Simd for Neon {
    type F32 = F32;

    #[inline(always)]
    fn load(self, values: &[f32; LANES]) -> F32 {
        unsafe { [vld1q_f32(values.as_ptr()), vld1q_f32(values.as_ptr().add(4))] }
    }
    #[inline(always)]
    fn store(self, a: F32) -> [f32; LANES] {
        let mut values = [0.0; LANES];
        unsafe {
            vst1q_f32(values.as_mut_ptr(), a[0]);
            vst1q_f32(values.as_mut_ptr().add(4), a[1]);
        }
        values
    }
    #[inline(always)]
    fn splat(self, value: f32) -> F32 {
        both(|_| unsafe { vdupq_n_f32(value) })
    }
    #[inline(always)]
    fn add(self, a: F32, b: F32) -> F32 {
        both(|i| unsafe { vaddq_f32(a[i], b[i]) })
    }
    #[inline(always)]
    fn sub(self, a: F32, b: F32) -> F32 {
        both(|i| unsafe { vsubq_f32(a[i], b[i]) })
    }
    #[inline(always)]
    fn mul(self, a: F32, b: F32) -> F32 {
        both(|i| unsafe { vmulq_f32(a[i], b[i]) })
    }
    #[inline(always)]
    fn mul_add(self, a: F32, b: F32, c: F32) -> F32 {
        both(|i| unsafe { vfmaq_f32(c[i], a[i], b[i]) })
    }
    #[inline(always)]
    fn mul_sub(self, a: F32, b: F32, c: F32) -> F32 {
        both(|i| unsafe { vnegq_f32(vfmsq_f32(c[i], a[i], b[i])) })
    }
    #[inline(always)]
    fn min(self, a: F32, b: F32) -> F32 {
        both(|i| unsafe { vbslq_f32(vcltq_f32(a[i], b[i]), a[i], b[i]) })
    }
    #[inline(always)]
    fn max(self, a: F32, b: F32) -> F32 {
        both(|i| unsafe { vbslq_f32(vcgtq_f32(a[i], b[i]), a[i], b[i]) })
    }
    #[inline(always)]
    fn abs(self, a: F32) -> F32 {
        both(|i| unsafe { vabsq_f32(a[i]) })
    }
    #[inline(always)]
    fn flip(self, a: F32, sign: F32) -> F32 {
        both(|i| unsafe {
            let bit = vandq_u32(vreinterpretq_u32_f32(sign[i]), vdupq_n_u32(0x8000_0000));
            vreinterpretq_f32_u32(veorq_u32(vreinterpretq_u32_f32(a[i]), bit))
        })
    }
    #[inline(always)]
    fn not_gt(self, a: F32, b: F32) -> u32 {
        const BITS: [u32; 4] = [1, 2, 4, 8];
        let half = |i: usize| unsafe { vaddvq_u32(vbicq_u32(vld1q_u32(BITS.as_ptr()), vcgtq_f32(a[i], b[i]))) };
        half(0) | half(1) << 4
    }
    #[inline(always)]
    fn prefetch<T>(self, _: &[T], _: usize) {}
}
