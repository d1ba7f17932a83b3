//! The balanced builder: the binned surface area heuristic, from the top down.
//!
//! A node's items are split where the expected cost of a ray, Σ area · count, is least (Wald 2007,
//! doi:10.1109/RT.2007.4342588). Threads share the work on large nodes, then each takes subtrees.

use std::borrow::Cow;

use crate::build::MAX_DEPTH;
use crate::build::binary::{Forest, Node, Subtree};
use crate::build::bins::{Grid, Split};
use crate::build::bounds::Bounds;
use crate::build::chunks;
use crate::build::item::{Item, bounds_of};
use crate::build::plan::Plan;

/// The most items in a subtree, which is one thread's work.
pub(super) const SUBTREE: usize = 1 << 12;
/// So few items are not split, if they are of one kind: the heuristic has no use for more leaves.
pub(super) const SMALL: usize = 4;

/// The tree of items, which are reordered.
pub(super) fn build(items: &mut [Item], bounds: Bounds, depth: usize) -> Forest<'_> {
    if items.len() <= SUBTREE {
        return subtree(items, bounds, depth);
    }
    let (middle, [left, right]) = split(items, depth);
    let (left_items, right_items) = items.split_at_mut(middle);
    let (left, right) = rayon::join(|| build(left_items, left, depth + 1), || build(right_items, right, depth + 1));
    Forest::join(left, right, bounds)
}

fn subtree(items: &mut [Item], bounds: Bounds, depth: usize) -> Forest<'_> {
    let mut nodes = Vec::with_capacity(items.len());
    let plan = branch(&mut nodes, items, 0, bounds, depth);
    nodes.shrink_to_fit();
    Forest::new(Subtree { nodes, items: Cow::Borrowed(items) }, plan)
}

/// Appends the tree of items, of which the first is number `first` of the subtree.
pub(super) fn branch(nodes: &mut Vec<Node>, items: &mut [Item], first: usize, bounds: Bounds, depth: usize) -> Plan {
    let index = nodes.len();
    let kind = items[0].kind();
    let is_small = items.len() <= SMALL.min(kind.lanes());
    if is_small && items.iter().all(|item| item.kind() == kind) {
        let (plan, choices) = Plan::leaf(bounds.half_area(), kind, items.len());
        nodes.push(Node::leaf(bounds, first, items.len(), choices));
        return plan;
    }
    let (middle, sides) = if is_small { split_kinds(items) } else { split(items, depth) };
    let (left_items, right_items) = items.split_at_mut(middle);
    nodes.push(Node::leaf(bounds, first, 0, Default::default()));
    let left = branch(nodes, left_items, first, sides[0], depth + 1);
    let right_index = nodes.len();
    let right = branch(nodes, right_items, first + middle, sides[1], depth + 1);
    let (plan, choices) = Plan::join(&left, &right, bounds.half_area());
    nodes[index] = Node::inner(bounds, first, right_index - index, choices);
    plan
}

/// Reorders items; returns how many go left, and the boxes of both sides.
fn split(items: &mut [Item], depth: usize) -> (usize, [Bounds; 2]) {
    // Levels that halving takes, and some for kinds.
    let levels_needed = items.len().next_power_of_two().ilog2() as usize + 2;
    let centers = chunks::centers(items);
    let split = match items.len() {
        _ if depth + levels_needed >= MAX_DEPTH => None,
        0..=8 => split_in_bins::<4>(items, centers),
        9..=32 => split_in_bins::<8>(items, centers),
        33..=1024 => split_in_bins::<16>(items, centers),
        _ => split_in_bins::<32>(items, centers),
    };
    split.unwrap_or_else(|| halve(items, centers))
}

fn split_in_bins<const N: usize>(items: &mut [Item], centers: Bounds) -> Option<(usize, [Bounds; 2])> {
    let grid = Grid::<N>::new(centers);
    let split: Split = chunks::bins(items, &grid).best()?;
    Some((chunks::partition(items, |item| grid.goes_left(&split, item)), split.bounds))
}

/// The fallback: halves by the order of centres along the longest axis; always makes progress.
pub(super) fn halve(items: &mut [Item], centers: Bounds) -> (usize, [Bounds; 2]) {
    let axis = (centers.hi - centers.lo).max_position();
    let middle = items.len() / 2;
    let key = |item: &Item| item.center_on(axis);
    items.select_nth_unstable_by(middle, |a, b| key(a).total_cmp(&key(b)).then(a.prim().cmp(&b.prim())));
    let (left, right) = items.split_at(middle);
    (middle, [chunks::bounds(left), chunks::bounds(right)])
}

/// Those of the first item's kind go left.
fn split_kinds(items: &mut [Item]) -> (usize, [Bounds; 2]) {
    let kind = items[0].kind();
    let middle = chunks::partition(items, |item| item.kind() == kind);
    let (left, right) = items.split_at(middle);
    (middle, [bounds_of(left), bounds_of(right)])
}
