//! Where to split items: the surface area heuristic, tried at the borders of bins (Wald 2007,
//! doi:10.1109/RT.2007.4342588).

use glam::{Mat3A, Vec3A};

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

/// For each bin and axis, the box around the items, and their number.
#[derive(Clone)]
pub(super) struct Bins<const N: usize> {
    bounds: [[Bounds; 3]; N],
    counts: [[u32; 3]; N],
}

impl<const N: usize> Bins<N> {
    #[inline]
    pub(super) fn new(items: &[Item], grid: &Grid<N>) -> Self {
        let mut bins = Self { bounds: [[Bounds::EMPTY; 3]; N], counts: [[0; 3]; N] };
        for item in items {
            let bounds = item.bounds();
            let at = grid.bins(bounds.center());
            for (axis, bin) in at.into_iter().enumerate() {
                bins.bounds[bin][axis] = bins.bounds[bin][axis].union(bounds);
                bins.counts[bin][axis] += 1;
            }
        }
        bins
    }

    pub(super) fn merge(&mut self, other: &Self) {
        for bin in 0..N {
            for axis in 0..3 {
                self.bounds[bin][axis] = self.bounds[bin][axis].union(other.bounds[bin][axis]);
                self.counts[bin][axis] += other.counts[bin][axis];
            }
        }
    }

    /// The cheapest split with items on both sides; none if all are in one bin. All axes are looked at at once.
    #[inline]
    pub(super) fn best(&self) -> Option<Split> {
        let mut right = [Vec3A::ZERO; N];
        let mut side = Side::EMPTY;
        for bin in (1..N).rev() {
            side.add(&self.bounds[bin], self.counts[bin]);
            right[bin] = side.cost();
        }
        let mut side = Side::EMPTY;
        let (mut costs, mut bins) = (Vec3A::INFINITY, Vec3A::ZERO);
        for (bin, right) in right.into_iter().enumerate().skip(1) {
            side.add(&self.bounds[bin - 1], self.counts[bin - 1]);
            let cost = side.cost() + right;
            let is_less = cost.cmplt(costs);
            costs = Vec3A::select(is_less, cost, costs);
            bins = Vec3A::select(is_less, Vec3A::splat(bin as f32), bins);
        }
        let axis = costs.min_position();
        let (cost, bin) = (costs[axis], bins[axis] as usize);
        let union = |bins: &[[Bounds; 3]]| bins.iter().fold(Bounds::EMPTY, |a, b| a.union(b[axis]));
        let (left, right) = self.bounds.split_at(bin);
        cost.is_finite().then(|| Split { axis, bin, cost, bounds: [union(left), union(right)] })
    }
}

/// What lies on one side of a border, for each axis.
struct Side {
    bounds: [Bounds; 3],
    counts: Vec3A,
}

impl Side {
    const EMPTY: Self = Self { bounds: [Bounds::EMPTY; 3], counts: Vec3A::ZERO };

    #[inline(always)]
    fn add(&mut self, bounds: &[Bounds; 3], [x, y, z]: [u32; 3]) {
        for (side, bounds) in self.bounds.iter_mut().zip(bounds) {
            *side = side.union(*bounds);
        }
        self.counts += Vec3A::new(x as f32, y as f32, z as f32);
    }

    /// Area times count; infinite if there is nothing.
    #[inline(always)]
    fn cost(&self) -> Vec3A {
        let [a, b, c] = &self.bounds;
        let size = |b: &Bounds| (b.hi - b.lo).max(Vec3A::ZERO);
        let size = Mat3A::from_cols(size(a), size(b), size(c)).transpose();
        let (x, y, z) = (size.x_axis, size.y_axis, size.z_axis);
        let cost = (x * y + y * z + z * x) * self.counts;
        Vec3A::select(self.counts.cmpgt(Vec3A::ZERO), cost, Vec3A::INFINITY)
    }
}
