//! Where to split items: the surface area heuristic, tried at the borders of bins (Wald 2007,
//! doi:10.1109/RT.2007.4342588).

use glam::Vec3A;

use crate::build::bounds::Bounds;
use crate::build::item::Item;

/// Maps centres to N bins along each axis, N a power of two.
#[derive(Clone, Copy)]
pub(super) struct Grid<const N: usize> {
    lo: Vec3A,
    scale: Vec3A,
}

impl<const N: usize> Grid<N> {
    /// Just below 2.
    const END: f32 = 2.0_f32.next_down();

    pub(super) fn new(centers: Bounds) -> Self {
        let scale = (centers.hi - centers.lo).recip();
        // Axes along which all centres coincide, or nearly so, have one bin.
        let scale = Vec3A::from_array(scale.to_array().map(|x| if x.is_finite() { x } else { 0.0 }));
        Self { lo: centers.lo, scale }
    }

    /// The bins of a centre. Numbers from 1 to 2 have their place between the two in the leading bits of their mantissa.
    #[inline(always)]
    fn bins(&self, center: Vec3A) -> [usize; 3] {
        let x = ((center - self.lo) * self.scale + Vec3A::ONE).min(Vec3A::splat(Self::END));
        x.to_array().map(|x| (x.to_bits() >> (23 - N.ilog2())) as usize & (N - 1))
    }

    /// The same bin, along one axis.
    #[inline(always)]
    fn bin(&self, item: Item, axis: usize) -> usize {
        let x = ((item.center_on(axis) - self.lo[axis]) * self.scale[axis] + 1.0).min(Self::END);
        (x.to_bits() >> (23 - N.ilog2())) as usize & (N - 1)
    }

    #[inline(always)]
    pub(super) fn goes_left(&self, split: &Split, item: Item) -> bool {
        self.bin(item, split.axis) < split.bin
    }
}

/// A border between bins, and what lies on its sides.
#[derive(Clone, Copy, Debug)]
pub(super) struct Split {
    pub(super) axis: usize,
    /// Items whose bin is below this go left.
    pub(super) bin: usize,
    /// Σ area · count of both sides.
    pub(super) cost: f32,
    pub(super) bounds: [Bounds; 2],
}

/// Boxes and counts of the items in each bin.
#[derive(Clone)]
pub(super) struct Bins<const N: usize> {
    bounds: [[Bounds; N]; 3],
    counts: [[u32; N]; 3],
}

impl<const N: usize> Bins<N> {
    #[inline]
    pub(super) fn new(items: &[Item], grid: &Grid<N>) -> Self {
        let mut bins = Self { bounds: [[Bounds::EMPTY; N]; 3], counts: [[0; N]; 3] };
        for item in items {
            let bounds = item.bounds();
            let at = grid.bins(bounds.center());
            for (axis, bin) in at.into_iter().enumerate() {
                bins.bounds[axis][bin] = bins.bounds[axis][bin].union(bounds);
                bins.counts[axis][bin] += 1;
            }
        }
        bins
    }

    pub(super) fn merge(&mut self, other: &Self) {
        for axis in 0..3 {
            for bin in 0..N {
                self.bounds[axis][bin] = self.bounds[axis][bin].union(other.bounds[axis][bin]);
                self.counts[axis][bin] += other.counts[axis][bin];
            }
        }
    }

    /// The cheapest split with items on both sides; none if all are in one bin.
    #[inline]
    pub(super) fn best(&self) -> Option<Split> {
        let mut best = (f32::INFINITY, 0, 0);
        for axis in 0..3 {
            let (bounds, counts) = (&self.bounds[axis], &self.counts[axis]);
            let mut right = [0.0; N];
            let (mut around, mut count) = (Bounds::EMPTY, 0);
            for bin in (1..N).rev() {
                (around, count) = (around.union(bounds[bin]), count + counts[bin]);
                right[bin] = if count > 0 { around.half_area() * count as f32 } else { f32::INFINITY };
            }
            let (mut around, mut count) = (Bounds::EMPTY, 0);
            for bin in 1..N {
                (around, count) = (around.union(bounds[bin - 1]), count + counts[bin - 1]);
                let cost = around.half_area() * count as f32 + right[bin];
                if cost < best.0 && count > 0 {
                    best = (cost, axis, bin);
                }
            }
        }
        let (cost, axis, bin) = best;
        let union = |bins: &[Bounds]| bins.iter().fold(Bounds::EMPTY, |a, &b| a.union(b));
        let (left, right) = self.bounds[axis].split_at(bin);
        cost.is_finite().then(|| Split { axis, bin, cost, bounds: [union(left), union(right)] })
    }
}
