//! From primitives to the tree that rays walk: a binary tree, whose subtrees become nodes of eight and leaves of eight.

mod binary;
mod bins;
mod bounds;
mod chunks;
mod clip;
mod emit;
mod item;
mod morton;
mod plan;
mod quality;
mod sah;
mod spatial;

use crate::aabb::Aabb;
use crate::error::BuildError;
use crate::geometry::Geometry;
use crate::simd::LANES;
use crate::stats::Stats;
use crate::wide::{Child, Tree};

use item::Items;

pub use quality::Quality;

/// No path of the binary tree is longer; the stack of a walk is sized by it.
pub(crate) const MAX_DEPTH: usize = 64;

/// What a build makes.
pub(crate) struct Built {
    pub(crate) tree: Tree,
    /// The box around everything that can be hit.
    pub(crate) bounds: Aabb,
    pub(crate) stats: Stats,
}

/// A tree over the primitives.
pub(crate) fn build(geometry: &(impl Geometry + ?Sized), quality: Quality) -> Result<Built, BuildError> {
    let (count, most) = (geometry.len(), Child::MAX_BLOCKS);
    if count > most {
        return Err(BuildError::TooMany { count, most });
    }
    let t0 = std::time::Instant::now();
    let Items { mut list, bounds, degenerate } = Items::new(geometry)?;
    let stats = Stats { primitives: list.len(), degenerate, ..Stats::default() };
    if list.is_empty() {
        return Ok(Built { tree: Tree::empty(), bounds: Aabb::EMPTY, stats });
    }
    let t1 = std::time::Instant::now();
    let forest = match quality {
        Quality::Fast => morton::build(list),
        Quality::Balanced => sah::build(&mut list, bounds, 0),
        Quality::Best => spatial::build(geometry, list, bounds),
    };
    let t2 = std::time::Instant::now();
    let (tree, references) = emit::emit(&forest, geometry);
    eprintln!(
        "items {:.3} tree {:.3} emit {:.3} subtrees {}",
        (t1 - t0).as_secs_f64(),
        (t2 - t1).as_secs_f64(),
        t2.elapsed().as_secs_f64(),
        forest.subtrees.len()
    );
    let bounds = bounds.into();
    let (nodes, leaves) = (tree.nodes.len(), tree.leaves());
    let fill = references as f32 / (leaves * LANES) as f32;
    let sah_cost = 0.0;
    Ok(Built { stats: Stats { nodes, leaves, references, fill, sah_cost, bytes: tree.bytes(), ..stats }, tree, bounds })
}
#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;
    use crate::shape::{Primitive, Sphere};
    use crate::simd::LANES;
    use crate::wide::{Kind, Target};

    fn depth(tree: &Tree, child: Child) -> usize {
        match child.target() {
            Target::Node(index) => 1 + tree.nodes[index].child.iter().map(|&c| depth(tree, c)).max().unwrap_or(0),
            Target::Leaf(..) | Target::Nothing => 0,
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
        let Built { tree, .. } = build(&prims, Quality::Balanced).unwrap();
        assert!(depth(&tree, tree.root) <= MAX_DEPTH);
        let lanes = (0..tree.spheres.len()).flat_map(|block| (0..LANES).map(move |lane| (block, lane)));
        let in_use = lanes.filter(|&(block, lane)| tree.spheres[block].used >> lane & 1 == 1);
        let mut ids: Vec<_> = in_use.map(|(block, lane)| tree.id(Kind::Sphere, block, lane)).collect();
        ids.sort_unstable();
        assert!(ids.into_iter().eq(0..prims.len() as u32), "each is in one leaf");
    }
}
