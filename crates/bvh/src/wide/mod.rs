//! The tree as rays walk it: nodes with up to eight children, leaves with up to eight primitives of one kind.

mod block;
mod node;
mod replace;
mod room;

use std::sync::Arc;

pub(crate) use block::{CornerBlock, FEW, InstanceLeaf, MovingBlock, SphereBlock};
pub(crate) use node::{Child, Kind, Node, Target};
pub(crate) use room::{Plain, Room, Sizes, zeroed};

use crate::bvh::Bvh;
use crate::ray::{Hit, PrimHit, RayF64};
use crate::shape::Primitive;
use crate::simd::LANES;
use crate::wide::room::Places;

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
    /// What the instances show.
    pub(crate) objects: Vec<Arc<Bvh>>,
    /// The caller's index of each instance, with its index here, sorted.
    pub(crate) instance_of: Vec<(u32, u32)>,
}

impl Tree {
    /// A tree of known size, yet to be written.
    pub(crate) fn with_sizes(sizes: Sizes) -> Self {
        Self {
            nodes: zeroed(sizes.nodes),
            few_triangles: zeroed(sizes.of(Kind::FewTriangles)),
            triangles: zeroed(sizes.of(Kind::Triangles)),
            quads: zeroed(sizes.of(Kind::Quads)),
            spheres: zeroed(sizes.of(Kind::Spheres)),
            moving: zeroed(sizes.of(Kind::Moving)),
            instances: zeroed(sizes.of(Kind::Instance)),
            ..Self::default()
        }
    }

    /// All of its places.
    pub(crate) fn room(&mut self) -> Room<'_> {
        Room {
            nodes: Places::new(&mut self.nodes),
            few_triangles: Places::new(&mut self.few_triangles),
            triangles: Places::new(&mut self.triangles),
            quads: Places::new(&mut self.quads),
            spheres: Places::new(&mut self.spheres),
            moving: Places::new(&mut self.moving),
            instances: Places::new(&mut self.instances),
        }
    }

    /// The number of leaves.
    pub(crate) fn leaves(&self) -> usize {
        self.blocks().into_iter().map(|(_, blocks)| blocks).sum()
    }

    /// The number of primitives in a block.
    pub(crate) fn count(&self, kind: Kind, block: usize) -> usize {
        (0..kind.lanes()).filter(|&lane| self.is_used(kind, block, lane)).count()
    }

    /// A node that the root or a child refers to.
    #[inline(always)]
    pub(crate) fn node(&self, index: usize) -> &Node {
        debug_assert!(index < self.nodes.len());
        // SAFETY: builders make no other references (`Bvh::validate` checks it), and nodes are never taken away.
        unsafe { self.nodes.get_unchecked(index) }
    }

    /// The blocks that there are of each kind.
    pub(crate) fn blocks(&self) -> [(Kind, usize); Kind::COUNT] {
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
            Kind::Instance | Kind::Nothing => Primitive::Instance(self.instances[block].instance),
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
            + size_of_val(self.instance_of.as_slice())
    }
}
