//! Leaves: primitives of one kind, lane by lane. The lanes in use come first. Aligning blocks to cache lines would
//! cost memory and gains nothing.

use glam::Vec3;

use crate::filter::Block;
use crate::instance::Instance;
use crate::shape::{MovingTriangle, Primitive, Quad, Sphere, Triangle};
use crate::simd::LANES;

/// Lanes of the blocks that are shorter than a node.
pub(crate) const FEW: usize = 4;

/// For each of three points, for each axis, the coordinate in each lane.
type Points<const N: usize> = [[[f32; N]; 3]; 3];

/// Triangles as three vertices, or quads as a corner and two edges.
#[derive(Clone, Debug)]
#[repr(C)]
pub(crate) struct CornerBlock<const N: usize> {
    pub(crate) points: Points<N>,
    pub(crate) id: [u32; N],
    /// The longest side of the box around all of them.
    pub(crate) size: f32,
    /// Bit i: lane i is in use.
    pub(crate) used: u32,
}

impl<const N: usize> CornerBlock<N> {
    pub(super) fn new(primitives: impl Iterator<Item = (u32, Primitive)>, size: f32) -> Self {
        let mut block = Self { points: [[[0.0; N]; 3]; 3], id: [u32::MAX; N], size, used: 0 };
        for (lane, (id, primitive)) in primitives.take(N).enumerate() {
            let points = match primitive {
                Primitive::Triangle(t) => [t.a, t.b, t.c],
                Primitive::Quad(q) => [q.corner, q.u, q.v],
                _ => continue,
            };
            block.id[lane] = id;
            block.used |= 1 << lane;
            set_points(&mut block.points, lane, points);
        }
        block
    }

    /// What holds for all of them.
    #[inline(always)]
    pub(crate) fn block(&self) -> Block {
        Block { used: self.used, size: self.size, error: 0.0 }
    }

    #[inline]
    pub(crate) fn triangle(&self, lane: usize) -> Triangle {
        let [a, b, c] = points_of(&self.points, lane);
        Triangle { a, b, c }
    }

    #[inline]
    pub(crate) fn quad(&self, lane: usize) -> Quad {
        let [corner, u, v] = points_of(&self.points, lane);
        Quad { corner, u, v }
    }
}

fn set_points<const N: usize>(to: &mut Points<N>, lane: usize, points: [Vec3; 3]) {
    for (to, point) in to.iter_mut().zip(points) {
        (0..3).for_each(|axis| to[axis][lane] = point[axis]);
    }
}

#[inline(always)]
fn points_of<const N: usize>(points: &Points<N>, lane: usize) -> [Vec3; 3] {
    points.each_ref().map(|p| Vec3::new(p[0][lane], p[1][lane], p[2][lane]))
}

/// Spheres.
#[derive(Clone, Debug)]
#[repr(C)]
pub(crate) struct SphereBlock<const N: usize = LANES> {
    pub(crate) center: [[f32; N]; 3],
    pub(crate) radius: [f32; N],
    pub(crate) id: [u32; N],
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

/// Triangles that move.
#[derive(Clone, Debug)]
#[repr(C)]
pub(crate) struct MovingBlock {
    /// At the beginning and at the end of each one's time.
    points: [Points<FEW>; 2],
    time: [[f32; 2]; FEW],
    pub(crate) id: [u32; FEW],
    /// The longest side of the box around all of them at all times.
    pub(crate) size: f32,
    /// The largest coordinate, by size.
    pub(crate) reach: f32,
    pub(crate) used: u32,
}

impl MovingBlock {
    pub(super) fn new(primitives: impl Iterator<Item = (u32, Primitive)>, size: f32) -> Self {
        let points = [[[[0.0; FEW]; 3]; 3]; 2];
        let mut block = Self { points, time: [[0.0; 2]; FEW], id: [u32::MAX; FEW], size, reach: 0.0, used: 0 };
        for (lane, (id, primitive)) in primitives.take(FEW).enumerate() {
            if let Primitive::MovingTriangle(MovingTriangle { at, time }) = primitive {
                block.id[lane] = id;
                block.used |= 1 << lane;
                block.time[lane] = time;
                for (to, t) in block.points.iter_mut().zip(at) {
                    set_points(to, lane, [t.a, t.b, t.c]);
                    block.reach =
                        [t.a, t.b, t.c].map(|p| p.abs().max_element()).into_iter().fold(block.reach, f32::max);
                }
            }
        }
        block
    }

    /// Bit i: lane i exists at this time.
    #[inline]
    fn used_at(&self, time: f32) -> u32 {
        (0..FEW).map(|i| u32::from(self.time[i][0] <= time && time <= self.time[i][1]) << i).sum::<u32>() & self.used
    }

    /// The vertices at a time.
    pub(crate) fn points_at(&self, time: f32) -> Points<FEW> {
        let share = self.time.map(|[start, end]| MovingTriangle::share(start, end, time) as f32);
        let [from, to] = &self.points;
        std::array::from_fn(|point| {
            std::array::from_fn(|axis| {
                let (from, to) = (&from[point][axis], &to[point][axis]);
                std::array::from_fn(|lane| from[lane] + (to[lane] - from[lane]) * share[lane])
            })
        })
    }

    /// What holds for all of them at a time.
    pub(crate) fn block_at(&self, time: f32) -> Block {
        Block { used: self.used_at(time), size: self.size, error: self.reach }
    }

    #[inline]
    pub(crate) fn triangle(&self, lane: usize) -> MovingTriangle {
        let at = self.points.each_ref().map(|points| {
            let [a, b, c] = points_of(points, lane);
            Triangle { a, b, c }
        });
        MovingTriangle { at, time: self.time[lane] }
    }
}

/// An instance: a leaf of its own.
#[derive(Clone, Debug)]
pub(crate) struct InstanceLeaf {
    pub(crate) id: u32,
    pub(crate) instance: Instance,
}

impl InstanceLeaf {
    /// None of another primitive.
    pub(super) fn new(id: u32, primitive: &Primitive) -> Option<Self> {
        match *primitive {
            Primitive::Instance(instance) => Some(Self { id, instance }),
            _ => None,
        }
    }
}
