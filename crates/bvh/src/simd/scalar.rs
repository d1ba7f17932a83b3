//! Plain loops over arrays: the reference, and the path of processors without anything better.

use crate::simd::{Cpu, Simd, Task};

/// Every processor has this.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Scalar;

impl<const N: usize> Simd<N> for Scalar {
    type F32 = [f32; N];
    type Mask = u32;

    #[inline(always)]
    fn load(self, values: &[f32; N]) -> [f32; N] {
        *values
    }
    #[inline(always)]
    fn store(self, a: [f32; N]) -> [f32; N] {
        a
    }
    #[inline(always)]
    fn splat(self, value: f32) -> [f32; N] {
        [value; N]
    }
    #[inline(always)]
    fn add(self, a: [f32; N], b: [f32; N]) -> [f32; N] {
        std::array::from_fn(|i| a[i] + b[i])
    }
    #[inline(always)]
    fn sub(self, a: [f32; N], b: [f32; N]) -> [f32; N] {
        std::array::from_fn(|i| a[i] - b[i])
    }
    #[inline(always)]
    fn mul(self, a: [f32; N], b: [f32; N]) -> [f32; N] {
        std::array::from_fn(|i| a[i] * b[i])
    }
    #[inline(always)]
    fn div(self, a: [f32; N], b: [f32; N]) -> [f32; N] {
        std::array::from_fn(|i| a[i] / b[i])
    }
    #[inline(always)]
    fn mul_add(self, a: [f32; N], b: [f32; N], c: [f32; N]) -> [f32; N] {
        std::array::from_fn(|i| a[i] * b[i] + c[i])
    }
    #[inline(always)]
    fn mul_sub(self, a: [f32; N], b: [f32; N], c: [f32; N]) -> [f32; N] {
        std::array::from_fn(|i| a[i] * b[i] - c[i])
    }
    #[inline(always)]
    fn neg_mul_add(self, a: [f32; N], b: [f32; N], c: [f32; N]) -> [f32; N] {
        std::array::from_fn(|i| c[i] - a[i] * b[i])
    }
    #[inline(always)]
    fn min(self, a: [f32; N], b: [f32; N]) -> [f32; N] {
        std::array::from_fn(|i| if a[i] < b[i] { a[i] } else { b[i] })
    }
    #[inline(always)]
    fn max(self, a: [f32; N], b: [f32; N]) -> [f32; N] {
        std::array::from_fn(|i| if a[i] > b[i] { a[i] } else { b[i] })
    }
    #[inline(always)]
    fn abs(self, a: [f32; N]) -> [f32; N] {
        a.map(f32::abs)
    }
    #[inline(always)]
    fn flip(self, a: [f32; N], sign: [f32; N]) -> [f32; N] {
        std::array::from_fn(|i| f32::from_bits(a[i].to_bits() ^ (sign[i].to_bits() & 0x8000_0000)))
    }
    #[inline(always)]
    fn not_gt(self, a: [f32; N], b: [f32; N]) -> u32 {
        (0..N).map(|i| (u32::from(a[i] > b[i]) ^ 1) << i).sum()
    }
    #[inline(always)]
    fn gt(self, a: [f32; N], b: [f32; N]) -> u32 {
        (0..N).map(|i| u32::from(a[i] > b[i]) << i).sum()
    }
    #[inline(always)]
    fn and(self, a: u32, b: u32) -> u32 {
        a & b
    }
    #[inline(always)]
    fn or(self, a: u32, b: u32) -> u32 {
        a | b
    }
    #[inline(always)]
    fn bits(self, mask: u32) -> u32 {
        mask
    }
}

impl Cpu for Scalar {
    #[inline(never)]
    fn call<T: Task>(self, task: T) -> T::Output {
        task.run(self)
    }

    #[inline(always)]
    fn prefetch<T>(self, _: &[T], _: usize) {}
}
