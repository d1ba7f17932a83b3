//! Room for a tree whose size is known before it is written, so that threads can write parts of it.

use std::alloc::{Layout, alloc_zeroed, handle_alloc_error};
use std::ops::Add;

use crate::shape::Primitive;
use crate::wide::{Child, CornerBlock, Kind, Node, SphereBlock};

/// Types for which zeros are a value.
///
/// # Safety
/// Bytes of zeros must be a value of the type.
pub(crate) unsafe trait Plain: Sized {}

// SAFETY: of all three: they are made of numbers, and of references that are numbers.
unsafe impl Plain for Node {}
unsafe impl Plain for CornerBlock {}
unsafe impl Plain for SphereBlock {}

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
        Vec::from_raw_parts(start.cast(), len, len)
    }
}

/// How much of everything a part of a tree takes.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Sizes {
    pub(super) nodes: usize,
    pub(super) triangles: usize,
    pub(super) quads: usize,
    pub(super) spheres: usize,
}

impl Sizes {
    pub(crate) fn nodes(nodes: usize) -> Self {
        Self { nodes, ..Self::default() }
    }

    /// A leaf of `count` primitives.
    pub(crate) fn leaf(kind: Kind, _count: usize) -> Self {
        match kind {
            Kind::Triangle => Self { triangles: 1, ..Self::default() },
            Kind::Quad => Self { quads: 1, ..Self::default() },
            Kind::Sphere => Self { spheres: 1, ..Self::default() },
        }
    }
}

impl Add for Sizes {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            nodes: self.nodes + other.nodes,
            triangles: self.triangles + other.triangles,
            quads: self.quads + other.quads,
            spheres: self.spheres + other.spheres,
        }
    }
}

/// Places for a part of a tree.
pub(crate) struct Room<'a> {
    pub(super) nodes: Places<'a, Node>,
    pub(super) triangles: Places<'a, CornerBlock>,
    pub(super) quads: Places<'a, CornerBlock>,
    pub(super) spheres: Places<'a, SphereBlock>,
}

impl<'a> Room<'a> {
    /// Cuts off the first places.
    pub(crate) fn take(&mut self, sizes: &Sizes) -> Room<'a> {
        Room {
            nodes: self.nodes.take(sizes.nodes),
            triangles: self.triangles.take(sizes.triangles),
            quads: self.quads.take(sizes.quads),
            spheres: self.spheres.take(sizes.spheres),
        }
    }

    /// The index of the next node, which is to be [put](Self::put_node) there later.
    pub(crate) fn place_node(&mut self) -> usize {
        self.nodes.place()
    }

    pub(crate) fn put_node(&mut self, index: usize, node: Node) {
        self.nodes.put(index, node);
    }

    /// Writes a leaf of primitives of one kind, eight at most, in a box whose longest side is `size`.
    pub(crate) fn push_leaf(&mut self, primitives: impl Iterator<Item = (u32, Primitive)> + Clone, size: f32) -> Child {
        let kind = primitives.clone().next().map_or(Kind::Sphere, |(_, p)| Kind::of(&p));
        let index = match kind {
            Kind::Triangle => self.triangles.push(CornerBlock::new(primitives, size)),
            Kind::Quad => self.quads.push(CornerBlock::new(primitives, size)),
            Kind::Sphere => self.spheres.push(SphereBlock::new(primitives)),
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
