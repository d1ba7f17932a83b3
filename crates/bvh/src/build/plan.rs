//! Which subtrees of the binary tree become leaves, and which nodes of eight children, at the least expected cost.
//!
//! For each subtree and each number of places, 1 to 8, the cheapest way to show it in so many children of a wide node is
//! found from the bottom up (Ylitie, Karras & Laine 2017, doi:10.1145/3105762.3105773).

use crate::simd::LANES;
use crate::wide::Kind;

/// Cost of testing the boxes of a node.
pub(crate) const NODE_COST: f32 = 1.0;

/// Cost of testing the primitives of a leaf: where eight lanes are one instruction, four save only memory; where they are two
/// instructions, half the time.
pub(crate) fn leaf_cost(kind: Kind) -> f32 {
    match kind {
        Kind::Nothing => 0.0,
        Kind::FewTriangles => 0.8,
        _ => 1.0,
    }
}

/// What is known of a subtree: the cost of showing it in 1 to 8 places.
#[derive(Clone, Copy, Debug)]
pub(super) struct Plan {
    cost: [f32; LANES],
    /// The kind of all primitives below, if they are of one.
    kind: Option<Kind>,
    count: u32,
}

impl Plan {
    /// A leaf of the binary tree.
    pub(super) fn leaf(area: f32, kind: Kind, count: usize) -> (Self, Choices) {
        let cost = area * leaf_cost(kind.for_leaf(count));
        (Self { cost: [cost; LANES], kind: Some(kind), count: count as u32 }, Choices::LEAF)
    }

    /// A node of the binary tree with the box's area.
    pub(super) fn join(left: &Self, right: &Self, area: f32) -> (Self, Choices) {
        let count = left.count + right.count;
        let kind = left.kind.filter(|_| left.kind == right.kind);
        let mut cost = [0.0; LANES];
        let mut choices = Choices::default();
        for places in 2..=LANES {
            (cost[places - 1], choices) = choices.with_best(places, &left.cost, &right.cost);
        }
        // As a node of its own, it shows its children in all eight places, whether or not fewer would do.
        let node = cost[LANES - 1] + area * NODE_COST;
        let leaf = kind.filter(|kind| count as usize <= kind.lanes());
        cost[0] = match leaf.map(|kind| area * leaf_cost(kind.for_leaf(count as usize))).filter(|&leaf| leaf <= node) {
            Some(leaf) => {
                choices.0 |= Choices::LEAF.0;
                leaf
            }
            None => node,
        };
        for places in 2..=LANES {
            if cost[places - 2] <= cost[places - 1] {
                cost[places - 1] = cost[places - 2];
                choices = choices.with_fewer(places);
            }
        }
        (Self { cost, kind, count }, choices)
    }
}

/// How to show a subtree in 1 to 8 places, in 32 bits.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Choices(u32);

impl Choices {
    /// In one place: a leaf. Otherwise, a node.
    const LEAF: Self = Self(1 << 31);

    /// From this bit on: for 2 to 8 places, how many of them the left child gets.
    const fn shift(places: usize) -> usize {
        3 * (places - 2)
    }

    /// From this bit on: for 2 to 8 places, whether one fewer is as good.
    const fn fewer(places: usize) -> u32 {
        1 << (21 + places - 2)
    }

    /// The cheapest way to share places between the children.
    #[inline(always)]
    fn with_best(self, places: usize, left: &[f32; LANES], right: &[f32; LANES]) -> (f32, Self) {
        let mut best = (f32::INFINITY, 1);
        for k in 1..places {
            let cost = left[k - 1] + right[places - k - 1];
            if cost < best.0 {
                best = (cost, k);
            }
        }
        (best.0, Self(self.0 | (best.1 as u32) << Self::shift(places)))
    }

    fn with_fewer(self, places: usize) -> Self {
        Self(self.0 | Self::fewer(places))
    }

    /// Whether in one place this is a leaf.
    pub(super) fn is_leaf(self) -> bool {
        self.0 & Self::LEAF.0 != 0
    }

    /// The places of the left child in a node of its own.
    pub(super) fn left_of_node(self) -> usize {
        (self.0 >> Self::shift(LANES) & 7) as usize
    }

    /// The places of the left child if this is shown in so many places; none if it takes one.
    pub(super) fn left_of(self, mut places: usize) -> Option<usize> {
        while places > 1 && self.0 & Self::fewer(places) != 0 {
            places -= 1;
        }
        (places > 1).then(|| (self.0 >> Self::shift(places) & 7) as usize)
    }
}
