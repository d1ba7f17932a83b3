//! A choice by fixed weights: light i with chance wᵢ / Σ w.
//!
//! The running sums of the weights are searched for u · Σ w. Unlike with an alias table, neighbouring numbers choose
//! neighbouring lights, so stratified numbers stay stratified. A guide table tells where in the sums to look: on
//! average one or two steps, whatever the number of lights. Chen & Asau 1974, doi:10.1080/05695557408974949.

/// Weights, ready to choose by.
#[derive(Clone, Debug)]
pub(super) struct Discrete {
    /// The sum of the weights up to and with each.
    ends: Vec<f64>,
    /// The index that is chosen by u = k / n, for k in 0..=n.
    guide: Vec<u32>,
}

impl Discrete {
    /// `weights` are not negative; those of 0 are never chosen.
    pub(super) fn new(weights: impl Iterator<Item = f32>) -> Self {
        let running = weights.scan(0.0, |sum, weight| {
            *sum += f64::from(weight);
            Some(*sum)
        });
        let ends: Vec<f64> = running.collect();
        let (n, total) = (ends.len(), ends.last().copied().unwrap_or(0.0));
        let last = ends.partition_point(|&end| end < total);
        let mut index = 0;
        let guide = (0..=n).map(|k| {
            let x = k as f64 / n as f64 * total;
            while index < last && ends[index] <= x {
                index += 1;
            }
            index as u32
        });
        Self { guide: guide.collect(), ends }
    }

    /// The sums before and after a weight, and that of all.
    #[inline]
    fn interval(&self, index: usize) -> (f64, f64, f64) {
        let before = if index == 0 { 0.0 } else { self.ends[index - 1] };
        (before, self.ends[index], self.ends[self.ends.len() - 1])
    }

    /// The index chosen by `u` in [0, 1), its chance, and the rest of `u`, again in 0..1.
    #[inline]
    pub(super) fn sample(&self, u: f64) -> Option<(u32, f64, f64)> {
        let n = self.ends.len();
        let x = u * *self.ends.last().filter(|&&total| total > 0.0)?;
        let k = ((u * n as f64) as usize).min(n - 1);
        let (first, last) = (self.guide[k] as usize, self.guide[k + 1] as usize);
        let index = first + self.ends[first..last].partition_point(|&end| end <= x);
        let (before, after, _) = self.interval(index);
        Some((index as u32, self.pmf(index as u32), (x - before) / (after - before)))
    }

    /// The chance of an index.
    #[inline]
    pub(super) fn pmf(&self, index: u32) -> f64 {
        if index as usize >= self.ends.len() {
            return 0.0;
        }
        let (before, after, total) = self.interval(index as usize);
        if after > before { (after - before) / total } else { 0.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use proptest::test_runner::RngSeed;

    proptest! {
        #![proptest_config(ProptestConfig { rng_seed: RngSeed::Fixed(1), failure_persistence: None, ..Default::default() })]

        /// The guide changes nothing: the index is that of a search through all.
        #[test]
        fn finds_the_first_sum_above(
            weights in prop::collection::vec(prop::sample::select(vec![0.0f32, 1e-30, 0.1, 1.0, 3.0, 1e6]), 1..40),
            u in 0.0f64..1.0,
        ) {
            let choice = Discrete::new(weights.iter().copied());
            let total: f64 = choice.ends[weights.len() - 1];
            let Some((index, pmf, rest)) = choice.sample(u) else {
                prop_assert_eq!(total, 0.0);
                return Ok(());
            };
            prop_assert!(weights[index as usize] > 0.0 && pmf > 0.0 && (0.0..=1.0).contains(&rest));
            let searched = choice.ends.partition_point(|&end| end <= u * total);
            let off = (choice.ends[searched] - choice.ends[index as usize]).abs();
            prop_assert!(index as usize == searched || off < 1e-12 * total, "{} for {}", index, searched);
        }
    }

    #[test]
    fn nothing_to_choose() {
        assert!(Discrete::new([].into_iter()).sample(0.5).is_none());
        assert!(Discrete::new([0.0, 0.0].into_iter()).sample(0.5).is_none());
        assert_eq!(Discrete::new([0.0, 2.0].into_iter()).pmf(7), 0.0);
    }
}
