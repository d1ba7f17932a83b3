//! AVX2 and FMA, and the bit instructions (BMI) that every processor with AVX2 has.

use std::arch::x86_64::*;

use crate::simd::{Cpu, Simd, Task};

/// The proof that the processor has AVX2, FMA and BMI: [`detect`](Self::detect) is the only way to get one.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Avx2(());

impl Avx2 {
    #[inline]
    pub(crate) fn detect() -> Option<Self> {
        use std::arch::is_x86_feature_detected as has;
        (has!("avx2") && has!("fma") && has!("bmi1") && has!("bmi2")).then_some(Self(()))
    }
}

/// Implements [`Simd`] for one width: the number of lanes, the type of a vector, and the prefix of its instructions.
macro_rules! impl_simd {
    ($lanes:literal, $vector:ty, $load:ident, $store:ident, $set1:ident, $add:ident, $sub:ident, $mul:ident, $div:ident,
     $fmadd:ident, $fmsub:ident, $fnmadd:ident, $min:ident, $max:ident, $and:ident, $andnot:ident, $xor:ident, $or:ident, $cmp:ident,
     $movemask:ident) => {
        // SAFETY: of every block below: `self` proves that the processor has the instructions, and loads and stores go to
        // arrays of as many numbers as the vector has.
        impl Simd<$lanes> for Avx2 {
            type F32 = $vector;
            type Mask = $vector;

            #[inline(always)]
            fn load(self, values: &[f32; $lanes]) -> $vector {
                unsafe { $load(values.as_ptr()) }
            }
            #[inline(always)]
            fn store(self, a: $vector) -> [f32; $lanes] {
                let mut values = [0.0; $lanes];
                unsafe { $store(values.as_mut_ptr(), a) };
                values
            }
            #[inline(always)]
            fn splat(self, value: f32) -> $vector {
                unsafe { $set1(value) }
            }
            #[inline(always)]
            fn add(self, a: $vector, b: $vector) -> $vector {
                unsafe { $add(a, b) }
            }
            #[inline(always)]
            fn sub(self, a: $vector, b: $vector) -> $vector {
                unsafe { $sub(a, b) }
            }
            #[inline(always)]
            fn mul(self, a: $vector, b: $vector) -> $vector {
                unsafe { $mul(a, b) }
            }
            #[inline(always)]
            fn div(self, a: $vector, b: $vector) -> $vector {
                unsafe { $div(a, b) }
            }
            #[inline(always)]
            fn mul_add(self, a: $vector, b: $vector, c: $vector) -> $vector {
                unsafe { $fmadd(a, b, c) }
            }
            #[inline(always)]
            fn mul_sub(self, a: $vector, b: $vector, c: $vector) -> $vector {
                unsafe { $fmsub(a, b, c) }
            }
            #[inline(always)]
            fn neg_mul_add(self, a: $vector, b: $vector, c: $vector) -> $vector {
                unsafe { $fnmadd(a, b, c) }
            }
            #[inline(always)]
            fn min(self, a: $vector, b: $vector) -> $vector {
                unsafe { $min(a, b) }
            }
            #[inline(always)]
            fn max(self, a: $vector, b: $vector) -> $vector {
                unsafe { $max(a, b) }
            }
            #[inline(always)]
            fn abs(self, a: $vector) -> $vector {
                unsafe { $andnot($set1(-0.0), a) }
            }
            #[inline(always)]
            fn flip(self, a: $vector, sign: $vector) -> $vector {
                unsafe { $xor(a, $and(sign, $set1(-0.0))) }
            }
            #[inline(always)]
            fn not_gt(self, a: $vector, b: $vector) -> $vector {
                unsafe { $cmp::<_CMP_NGT_UQ>(a, b) }
            }
            #[inline(always)]
            fn gt(self, a: $vector, b: $vector) -> $vector {
                unsafe { $cmp::<_CMP_GT_OQ>(a, b) }
            }
            #[inline(always)]
            fn and(self, a: $vector, b: $vector) -> $vector {
                unsafe { $and(a, b) }
            }
            #[inline(always)]
            fn or(self, a: $vector, b: $vector) -> $vector {
                unsafe { $or(a, b) }
            }
            #[inline(always)]
            fn bits(self, mask: $vector) -> u32 {
                unsafe { $movemask(mask) as u32 }
            }
        }
    };
}

impl_simd! {
    8, __m256, _mm256_loadu_ps, _mm256_storeu_ps, _mm256_set1_ps, _mm256_add_ps, _mm256_sub_ps, _mm256_mul_ps, _mm256_div_ps,
    _mm256_fmadd_ps, _mm256_fmsub_ps, _mm256_fnmadd_ps, _mm256_min_ps, _mm256_max_ps, _mm256_and_ps, _mm256_andnot_ps,
    _mm256_xor_ps, _mm256_or_ps, _mm256_cmp_ps, _mm256_movemask_ps
}
impl_simd! {
    4, __m128, _mm_loadu_ps, _mm_storeu_ps, _mm_set1_ps, _mm_add_ps, _mm_sub_ps, _mm_mul_ps, _mm_div_ps,
    _mm_fmadd_ps, _mm_fmsub_ps, _mm_fnmadd_ps, _mm_min_ps, _mm_max_ps, _mm_and_ps, _mm_andnot_ps,
    _mm_xor_ps, _mm_or_ps, _mm_cmp_ps, _mm_movemask_ps
}

impl Cpu for Avx2 {
    #[inline(always)]
    fn call<T: Task>(self, task: T) -> T::Output {
        #[inline(never)]
        #[target_feature(enable = "avx2,fma,bmi1,bmi2")]
        fn run<T: Task>(avx2: Avx2, task: T) -> T::Output {
            task.run(avx2)
        }
        // SAFETY: `self` proves that the processor has these.
        unsafe { run(self, task) }
    }

    #[inline(always)]
    fn prefetch<T>(self, list: &[T], index: usize) {
        let start = list.as_ptr().wrapping_add(index).cast::<i8>();
        for line in 0..size_of::<T>().div_ceil(64).min(6) {
            // SAFETY: a prefetch may name any address.
            unsafe { _mm_prefetch::<_MM_HINT_T0>(start.wrapping_add(64 * line)) };
        }
    }
}
