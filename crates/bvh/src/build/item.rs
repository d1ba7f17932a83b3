//! What builders sort: for each primitive, its box and its number, in 32 bytes.

use glam::{DVec3, Vec3, Vec3A, Vec4};
use rayon::prelude::*;

use crate::build::bounds::Bounds;
use crate::error::BuildError;
use crate::geometry::Geometry;
use crate::shape::Primitive;
use crate::wide::{Kind, Plain, zeroed};

/// Items made by a thread at a time.
const CHUNK: usize = 1 << 13;

/// A primitive, or the part of one that lies in a box.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub(super) struct Item {
    /// The corners of the box. In the fourth place: the index of the primitive; its kind.
    lo: Vec4,
    hi: Vec4,
}

// SAFETY: eight numbers, without padding; zeros are numbers.
unsafe impl Plain for Item {}

/// Set in the fourth places, so that they are no denormal numbers, with which some processors are slow.
const NORMAL: u32 = 1 << 30;

impl Item {
    pub(super) fn new(prim: u32, kind: Kind, bounds: Bounds) -> Self {
        let [prim, kind] = [prim, kind as u32].map(|bits| f32::from_bits(NORMAL | bits));
        Self { lo: bounds.lo.extend(prim), hi: bounds.hi.extend(kind) }
    }

    #[inline(always)]
    pub(super) fn prim(self) -> u32 {
        self.lo.w.to_bits() & !NORMAL
    }

    #[inline(always)]
    pub(super) fn kind(self) -> Kind {
        Kind::from_bits(self.hi.w.to_bits())
    }

    #[inline(always)]
    pub(super) fn bounds(self) -> Bounds {
        Bounds { lo: Vec3A::from_vec4(self.lo), hi: Vec3A::from_vec4(self.hi) }
    }

    /// Twice the centre of the box.
    #[inline(always)]
    pub(super) fn center_on(self, axis: usize) -> f32 {
        self.lo[axis] + self.hi[axis]
    }
}

/// The box around items.
pub(super) fn bounds_of(items: &[Item]) -> Bounds {
    items.iter().fold(Bounds::EMPTY, |b, item| b.union(item.bounds()))
}

/// An item for each primitive that can be hit.
pub(super) struct Items {
    pub(super) list: Vec<Item>,
    pub(super) bounds: Bounds,
    /// Primitives that were left out.
    pub(super) degenerate: usize,
}

/// What a thread found in its chunk of primitives.
struct Chunk {
    items: usize,
    bounds: Bounds,
    not_finite: Option<usize>,
}

impl Items {
    pub(super) fn new(geometry: &(impl Geometry + ?Sized)) -> Result<Self, BuildError> {
        let count = geometry.len();
        let mut list = zeroed::<Item>(count);
        let chunks = list.par_chunks_mut(CHUNK).enumerate();
        let chunks: Vec<_> = chunks.map(|(n, places)| fill(geometry, n * CHUNK, places)).collect();
        if let Some(index) = chunks.iter().find_map(|chunk| chunk.not_finite) {
            return Err(BuildError::NotFinite { index });
        }
        let mut kept = 0;
        for (n, chunk) in chunks.iter().enumerate() {
            let first = n * CHUNK;
            if kept < first {
                list.copy_within(first..first + chunk.items, kept);
            }
            kept += chunk.items;
        }
        list.truncate(kept);
        let bounds = chunks.iter().fold(Bounds::EMPTY, |b, chunk| b.union(chunk.bounds));
        Ok(Self { list, bounds, degenerate: count - kept })
    }
}

/// Items of the primitives from `first` on, without gaps.
fn fill(geometry: &(impl Geometry + ?Sized), first: usize, places: &mut [Item]) -> Chunk {
    let mut chunk = Chunk { items: 0, bounds: Bounds::EMPTY, not_finite: None };
    for index in first..first + places.len() {
        let primitive = geometry.primitive(index);
        if !is_finite(&primitive) {
            chunk.not_finite = Some(index);
            break;
        }
        if !is_degenerate(&primitive) {
            let bounds = primitive.bounds().into();
            chunk.bounds = chunk.bounds.union(bounds);
            places[chunk.items] = Item::new(index as u32, Kind::of(&primitive), bounds);
            chunk.items += 1;
        }
    }
    chunk
}

pub(super) fn is_finite(primitive: &Primitive) -> bool {
    let all = |points: [Vec3; 3]| points.into_iter().all(Vec3::is_finite);
    match primitive {
        Primitive::Sphere(s) => s.center.is_finite() && s.radius.is_finite(),
        Primitive::Quad(q) => all([q.corner, q.u, q.v]),
        Primitive::Triangle(t) => all([t.a, t.b, t.c]),
    }
}

/// Whether there is nothing to hit: no radius, or no area in double precision.
pub(super) fn is_degenerate(primitive: &Primitive) -> bool {
    match primitive {
        Primitive::Sphere(s) => s.radius <= 0.0,
        Primitive::Quad(q) => q.u.as_dvec3().cross(q.v.as_dvec3()) == DVec3::ZERO,
        Primitive::Triangle(t) => {
            let [a, b, c] = [t.a, t.b, t.c].map(Vec3::as_dvec3);
            (b - a).cross(c - a) == DVec3::ZERO
        }
    }
}
