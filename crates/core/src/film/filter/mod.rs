//! Pixel filters: how much a pixel makes of the light that falls near to it.
//!
//! A pixel is the integral of the picture times a filter f around the pixel's centre. It is estimated by drawing the
//! samples' offsets from the centre with density |f|: each then counts as much as any other, and no sample belongs to
//! two pixels. Where f is negative the weight is, too:
//!
//! weight = sign(f) ∫|f| / ∫f.
//!
//! Ernst, Stamminger & Greiner 2006, "Filter Importance Sampling", doi:10.1109/RT.2006.280221. All filters are products
//! of a function of x and the same of y, even, and 0 beyond their radius.
//!
//! ```toml
//! [render.filter.gaussian]
//! radius = 1.5
//! sigma = 0.5
//! ```

mod desc;
mod table;

use glam::Vec2;

use table::Table;

pub use desc::{BlackmanHarris, BoxFilter, FilterDesc, Gaussian, Mitchell, Tent};

/// A point of a filter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FilterSample {
    /// From the pixel's centre, pixels.
    pub offset: Vec2,
    /// The factor on the light that falls there; 1 in the mean.
    pub weight: f32,
}

/// A filter ready to be sampled.
#[derive(Clone, Debug)]
pub struct Filter {
    desc: FilterDesc,
    radius: f32,
    axis: Axis,
}

/// How one axis is sampled.
#[derive(Clone, Debug)]
enum Axis {
    Box,
    Tent,
    Table(Table),
}

impl Default for Filter {
    fn default() -> Self {
        Self::new(&FilterDesc::default())
    }
}

impl Filter {
    /// The filter of a description without problems.
    pub fn new(desc: &FilterDesc) -> Self {
        let axis = match desc {
            FilterDesc::Box(_) => Axis::Box,
            FilterDesc::Tent(_) => Axis::Tent,
            _ => Axis::Table(Table::new(|t| desc.eval_axis(t))),
        };
        Self { desc: desc.clone(), radius: desc.radius(), axis }
    }

    /// Offsets in x and y from the centre that any sample has at most, pixels.
    pub fn radius(&self) -> f32 {
        self.radius
    }

    /// A point with the density |f|. Larger numbers give larger offsets, axis by axis.
    #[inline]
    pub fn sample(&self, u: Vec2) -> FilterSample {
        let (x, weight_x) = self.sample_axis(u.x);
        let (y, weight_y) = self.sample_axis(u.y);
        FilterSample { offset: Vec2::new(x, y), weight: weight_x * weight_y }
    }

    #[inline]
    fn sample_axis(&self, u: f32) -> (f32, f32) {
        // The share of |f| between the centre and the offset, on the offset's side.
        let centred = u - 0.5;
        let share = 2.0 * centred.abs();
        let (t, weight) = match &self.axis {
            Axis::Box => (share, 1.0),
            Axis::Tent => (share / (1.0 + (1.0 - share).sqrt()), 1.0),
            Axis::Table(table) => table.sample(share),
        };
        ((self.radius * t).copysign(centred), weight)
    }

    /// The filter, 1 / pixels²; its integral is 1.
    pub fn eval(&self, offset: Vec2) -> f32 {
        self.eval_axis(offset.x) * self.eval_axis(offset.y)
    }

    fn eval_axis(&self, x: f32) -> f32 {
        let t = x.abs() / self.radius;
        if t > 1.0 {
            return 0.0;
        }
        let mean = match &self.axis {
            Axis::Box => 1.0,
            Axis::Tent => 0.5,
            Axis::Table(table) => table.mean(),
        };
        (self.desc.eval_axis(f64::from(t)) / (2.0 * mean * f64::from(self.radius))) as f32
    }
}

#[cfg(test)]
mod tests {
    use glam::UVec2;

    use super::*;
    use crate::sampler::Independent;
    use crate::testing::chi2_counts;

    const SAMPLES: u32 = 100_000;

    fn all() -> Vec<FilterDesc> {
        vec![
            FilterDesc::Box(BoxFilter { radius: 0.7 }),
            FilterDesc::Tent(Tent::default()),
            FilterDesc::Tent(Tent { radius: 0.3 }),
            FilterDesc::Gaussian(Gaussian::default()),
            FilterDesc::Gaussian(Gaussian { radius: 2.0, sigma: 1e6 }),
            FilterDesc::Gaussian(Gaussian { radius: 16.0, sigma: 0.1 }),
            FilterDesc::Mitchell(Mitchell::default()),
            FilterDesc::Mitchell(Mitchell { radius: 5.0, b: 0.0, c: 1.0 }),
            FilterDesc::Mitchell(Mitchell { radius: 1.0, b: 1.0, c: 0.0 }),
            FilterDesc::BlackmanHarris(BlackmanHarris::default()),
            FilterDesc::BlackmanHarris(BlackmanHarris { radius: 16.0 }),
        ]
    }

    fn samples(filter: &Filter) -> impl Iterator<Item = FilterSample> {
        (0..SAMPLES).map(|i| filter.sample(Independent::new(5, UVec2::ZERO, i).get_2d()))
    }

    /// The integral of `f` over lo..hi by Simpson's rule.
    fn integrate(f: impl Fn(f64) -> f64, lo: f64, hi: f64) -> f64 {
        const N: usize = 64;
        let h = (hi - lo) / N as f64;
        let weight = |i: usize| if i == 0 || i == N { 1.0 } else { 2.0 + 2.0 * (i % 2) as f64 };
        (0..=N).map(|i| weight(i) * f(lo + i as f64 * h)).sum::<f64>() * h / 3.0
    }

    #[test]
    fn samples_follow_the_filter() {
        const BINS: usize = 24;
        for desc in all() {
            let filter = Filter::new(&desc);
            let radius = f64::from(filter.radius());
            let bin = |x: f32| (((f64::from(x) / radius + 1.0) * 0.5 * BINS as f64) as usize).min(BINS - 1);
            let mut observed = [0; BINS * BINS];
            for s in samples(&filter) {
                assert!(s.offset.abs().max_element() <= filter.radius());
                observed[bin(s.offset.x) * BINS + bin(s.offset.y)] += 1;
            }
            let edge = |i: usize| radius * (2.0 * i as f64 / BINS as f64 - 1.0);
            let mass = |f: &dyn Fn(f64) -> f64| -> Vec<f64> {
                (0..BINS).map(|i| integrate(f, edge(i), edge(i + 1))).collect()
            };
            let axis = |x: f64| f64::from(filter.eval_axis(x as f32));
            let signed: f64 = mass(&axis).iter().sum();
            assert!((signed - 1.0).abs() < 1e-5, "{desc:?}: the filter integrates to {signed}");
            let masses = mass(&|x| axis(x).abs());
            let total: f64 = masses.iter().sum();
            let expected: Vec<f64> = (0..observed.len())
                .map(|k| f64::from(SAMPLES) * masses[k / BINS] * masses[k % BINS] / (total * total))
                .collect();
            chi2_counts(&observed, &expected).unwrap_or_else(|e| panic!("{desc:?}: {e}"));
            let eval = filter.eval(Vec2::new(0.1, -0.2) * filter.radius());
            assert!((f64::from(eval) / (axis(0.1 * radius) * axis(0.2 * radius)) - 1.0).abs() < 1e-5);
        }
    }

    /// Over a ramp, whatever its slope, a filter's mean is the ramp at the centre: weights are 1 in the mean, and
    /// offsets cancel. Evenly spaced numbers leave only the errors of their spacing, single precision and the table.
    #[test]
    fn ramps_are_kept() {
        const N: u32 = 1 << 18;
        for desc in all() {
            let filter = Filter::new(&desc);
            let radius = f64::from(filter.radius());
            let mut moments = [0.0; 3];
            for i in 0..N {
                let (x, weight) = filter.sample_axis((i as f32 + 0.5) / N as f32);
                let (t, weight) = (f64::from(x) / radius, f64::from(weight) / f64::from(N));
                moments = [moments[0] + weight, moments[1] + weight * t, moments[2] + weight * t * t];
            }
            let t_sq = integrate(|t| t * t * radius * f64::from(filter.eval_axis((t * radius) as f32)), -1.0, 1.0);
            for (moment, expected, tolerance) in
                [(moments[0], 1.0, 1e-4), (moments[1], 0.0, 1e-7), (moments[2], t_sq, 1e-4)]
            {
                assert!((moment - expected).abs() < tolerance, "{desc:?}: {moments:?}, mean square {t_sq}");
            }
        }
    }

    #[test]
    fn weights_are_1_but_for_negative_filters() {
        for desc in all() {
            let filter = Filter::new(&desc);
            let weights = samples(&filter).map(|s| s.weight);
            match &desc {
                FilterDesc::Mitchell(f) if f.c > 0.0 => {
                    let size = filter.sample(Vec2::splat(0.5)).weight;
                    let (mut mean, mut negative) = (0.0, 0);
                    for w in weights {
                        assert_eq!(w.abs(), size);
                        mean += f64::from(w) / f64::from(SAMPLES);
                        negative += u32::from(w < 0.0);
                    }
                    let error = (f64::from(size).powi(2) - 1.0).sqrt() / f64::from(SAMPLES).sqrt();
                    assert!(size > 1.0 && negative > 0 && (mean - 1.0).abs() < 4.0 * error, "{desc:?}: mean {mean}");
                }
                _ => assert!(weights.into_iter().all(|w| w == 1.0), "{desc:?}"),
            }
        }
    }

    #[test]
    fn the_box_of_a_pixel_is_the_square_itself() {
        let filter = Filter::new(&FilterDesc::Box(BoxFilter::default()));
        let numbers = (0..10_000).map(|i| Independent::new(6, UVec2::ZERO, i).get_2d());
        for u in numbers.chain([Vec2::ZERO, Vec2::splat(0.5), Vec2::new(1e-9, 1.0 - f32::EPSILON / 2.0)]) {
            assert_eq!(filter.sample(u), FilterSample { offset: u - Vec2::splat(0.5), weight: 1.0 });
        }
    }

    #[test]
    fn larger_numbers_give_larger_offsets() {
        for desc in all() {
            let filter = Filter::new(&desc);
            let offset = |i: u32| filter.sample(Vec2::splat(i as f32 / 65536.0)).offset;
            for i in 1..65536 {
                assert!(offset(i).cmpge(offset(i - 1)).all(), "{desc:?} at {i}");
            }
            assert!((offset(0).x + filter.radius()).abs() < 1e-6 * filter.radius());
            assert_eq!(offset(32768).x, 0.0);
        }
    }
}
