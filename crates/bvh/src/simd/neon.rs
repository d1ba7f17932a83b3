//! NEON: registers of four numbers, one or two at a time.

use std::arch::aarch64::*;
use std::arch::asm;

use crate::simd::{Cpu, Simd, Task};

/// The proof that the processor has NEON: [`detect`](Self::detect) is the only way to get one.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Neon(());

impl Neon {
    #[inline]
    pub(crate) fn detect() -> Option<Self> {
        std::arch::is_aarch64_feature_detected!("neon").then_some(Self(()))
    }
}

/// One register after the other.
#[inline(always)]
fn each<T, const Q: usize>(f: impl Fn(usize) -> T) -> [T; Q] {
    std::array::from_fn(f)
}

/// Implements [`Simd`] for so many lanes in so many registers.
macro_rules! impl_simd {
    ($lanes:literal, $registers:literal) => {
        // SAFETY: of every block below: `self` proves that the processor has the instructions, and loads and stores go to
        // arrays of as many numbers as the registers hold.
        impl Simd<$lanes> for Neon {
            type F32 = [float32x4_t; $registers];
            type Mask = [uint32x4_t; $registers];

            #[inline(always)]
            fn load(self, values: &[f32; $lanes]) -> [float32x4_t; $registers] {
                each(|r| unsafe { vld1q_f32(values[4 * r..].as_ptr()) })
            }
            #[inline(always)]
            fn store(self, a: [float32x4_t; $registers]) -> [f32; $lanes] {
                let mut values = [0.0; $lanes];
                for (values, a) in values.chunks_exact_mut(4).zip(a) {
                    unsafe { vst1q_f32(values.as_mut_ptr(), a) };
                }
                values
            }
            #[inline(always)]
            fn splat(self, value: f32) -> [float32x4_t; $registers] {
                each(|r| unsafe { vdupq_n_f32(value) })
            }
            #[inline(always)]
            fn add(self, a: [float32x4_t; $registers], b: [float32x4_t; $registers]) -> [float32x4_t; $registers] {
                each(|r| unsafe { vaddq_f32(a[r], b[r]) })
            }
            #[inline(always)]
            fn sub(self, a: [float32x4_t; $registers], b: [float32x4_t; $registers]) -> [float32x4_t; $registers] {
                each(|r| unsafe { vsubq_f32(a[r], b[r]) })
            }
            #[inline(always)]
            fn mul(self, a: [float32x4_t; $registers], b: [float32x4_t; $registers]) -> [float32x4_t; $registers] {
                each(|r| unsafe { vmulq_f32(a[r], b[r]) })
            }
            #[inline(always)]
            fn div(self, a: [float32x4_t; $registers], b: [float32x4_t; $registers]) -> [float32x4_t; $registers] {
                each(|r| unsafe { vdivq_f32(a[r], b[r]) })
            }
            #[inline(always)]
            fn mul_add(
                self,
                a: [float32x4_t; $registers],
                b: [float32x4_t; $registers],
                c: [float32x4_t; $registers],
            ) -> [float32x4_t; $registers] {
                each(|r| unsafe { vfmaq_f32(c[r], a[r], b[r]) })
            }
            #[inline(always)]
            fn mul_sub(
                self,
                a: [float32x4_t; $registers],
                b: [float32x4_t; $registers],
                c: [float32x4_t; $registers],
            ) -> [float32x4_t; $registers] {
                each(|r| unsafe { vfmaq_f32(vnegq_f32(c[r]), a[r], b[r]) })
            }
            #[inline(always)]
            fn neg_mul_add(
                self,
                a: [float32x4_t; $registers],
                b: [float32x4_t; $registers],
                c: [float32x4_t; $registers],
            ) -> [float32x4_t; $registers] {
                each(|r| unsafe { vfmsq_f32(c[r], a[r], b[r]) })
            }
            // Not `vminq_f32`, which makes NaN of NaN and a number.
            #[inline(always)]
            fn min(self, a: [float32x4_t; $registers], b: [float32x4_t; $registers]) -> [float32x4_t; $registers] {
                each(|r| unsafe { vbslq_f32(vcltq_f32(a[r], b[r]), a[r], b[r]) })
            }
            #[inline(always)]
            fn max(self, a: [float32x4_t; $registers], b: [float32x4_t; $registers]) -> [float32x4_t; $registers] {
                each(|r| unsafe { vbslq_f32(vcgtq_f32(a[r], b[r]), a[r], b[r]) })
            }
            #[inline(always)]
            fn abs(self, a: [float32x4_t; $registers]) -> [float32x4_t; $registers] {
                each(|r| unsafe { vabsq_f32(a[r]) })
            }
            #[inline(always)]
            fn flip(self, a: [float32x4_t; $registers], sign: [float32x4_t; $registers]) -> [float32x4_t; $registers] {
                each(|r| unsafe {
                    let sign = vandq_u32(vreinterpretq_u32_f32(sign[r]), vdupq_n_u32(0x8000_0000));
                    vreinterpretq_f32_u32(veorq_u32(vreinterpretq_u32_f32(a[r]), sign))
                })
            }
            #[inline(always)]
            fn not_gt(self, a: [float32x4_t; $registers], b: [float32x4_t; $registers]) -> [uint32x4_t; $registers] {
                each(|r| unsafe { vmvnq_u32(vcgtq_f32(a[r], b[r])) })
            }
            #[inline(always)]
            fn gt(self, a: [float32x4_t; $registers], b: [float32x4_t; $registers]) -> [uint32x4_t; $registers] {
                each(|r| unsafe { vcgtq_f32(a[r], b[r]) })
            }
            #[inline(always)]
            fn and(self, a: [uint32x4_t; $registers], b: [uint32x4_t; $registers]) -> [uint32x4_t; $registers] {
                each(|r| unsafe { vandq_u32(a[r], b[r]) })
            }
            #[inline(always)]
            fn or(self, a: [uint32x4_t; $registers], b: [uint32x4_t; $registers]) -> [uint32x4_t; $registers] {
                each(|r| unsafe { vorrq_u32(a[r], b[r]) })
            }
            #[inline(always)]
            fn bits(self, mask: [uint32x4_t; $registers]) -> u32 {
                const BITS: [u32; 4] = [1, 2, 4, 8];
                let bits = |r: usize| unsafe { vaddvq_u32(vandq_u32(vld1q_u32(BITS.as_ptr()), mask[r])) } << (4 * r);
                (0..$registers).fold(0, |all, r| all | bits(r))
            }
        }
    };
}

impl_simd!(4, 1);
impl_simd!(8, 2);

impl Cpu for Neon {
    #[inline(never)]
    fn call<T: Task>(self, task: T) -> T::Output {
        task.run(self)
    }

    #[inline(always)]
    fn prefetch<T>(self, list: &[T], index: usize) {
        let start = list.as_ptr().wrapping_add(index).cast::<u8>();
        for line in 0..size_of::<T>().div_ceil(64) {
            let address = start.wrapping_add(64 * line);
            // SAFETY: this instruction never faults, whatever the address. The intrinsic is not stable.
            unsafe { asm!("prfm pldl1keep, [{}]", in(reg) address, options(nostack, preserves_flags, readonly)) };
        }
    }
}
