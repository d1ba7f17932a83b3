//! The hash that random numbers come from: SplitMix64's. Steele, Lea & Flood 2014, doi:10.1145/2660193.2660195.

/// 2⁶⁴ divided by the golden ratio, odd.
pub(crate) const GAMMA: u64 = 0x9e37_79b9_7f4a_7c15;

/// A bijection of 64 bits in which every bit depends on every other.
#[inline]
pub fn mix(mut z: u64) -> u64 {
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// The first 24 bits to [0, 1): every value is exact and below 1.
#[inline]
pub(crate) fn unit(bits: u32) -> f32 {
    (bits >> 8) as f32 * (1.0 / (1 << 24) as f32)
}

/// The largest number below 1.
pub(crate) const BELOW_ONE: f32 = 1.0 - 0.5 * f32::EPSILON;
