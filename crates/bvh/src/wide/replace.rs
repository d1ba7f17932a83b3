//! Other primitives in the same leaves.

use rayon::prelude::*;

use crate::aabb::Aabb;
use crate::shape::Primitive;
use crate::simd::LANES;
use crate::wide::{CornerBlock, Kind, SphereBlock, Tree};

impl Tree {
    /// Gives each primitive the shape there is now for its index, and returns the boxes of the leaves, by kind. None, and a
    /// tree that is of no use, if there is no shape, or one of another kind.
    pub(crate) fn replace_primitives(
        &mut self,
        find: impl Fn(u32) -> Option<Primitive> + Sync,
    ) -> Option<[Vec<Aabb>; 3]> {
        let corners = |blocks: &mut Vec<CornerBlock>, kind| {
            let replace = |block: &mut CornerBlock| {
                let leaf = Leaf::new(kind, &block.id, block.used, &find)?;
                *block = CornerBlock::new(leaf.primitives(), leaf.size());
                Some(leaf.bounds)
            };
            blocks.par_iter_mut().map(replace).collect::<Option<Vec<_>>>()
        };
        let triangles = corners(&mut self.triangles, Kind::Triangle)?;
        let quads = corners(&mut self.quads, Kind::Quad)?;
        let replace = |block: &mut SphereBlock| {
            let leaf = Leaf::new(Kind::Sphere, &block.id, block.used, &find)?;
            *block = SphereBlock::new(leaf.primitives());
            Some(leaf.bounds)
        };
        let spheres = self.spheres.par_iter_mut().map(replace).collect::<Option<Vec<_>>>()?;
        let mut all = [const { Vec::new() }; 3];
        for (kind, boxes) in [(Kind::Triangle, triangles), (Kind::Quad, quads), (Kind::Sphere, spheres)] {
            all[kind as usize] = boxes;
        }
        Some(all)
    }
}

struct Leaf {
    lanes: [Option<(u32, Primitive)>; LANES],
    bounds: Aabb,
}

impl Leaf {
    fn new(kind: Kind, ids: &[u32], used: u32, find: &impl Fn(u32) -> Option<Primitive>) -> Option<Self> {
        let mut leaf = Self { lanes: [None; LANES], bounds: Aabb::EMPTY };
        for (lane, &id) in ids.iter().enumerate().filter(|(lane, _)| used >> lane & 1 == 1) {
            let primitive = find(id).filter(|primitive| Kind::of(primitive) == kind)?;
            leaf.lanes[lane] = Some((id, primitive));
            leaf.bounds = leaf.bounds.union(primitive.bounds());
        }
        Some(leaf)
    }

    fn primitives(&self) -> impl Iterator<Item = (u32, Primitive)> + Clone {
        self.lanes.iter().flatten().copied()
    }

    fn size(&self) -> f32 {
        (self.bounds.hi - self.bounds.lo).max_element().next_up()
    }
}
