//! The fast builder: items along a space-filling curve, split where the curve enters another cell.
//!
//! Centres are numbered along the Morton curve, ten bits an axis, and sorted; a node is split where the highest bit in
//! which its numbers differ changes (Lauterbach et al. 2009, doi:10.1111/j.1467-8659.2009.01377.x).

use std::borrow::Cow;

use glam::Vec3A;
use rayon::prelude::*;

use crate::build::binary::{Forest, Node, Subtree};
use crate::build::bounds::Bounds;
use crate::build::chunks;
use crate::build::item::Item;
use crate::build::plan::Plan;
use crate::build::sah::{SMALL, SUBTREE};

/// Bits of a number along the curve.
const BITS: usize = 30;

pub(super) fn build(items: Vec<Item>) -> Forest<'static> {
    let centers = chunks::centers(&items);
    let scale = Vec3A::splat((1 << (BITS / 3)) as f32) / (centers.hi - centers.lo).max(Vec3A::splat(f32::MIN_POSITIVE));
    // The place in the list, in the lower half, makes each key unique, so their order is.
    let key = |(index, item): (usize, &Item)| {
        let cell = ((item.bounds().center() - centers.lo) * scale).to_array();
        let [x, y, z] = cell.map(|x| spread((x as u32).min((1 << (BITS / 3)) - 1)));
        u64::from(x << 2 | y << 1 | z) << 32 | index as u64
    };
    let mut keys: Vec<u64> = items.par_iter().enumerate().map(key).collect();
    keys.par_sort_unstable();
    let sorted: Vec<Item> = keys.par_iter().map(|&key| items[key as u32 as usize]).collect();
    drop(items);
    grow(&keys, &sorted).0
}

/// Moves bit i of ten to bit 3 i.
fn spread(x: u32) -> u32 {
    let x = (x | x << 16) & 0x0300_00ff;
    let x = (x | x << 8) & 0x0300_f00f;
    let x = (x | x << 4) & 0x030c_30c3;
    (x | x << 2) & 0x0924_9249
}

/// How many items go left.
fn split(keys: &[u64]) -> usize {
    let (first, last) = (keys[0] >> 32, keys[keys.len() - 1] >> 32);
    match (first ^ last).checked_ilog2() {
        Some(bit) => keys.partition_point(|key| key >> (32 + bit) & 1 == 0),
        None => keys.len() / 2,
    }
}

fn grow(keys: &[u64], items: &[Item]) -> (Forest<'static>, Bounds) {
    if items.len() <= SUBTREE {
        let mut nodes = Vec::with_capacity(items.len());
        let (plan, bounds) = branch(&mut nodes, keys, items, 0);
        nodes.shrink_to_fit();
        return (Forest::new(Subtree { nodes, items: Cow::Owned(items.to_vec()) }, plan), bounds);
    }
    let middle = split(keys);
    let ((left, left_bounds), (right, right_bounds)) =
        rayon::join(|| grow(&keys[..middle], &items[..middle]), || grow(&keys[middle..], &items[middle..]));
    let bounds = left_bounds.union(right_bounds);
    (Forest::join(left, right, bounds), bounds)
}

/// Appends the tree of items, of which the first is number `first` of the subtree.
fn branch(nodes: &mut Vec<Node>, keys: &[u64], items: &[Item], first: usize) -> (Plan, Bounds) {
    let kind = items[0].kind();
    let is_small = items.len() <= SMALL.min(kind.lanes());
    if is_small && items.iter().all(|item| item.kind() == kind) {
        let bounds = chunks::bounds(items);
        let (plan, choices) = Plan::leaf(bounds.half_area(), kind, items.len());
        nodes.push(Node::leaf(bounds, first, items.len(), choices));
        return (plan, bounds);
    }
    let index = nodes.len();
    nodes.push(Node::leaf(Bounds::EMPTY, first, 0, Default::default()));
    let middle = split(keys);
    let (left, left_bounds) = branch(nodes, &keys[..middle], &items[..middle], first);
    let right_index = nodes.len();
    let (right, right_bounds) = branch(nodes, &keys[middle..], &items[middle..], first + middle);
    let bounds = left_bounds.union(right_bounds);
    let (plan, choices) = Plan::join(&left, &right, bounds.half_area());
    nodes[index] = Node::inner(bounds, first, right_index - index, choices);
    (plan, bounds)
}
