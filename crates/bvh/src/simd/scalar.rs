//! Plain loops over arrays: the reference, and the path of processors without anything better.

use crate::simd::{LANES, Simd};

/// Every processor has this.
#[derive(Clone, Copy)]
pub(crate) struct Scalar;

type F32 = [f32; LANES];

#[inline(always)]
fn each(f: impl Fn(usize) -> f32) -> F32 {
    std::array::from_fn(f)
}

impl Simd for Scalar {
    type F32 = F32;

    #[inline(always)]
    fn load(self, values: &F32) -> F32 {
        *values
    }
    #[inline(always)]
    fn store(self, a: F32) -> F32 {
        a
    }
    #[inline(always)]
    fn splat(self, value: f32) -> F32 {
        [value; LANES]
    }
    #[inline(always)]
    fn add(self, a: F32, b: F32) -> F32 {
        each(|i| a[i] + b[i])
    }
    #[inline(always)]
    fn sub(self, a: F32, b: F32) -> F32 {
        each(|i| a[i] - b[i])
    }
    #[inline(always)]
    fn mul(self, a: F32, b: F32) -> F32 {
        each(|i| a[i] * b[i])
    }
    #[inline(always)]
    fn mul_add(self, a: F32, b: F32, c: F32) -> F32 {
        each(|i| a[i] * b[i] + c[i])
    }
    #[inline(always)]
    fn mul_sub(self, a: F32, b: F32, c: F32) -> F32 {
        each(|i| a[i] * b[i] - c[i])
    }
    #[inline(always)]
    fn min(self, a: F32, b: F32) -> F32 {
        each(|i| if a[i] < b[i] { a[i] } else { b[i] })
    }
    #[inline(always)]
    fn max(self, a: F32, b: F32) -> F32 {
        each(|i| if a[i] > b[i] { a[i] } else { b[i] })
    }
    #[inline(always)]
    fn abs(self, a: F32) -> F32 {
        each(|i| a[i].abs())
    }
    #[inline(always)]
    fn flip(self, a: F32, sign: F32) -> F32 {
        each(|i| f32::from_bits(a[i].to_bits() ^ (sign[i].to_bits() & 0x8000_0000)))
    }
    #[inline(always)]
    fn not_gt(self, a: F32, b: F32) -> u32 {
        (0..LANES).map(|i| (u32::from(a[i] > b[i]) ^ 1) << i).sum()
    }
    #[inline(always)]
    fn prefetch<T>(self, _: &[T], _: usize) {}
}
