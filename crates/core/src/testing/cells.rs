//! Directions sorted into boxes of nearly equal chance, which a first set of samples lays out.
//!
//! A density as wide as the sphere and one as narrow as a hundredth of a degree are told from a wrong one equally well,
//! and within a box a density varies little, so it is easy to integrate.

/// A direction: two numbers in which solid angle is even, the second of them the azimuth in turns.
pub(super) type Point = [f64; 2];

/// A box of directions, from a lower to an upper corner.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cell([Point; 2]);

impl Cell {
    /// 1 − cos of the angle to the pole and the azimuth of all directions within 90 degrees.
    pub(super) const HEMISPHERE: Self = Self([[0.0, -0.5], [1.0, 0.5]]);
    /// The cosine and the azimuth of all directions.
    pub(super) const SPHERE: Self = Self([[-1.0, -0.5], [1.0, 0.5]]);

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
    fn integrate_around(self, layout: &[Point], tolerance: f64, f: &impl Fn(Point) -> f64) -> f64 {
        let [rows, columns] = [0, 1].map(|axis| {
            let (lo, hi) = (self.0[0][axis], self.0[1][axis]);
            let bounds = layout.iter().fold([hi, lo], |b, p| [b[0].min(p[axis]), b[1].max(p[axis])]);
            let [below, above] = if bounds[0] < bounds[1] { bounds } else { [lo, hi] };
            let steps = || (0..).map(|k| (2.0_f64.powi(k) - 0.5) * (above - below));
            let mut cuts: Vec<f64> = steps().map(|step| below - step).take_while(|&x| x > lo).collect();
            cuts.reverse();
            cuts.insert(0, lo);
            cuts.extend(steps().map(|step| above + step).take_while(|&x| x < hi));
            cuts.push(hi);
            cuts
        });
        let pieces = rows.windows(2).flat_map(|r| columns.windows(2).map(move |c| Self([[r[0], c[0]], [r[1], c[1]]])));
        pieces.map(|piece| piece.integrate(f, piece.gauss(f), tolerance, 10)).sum()
    }

    /// Halves itself where `layout` has as many points on either side, as long as they are many; finds the number of
    /// `points` and the integral of `f`, to about `tolerance`, in each part.
    pub(super) fn divide(
        self,
        layout: Vec<Point>,
        points: Vec<Point>,
        tolerance: f64,
        f: &impl Fn(Point) -> f64,
    ) -> Vec<(u64, f64)> {
        self.halve(0, layout, points, &|cell, layout| cell.integrate_around(layout, tolerance, f))
    }

    fn halve(
        self,
        axis: usize,
        mut layout: Vec<Point>,
        points: Vec<Point>,
        integral: &impl Fn(Self, &[Point]) -> f64,
    ) -> Vec<(u64, f64)> {
        const MANY: usize = 100;
        if layout.len() < MANY {
            return vec![(points.len() as u64, integral(self, &layout))];
        }
        let half = layout.len() / 2;
        let at = layout.select_nth_unstable_by(half, |a, b| a[axis].total_cmp(&b[axis])).1[axis];
        let upper = layout.split_off(half);
        let (below, above) = points.into_iter().partition(|p| p[axis] < at);
        let [lower_cell, upper_cell] = self.cut(axis, at);
        let mut bins = lower_cell.halve(1 - axis, layout, below, integral);
        bins.extend(upper_cell.halve(1 - axis, upper, above, integral));
        bins
    }
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
}
