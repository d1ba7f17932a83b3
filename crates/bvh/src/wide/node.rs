//! Nodes and the references that they hold.

use glam::Vec3;

use crate::aabb::Aabb;
use crate::shape::Primitive;
use crate::simd::LANES;
use crate::wide::block::FEW;

/// What a leaf holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    /// Up to eight.
    Triangles,
    /// Up to four: half the memory, and on many processors half the time.
    FewTriangles,
    Quads,
    Spheres,
    Moving,
    Instance,
    /// No primitive at all.
    Nothing,
}

impl Kind {
    /// Kinds of leaves that hold something.
    pub(crate) const COUNT: usize = 6;

    /// From its three bits.
    #[inline(always)]
    pub(crate) fn from_bits(bits: u32) -> Self {
        match bits & 7 {
            0 => Self::Triangles,
            1 => Self::FewTriangles,
            2 => Self::Quads,
            3 => Self::Spheres,
            4 => Self::Moving,
            5 => Self::Instance,
            _ => Self::Nothing,
        }
    }

    /// What leaves of such primitives hold, if they are many.
    pub(crate) fn of(primitive: &Primitive) -> Self {
        match primitive {
            Primitive::Triangle(_) => Self::Triangles,
            Primitive::Quad(_) => Self::Quads,
            Primitive::Sphere(_) => Self::Spheres,
            Primitive::MovingTriangle(_) => Self::Moving,
            Primitive::Instance(_) => Self::Instance,
        }
    }

    /// What a leaf of so many of these primitives holds.
    pub(crate) fn for_leaf(self, count: usize) -> Self {
        if self == Self::Triangles && count <= FEW { Self::FewTriangles } else { self }
    }

    /// The most primitives in a leaf.
    pub(crate) fn lanes(self) -> usize {
        match self {
            Self::Triangles | Self::Quads | Self::Spheres => LANES,
            Self::FewTriangles | Self::Moving => FEW,
            Self::Instance => 1,
            Self::Nothing => 0,
        }
    }
}

/// A reference to an inner node or to a leaf, in 32 bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Child(u32);

impl Default for Child {
    fn default() -> Self {
        Self::NONE
    }
}

/// What a [`Child`] refers to.
pub(crate) enum Target {
    Node(usize),
    Leaf(Kind, usize),
}

impl Child {
    /// Blocks of a kind; a hit's slot has three bits more, for the lane.
    pub(crate) const MAX_BLOCKS: usize = 1 << 26;
    /// Nothing.
    pub(crate) const NONE: Self = Self(u32::MAX);

    const LEAF: u32 = 1 << 31;
    const KIND_SHIFT: u32 = 28;
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
