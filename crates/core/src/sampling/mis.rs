//! Weights between two ways to draw the same direction.
//!
//! Veach & Guibas 1995, doi:10.1145/218380.218498.

/// The weight of a way of density `pdf` beside one of density `other`: the power heuristic, pdf² / (pdf² + other²).
#[inline]
pub fn power_heuristic(pdf: f32, other: f32) -> f32 {
    // The quotient stays in range where squares would not.
    let ratio = other / pdf;
    if ratio.is_finite() { 1.0 / (1.0 + ratio * ratio) } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weights_of_both_ways_sum_to_1() {
        for (a, b) in [(1.0, 1.0), (3.0, 0.5), (1e-30, 1e30), (1e38, 1e-38), (2.0, 0.0)] {
            let sum = power_heuristic(a, b) + power_heuristic(b, a);
            assert!((sum - 1.0).abs() < 1e-6, "{a}, {b}: {sum}");
        }
        assert!((power_heuristic(3.0, 1.0) - 0.9).abs() < 1e-6);
    }
}
