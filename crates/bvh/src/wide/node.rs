//! Nodes and the references that they hold.

use glam::Vec3;

use crate::aabb::Aabb;
use crate::shape::Primitive;
use crate::simd::LANES;

/// What a leaf holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    Triangle,
    Quad,
    Sphere,
}

impl Kind {
    /// From its two bits.
    #[inline(always)]
    pub(crate) fn from_bits(bits: u32) -> Self {
        match bits & 3 {
            0 => Self::Triangle,
            1 => Self::Quad,
            _ => Self::Sphere,
        }
    }

    pub(crate) fn of(primitive: &Primitive) -> Self {
        match primitive {
            Primitive::Triangle(_) => Self::Triangle,
            Primitive::Quad(_) => Self::Quad,
            Primitive::Sphere(_) => Self::Sphere,
        }
    }
}

/// A reference to an inner node or to a leaf, in 32 bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Child(u32);

/// What a [`Child`] refers to.
pub(crate) enum Target {
    Node(usize),
    Leaf(Kind, usize),
    Nothing,
}

impl Child {
    /// Blocks of a kind; a hit's slot has three bits more, for the lane.
    pub(crate) const MAX_BLOCKS: usize = 1 << 27;
    /// Nothing.
    pub(crate) const NONE: Self = Self(u32::MAX);

    const LEAF: u32 = 1 << 31;
    const KIND_SHIFT: u32 = 29;
    const INDEX: u32 = (1 << Self::KIND_SHIFT) - 1;

    pub(crate) fn node(index: usize) -> Self {
        Self(index as u32)
    }

    pub(crate) fn leaf(kind: Kind, block: usize) -> Self {
        Self(Self::LEAF | (kind as u32) << Self::KIND_SHIFT | block as u32)
    }

    pub(crate) fn bits(self) -> u32 {
        self.0
    }

    pub(crate) fn from_bits(bits: u32) -> Self {
        Self(bits)
    }

    #[inline(always)]
    pub(crate) fn target(self) -> Target {
        if self.0 & Self::LEAF == 0 {
            Target::Node(self.0 as usize)
        } else if self == Self::NONE {
            Target::Nothing
        } else {
            Target::Leaf(Kind::from_bits(self.0 >> Self::KIND_SHIFT), (self.0 & Self::INDEX) as usize)
        }
    }
}

/// Up to eight children with their boxes, lane by lane; an unused lane has an empty box, which no finite ray meets.
#[derive(Clone, Debug)]
#[repr(C, align(64))]
pub(crate) struct Node {
    /// `[lo, hi][axis]` of the boxes.
    pub(crate) planes: [[[f32; LANES]; 3]; 2],
    pub(crate) child: [Child; LANES],
}

impl Node {
    pub(crate) fn new(children: &[(Child, Aabb)]) -> Self {
        let bounds = |lane: usize| children.get(lane).map_or(Aabb::EMPTY, |c| c.1);
        let lo = [0, 1, 2].map(|axis| std::array::from_fn(|lane| bounds(lane).lo[axis]));
        let hi = [0, 1, 2].map(|axis| std::array::from_fn(|lane| bounds(lane).hi[axis]));
        let child = std::array::from_fn(|lane| children.get(lane).map_or(Child::NONE, |c| c.0));
        Self { planes: [lo, hi], child }
    }

    /// The box of a lane's child.
    pub(crate) fn bounds(&self, lane: usize) -> Aabb {
        let [lo, hi] = self.planes.map(|planes| Vec3::from_array(planes.map(|plane| plane[lane])));
        Aabb { lo, hi }
    }
}
