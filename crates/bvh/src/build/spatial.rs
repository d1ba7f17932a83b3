//! The best builder: as the balanced one, but a plane may cut primitives in two, where that makes boxes overlap less.
//!
//! Spatial splits (Stich, Friedrich & Dietrich 2009, doi:10.1145/1572769.1572771) are tried where the children of the best
//! split of whole items overlap much. How many parts they may add is bounded beforehand; what a node does not use is
//! shared between its children by their numbers of items, so the tree is the same for any number of threads.

use std::borrow::Cow;

use glam::Vec3A;
use rayon::prelude::*;

use crate::build::MAX_DEPTH;
use crate::build::binary::{Forest, Node, Subtree};
use crate::build::bins::{Grid, Split};
use crate::build::bounds::Bounds;
use crate::build::chunks;
use crate::build::clip::clip;
use crate::build::item::Item;
use crate::build::plan::Plan;
use crate::build::sah::{self, SUBTREE};
use crate::geometry::Geometry;

/// Overlaps smaller than this, relative to the area of the box around everything, are left alone.
const LEAST_OVERLAP: f32 = 1e-5;
/// Parts that may be added, relative to the number of items.
const BUDGET: f32 = 0.5;
/// Where cuts are tried, plus one.
const BINS: usize = 16;
/// A cut must be so much cheaper than a split of whole items.
const GAIN: f32 = 0.99;
/// Items that a thread looks at in one go.
const CHUNK: usize = 1 << 11;

pub(super) fn build(geometry: &(impl Geometry + ?Sized), items: Vec<Item>, bounds: Bounds) -> Forest<'static> {
    let budget = (items.len() as f32 * BUDGET) as usize;
    let builder = Builder { geometry, least_overlap: LEAST_OVERLAP * bounds.half_area() };
    builder.build(items, bounds, budget, 0)
}

struct Builder<'a, G: ?Sized> {
    geometry: &'a G,
    least_overlap: f32,
}

/// The two sides of a split.
struct Sides {
    /// The left items are the last.
    items: Vec<Item>,
    right: usize,
    bounds: [Bounds; 2],
    budget: [usize; 2],
}

impl<G: Geometry + ?Sized> Builder<'_, G> {
    fn build(&self, items: Vec<Item>, bounds: Bounds, budget: usize, depth: usize) -> Forest<'static> {
        if items.len() <= SUBTREE {
            return self.subtree(items, bounds, budget, depth);
        }
        let Sides { mut items, right, bounds: sides, budget } = self.split(items, bounds, budget, depth);
        let left_items = items.split_off(right);
        let (left, right) = rayon::join(
            || self.build(left_items, sides[0], budget[0], depth + 1),
            || self.build(items, sides[1], budget[1], depth + 1),
        );
        Forest::join(left, right, bounds)
    }

    fn subtree(&self, items: Vec<Item>, bounds: Bounds, budget: usize, depth: usize) -> Forest<'static> {
        let mut tail = Tail { nodes: Vec::with_capacity(items.len()), done: Vec::with_capacity(items.len()), items };
        let plan = self.branch(&mut tail, 0, bounds, budget, depth);
        tail.nodes.shrink_to_fit();
        tail.done.shrink_to_fit();
        Forest::new(Subtree { nodes: tail.nodes, items: Cow::Owned(tail.done) }, plan)
    }

    /// Builds the tree of the items from `start` on, and moves them to where they are done.
    fn branch(&self, tail: &mut Tail, start: usize, bounds: Bounds, budget: usize, depth: usize) -> Plan {
        let first = tail.done.len();
        if budget == 0 || bounds.half_area() <= self.least_overlap || tail.items.len() - start <= sah::SMALL {
            let plan = sah::branch(&mut tail.nodes, &mut tail.items[start..], first, bounds, depth);
            tail.done.extend(tail.items.drain(start..));
            return plan;
        }
        let items = tail.items.split_off(start);
        let sides = self.split(items, bounds, budget, depth);
        tail.items.extend_from_slice(&sides.items);
        let index = tail.nodes.len();
        tail.nodes.push(Node::leaf(bounds, first, 0, Default::default()));
        let left = self.branch(tail, start + sides.right, sides.bounds[0], sides.budget[0], depth + 1);
        let right_index = tail.nodes.len();
        let right = self.branch(tail, start, sides.bounds[1], sides.budget[1], depth + 1);
        let (plan, choices) = Plan::join(&left, &right, bounds.half_area());
        tail.nodes[index] = Node::inner(bounds, first, right_index - index, choices);
        plan
    }

    fn split(&self, mut items: Vec<Item>, bounds: Bounds, budget: usize, depth: usize) -> Sides {
        let count = items.len();
        // No level has more items, parts yet to be made included, than the one above it.
        let levels_needed = (count + budget).next_power_of_two().ilog2() as usize + 2;
        let centers = chunks::centers(&items);
        if depth + levels_needed < MAX_DEPTH {
            let grid = Grid::<32>::new(centers);
            let whole = chunks::bins(&items, &grid).best();
            if let Some(sides) = self.cut(&items, bounds, whole.as_ref(), budget) {
                return sides;
            }
            if let Some(split) = whole {
                let right = chunks::partition(&mut items, |item| !grid.goes_left(&split, item));
                return Sides { budget: share(budget, [count - right, right]), items, right, bounds: split.bounds };
            }
        }
        let (right, [right_bounds, left_bounds]) = sah::halve(&mut items, centers);
        Sides { budget: share(budget, [count - right, right]), items, right, bounds: [left_bounds, right_bounds] }
    }

    /// Cuts items in two, if that is cheaper than to split them as they are.
    fn cut(&self, items: &[Item], bounds: Bounds, whole: Option<&Split>, budget: usize) -> Option<Sides> {
        let (cost, overlap) = match whole {
            Some(split) => (split.cost, split.bounds[0].intersection(split.bounds[1]).half_area()),
            None => (bounds.half_area() * items.len() as f32, bounds.half_area()),
        };
        if budget == 0 || overlap <= self.least_overlap {
            return None;
        }
        let cut = self.best_cut(items, bounds, budget).filter(|cut| cut.cost < GAIN * cost)?;
        let parts: Vec<_> = items.par_chunks(CHUNK).map(|chunk| self.divide(chunk, &cut)).collect();
        let mut sides = Vec::with_capacity(items.len() + cut.added);
        parts.iter().for_each(|[_, right]| sides.extend_from_slice(right));
        let right = sides.len();
        parts.iter().for_each(|[left, _]| sides.extend_from_slice(left));
        let left = sides.len() - right;
        if left.max(right) >= items.len() || left == 0 || right == 0 {
            return None;
        }
        let rest = budget - (left + right).saturating_sub(items.len()).min(budget);
        let bounds = [chunks::bounds(&sides[right..]), chunks::bounds(&sides[..right])];
        Some(Sides { items: sides, right, bounds, budget: share(rest, [left, right]) })
    }

    fn best_cut(&self, items: &[Item], bounds: Bounds, budget: usize) -> Option<Cut> {
        let parts: Vec<_> = items.par_chunks(CHUNK).map(|chunk| self.bins(chunk, bounds)).collect();
        let mut bins = Bins::default();
        parts.iter().for_each(|part| bins.merge(part));
        let mut best: Option<Cut> = None;
        for axis in 0..3 {
            bins.sweep(axis, |bin, cut| {
                let added = (cut.counts[0] + cut.counts[1]) as usize - items.len();
                if added <= budget && best.as_ref().is_none_or(|best| cut.cost < best.cost) {
                    best = Some(Cut { at: border(bounds, axis, bin), added, ..cut });
                }
            });
        }
        best
    }

    /// Cuts the boxes of items at all borders of bins: what is left of the items themselves would take too long to find out.
    fn bins(&self, items: &[Item], bounds: Bounds) -> Bins {
        let mut bins = Bins::default();
        let extent = bounds.hi - bounds.lo;
        let scale = extent.recip() * BINS as f32;
        let borders: [Vec3A; BINS + 1] = std::array::from_fn(|bin| bounds.lo + extent * (bin as f32 / BINS as f32));
        for item in items {
            let part = item.bounds();
            let [first, last] = [part.lo, part.hi].map(|p| ((p - bounds.lo) * scale).to_array());
            for axis in 0..3 {
                let [first, last] = [first[axis], last[axis]].map(|x| (x as usize).min(BINS - 1));
                bins.enter[axis][first] += 1;
                bins.leave[axis][last] += 1;
                for bin in first..=last {
                    let mut slice = part;
                    if bin > first {
                        slice.lo[axis] = borders[bin][axis];
                    }
                    if bin < last {
                        slice.hi[axis] = borders[bin + 1][axis];
                    }
                    bins.bounds[axis][bin] = bins.bounds[axis][bin].union(slice);
                }
            }
        }
        bins
    }

    /// The items on both sides, cut in two unless it is cheaper to leave them whole on one side.
    fn divide(&self, items: &[Item], cut: &Cut) -> [Vec<Item>; 2] {
        let mut sides = [Vec::with_capacity(items.len()), Vec::with_capacity(items.len())];
        for item in items {
            let bounds = item.bounds();
            if bounds.hi[cut.axis] <= cut.at {
                sides[0].push(*item);
            } else if bounds.lo[cut.axis] >= cut.at {
                sides[1].push(*item);
            } else {
                match cut.whole_side(bounds) {
                    Some(side) => sides[side].push(*item),
                    None => {
                        let primitive = self.geometry.primitive(item.prim() as usize);
                        let parts = clip(&primitive, bounds, cut.axis, cut.at);
                        for (side, part) in sides.iter_mut().zip(parts).filter(|(_, part)| !part.is_empty()) {
                            side.push(Item::new(item.prim(), item.kind(), part));
                        }
                    }
                }
            }
        }
        sides
    }
}

/// What a thread has of a subtree that it builds.
struct Tail {
    nodes: Vec<Node>,
    /// Items in leaves.
    done: Vec<Item>,
    /// Items yet to be sorted.
    items: Vec<Item>,
}

/// Shares a budget between sides.
fn share(budget: usize, counts: [usize; 2]) -> [usize; 2] {
    let all = (counts[0] + counts[1]).max(1) as u64;
    let left = (budget as u64 * counts[0] as u64 / all) as usize;
    [left, budget - left]
}

fn border(bounds: Bounds, axis: usize, bin: usize) -> f32 {
    bounds.lo[axis] + (bounds.hi[axis] - bounds.lo[axis]) * (bin as f32 / BINS as f32)
}

/// A plane, and what is on its sides.
struct Cut {
    axis: usize,
    at: f32,
    cost: f32,
    bounds: [Bounds; 2],
    counts: [u32; 2],
    /// How many items it cuts.
    added: usize,
}

impl Cut {
    /// The side on which an item is to stay whole, if that costs less than its parts do.
    fn whole_side(&self, item: Bounds) -> Option<usize> {
        let [left, right] = self.bounds;
        let [n, m] = self.counts.map(|count| count as f32);
        let (area, other) = (left.half_area(), right.half_area());
        let left_only = left.union(item).half_area() * n + other * (m - 1.0);
        let right_only = area * (n - 1.0) + right.union(item).half_area() * m;
        let best = left_only.min(right_only);
        (best <= area * n + other * m).then_some(usize::from(right_only < left_only))
    }
}

/// Boxes of the parts in each bin, and how many items begin and end there.
struct Bins {
    bounds: [[Bounds; BINS]; 3],
    enter: [[u32; BINS]; 3],
    leave: [[u32; BINS]; 3],
}

impl Default for Bins {
    fn default() -> Self {
        Self { bounds: [[Bounds::EMPTY; BINS]; 3], enter: [[0; BINS]; 3], leave: [[0; BINS]; 3] }
    }
}

impl Bins {
    fn merge(&mut self, other: &Self) {
        for (axis, bin) in (0..3).flat_map(|axis| (0..BINS).map(move |bin| (axis, bin))) {
            self.bounds[axis][bin] = self.bounds[axis][bin].union(other.bounds[axis][bin]);
            self.enter[axis][bin] += other.enter[axis][bin];
            self.leave[axis][bin] += other.leave[axis][bin];
        }
    }

    /// All cuts along an axis that have items on both sides.
    fn sweep(&self, axis: usize, mut found: impl FnMut(usize, Cut)) {
        let mut right = [(Bounds::EMPTY, 0); BINS + 1];
        for bin in (1..BINS).rev() {
            right[bin] = (right[bin + 1].0.union(self.bounds[axis][bin]), right[bin + 1].1 + self.leave[axis][bin]);
        }
        let mut left = (Bounds::EMPTY, 0);
        for bin in 1..BINS {
            left = (left.0.union(self.bounds[axis][bin - 1]), left.1 + self.enter[axis][bin - 1]);
            let right = right[bin];
            if left.1 > 0 && right.1 > 0 {
                let cost = left.0.half_area() * left.1 as f32 + right.0.half_area() * right.1 as f32;
                let (bounds, counts) = ([left.0, right.0], [left.1, right.1]);
                found(bin, Cut { axis, at: 0.0, cost, bounds, counts, added: 0 });
            }
        }
    }
}
