//! Everything that a scattering lobe promises.
//!
//! The chi² test sorts directions into boxes of nearly equal chance, which a first set of samples lays out: a lobe as
//! wide as the hemisphere and one as narrow as a hundredth of a degree are told from a wrong density equally well, and
//! within a box a density varies little, so it is easy to integrate.

use std::f64::consts::TAU;

use glam::{UVec2, Vec3};

use super::{SIGNIFICANCE, chi2_at};
use crate::material::Bsdf;
use crate::sampler::Independent;

/// Whether a lobe claims that light can be sent either way: f(wo, wi) eta² = f(wi, wo), with eta the index of
/// refraction on the side of wi over that on the side of wo (Veach 1997, §5.2); 1 if they are the same.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reciprocal {
    /// It does.
    Yes,
    /// It does not.
    No,
}

/// All that a lobe promises, for directions of view from straight above to grazing, on both sides: samples follow the
/// density (chi²), weights are eval / pdf, no energy is made, and reciprocity if claimed.
///
/// # Errors
/// The first promise that is broken.
pub fn check_lobe(bsdf: &Bsdf, reciprocal: Reciprocal) -> Result<(), String> {
    let angles = [0.0_f32, 20.0, 45.0, 70.0, 85.0, 89.0];
    for (i, degrees) in angles.into_iter().enumerate() {
        for side in [1.0, -1.0] {
            let (sin, cos) = degrees.to_radians().sin_cos();
            // Opposite, where lobes are, is far from where azimuths jump from half a turn to minus that.
            let azimuth = 2.4 + 0.3 * i as f32;
            let wo = Vec3::new(sin * azimuth.cos(), sin * azimuth.sin(), side * cos);
            let place = |e: String| format!("{bsdf:?} at {degrees} degrees, side {side}: {e}");
            chi2_lobe(bsdf, wo, SIGNIFICANCE / (2 * angles.len()) as f64).map_err(place)?;
            check_samples(bsdf, wo, reciprocal).map_err(place)?;
        }
    }
    Ok(())
}

/// A direction of one hemisphere: 1 − |z| and the azimuth in turns, in which solid angle is even.
type Point = [f64; 2];

/// A box of directions, from a lower to an upper corner.
#[derive(Clone, Copy)]
struct Cell([Point; 2]);

impl Cell {
    const HEMISPHERE: Self = Self([[0.0, -0.5], [1.0, 0.5]]);

    /// Both parts of a cut through one axis.
    fn cut(self, axis: usize, at: f64) -> [Self; 2] {
        let [mut lower, mut upper] = [self; 2];
        (lower.0[1][axis], upper.0[0][axis]) = (at, at);
        [lower, upper]
    }

    /// The integral by Gauss's rule with 3 × 3 points.
    fn gauss(self, f: &impl Fn(Point) -> f64) -> f64 {
        const RULE: [(f64, f64); 3] = [(-0.774_596_669_241_483_4, 5.0), (0.0, 8.0), (0.774_596_669_241_483_4, 5.0)];
        let [lo, hi] = self.0;
        let at = |axis: usize, x: f64| 0.5 * ((hi[axis] + lo[axis]) + x * (hi[axis] - lo[axis]));
        let sum: f64 = RULE
            .iter()
            .flat_map(|x| RULE.iter().map(move |y| (x, y)))
            .map(|(x, y)| x.1 * y.1 / 324.0 * f([at(0, x.0), at(1, y.0)]))
            .sum();
        sum * (hi[0] - lo[0]) * (hi[1] - lo[1])
    }

    /// The integral, quartered until it holds still.
    fn integrate(self, f: &impl Fn(Point) -> f64, whole: f64, tolerance: f64, depth: u32) -> f64 {
        let middle = [0, 1].map(|axis| 0.5 * (self.0[0][axis] + self.0[1][axis]));
        let quarters = self.cut(0, middle[0]).map(|half| half.cut(1, middle[1]));
        let values = quarters.map(|half| half.map(|cell| cell.gauss(f)));
        let sum = values.as_flattened().iter().sum::<f64>();
        if (sum - whole).abs() <= tolerance || depth == 0 {
            return sum;
        }
        let pairs = quarters.as_flattened().iter().zip(values.as_flattened());
        pairs.map(|(cell, &value)| cell.integrate(f, value, 0.5 * tolerance, depth - 1)).sum()
    }

    /// The integral of a density, most of which lies where the points of `layout` do: cells of doubling size lead away
    /// from their box, so that none is so large that its rule misses what the density has there.
    fn integrate_around(self, layout: &[Point], f: &impl Fn(Point) -> f64) -> f64 {
        let [rows, columns] = [0, 1].map(|axis| {
            let (lo, hi) = (self.0[0][axis], self.0[1][axis]);
            let bounds = layout.iter().fold([hi, lo], |b, p| [b[0].min(p[axis]), b[1].max(p[axis])]);
            let [below, above] = if bounds[0] < bounds[1] { bounds } else { [lo, hi] };
            let steps = || (0..).map(|k| (f64::from(1_u32 << k) - 0.5) * (above - below));
            let mut cuts: Vec<f64> = steps().map(|step| below - step).take_while(|&x| x > lo).collect();
            cuts.reverse();
            cuts.insert(0, lo);
            cuts.extend(steps().map(|step| above + step).take_while(|&x| x < hi));
            cuts.push(hi);
            cuts
        });
        let pieces = rows.windows(2).flat_map(|r| columns.windows(2).map(move |c| Self([[r[0], c[0]], [r[1], c[1]]])));
        pieces.map(|piece| piece.integrate(f, piece.gauss(f), 2e-7, 10)).sum()
    }

    /// Halves itself where `layout` has as many points on either side, as long as they are many; finds the number of
    /// `points` and the integral of `f` in each part.
    fn divide(
        self,
        mut layout: Vec<Point>,
        points: Vec<Point>,
        axis: usize,
        f: &impl Fn(Point) -> f64,
    ) -> Vec<(u64, f64)> {
        const MANY: usize = 100;
        if layout.len() < MANY {
            return vec![(points.len() as u64, self.integrate_around(&layout, f))];
        }
        let half = layout.len() / 2;
        let at = layout.select_nth_unstable_by(half, |a, b| a[axis].total_cmp(&b[axis])).1[axis];
        let upper = layout.split_off(half);
        let (below, above) = points.into_iter().partition(|p| p[axis] < at);
        let [lower_cell, upper_cell] = self.cut(axis, at);
        let mut bins = lower_cell.divide(layout, below, 1 - axis, f);
        bins.extend(upper_cell.divide(upper, above, 1 - axis, f));
        bins
    }
}

/// The point of a direction; near the pole x and y tell it more exactly than z.
fn point(w: Vec3) -> Point {
    let (w, r_sq) = (w.as_dvec3(), w.as_dvec3().truncate().length_squared());
    let z = w.z.abs();
    let depth = if r_sq < 0.5 { r_sq / (1.0 + z) } else { 1.0 - z };
    [depth.clamp(0.0, 1.0), w.y.atan2(w.x) / TAU]
}

fn direction([depth, turn]: Point, side: f64) -> Vec3 {
    let r = (depth * (2.0 - depth)).sqrt();
    let (sin, cos) = (turn * TAU).sin_cos();
    Vec3::new((r * cos) as f32, (r * sin) as f32, (side * (1.0 - depth)) as f32)
}

/// The points of `count` samples in each hemisphere.
fn draw(bsdf: &Bsdf, wo: Vec3, seed: u64, count: u32) -> [Vec<Point>; 2] {
    let mut points = [vec![], vec![]];
    for i in 0..count {
        let mut numbers = Independent::new(seed, UVec2::ZERO, i);
        let (uc, u) = (numbers.get_1d(), numbers.get_2d());
        if let Some(s) = bsdf.sample(wo, uc, u) {
            points[usize::from(s.wi.z < 0.0)].push(point(s.wi));
        }
    }
    points
}

/// Chi² of the directions that a lobe draws against its density, integrated box by box; and the share that it absorbs
/// against what the density lacks.
fn chi2_lobe(bsdf: &Bsdf, wo: Vec3, significance: f64) -> Result<(), String> {
    const LAYOUT: u32 = 20_000;
    const SAMPLES: u32 = 100_000;
    let (mut observed, mut chances) = (vec![], vec![]);
    let hemispheres = draw(bsdf, wo, 10, LAYOUT).into_iter().zip(draw(bsdf, wo, 11, SAMPLES));
    for ((layout, points), side) in hemispheres.zip([1.0, -1.0]) {
        let density = |p: Point| {
            let (eval, pdf) = bsdf.eval_pdf(wo, direction(p, side));
            if eval.is_black() { 0.0 } else { f64::from(pdf) * TAU }
        };
        for (count, chance) in Cell::HEMISPHERE.divide(layout, points, 0, &density) {
            observed.push(count);
            chances.push(chance);
        }
    }
    let (samples, scattered) = (f64::from(SAMPLES), observed.iter().sum::<u64>() as f64);
    let chance: f64 = chances.iter().sum();
    // Five standard deviations, and what the integration may be off.
    let slack = 5.0 * (chance * (1.0 - chance).max(0.0) / samples).sqrt() + 1e-3;
    if (scattered / samples - chance).abs() > slack {
        return Err(format!("{scattered} of {samples} samples scatter, but the density integrates to {chance}"));
    }
    let expected: Vec<f64> = chances.iter().map(|c| c / chance * scattered).collect();
    chi2_at(&observed, &expected, significance)
}

/// Sample by sample: unit directions, weight = eval / pdf, energy at most 1, reciprocity.
fn check_samples(bsdf: &Bsdf, wo: Vec3, reciprocal: Reciprocal) -> Result<(), String> {
    let close = |a: f32, b: f32| (a - b).abs() <= 2e-3 * a.abs().max(b.abs()) + 1e-6;
    for i in 0..2000 {
        let mut numbers = Independent::new(12, UVec2::ZERO, i);
        let (uc, u) = (numbers.get_1d(), numbers.get_2d());
        let Some(s) = bsdf.sample(wo, uc, u).filter(|s| !s.delta) else {
            continue;
        };
        if (s.wi.length() - 1.0).abs() > 1e-4 {
            return Err(format!("direction of length {}", s.wi.length()));
        }
        let (pdf, eval) = (bsdf.pdf(wo, s.wi), bsdf.eval(wo, s.wi).to_rgb());
        if !close(pdf, s.pdf) {
            return Err(format!("sample says density {}, pdf says {pdf}", s.pdf));
        }
        for (weight, eval) in s.weight.to_rgb().into_iter().zip(eval) {
            if !close(weight * pdf, eval) {
                return Err(format!("weight {weight} times density {pdf} is not eval {eval}"));
            }
            if weight * s.eta * s.eta > 1.0 + 1e-5 {
                return Err(format!("weight {weight}, index {}: makes light", s.eta));
            }
        }
        if reciprocal == Reciprocal::Yes {
            let there = eval[0] / s.wi.z.abs() * (s.eta * s.eta);
            let back = bsdf.eval(s.wi, wo).to_rgb()[0] / wo.z.abs();
            if !close(there, back) {
                return Err(format!("{there} one way, {back} the other"));
            }
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn integrals_are_adaptive() {
        // A peak a thousandth of the box wide, and an edge.
        let peak = |p: Point| 1.0 / (1.0 + 1e6 * ((p[0] - 0.3).powi(2) + p[1].powi(2))).powi(2);
        let cell = Cell::HEMISPHERE;
        let value = cell.integrate(&peak, cell.gauss(&peak), 1e-10, 14);
        assert!((value / (std::f64::consts::PI * 1e-6) - 1.0).abs() < 1e-3, "{value}");
        let edge = |p: Point| f64::from(u8::from(p[0] + p[1] < 0.37));
        assert!((cell.integrate(&edge, cell.gauss(&edge), 1e-5, 10) - 0.5 * 0.87 * 0.87).abs() < 1e-3);
    }

    #[test]
    fn points_round_trip() {
        for w in [Vec3::new(1e-5, -2e-5, 1.0), Vec3::new(-0.6, 0.0, -0.8), Vec3::new(0.0, 1.0, 1e-4)] {
            assert!((direction(point(w), f64::from(w.z.signum())) - w).length() < 1e-7);
        }
    }
}
