//! New positions for the primitives of a tree, which keeps its shape: for animation, in linear time.

use rayon::prelude::*;

use crate::aabb::Aabb;
use crate::build::Built;
use crate::build::cost::sah_cost;
use crate::build::item::check as check_primitive;
use crate::error::BuildError;
use crate::geometry::Geometry;
use crate::shape::Primitive;
use crate::simd::LANES;
use crate::stats::Stats;
use crate::wide::{Kind, Node, Target, Tree};

/// Primitives that a thread looks at in one go.
const CHUNK: usize = 1 << 13;

/// The tree with the primitives where they are now. None if it would need another shape: there are more or fewer, or some
/// have become or ceased to be degenerate, or have become another kind of primitive.
pub(crate) fn refit(
    mut tree: Tree,
    stats: Stats,
    geometry: &(impl Geometry + ?Sized),
) -> Result<Option<Built>, BuildError> {
    let degenerate = check(geometry)?;
    if geometry.len() != stats.primitives + stats.degenerate || degenerate != stats.degenerate {
        return Ok(None);
    }
    let find = |id: u32| Some(geometry.primitive(id as usize)).filter(|p| !is_left_out(p, geometry));
    let Some(leaves) = tree.replace_primitives(find, geometry.objects()) else {
        return Ok(None);
    };
    let bounds_of = |nodes: &[Aabb], target| match target {
        Target::Node(index) => nodes[index],
        Target::Leaf(Kind::Nothing, _) => Aabb::EMPTY,
        Target::Leaf(kind, block) => leaves[kind as usize][block],
    };
    // Children come after their parents.
    let mut nodes = vec![Aabb::EMPTY; tree.nodes.len()];
    for index in (0..nodes.len()).rev() {
        let boxes = tree.nodes[index].child.map(|child| bounds_of(&nodes, child.target()));
        let children = std::array::from_fn::<_, LANES, _>(|lane| (tree.nodes[index].child[lane], boxes[lane]));
        tree.nodes[index] = Node::new(&children);
        nodes[index] = boxes.into_iter().fold(Aabb::EMPTY, Aabb::union);
    }
    let bounds = bounds_of(&nodes, tree.root.target());
    let stats = Stats { sah_cost: sah_cost(&tree, bounds), ..stats };
    Ok(Some(Built { tree, bounds, stats }))
}

/// The number of degenerate primitives.
fn check(geometry: &(impl Geometry + ?Sized)) -> Result<usize, BuildError> {
    let count = geometry.len();
    let chunks = (0..count.div_ceil(CHUNK)).into_par_iter().map(|n| {
        let mut degenerate = 0;
        for index in n * CHUNK..count.min((n + 1) * CHUNK) {
            let primitive = geometry.primitive(index);
            check_primitive(&primitive, index, geometry.objects())?;
            degenerate += usize::from(is_left_out(&primitive, geometry));
        }
        Ok(degenerate)
    });
    let chunks: Vec<_> = chunks.collect();
    chunks.into_iter().sum()
}

/// Whether a primitive is in no leaf.
fn is_left_out(primitive: &Primitive, geometry: &(impl Geometry + ?Sized)) -> bool {
    primitive.is_degenerate() || primitive.bounds(geometry.objects()) == Aabb::EMPTY
}
