//! From primitives to the tree that rays walk: a binary tree, whose subtrees become nodes of eight and leaves of eight.

mod binary;
mod collapse;
mod sah;

use crate::aabb::Aabb;
use crate::shape::Primitive;
use crate::wide::{Child, Tree};

/// No path of the binary tree is longer; the stack of a walk is sized by it.
pub(crate) const MAX_DEPTH: usize = 64;

/// A tree over `primitives`, and the box around them.
pub(crate) fn build(primitives: &[Primitive]) -> (Tree, Aabb) {
    assert!(primitives.len() <= Child::MAX_BLOCKS, "a tree holds at most {} primitives", Child::MAX_BLOCKS);
    let binary = sah::build(primitives);
    (collapse::collapse(&binary, primitives), binary.bounds())
}
