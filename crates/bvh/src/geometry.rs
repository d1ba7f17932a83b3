//! What a tree is built from.

use std::sync::Arc;

use glam::Vec3;

use crate::bvh::Bvh;
use crate::shape::{Primitive, Triangle};

/// A numbered list of primitives. The builder reads it, from many threads and more than once; the tree keeps what it needs.
/// While a tree is built or refitted, the answers must not change: otherwise the tree is of no use, but safe.
pub trait Geometry: Sync {
    /// The number of primitives.
    fn len(&self) -> usize;

    /// The primitive of an index below [`len`](Self::len); the same each time. It is called several times for each primitive,
    /// so it should cost little.
    fn primitive(&self, index: usize) -> Primitive;

    /// What instances show: [`Instance::object`](crate::Instance::object) is an index into this list. None by default.
    fn objects(&self) -> &[Arc<Bvh>] {
        &[]
    }

    /// Whether there are no primitives.
    fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

impl Geometry for [Primitive] {
    fn len(&self) -> usize {
        self.len()
    }

    fn primitive(&self, index: usize) -> Primitive {
        self[index]
    }
}

impl Geometry for Vec<Primitive> {
    fn len(&self) -> usize {
        self.len()
    }

    fn primitive(&self, index: usize) -> Primitive {
        self[index]
    }
}

/// Triangles that share vertices. An index is 32 bits; hits have the triangle's index.
#[derive(Clone, Copy, Debug)]
pub struct Mesh<'a> {
    /// Positions.
    pub vertices: &'a [Vec3],
    /// Three indices of vertices for each triangle. An index without a vertex stands for a vertex that is not a number.
    pub triangles: &'a [[u32; 3]],
}

impl Geometry for Mesh<'_> {
    fn len(&self) -> usize {
        self.triangles.len()
    }

    fn primitive(&self, index: usize) -> Primitive {
        let vertex = |i: u32| self.vertices.get(i as usize).copied().unwrap_or(Vec3::NAN);
        let [a, b, c] = self.triangles[index].map(vertex);
        Primitive::Triangle(Triangle { a, b, c })
    }
}
