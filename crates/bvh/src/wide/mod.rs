//! The tree as rays walk it: nodes with up to eight children, leaves with up to eight primitives of one kind.

mod block;
mod node;
mod replace;
mod room;

pub(crate) use block::{CornerBlock, SphereBlock};
pub(crate) use node::{Child, Kind, Node, Target};
pub(crate) use room::{Plain, Room, Sizes, zeroed};

use crate::shape::{Primitive, Quad, Triangle};
use crate::wide::room::Places;

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

    /// A tree of known size, yet to be written.
    pub(crate) fn with_sizes(sizes: Sizes) -> Self {
        Self {
            root: Child::NONE,
            nodes: zeroed(sizes.nodes),
            triangles: zeroed(sizes.triangles),
            quads: zeroed(sizes.quads),
            spheres: zeroed(sizes.spheres),
        }
    }

    /// All of its places.
    pub(crate) fn room(&mut self) -> Room<'_> {
        Room {
            nodes: Places::new(&mut self.nodes),
            triangles: Places::new(&mut self.triangles),
            quads: Places::new(&mut self.quads),
            spheres: Places::new(&mut self.spheres),
        }
    }

    /// The number of leaves.
    pub(crate) fn leaves(&self) -> usize {
        self.triangles.len() + self.quads.len() + self.spheres.len()
    }

    /// The number of primitives in a block.
    pub(crate) fn count(&self, kind: Kind, block: usize) -> usize {
        let used = match kind {
            Kind::Triangle => self.triangles[block].used,
            Kind::Quad => self.quads[block].used,
            Kind::Sphere => self.spheres[block].used,
        };
        used.count_ones() as usize
    }

    /// The memory that it takes.
    pub(crate) fn bytes(&self) -> usize {
        size_of_val(self.nodes.as_slice())
            + size_of_val(self.triangles.as_slice())
            + size_of_val(self.quads.as_slice())
            + size_of_val(self.spheres.as_slice())
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
