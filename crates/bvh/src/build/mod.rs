//! From primitives to the tree that rays walk: a binary tree, whose subtrees become nodes of eight and leaves of eight.

mod binary;
mod bins;
mod bounds;
mod chunks;
mod clip;
mod cost;
mod emit;
mod item;
mod morton;
mod plan;
mod quality;
mod refit;
mod sah;
mod spatial;

use crate::aabb::Aabb;
use crate::bvh::Bvh;
use crate::error::BuildError;
use crate::geometry::Geometry;
use crate::stats::Stats;
use crate::wide::Tree;

use cost::sah_cost;
use item::Items;

pub use quality::Quality;
pub(crate) use refit::refit;

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
    let (count, most) = (geometry.len(), Bvh::MAX_PRIMITIVES);
    if count > most {
        return Err(BuildError::TooMany { count, most });
    }
    let Items { mut list, bounds, degenerate } = Items::new(geometry)?;
    let stats = Stats { primitives: list.len(), degenerate, ..Stats::default() };
    if list.is_empty() {
        return Ok(Built { tree: Tree::default(), bounds: Aabb::EMPTY, stats });
    }
    let forest = match quality {
        Quality::Fast => morton::build(list),
        Quality::Balanced => sah::build(&mut list, bounds, 0),
        Quality::Best => spatial::build(geometry, list, bounds),
    };
    let (mut tree, references) = emit::emit(&forest, geometry)?;
    tree.set_objects(geometry.objects());
    let bounds = bounds.into();
    let sah_cost = sah_cost(&tree, bounds);
    let (nodes, leaves) = (tree.nodes.len(), tree.leaves());
    let places: usize = tree.blocks().into_iter().map(|(kind, blocks)| kind.lanes() * blocks).sum();
    let fill = references as f32 / places as f32;
    Ok(Built { stats: Stats { nodes, leaves, references, fill, sah_cost, bytes: tree.bytes(), ..stats }, tree, bounds })
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;
    use crate::shape::{Primitive, Quad, Sphere, Triangle};
    use crate::simd::LANES;
    use crate::wide::{Child, Kind, Target};

    fn depth(tree: &Tree, child: Child) -> usize {
        match child.target() {
            Target::Node(index) => 1 + tree.nodes[index].child.iter().map(|&c| depth(tree, c)).max().unwrap_or(0),
            Target::Leaf(..) => 0,
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
        let mut ids: Vec<_> = in_use.map(|(block, lane)| tree.id(Kind::Spheres, block, lane)).collect();
        ids.sort_unstable();
        assert!(ids.into_iter().eq(0..prims.len() as u32), "each is in one leaf");
    }

    /// Triangles of all sizes, among them quads and balls.
    fn shapes(count: u32) -> Vec<Primitive> {
        let unit = |i: u32, k: u32| {
            let bits = (i * 3 + k).wrapping_mul(0x9e37_79b9).rotate_left(13).wrapping_mul(0x85eb_ca6b);
            (bits >> 8) as f32 / (1 << 23) as f32 - 1.0
        };
        let vector = |i: u32| Vec3::new(unit(i, 0), unit(i, 1), unit(i, 2));
        let shape = |i: u32| {
            let (a, size) = (vector(4 * i), 0.02 / (0.02 + unit(i, 7).abs()));
            let (u, v) = (size * vector(4 * i + 1), size * vector(4 * i + 2));
            match i % 16 {
                0 => Primitive::Quad(Quad { corner: a, u, v }),
                1 => Primitive::Sphere(Sphere { center: a, radius: 0.1 * size }),
                2 => Primitive::Triangle(Triangle { a, b: a, c: a + v }),
                _ => Primitive::Triangle(Triangle { a, b: a + u, c: a + v }),
            }
        };
        (0..count).map(shape).collect()
    }

    #[test]
    fn the_tree_does_not_depend_on_the_number_of_threads() {
        for (quality, count) in Quality::ALL.into_iter().flat_map(|q| [(q, 100), (q, 5000), (q, 90_000)]) {
            let shapes = shapes(count);
            let print = |threads| {
                let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
                let built = pool.install(|| build(&shapes, quality).unwrap());
                format!("{:?} {:?} {:?}", built.bounds, built.stats, built.tree)
            };
            let one = print(1);
            assert!([2, 7].into_iter().all(|threads| print(threads) == one), "{quality}, {count} shapes");
        }
    }

    #[test]
    fn stats_are_those_of_the_tree() {
        let shapes = shapes(20_000);
        let degenerate = shapes.len() / 16;
        for quality in Quality::ALL {
            let Built { tree, stats, .. } = build(&shapes, quality).unwrap();
            assert_eq!((stats.primitives, stats.degenerate), (shapes.len() - degenerate, degenerate));
            let leaves = tree.blocks().into_iter().flat_map(|(kind, n)| (0..n).map(move |block| (kind, block)));
            assert_eq!(leaves.map(|(kind, block)| tree.count(kind, block)).sum::<usize>(), stats.references);
            assert!(stats.references >= stats.primitives);
            assert!(quality == Quality::Best || stats.references == stats.primitives);
            assert!(stats.fill > 0.2 && stats.fill <= 1.0 && stats.sah_cost > 1.0, "{stats:?}");
        }
    }

    /// Small triangles in a row, and some as long as the row.
    #[test]
    fn the_best_builder_cuts_what_overlaps() {
        let triangle = |i: usize| {
            let (start, length) = if i.is_multiple_of(20) { (0.0, 20.0) } else { (0.02 * i as f32, 0.02) };
            let a = Vec3::new(start, 0.001 * (i % 40) as f32, 0.001 * (i % 37) as f32);
            Primitive::Triangle(Triangle { a, b: a + length * Vec3::X, c: a + Vec3::new(length, 0.02, 0.02) })
        };
        let row: Vec<_> = (0..1000).map(triangle).collect();
        let [_, balanced, best] = Quality::ALL.map(|quality| build(&row, quality).unwrap().stats);
        assert!(best.references > row.len() && best.references <= row.len() * 3 / 2, "{best:?}");
        assert!(best.sah_cost < 0.9 * balanced.sah_cost, "{balanced:?} {best:?}");
    }
}
