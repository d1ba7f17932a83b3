//! Leaves: eight primitives of one kind, lane by lane. The lanes in use come first. Aligning blocks to cache lines would
//! cost memory and gains nothing.

use glam::Vec3;

use crate::shape::{Primitive, Sphere};
use crate::simd::LANES;

/// Triangles as three vertices, or quads as a corner and two edges.
#[derive(Clone, Debug)]
#[repr(C)]
pub(crate) struct CornerBlock {
    /// `[corner][axis]`.
    pub(crate) corner: [[[f32; LANES]; 3]; 3],
    pub(crate) id: [u32; LANES],
    /// The longest side of the box around all of them.
    pub(crate) size: f32,
    /// Bit i: lane i is in use.
    pub(crate) used: u32,
}

impl CornerBlock {
    pub(super) fn new(primitives: impl Iterator<Item = (u32, Primitive)>, size: f32) -> Self {
        let mut block = Self { corner: [[[0.0; LANES]; 3]; 3], id: [u32::MAX; LANES], size, used: 0 };
        for (lane, (id, primitive)) in primitives.take(LANES).enumerate() {
            let corners = match primitive {
                Primitive::Triangle(t) => [t.a, t.b, t.c],
                Primitive::Quad(q) => [q.corner, q.u, q.v],
                Primitive::Sphere(_) => continue,
            };
            block.id[lane] = id;
            block.used |= 1 << lane;
            for (corner, value) in block.corner.iter_mut().zip(corners) {
                (0..3).for_each(|axis| corner[axis][lane] = value[axis]);
            }
        }
        block
    }

    #[inline]
    pub(crate) fn corners(&self, lane: usize) -> [Vec3; 3] {
        self.corner.each_ref().map(|c| Vec3::new(c[0][lane], c[1][lane], c[2][lane]))
    }
}

/// Spheres.
#[derive(Clone, Debug)]
#[repr(C)]
pub(crate) struct SphereBlock {
    pub(crate) center: [[f32; LANES]; 3],
    pub(crate) radius: [f32; LANES],
    pub(crate) id: [u32; LANES],
    /// Bit i: lane i is in use.
    pub(crate) used: u32,
}

impl SphereBlock {
    pub(super) fn new(primitives: impl Iterator<Item = (u32, Primitive)>) -> Self {
        let mut block = Self { center: [[0.0; LANES]; 3], radius: [0.0; LANES], id: [u32::MAX; LANES], used: 0 };
        for (lane, (id, primitive)) in primitives.take(LANES).enumerate() {
            if let Primitive::Sphere(sphere) = primitive {
                block.id[lane] = id;
                block.used |= 1 << lane;
                block.radius[lane] = sphere.radius;
                (0..3).for_each(|axis| block.center[axis][lane] = sphere.center[axis]);
            }
        }
        block
    }

    #[inline]
    pub(crate) fn sphere(&self, lane: usize) -> Sphere {
        let center = Vec3::new(self.center[0][lane], self.center[1][lane], self.center[2][lane]);
        Sphere { center, radius: self.radius[lane] }
    }
}
