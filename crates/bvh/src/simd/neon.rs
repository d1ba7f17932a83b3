//! NEON: two registers of four numbers.

use std::arch::aarch64::*;
use std::arch::asm;

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

/// Lanes 0..4 and 4..8.
type F32 = [float32x4_t; 2];

/// A half after the other.
#[inline(always)]
fn each(f: impl Fn(usize) -> float32x4_t) -> F32 {
    [f(0), f(1)]
}

/// Bit i: lane i of the comparison failed. Its lanes are all ones or all zeros.
#[inline(always)]
fn failed(_: Neon, holds: [uint32x4_t; 2]) -> u32 {
    const BITS: [u16; LANES] = [1, 2, 4, 8, 16, 32, 64, 128];
    // SAFETY: the first argument proves that the processor has NEON.
    unsafe {
        let holds = vcombine_u16(vmovn_u32(holds[0]), vmovn_u32(holds[1]));
        u32::from(vaddvq_u16(vbicq_u16(vld1q_u16(BITS.as_ptr()), holds)))
    }
}

// SAFETY: of every block below: `self` proves that the processor has the instructions, and loads and stores go to
// arrays of eight numbers.
impl Simd for Neon {
    type F32 = F32;

    #[inline(always)]
    fn load(self, values: &[f32; LANES]) -> F32 {
        each(|half| unsafe { vld1q_f32(values[4 * half..].as_ptr()) })
    }
    #[inline(always)]
    fn store(self, a: F32) -> [f32; LANES] {
        let mut values = [0.0; LANES];
        for (values, a) in values.chunks_exact_mut(4).zip(a) {
            unsafe { vst1q_f32(values.as_mut_ptr(), a) };
        }
        values
    }
    #[inline(always)]
    fn splat(self, value: f32) -> F32 {
        each(|_| unsafe { vdupq_n_f32(value) })
    }
    #[inline(always)]
    fn add(self, a: F32, b: F32) -> F32 {
        each(|half| unsafe { vaddq_f32(a[half], b[half]) })
    }
    #[inline(always)]
    fn sub(self, a: F32, b: F32) -> F32 {
        each(|half| unsafe { vsubq_f32(a[half], b[half]) })
    }
    #[inline(always)]
    fn mul(self, a: F32, b: F32) -> F32 {
        each(|half| unsafe { vmulq_f32(a[half], b[half]) })
    }
    #[inline(always)]
    fn mul_add(self, a: F32, b: F32, c: F32) -> F32 {
        each(|half| unsafe { vfmaq_f32(c[half], a[half], b[half]) })
    }
    #[inline(always)]
    fn mul_sub(self, a: F32, b: F32, c: F32) -> F32 {
        each(|half| unsafe { vfmaq_f32(vnegq_f32(c[half]), a[half], b[half]) })
    }
    // Not `vminq_f32`, which makes NaN of NaN and a number.
    #[inline(always)]
    fn min(self, a: F32, b: F32) -> F32 {
        each(|half| unsafe { vbslq_f32(vcltq_f32(a[half], b[half]), a[half], b[half]) })
    }
    #[inline(always)]
    fn max(self, a: F32, b: F32) -> F32 {
        each(|half| unsafe { vbslq_f32(vcgtq_f32(a[half], b[half]), a[half], b[half]) })
    }
    #[inline(always)]
    fn abs(self, a: F32) -> F32 {
        each(|half| unsafe { vabsq_f32(a[half]) })
    }
    #[inline(always)]
    fn flip(self, a: F32, sign: F32) -> F32 {
        each(|half| unsafe {
            let sign = vandq_u32(vreinterpretq_u32_f32(sign[half]), vdupq_n_u32(0x8000_0000));
            vreinterpretq_f32_u32(veorq_u32(vreinterpretq_u32_f32(a[half]), sign))
        })
    }
    #[inline(always)]
    fn not_gt(self, a: F32, b: F32) -> u32 {
        failed(self, [0, 1].map(|half| unsafe { vcgtq_f32(a[half], b[half]) }))
    }
    #[inline(always)]
    fn prefetch<T>(self, list: &[T], index: usize) {
        let start = list.as_ptr().wrapping_add(index).cast::<u8>();
        for line in 0..size_of::<T>().div_ceil(64).min(4) {
            let address = start.wrapping_add(64 * line);
            // The intrinsic is not stable. This instruction never faults, whatever the address.
            unsafe { asm!("prfm pldl1keep, [{}]", in(reg) address, options(nostack, preserves_flags, readonly)) };
        }
    }
}
