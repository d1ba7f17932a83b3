//! The binary tree that builders make.

use std::sync::Arc;

use glam::Vec3A;

use crate::aabb::Aabb;
use crate::bvh::Bvh;
use crate::shape::Primitive;

/// A box in the form that builders compute with.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounds {
    pub(super) lo: Vec3A,
    pub(super) hi: Vec3A,
}

impl Bounds {
    pub(super) const EMPTY: Self = Self { lo: Vec3A::INFINITY, hi: Vec3A::NEG_INFINITY };

    #[inline]
    pub(super) fn union(self, other: Self) -> Self {
        Self { lo: self.lo.min(other.lo), hi: self.hi.max(other.hi) }
    }

    #[inline]
    pub(super) fn half_area(self) -> f32 {
        let e = (self.hi - self.lo).max(Vec3A::ZERO);
        e.x * e.y + e.y * e.z + e.z * e.x
    }

    /// Twice the centre.
    #[inline]
    pub(super) fn center(self) -> Vec3A {
        self.lo + self.hi
    }

    pub(super) fn longest_side(self) -> f32 {
        (self.hi - self.lo).max_element().next_up()
    }
}

impl From<Aabb> for Bounds {
    fn from(b: Aabb) -> Self {
        Self { lo: b.lo.into(), hi: b.hi.into() }
    }
}

impl From<Bounds> for Aabb {
    fn from(b: Bounds) -> Self {
        Self { lo: b.lo.into(), hi: b.hi.into() }
    }
}

/// A primitive, or the part of one that lies in a box.
#[derive(Clone, Copy, Debug)]
pub(super) struct Item {
    pub(super) bounds: Bounds,
    pub(super) prim: u32,
}

/// A node over `count` items. Its left child follows it; every item has a leaf of its own, so a subtree of n items takes
/// 2 n − 1 nodes, and both children's places are known before they are built.
#[derive(Clone, Copy, Debug)]
pub(super) struct Node {
    pub(super) bounds: Bounds,
    pub(super) count: u32,
    /// Items below the left child; 0 in a leaf.
    pub(super) left: u32,
}

/// A tree whose leaves are `items`, in order.
pub(super) struct Binary {
    pub(super) nodes: Vec<Node>,
    pub(super) items: Vec<Item>,
}

impl Binary {
    /// One item for each primitive, and room for the nodes.
    pub(super) fn new(primitives: &[Primitive], objects: &[Arc<Bvh>]) -> Self {
        let item = |(i, p): (usize, &Primitive)| Item { bounds: p.bounds(objects).into(), prim: i as u32 };
        let items: Vec<_> = primitives.iter().enumerate().map(item).collect();
        let empty = Node { bounds: Bounds::EMPTY, count: 0, left: 0 };
        Self { nodes: vec![empty; (2 * items.len()).saturating_sub(1)], items }
    }

    pub(super) fn bounds(&self) -> Aabb {
        self.nodes.first().map_or(Aabb::EMPTY, |root| root.bounds.into())
    }

    /// The children of a node that is no leaf.
    pub(super) fn children(&self, node: usize) -> Option<[usize; 2]> {
        let left = self.nodes[node].left as usize;
        (left > 0).then_some([node + 1, node + 2 * left])
    }
}
