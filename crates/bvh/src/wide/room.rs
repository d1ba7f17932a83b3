//! Room for a tree whose size is known before it is written, so that threads can write parts of it.

use std::alloc::{Layout, alloc_zeroed, handle_alloc_error};
use std::ops::Add;

use crate::error::BuildError;
use crate::shape::Primitive;
use crate::simd::LANES;
use crate::wide::{Child, CornerBlock, FEW, InstanceLeaf, Kind, MovingBlock, Node, SphereBlock};

/// Types for which zeros are a value.
///
/// # Safety
/// Bytes of zeros must be a value of the type.
pub(crate) unsafe trait Plain: Sized {}

// SAFETY: of all: they are made of numbers, and of references that are numbers.
unsafe impl Plain for Node {}
unsafe impl<const N: usize> Plain for CornerBlock<N> {}
unsafe impl Plain for SphereBlock {}
unsafe impl Plain for MovingBlock {}
unsafe impl Plain for InstanceLeaf {}

/// A list of zeros. Unlike `vec!`, it touches no memory: that is left to the threads that write it.
pub(crate) fn zeroed<T: Plain>(len: usize) -> Vec<T> {
    let Ok(layout) = Layout::array::<T>(len) else {
        return Vec::with_capacity(len);
    };
    if layout.size() == 0 {
        return Vec::new();
    }
    // SAFETY: the layout has a size; it is that of a vector of `len` elements, for which zeros are values.
    unsafe {
        let start = alloc_zeroed(layout);
        if start.is_null() {
            handle_alloc_error(layout);
        }
        ask_for_large_pages(start, layout.size());
        Vec::from_raw_parts(start.cast(), len, len)
    }
}

/// Trees that are larger than a few hundred pages are walked all over: on Linux, with pages of 2 MiB fewer addresses are looked up.
#[cfg(target_os = "linux")]
fn ask_for_large_pages(start: *mut u8, bytes: usize) {
    const LARGE: usize = 2 << 20;
    let first = start.align_offset(LARGE);
    if let Some(whole) = bytes.checked_sub(first).map(|rest| rest / LARGE * LARGE).filter(|&whole| whole > 0) {
        // SAFETY: the range lies in the allocation; the advice changes no contents, and may be refused.
        unsafe { libc::madvise(start.add(first).cast(), whole, libc::MADV_HUGEPAGE) };
    }
}

#[cfg(not(target_os = "linux"))]
fn ask_for_large_pages(_: *mut u8, _: usize) {}

/// How much of everything a part of a tree takes.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Sizes {
    pub(super) nodes: usize,
    /// Of each [`Kind`].
    pub(super) leaves: [usize; Kind::COUNT],
}

impl Sizes {
    pub(crate) fn nodes(nodes: usize) -> Self {
        Self { nodes, ..Self::default() }
    }

    pub(crate) fn leaf(kind: Kind) -> Self {
        let mut sizes = Self::default();
        sizes.leaves[kind as usize] = 1;
        sizes
    }

    /// An error if references cannot tell so many leaves of a kind apart.
    pub(crate) fn checked(self) -> Result<Self, BuildError> {
        let (most, count) = (Child::MAX_BLOCKS, self.leaves.into_iter().fold(0, usize::max));
        if count <= most { Ok(self) } else { Err(BuildError::TooManyLeaves { count, most }) }
    }

    pub(super) fn of(&self, kind: Kind) -> usize {
        self.leaves[kind as usize]
    }
}

impl Add for Sizes {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        let leaves = std::array::from_fn(|kind| self.leaves[kind] + other.leaves[kind]);
        Self { nodes: self.nodes + other.nodes, leaves }
    }
}

/// Places for a part of a tree.
pub(crate) struct Room<'a> {
    pub(super) nodes: Places<'a, Node>,
    pub(super) few_triangles: Places<'a, CornerBlock<FEW>>,
    pub(super) triangles: Places<'a, CornerBlock<LANES>>,
    pub(super) quads: Places<'a, CornerBlock<LANES>>,
    pub(super) spheres: Places<'a, SphereBlock>,
    pub(super) moving: Places<'a, MovingBlock>,
    pub(super) instances: Places<'a, InstanceLeaf>,
}

impl<'a> Room<'a> {
    /// Cuts off the first places.
    pub(crate) fn take(&mut self, sizes: &Sizes) -> Room<'a> {
        Room {
            nodes: self.nodes.take(sizes.nodes),
            few_triangles: self.few_triangles.take(sizes.of(Kind::FewTriangles)),
            triangles: self.triangles.take(sizes.of(Kind::Triangles)),
            quads: self.quads.take(sizes.of(Kind::Quads)),
            spheres: self.spheres.take(sizes.of(Kind::Spheres)),
            moving: self.moving.take(sizes.of(Kind::Moving)),
            instances: self.instances.take(sizes.of(Kind::Instance)),
        }
    }

    /// The index of the next node, which is to be [put](Self::put_node) there later.
    pub(crate) fn place_node(&mut self) -> usize {
        self.nodes.place()
    }

    pub(crate) fn put_node(&mut self, index: usize, node: Node) {
        self.nodes.put(index, node);
    }

    /// Writes a leaf of primitives of one kind, as many as it allows, in a box whose longest side is `size`.
    pub(crate) fn push_leaf(
        &mut self,
        kind: Kind,
        mut primitives: impl Iterator<Item = (u32, Primitive)>,
        size: f32,
    ) -> Child {
        let index = match kind {
            Kind::FewTriangles => self.few_triangles.push(CornerBlock::new(primitives, size)),
            Kind::Triangles => self.triangles.push(CornerBlock::new(primitives, size)),
            Kind::Quads => self.quads.push(CornerBlock::new(primitives, size)),
            Kind::Spheres => self.spheres.push(SphereBlock::new(primitives)),
            Kind::Moving => self.moving.push(MovingBlock::new(primitives, size)),
            Kind::Instance => match primitives.next().and_then(|(id, primitive)| InstanceLeaf::new(id, &primitive)) {
                Some(leaf) => self.instances.push(leaf),
                None => return Child::NONE,
            },
            Kind::Nothing => return Child::NONE,
        };
        Child::leaf(kind, index)
    }
}

/// Places in a list, the first of which have been given away.
pub(super) struct Places<'a, T> {
    list: &'a mut [T],
    /// The index of the first of `list` in the whole list.
    start: usize,
    used: usize,
}

impl<'a, T> Places<'a, T> {
    pub(super) fn new(list: &'a mut [T]) -> Self {
        Self { list, start: 0, used: 0 }
    }

    fn take(&mut self, count: usize) -> Self {
        let (_, free) = std::mem::take(&mut self.list).split_at_mut(self.used);
        let (taken, rest) = free.split_at_mut(count);
        let start = self.start + self.used;
        *self = Self { list: rest, start: start + count, used: 0 };
        Self { list: taken, start, used: 0 }
    }

    fn place(&mut self) -> usize {
        self.used += 1;
        self.start + self.used - 1
    }

    fn put(&mut self, index: usize, item: T) {
        self.list[index - self.start] = item;
    }

    fn push(&mut self, item: T) -> usize {
        let index = self.place();
        self.put(index, item);
        index
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn leaves_that_references_cannot_tell_apart_are_refused() {
        let sizes = |leaves| Sizes { leaves: [0, leaves, 0, 3, 0, 0], ..Sizes::nodes(Child::MAX_BLOCKS + 1) };
        assert!(sizes(Child::MAX_BLOCKS).checked().is_ok());
        let error = sizes(Child::MAX_BLOCKS + 1).checked().unwrap_err();
        assert_eq!(error, BuildError::TooManyLeaves { count: 67_108_865, most: 67_108_864 });
    }
}
