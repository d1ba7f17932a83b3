//! Tables of values at even steps.

use glam::FloatExt;

/// The step that a place in 0..=1 comes after, of `count` from 0 to 1, and how far after it, 0..=1; the nearest place for others.
#[inline]
pub(crate) fn place(t: f32, count: usize) -> (usize, f32) {
    let t = t.clamp(0.0, 1.0) * (count - 1) as f32;
    let step = (t as usize).min(count - 2);
    (step, t - step as f32)
}

/// The value at a place in 0..=1, linear between steps; there are two at least.
#[inline]
pub(crate) fn interpolate(values: &[f32], t: f32) -> f32 {
    let (i, between) = place(t, values.len());
    values[i].lerp(values[i + 1], between)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_and_middles() {
        let values = [1.0, 3.0, -1.0];
        for (t, expected) in [(0.0, 1.0), (0.25, 2.0), (0.5, 3.0), (0.75, 1.0), (1.0, -1.0), (-2.0, 1.0), (7.0, -1.0)] {
            assert_eq!(interpolate(&values, t), expected, "{t}");
        }
    }
}
