//! Other primitives in the same leaves.

use std::sync::Arc;

use rayon::prelude::*;

use crate::aabb::Aabb;
use crate::bvh::Bvh;
use crate::ray::Hit;
use crate::shape::Primitive;
use crate::simd::LANES;
use crate::wide::{CornerBlock, InstanceLeaf, Kind, MovingBlock, SphereBlock, Tree};

impl Tree {
    /// Gives each primitive the shape there is now for its index, and returns the boxes of the leaves, by kind. None, and a
    /// tree that is of no use, if there is no shape, or one of another kind.
    pub(crate) fn replace_primitives(
        &mut self,
        find: impl Fn(u32) -> Option<Primitive> + Sync + Send,
        objects: &[Arc<Bvh>],
    ) -> Option<[Vec<Aabb>; Kind::COUNT]> {
        let new = |kind: Kind, ids: &[u32]| Leaf::new(kind, ids, &find, objects);
        fn all<B: Send>(blocks: &mut [B], replace: impl Fn(&mut B) -> Option<Aabb> + Sync + Send) -> Option<Vec<Aabb>> {
            blocks.par_iter_mut().map(replace).collect()
        }
        let mut boxes = [const { Vec::new() }; Kind::COUNT];
        boxes[Kind::FewTriangles as usize] = all(&mut self.few_triangles, |block| {
            let leaf = new(Kind::Triangles, &block.id)?;
            *block = CornerBlock::new(leaf.primitives(), leaf.size());
            Some(leaf.bounds)
        })?;
        for (kind, blocks) in [(Kind::Triangles, &mut self.triangles), (Kind::Quads, &mut self.quads)] {
            boxes[kind as usize] = all(blocks, |block| {
                let leaf = new(kind, &block.id)?;
                *block = CornerBlock::new(leaf.primitives(), leaf.size());
                Some(leaf.bounds)
            })?;
        }
        boxes[Kind::Spheres as usize] = all(&mut self.spheres, |block| {
            let leaf = new(Kind::Spheres, &block.id)?;
            *block = SphereBlock::new(leaf.primitives());
            Some(leaf.bounds)
        })?;
        boxes[Kind::Moving as usize] = all(&mut self.moving, |block| {
            let leaf = new(Kind::Moving, &block.id)?;
            *block = MovingBlock::new(leaf.primitives(), leaf.size());
            Some(leaf.bounds)
        })?;
        boxes[Kind::Instance as usize] = all(&mut self.instances, |block| {
            let leaf = new(Kind::Instance, &[block.id])?;
            *block = leaf.primitives().find_map(|(id, primitive)| InstanceLeaf::new(id, &primitive))?;
            Some(leaf.bounds)
        })?;
        self.set_objects(objects);
        Some(boxes)
    }
}

struct Leaf {
    lanes: [Option<(u32, Primitive)>; LANES],
    bounds: Aabb,
}

impl Leaf {
    fn new(kind: Kind, ids: &[u32], find: &impl Fn(u32) -> Option<Primitive>, objects: &[Arc<Bvh>]) -> Option<Self> {
        let mut leaf = Self { lanes: [None; LANES], bounds: Aabb::EMPTY };
        for (lane, &id) in ids.iter().enumerate().filter(|(_, id)| **id != Hit::NO_PRIM) {
            let primitive = find(id).filter(|primitive| Kind::of(primitive) == kind)?;
            leaf.lanes[lane] = Some((id, primitive));
            leaf.bounds = leaf.bounds.union(primitive.bounds(objects));
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
