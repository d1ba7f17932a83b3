//! The tree as rays walk it: nodes with up to eight children, leaves with up to eight primitives of one kind.

mod block;
mod node;

pub(crate) use block::{CornerBlock, SphereBlock};
pub(crate) use node::{Child, Kind, Node, Target};

use crate::shape::{Primitive, Quad, Triangle};

/// Everything that a walk reads.
#[derive(Clone, Debug)]
pub(crate) struct Tree {
    pub(crate) root: Child,
    pub(crate) nodes: Vec<Node>,
    pub(crate) triangles: Vec<CornerBlock>,
    pub(crate) quads: Vec<CornerBlock>,
    pub(crate) spheres: Vec<SphereBlock>,
}

impl Tree {
    /// A tree without primitives.
    pub(crate) fn empty() -> Self {
        Self { root: Child::NONE, nodes: Vec::new(), triangles: Vec::new(), quads: Vec::new(), spheres: Vec::new() }
    }

    /// Appends a leaf of primitives of one kind, eight at most, in a box whose longest side is `size`.
    pub(crate) fn push_leaf(&mut self, primitives: impl Iterator<Item = (u32, Primitive)> + Clone, size: f32) -> Child {
        let kind = primitives.clone().next().map_or(Kind::Sphere, |(_, p)| Kind::of(&p));
        let index = match kind {
            Kind::Triangle => push(&mut self.triangles, CornerBlock::new(primitives, size)),
            Kind::Quad => push(&mut self.quads, CornerBlock::new(primitives, size)),
            Kind::Sphere => push(&mut self.spheres, SphereBlock::new(primitives)),
        };
        Child::leaf(kind, index)
    }

    /// The primitive in a lane of a block.
    #[inline]
    pub(crate) fn primitive(&self, kind: Kind, block: usize, lane: usize) -> Primitive {
        match kind {
            Kind::Triangle => {
                let [a, b, c] = self.triangles[block].corners(lane);
                Primitive::Triangle(Triangle { a, b, c })
            }
            Kind::Quad => {
                let [corner, u, v] = self.quads[block].corners(lane);
                Primitive::Quad(Quad { corner, u, v })
            }
            Kind::Sphere => Primitive::Sphere(self.spheres[block].sphere(lane)),
        }
    }

    /// The caller's index of the primitive in a lane of a block.
    #[inline]
    pub(crate) fn id(&self, kind: Kind, block: usize, lane: usize) -> u32 {
        match kind {
            Kind::Triangle => self.triangles[block].id[lane],
            Kind::Quad => self.quads[block].id[lane],
            Kind::Sphere => self.spheres[block].id[lane],
        }
    }
}

fn push<T>(list: &mut Vec<T>, item: T) -> usize {
    list.push(item);
    list.len() - 1
}
