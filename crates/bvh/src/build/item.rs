//! What builders sort: for each primitive, its box and its number, in 32 bytes.

use std::sync::Arc;

use glam::{Vec3A, Vec4};
use rayon::prelude::*;

use crate::aabb::Aabb;
use crate::build::bounds::Bounds;
use crate::bvh::Bvh;
use crate::error::BuildError;
use crate::geometry::Geometry;
use crate::ray::Hit;
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
    problem: Option<BuildError>,
}

impl Items {
    pub(super) fn new(geometry: &(impl Geometry + ?Sized)) -> Result<Self, BuildError> {
        let count = geometry.len();
        let mut list = zeroed::<Item>(count);
        let chunks = list.par_chunks_mut(CHUNK).enumerate();
        let chunks: Vec<_> = chunks.map(|(n, places)| fill(geometry, n * CHUNK, places)).collect();
        if let Some(problem) = chunks.iter().find_map(|chunk| chunk.problem) {
            return Err(problem);
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
    let mut chunk = Chunk { items: 0, bounds: Bounds::EMPTY, problem: None };
    for index in first..first + places.len() {
        let primitive = geometry.primitive(index);
        if let Err(problem) = check(&primitive, index, geometry.objects()) {
            chunk.problem = Some(problem);
            break;
        }
        let bounds = primitive.bounds(geometry.objects());
        // The object of an instance may be empty.
        if !primitive.is_degenerate() && bounds != Aabb::EMPTY {
            let bounds = Bounds::from(bounds);
            chunk.bounds = chunk.bounds.union(bounds);
            places[chunk.items] = Item::new(index as u32, Kind::of(&primitive), bounds);
            chunk.items += 1;
        }
    }
    chunk
}

/// Whether a primitive can be in a tree.
pub(super) fn check(primitive: &Primitive, index: usize, objects: &[Arc<Bvh>]) -> Result<(), BuildError> {
    if !primitive.is_finite() {
        return Err(BuildError::NotFinite { index });
    }
    if let Primitive::Instance(instance) = primitive {
        let (object, count, most) = (instance.object, objects.len(), Hit::MAX_NESTING);
        let shown = objects.get(object as usize).ok_or(BuildError::NoObject { index, object, count })?;
        if shown.nesting() >= most {
            return Err(BuildError::TooDeep { index, most });
        }
    }
    Ok(())
}
