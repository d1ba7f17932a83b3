//! Sums that do not round.
//!
//! A 128-bit integer counts multiples of 2⁻⁶⁴. Single-precision numbers below 2³² are rounded to such a multiple once
//! (those above 2⁻⁴⁰ are one already), and from there on addition is exact, associative and commutative.

use std::ops::AddAssign;

/// A sum in multiples of 2⁻⁶⁴; holds 2³¹ numbers below [`Exact::LIMIT`], or 2²⁴ below 2³⁸.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Exact(i128);

impl Exact {
    /// Samples must be smaller than this.
    pub(super) const LIMIT: f32 = 4_294_967_296.0;

    /// Rounds towards zero. Numbers of 2³⁸ and above, or not finite, have no meaning here.
    #[inline]
    pub(super) fn new(x: f32) -> Self {
        let bits = x.to_bits();
        let exponent = (bits >> 23 & 0xff) as i32;
        let fraction = i128::from(bits & 0x7f_ffff | u32::from(exponent != 0) << 23);
        // x = fraction · 2^(exponent − 150), and a denormal rounds to 0 at any rate.
        let shift = exponent - 150 + 64;
        let size = if shift >= 0 { fraction << shift.min(100) } else { fraction >> (-shift).min(127) };
        Self(if x < 0.0 { -size } else { size })
    }

    pub(super) fn to_f64(self) -> f64 {
        self.0 as f64 * (-64.0_f64).exp2()
    }
}

impl AddAssign for Exact {
    #[inline]
    fn add_assign(&mut self, other: Self) {
        self.0 += other.0;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use proptest::test_runner::RngSeed;

    proptest! {
        #![proptest_config(ProptestConfig { rng_seed: RngSeed::Fixed(1), failure_persistence: None, ..Default::default() })]

        #[test]
        fn keeps_numbers_to_a_quantum(x in -4e9f32..4e9, e in -70i32..1) {
            let x = x * (e as f32).exp2();
            prop_assert!((Exact::new(x).to_f64() - f64::from(x)).abs() <= (-64.0_f64).exp2());
        }
    }

    #[test]
    fn large_and_small_add_without_loss() {
        let mut sum = Exact::default();
        for x in [4e9, 1e-9, -4e9] {
            sum += Exact::new(x);
        }
        assert_eq!(sum, Exact::new(1e-9));
    }
}
