//! The binary tree that builders make: subtrees of some thousand items, and above them a tree whose leaves are subtrees.

use std::borrow::Cow;

use glam::Vec3;

use crate::build::bounds::Bounds;
use crate::build::item::Item;
use crate::build::plan::{Choices, Plan};

/// A node. Its left child follows it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Node {
    lo: Vec3,
    hi: Vec3,
    /// How far on the right child is; 0 in a leaf.
    right: u32,
    /// The first item below it; above subtrees, the first subtree.
    pub(super) first: u32,
    /// The number of items in a leaf.
    pub(super) count: u32,
    pub(super) choices: Choices,
}

impl Node {
    pub(super) fn leaf(bounds: Bounds, first: usize, count: usize, choices: Choices) -> Self {
        let (lo, hi) = (bounds.lo.into(), bounds.hi.into());
        Self { lo, hi, right: 0, first: first as u32, count: count as u32, choices }
    }

    pub(super) fn inner(bounds: Bounds, first: usize, right: usize, choices: Choices) -> Self {
        Self { right: right as u32, ..Self::leaf(bounds, first, 0, choices) }
    }

    pub(super) fn bounds(&self) -> Bounds {
        Bounds { lo: self.lo.into(), hi: self.hi.into() }
    }
}

/// The indices of the children of a node that is no leaf.
pub(super) fn children(nodes: &[Node], index: usize) -> Option<[usize; 2]> {
    let right = nodes[index].right as usize;
    (right > 0).then_some([index + 1, index + right])
}

/// The nodes that show a subtree in at most so many places.
pub(super) fn show(nodes: &[Node], index: usize, places: usize, shown: &mut impl FnMut(usize, usize)) {
    match (children(nodes, index), nodes[index].choices.left_of(places)) {
        (Some([left, right]), Some(left_places)) => {
            show(nodes, left, left_places, shown);
            show(nodes, right, places - left_places, shown);
        }
        (_, None) => shown(index, 1),
        (None, Some(_)) => shown(index, places),
    }
}

/// A tree over items. Its leaves hold as many as fit into a leaf, of one kind.
pub(super) struct Subtree<'a> {
    pub(super) nodes: Vec<Node>,
    pub(super) items: Cow<'a, [Item]>,
}

/// A tree over subtrees.
pub(super) struct Forest<'a> {
    pub(super) top: Vec<Node>,
    pub(super) subtrees: Vec<Subtree<'a>>,
    pub(super) plan: Plan,
}

impl<'a> Forest<'a> {
    pub(super) fn new(subtree: Subtree<'a>, plan: Plan) -> Self {
        let root = subtree.nodes[0];
        let top = vec![Node::leaf(root.bounds(), 0, 0, root.choices)];
        Self { top, subtrees: vec![subtree], plan }
    }

    pub(super) fn join(mut left: Self, mut right: Self, bounds: Bounds) -> Self {
        let (plan, choices) = Plan::join(&left.plan, &right.plan, bounds.half_area());
        let mut top = Vec::with_capacity(1 + left.top.len() + right.top.len());
        top.push(Node::inner(bounds, 0, 1 + left.top.len(), choices));
        right.top.iter_mut().for_each(|node| node.first += left.subtrees.len() as u32);
        top.append(&mut left.top);
        top.append(&mut right.top);
        left.subtrees.append(&mut right.subtrees);
        Self { top, subtrees: left.subtrees, plan }
    }
}
