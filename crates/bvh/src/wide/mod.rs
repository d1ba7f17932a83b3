//! The tree as rays walk it: nodes with up to eight children, leaves with up to eight primitives of one kind.

mod block;
mod node;

use std::sync::Arc;

pub(crate) use block::{CornerBlock, FEW, InstanceLeaf, MovingBlock, SphereBlock};
pub(crate) use node::{Child, Kind, Node, Target};

use crate::bvh::Bvh;
use crate::instance::{Affine, Instance};
use crate::ray::{Hit, PrimHit, RayF64};
use crate::shape::Primitive;
use crate::simd::LANES;

/// Everything that a walk reads.
#[derive(Clone, Debug, Default)]
pub(crate) struct Tree {
    pub(crate) root: Child,
    pub(crate) nodes: Vec<Node>,
    pub(crate) few_triangles: Vec<CornerBlock<FEW>>,
    pub(crate) triangles: Vec<CornerBlock<LANES>>,
    pub(crate) quads: Vec<CornerBlock<LANES>>,
    pub(crate) spheres: Vec<SphereBlock>,
    pub(crate) moving: Vec<MovingBlock>,
    pub(crate) instances: Vec<InstanceLeaf>,
    pub(crate) transforms: Vec<Affine>,
    /// What the instances show.
    pub(crate) objects: Vec<Arc<Bvh>>,
    /// The caller's index of each instance, with its index here, sorted.
    pub(crate) instance_of: Vec<(u32, u32)>,
}

impl Tree {
    /// Appends a leaf of primitives of one kind, as many as the kind allows, in a box whose longest side is `size`.
    pub(crate) fn push_leaf(
        &mut self,
        kind: Kind,
        mut primitives: impl Iterator<Item = (u32, Primitive)>,
        size: f32,
    ) -> Child {
        let index = match kind {
            Kind::FewTriangles => push(&mut self.few_triangles, CornerBlock::new(primitives, size)),
            Kind::Triangles => push(&mut self.triangles, CornerBlock::new(primitives, size)),
            Kind::Quads => push(&mut self.quads, CornerBlock::new(primitives, size)),
            Kind::Spheres => push(&mut self.spheres, SphereBlock::new(primitives)),
            Kind::Moving => push(&mut self.moving, MovingBlock::new(primitives, size)),
            Kind::Instance => match primitives.next() {
                Some((id, Primitive::Instance(instance))) => self.push_instance(id, &instance),
                _ => return Child::NONE,
            },
            Kind::Nothing => return Child::NONE,
        };
        Child::leaf(kind, index)
    }

    fn push_instance(&mut self, id: u32, instance: &Instance) -> usize {
        let Instance { object, at: [from, to], time } = *instance;
        let (transform, moves) = (self.transforms.len() as u32, from != to);
        self.transforms.push(from);
        if moves {
            self.transforms.push(to);
        }
        push(&mut self.instances, InstanceLeaf { id, object, transform, moves, time })
    }

    /// A node that the root or a child refers to.
    #[inline(always)]
    pub(crate) fn node(&self, index: usize) -> &Node {
        debug_assert!(index < self.nodes.len());
        // SAFETY: builders make no other references (`Bvh::validate` checks it), and nodes are never taken away.
        unsafe { self.nodes.get_unchecked(index) }
    }

    /// The blocks that there are of each kind.
    pub(crate) fn blocks(&self) -> [(Kind, usize); 6] {
        [
            (Kind::FewTriangles, self.few_triangles.len()),
            (Kind::Triangles, self.triangles.len()),
            (Kind::Quads, self.quads.len()),
            (Kind::Spheres, self.spheres.len()),
            (Kind::Moving, self.moving.len()),
            (Kind::Instance, self.instances.len()),
        ]
    }

    /// Whether there is a primitive in a lane of a block.
    pub(crate) fn is_used(&self, kind: Kind, block: usize, lane: usize) -> bool {
        self.id(kind, block, lane) != Hit::NO_PRIM
    }

    /// The primitive in a lane of a block.
    #[inline]
    pub(crate) fn primitive(&self, kind: Kind, block: usize, lane: usize) -> Primitive {
        match kind {
            Kind::FewTriangles => Primitive::Triangle(self.few_triangles[block].triangle(lane & (FEW - 1))),
            Kind::Triangles => Primitive::Triangle(self.triangles[block].triangle(lane)),
            Kind::Quads => Primitive::Quad(self.quads[block].quad(lane)),
            Kind::Spheres => Primitive::Sphere(self.spheres[block].sphere(lane)),
            Kind::Moving => Primitive::MovingTriangle(self.moving[block].triangle(lane & (FEW - 1))),
            Kind::Instance | Kind::Nothing => Primitive::Instance(self.instance(block)),
        }
    }

    /// The nearest point at which a ray meets the primitive in a lane of a block; none if it is an instance.
    #[inline(always)]
    pub(crate) fn intersect(&self, kind: Kind, block: usize, lane: usize, ray: &RayF64) -> Option<PrimHit> {
        match kind {
            Kind::FewTriangles => self.few_triangles[block].triangle(lane & (FEW - 1)).intersect(ray),
            Kind::Triangles => self.triangles[block].triangle(lane).intersect(ray),
            Kind::Quads => self.quads[block].quad(lane).intersect(ray),
            Kind::Spheres => self.spheres[block].sphere(lane).intersect(ray),
            Kind::Moving => self.moving[block].triangle(lane & (FEW - 1)).intersect(ray),
            Kind::Instance | Kind::Nothing => None,
        }
    }

    /// The instance of a leaf.
    #[inline]
    pub(crate) fn instance(&self, block: usize) -> Instance {
        let leaf = &self.instances[block];
        Instance { object: leaf.object, at: leaf.keys(&self.transforms), time: leaf.time }
    }

    /// Finds an instance by the caller's index.
    pub(crate) fn block_of_instance(&self, id: u32) -> Option<usize> {
        let at = self.instance_of.binary_search_by_key(&id, |&(id, _)| id).ok()?;
        Some(self.instance_of[at].1 as usize)
    }

    /// Takes what the instances show, when there will be no more instances.
    pub(crate) fn set_objects(&mut self, objects: &[Arc<Bvh>]) {
        if !self.instances.is_empty() {
            self.objects = objects.to_vec();
            self.instance_of = self.instances.iter().zip(0..).map(|(leaf, block)| (leaf.id, block)).collect();
            self.instance_of.sort_unstable();
        }
    }

    /// The caller's index of the primitive in a lane of a block.
    #[inline]
    pub(crate) fn id(&self, kind: Kind, block: usize, lane: usize) -> u32 {
        match kind {
            Kind::FewTriangles => self.few_triangles[block].id[lane & (FEW - 1)],
            Kind::Triangles => self.triangles[block].id[lane],
            Kind::Quads => self.quads[block].id[lane],
            Kind::Spheres => self.spheres[block].id[lane],
            Kind::Moving => self.moving[block].id[lane & (FEW - 1)],
            Kind::Instance | Kind::Nothing => self.instances[block].id,
        }
    }

    /// Memory in use, without the objects.
    pub(crate) fn bytes(&self) -> usize {
        size_of_val(self.nodes.as_slice())
            + size_of_val(self.few_triangles.as_slice())
            + size_of_val(self.triangles.as_slice())
            + size_of_val(self.quads.as_slice())
            + size_of_val(self.spheres.as_slice())
            + size_of_val(self.moving.as_slice())
            + size_of_val(self.instances.as_slice())
            + size_of_val(self.transforms.as_slice())
    }
}

fn push<T>(list: &mut Vec<T>, item: T) -> usize {
    list.push(item);
    list.len() - 1
}
