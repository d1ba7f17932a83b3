//! Random numbers from a seed, the same on every machine: SplitMix64 (Steele, Lea & Flood 2014, doi:10.1145/2660193.2660195).

/// A sequence of random numbers.
pub(crate) struct Random(pub(crate) u64);

impl Random {
    /// All integers, uniformly.
    pub(crate) fn integer(&mut self) -> u32 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 32) as u32
    }

    /// Uniform in [0, 1).
    pub(crate) fn unit(&mut self) -> f32 {
        (self.integer() >> 8) as f32 * (1.0 / 16_777_216.0)
    }

    /// Uniform from `a` to `b`.
    pub(crate) fn range(&mut self, a: f32, b: f32) -> f32 {
        a + (b - a) * self.unit()
    }
}
