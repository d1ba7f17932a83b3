//! The expected cost of a ray through a finished tree: the surface area heuristic (MacDonald & Booth 1990,
//! doi:10.1007/BF01911006).

use rayon::prelude::*;

use crate::aabb::Aabb;
use crate::build::bounds::Bounds;
use crate::build::plan::{NODE_COST, leaf_cost};
use crate::simd::LANES;
use crate::wide::{Child, Node, Target, Tree};

/// Nodes that a thread looks at in one go.
const CHUNK: usize = 1 << 12;

/// The expected cost of a ray that meets the box around everything, in tests of a node or a leaf. Where boxes are so large
/// that their areas are not finite, the number of nodes and leaves.
pub(super) fn sah_cost(tree: &Tree, bounds: Aabb) -> f32 {
    let root = area(bounds);
    let chance = |bounds| if root > 0.0 && root.is_finite() { area(bounds) / root } else { 1.0 };
    let of_node = |node: &Node| -> f64 {
        (0..LANES)
            .filter(|&lane| node.child[lane] != Child::NONE)
            .map(|lane| chance(node.bounds(lane)) * cost(node.child[lane]))
            .sum()
    };
    // Sums of fixed parts, in order, are the same for any number of threads.
    let parts: Vec<f64> = tree.nodes.par_chunks(CHUNK).map(|nodes| nodes.iter().map(of_node).sum()).collect();
    (cost(tree.root) + parts.into_iter().sum::<f64>()) as f32
}

fn area(bounds: Aabb) -> f64 {
    let bounds = Bounds::from(bounds);
    let e = (bounds.hi - bounds.lo).as_dvec3().max(glam::DVec3::ZERO);
    e.dot(glam::DVec3::new(e.y, e.z, e.x))
}

fn cost(child: Child) -> f64 {
    match child.target() {
        Target::Node(_) => NODE_COST.into(),
        Target::Leaf(kind, _) => leaf_cost(kind).into(),
    }
}
