//! The builder: binned surface area heuristic, the readable reference.
//!
//! A node's primitives are split where the expected cost of a ray, Σ area · count, is least, tried at the
//! borders of 16 bins along each axis (Wald 2007, doi:10.1109/RT.2007.4342588). The four-wide tree that rays walk comes
//! of it by opening the largest children first (Wald, Benthin & Boulos 2008, "Getting Rid of Packets", RT 2008;
//! Dammertz et al. 2008, doi:10.1111/j.1467-8659.2008.01261.x).

use crate::aabb::Aabb;
use crate::node::{Child, Node};
use crate::primitive::Primitive;

const BINS: usize = 16;
/// Cost of testing one node, in primitive tests.
const NODE_COST: f32 = 0.7;
/// Leaves above this size are split whatever the heuristic says.
const MAX_LEAF: usize = 4;
/// No path of the binary tree is longer; the traversal stack is sized by it.
pub(crate) const MAX_DEPTH: usize = 40;

/// The tree over `prims`, and the order in which its leaves hold them.
pub(crate) struct Tree {
    pub(crate) nodes: Vec<Node>,
    pub(crate) order: Vec<u32>,
}

pub(crate) fn build(prims: &[Primitive]) -> Tree {
    assert!(prims.len() <= Child::MAX_SLOTS, "a tree holds at most {} primitives", Child::MAX_SLOTS);
    let mut items: Vec<Item> = prims.iter().enumerate().map(|(i, p)| Item::new(i as u32, p.bounds())).collect();
    let root = split(&mut items, 0, 0);
    let mut nodes = Vec::new();
    if !prims.is_empty() {
        flatten(&root, &mut nodes);
    }
    Tree { nodes, order: items.iter().map(|item| item.prim).collect() }
}

/// A primitive on its way into a leaf.
struct Item {
    prim: u32,
    bounds: Aabb,
    /// Twice the centre of the bounds.
    center: glam::Vec3,
}

impl Item {
    fn new(prim: u32, bounds: Aabb) -> Self {
        Self { prim, bounds, center: bounds.centroid_twice() }
    }
}

/// A node of the binary tree.
struct Binary {
    bounds: Aabb,
    kind: Kind,
}

enum Kind {
    Leaf { first: usize, count: usize },
    Inner(Box<[Binary; 2]>),
}

/// Builds the subtree of `items`, which lie at `first` of the whole list and are reordered in place.
fn split(items: &mut [Item], first: usize, depth: usize) -> Binary {
    let bounds = items.iter().fold(Aabb::EMPTY, |b, item| b.union(item.bounds));
    let count = items.len();
    let leaf = Binary { bounds, kind: Kind::Leaf { first, count } };
    if count <= 1 {
        return leaf;
    }
    let levels_left = MAX_DEPTH.saturating_sub(depth);
    let levels_needed = count.next_power_of_two().ilog2() as usize;
    let middle = match best_split(items, bounds) {
        Some(best) if best.cost >= count as f32 && count <= MAX_LEAF => return leaf,
        Some(best) if levels_left > levels_needed => partition(items, &best),
        None if count <= MAX_LEAF => return leaf,
        _ => halve(items, bounds),
    };
    let (left, right) = items.split_at_mut(middle);
    let children = [split(left, first, depth + 1), split(right, first + middle, depth + 1)];
    Binary { bounds, kind: Kind::Inner(Box::new(children)) }
}

struct Split {
    axis: usize,
    /// Items whose bin is below this go left.
    bin: usize,
    bins: Bins,
    /// In primitive tests; a leaf costs its count.
    cost: f32,
}

/// Maps centres to bins along one axis.
#[derive(Clone, Copy)]
struct Bins {
    lo: f32,
    scale: f32,
}

impl Bins {
    fn index(&self, center: f32) -> usize {
        (((center - self.lo) * self.scale) as usize).min(BINS - 1)
    }
}

/// The cheapest split over all axes, or none if all centres coincide.
fn best_split(items: &[Item], bounds: Aabb) -> Option<Split> {
    let lo = items.iter().fold(glam::Vec3::INFINITY, |m, item| m.min(item.center));
    let hi = items.iter().fold(glam::Vec3::NEG_INFINITY, |m, item| m.max(item.center));
    let mut best: Option<Split> = None;
    for axis in 0..3 {
        let bins = Bins { lo: lo[axis], scale: BINS as f32 / (hi[axis] - lo[axis]) };
        if !(bins.scale.is_finite() && bins.scale > 0.0) {
            continue;
        }
        let mut filled = [(Aabb::EMPTY, 0_usize); BINS];
        for item in items {
            let (b, n) = &mut filled[bins.index(item.center[axis])];
            (*b, *n) = (b.union(item.bounds), *n + 1);
        }
        // Right sides by a sweep from the end, left sides by one from the start.
        let mut right = [(0.0, 0); BINS];
        let (mut b, mut n) = (Aabb::EMPTY, 0);
        for i in (1..BINS).rev() {
            (b, n) = (b.union(filled[i].0), n + filled[i].1);
            right[i] = (b.half_area(), n);
        }
        let (mut b, mut n) = (Aabb::EMPTY, 0);
        for bin in 1..BINS {
            (b, n) = (b.union(filled[bin - 1].0), n + filled[bin - 1].1);
            let (right_area, right_n) = right[bin];
            if n == 0 || right_n == 0 {
                continue;
            }
            let cost = NODE_COST + (b.half_area() * n as f32 + right_area * right_n as f32) / bounds.half_area();
            if best.as_ref().is_none_or(|s| cost < s.cost) {
                best = Some(Split { axis, bin, bins, cost });
            }
        }
    }
    best
}

/// Moves the left side of a split to the front; returns its length.
fn partition(items: &mut [Item], split: &Split) -> usize {
    let mut left = 0;
    for i in 0..items.len() {
        if split.bins.index(items[i].center[split.axis]) < split.bin {
            items.swap(left, i);
            left += 1;
        }
    }
    left
}

/// The fallback: halves by the order of centres along the longest axis; always makes progress.
fn halve(items: &mut [Item], bounds: Aabb) -> usize {
    let extent = bounds.hi - bounds.lo;
    let axis = extent.max_position();
    let middle = items.len() / 2;
    items.select_nth_unstable_by(middle, |a, b| a.center[axis].total_cmp(&b.center[axis]).then(a.prim.cmp(&b.prim)));
    middle
}

/// Appends the subtree as four-wide nodes.
fn flatten(binary: &Binary, nodes: &mut Vec<Node>) -> usize {
    let index = nodes.len();
    nodes.push(Node::new(&[]));
    let mut children = vec![binary];
    while children.len() < 4 {
        // The largest inner child makes way for its own.
        let inner = |(i, child): (usize, &&Binary)| {
            matches!(child.kind, Kind::Inner(_)).then_some((i, child.bounds.half_area()))
        };
        let Some((largest, _)) = children.iter().enumerate().filter_map(inner).max_by(|a, b| a.1.total_cmp(&b.1))
        else {
            break;
        };
        if let Kind::Inner(pair) = &children[largest].kind {
            children.splice(largest..=largest, pair.iter());
        }
    }
    let children: Vec<_> = children
        .into_iter()
        .map(|b| match b.kind {
            Kind::Leaf { first, count } => (Child::leaf(first, count), b.bounds),
            Kind::Inner(_) => (Child::node(flatten(b, nodes)), b.bounds),
        })
        .collect();
    nodes[index] = Node::new(&children);
    index
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;
    use crate::sphere::Sphere;

    fn depth(nodes: &[Node], child: Child) -> usize {
        match child.unpack() {
            Ok(_) => 0,
            Err(index) => 1 + nodes[index].child.iter().map(|&c| depth(nodes, c)).max().unwrap_or(0),
        }
    }

    /// Balls at ±2ᵏ on all axes: the heuristic would take off a few at a time.
    #[test]
    fn no_path_is_longer_than_the_stack_allows() {
        let mut balls = Vec::new();
        for k in -60..60 {
            let radius = 2.0_f32.powi(k);
            for axis in Vec3::AXES {
                balls.extend([1.0, -1.0].map(|sign| Sphere { center: sign * radius * axis, radius: 0.01 * radius }));
            }
        }
        let prims: Vec<_> = balls.into_iter().map(Primitive::Sphere).collect();
        let tree = build(&prims);
        assert!(depth(&tree.nodes, Child::ROOT) <= MAX_DEPTH / 2);
        let mut order = tree.order;
        order.sort_unstable();
        assert!(order.into_iter().eq(0..prims.len() as u32), "each is in one leaf");
    }
}
