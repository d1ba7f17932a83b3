//! The balanced builder: binned surface area heuristic.
//!
//! A node's items are split where the expected cost of a ray, Σ area · count, is least, tried at the borders of bins along
//! each axis (Wald 2007, doi:10.1109/RT.2007.4342588). Subtrees are built in parallel; where each one's nodes go is known
//! beforehand, so the tree is the same for any number of threads.

use std::sync::Arc;

use crate::build::MAX_DEPTH;
use crate::build::binary::{Binary, Bounds, Item, Node};
use crate::bvh::Bvh;
use crate::shape::Primitive;

const BINS: usize = 32;
/// Subtrees with fewer items are not worth a thread.
const PARALLEL: usize = 4096;

pub(super) fn build(primitives: &[Primitive], objects: &[Arc<Bvh>]) -> Binary {
    let mut binary = Binary::new(primitives, objects);
    if !binary.items.is_empty() {
        split(&mut binary.nodes, &mut binary.items, 0);
    }
    binary
}

/// Builds the subtree of `items`, which are reordered, into `nodes`, which are exactly as many as it needs.
fn split(nodes: &mut [Node], items: &mut [Item], depth: usize) {
    let (mut bounds, mut centers) = (Bounds::EMPTY, Bounds::EMPTY);
    for item in items.iter() {
        let center = item.bounds.center();
        bounds = bounds.union(item.bounds);
        centers = centers.union(Bounds { lo: center, hi: center });
    }
    let count = items.len();
    let Some((node, below)) = nodes.split_first_mut() else {
        return;
    };
    *node = Node { bounds, count: count as u32, left: 0 };
    if count <= 1 {
        return;
    }
    let levels_needed = count.next_power_of_two().ilog2() as usize;
    let best = if depth + levels_needed < MAX_DEPTH { best_split(items, centers) } else { None };
    let middle = match best {
        Some(best) => partition(items, &best),
        None => halve(items, centers),
    };
    node.left = middle as u32;
    let (left_items, right_items) = items.split_at_mut(middle);
    let (left_nodes, right_nodes) = below.split_at_mut(2 * middle - 1);
    let mut left = || split(left_nodes, left_items, depth + 1);
    let mut right = || split(right_nodes, right_items, depth + 1);
    if count > PARALLEL {
        rayon::join(left, right);
    } else {
        left();
        right();
    }
}

struct Split {
    axis: usize,
    /// Items whose bin is below this go left.
    bin: usize,
    bins: Bins,
    cost: f32,
}

/// Maps centres to bins along one axis.
#[derive(Clone, Copy)]
struct Bins {
    lo: f32,
    scale: f32,
    count: usize,
}

impl Bins {
    #[inline]
    fn index(&self, center: f32) -> usize {
        (((center - self.lo) * self.scale) as usize).min(self.count - 1)
    }
}

/// The cheapest split over all axes; none if all centres coincide.
fn best_split(items: &[Item], centers: Bounds) -> Option<Split> {
    let count = BINS.min(4 + items.len() / 2);
    let bins = [0, 1, 2].map(|axis| {
        let scale = count as f32 / (centers.hi[axis] - centers.lo[axis]);
        Bins { lo: centers.lo[axis], scale: if scale.is_finite() { scale } else { 0.0 }, count }
    });
    let mut filled = [[(Bounds::EMPTY, 0_u32); BINS]; 3];
    for item in items {
        let center = item.bounds.center();
        for axis in 0..3 {
            let (bounds, n) = &mut filled[axis][bins[axis].index(center[axis])];
            (*bounds, *n) = (bounds.union(item.bounds), *n + 1);
        }
    }
    let axes = (0..3).filter(|&axis| bins[axis].scale > 0.0);
    axes.filter_map(|axis| cheapest(&filled[axis][..count], axis, bins[axis])).min_by(|a, b| a.cost.total_cmp(&b.cost))
}

/// The cheapest split along one axis, by a sweep from either end.
fn cheapest(filled: &[(Bounds, u32)], axis: usize, bins: Bins) -> Option<Split> {
    let mut right = [(0.0, 0); BINS];
    let (mut bounds, mut n) = (Bounds::EMPTY, 0);
    for bin in (1..filled.len()).rev() {
        (bounds, n) = (bounds.union(filled[bin].0), n + filled[bin].1);
        right[bin] = (bounds.half_area() * n as f32, n);
    }
    let mut best: Option<Split> = None;
    let (mut bounds, mut n) = (Bounds::EMPTY, 0);
    for bin in 1..filled.len() {
        (bounds, n) = (bounds.union(filled[bin - 1].0), n + filled[bin - 1].1);
        let cost = bounds.half_area() * n as f32 + right[bin].0;
        if n > 0 && right[bin].1 > 0 && best.as_ref().is_none_or(|s| cost < s.cost) {
            best = Some(Split { axis, bin, bins, cost });
        }
    }
    best
}

/// Moves the left side of a split to the front; returns its length.
fn partition(items: &mut [Item], split: &Split) -> usize {
    let mut left = 0;
    for i in 0..items.len() {
        if split.bins.index(items[i].bounds.center()[split.axis]) < split.bin {
            items.swap(left, i);
            left += 1;
        }
    }
    left
}

/// The fallback: halves by the order of centres along the longest axis; always makes progress.
fn halve(items: &mut [Item], centers: Bounds) -> usize {
    let axis = (centers.hi - centers.lo).max_position();
    let middle = items.len() / 2;
    let key = |item: &Item| item.bounds.center()[axis];
    items.select_nth_unstable_by(middle, |a, b| key(a).total_cmp(&key(b)).then(a.prim.cmp(&b.prim)));
    middle
}
