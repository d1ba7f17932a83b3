//! What a pixel filter promises.

use glam::{UVec2, Vec2};

use super::chi2_counts;
use crate::film::{Filter, FilterSample};
use crate::sampler::Independent;

/// How a pixel is made of what lies around its centre: what [`Filter`] does.
pub trait PixelFilter {
    /// Offsets in x and y from the centre that any sample has at most, pixels.
    fn radius(&self) -> f32;

    /// A point with the density |f|.
    fn sample(&self, u: Vec2) -> FilterSample;

    /// The filter f, 1 / pixels²; its integral is 1.
    fn eval(&self, offset: Vec2) -> f32;
}

impl PixelFilter for Filter {
    fn radius(&self) -> f32 {
        self.radius()
    }

    fn sample(&self, u: Vec2) -> FilterSample {
        self.sample(u)
    }

    fn eval(&self, offset: Vec2) -> f32 {
        self.eval(offset)
    }
}

/// The integral of f is 1, offsets follow |f| (chi²), weights are sign(f) ∫|f| / ∫f, and all of it is about the centre: over a
/// ramp the weighted mean is that at the centre.
///
/// # Errors
/// The first promise that is broken.
pub fn check_filter(filter: &dyn PixelFilter) -> Result<(), String> {
    const SAMPLES: u32 = 50_000;
    const BINS: usize = 20;
    /// Midpoints along a side of a bin.
    const FINE: usize = 6;
    let radius = filter.radius();
    let step = 2.0 * f64::from(radius) / (BINS * FINE) as f64;
    let place = |i: usize| ((i as f64 + 0.5) * step - f64::from(radius)) as f32;
    let (mut integral, mut size, mut expected) = (0.0, 0.0, vec![0.0; BINS * BINS]);
    for (i, j) in (0..BINS * FINE).flat_map(|i| (0..BINS * FINE).map(move |j| (i, j))) {
        let f = f64::from(filter.eval(Vec2::new(place(i), place(j)))) * step * step;
        integral += f;
        size += f.abs();
        expected[i / FINE * BINS + j / FINE] += f.abs() * f64::from(SAMPLES);
    }
    if (integral - 1.0).abs() > 2e-3 {
        return Err(format!("it integrates to {integral}"));
    }
    expected.iter_mut().for_each(|e| *e /= size);

    let (mut observed, mut sum, mut ramp, mut ramp_sq) = (vec![0; BINS * BINS], 0.0, [0.0; 2], [0.0; 2]);
    for i in 0..SAMPLES {
        let FilterSample { offset, weight } = filter.sample(Independent::new(30, UVec2::ZERO, i).get_2d());
        if offset.abs().max_element() > radius * (1.0 + f32::EPSILON) {
            return Err(format!("offset {offset} of a filter of radius {radius}"));
        }
        let f = filter.eval(offset);
        let wrong_sign = weight * f < 0.0 && f.abs() > 1e-3 * filter.eval(Vec2::ZERO).abs();
        if wrong_sign || (f64::from(weight.abs()) - size).abs() > 5e-3 {
            return Err(format!("weight {weight} where the filter is {f}, and the integral of its size {size}"));
        }
        let bin = |x: f32| (((x / radius + 1.0) * 0.5 * BINS as f32) as usize).min(BINS - 1);
        observed[bin(offset.x) * BINS + bin(offset.y)] += 1;
        sum += f64::from(weight) / f64::from(SAMPLES);
        for (axis, x) in offset.to_array().into_iter().enumerate() {
            let x = f64::from(weight * x / radius);
            ramp[axis] += x / f64::from(SAMPLES);
            ramp_sq[axis] += x * x / f64::from(SAMPLES);
        }
    }
    chi2_counts(&observed, &expected).map_err(|e| format!("offsets: {e}"))?;
    let noise = |square: f64| 4.5 * (square / f64::from(SAMPLES)).sqrt();
    if (sum - 1.0).abs() > noise(size * size - 1.0) + 5e-3 {
        return Err(format!("weights are {sum} in the mean"));
    }
    if (0..2).any(|axis| ramp[axis].abs() > noise(ramp_sq[axis])) {
        return Err(format!("the mean over a ramp is {ramp:?} radii off the centre"));
    }
    Ok(())
}
