//! From the binary tree to nodes of eight children and leaves of eight primitives, at the least expected cost.
//!
//! For each subtree and each number of places, 1 to 8, the cheapest way to show it in so many children of a wide node is
//! found from the bottom up (Ylitie, Karras & Laine 2017, doi:10.1145/3105762.3105773).

use crate::build::binary::{Binary, Bounds};
use crate::shape::Primitive;
use crate::simd::LANES;
use crate::wide::{Child, Kind, Node, Tree};

/// Cost of testing the boxes of a node, and the primitives of a leaf of up to eight or four.
const NODE_COST: f32 = 1.0;
const LEAF_COST: f32 = 1.0;

/// How a subtree is shown in a given number of places.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Choice {
    /// One place: a leaf.
    Leaf,
    /// One place: a wide node of its own.
    Node,
    /// So many places for the left child, the rest for the right one.
    Split(u8),
    /// One place fewer is as good.
    Fewer,
}

/// What is known of a subtree: for 1 to 8 places, the cost and how to reach it.
#[derive(Clone, Copy)]
struct Plan {
    cost: [f32; LANES],
    choice: [Choice; LANES],
    /// Places of the left child if this becomes a wide node.
    left_of_node: u8,
    /// The kind of all primitives below, if they are of one.
    kind: Option<Kind>,
}

pub(super) fn collapse(binary: &Binary, primitives: &[Primitive]) -> Tree {
    let mut wide = Collapse { binary, primitives, plans: plan(binary, primitives), tree: Tree::default() };
    if !binary.nodes.is_empty() {
        wide.tree.root = wide.emit(0, 0);
    }
    wide.tree
}

fn plan(binary: &Binary, primitives: &[Primitive]) -> Vec<Plan> {
    let unknown = Plan { cost: [0.0; LANES], choice: [Choice::Leaf; LANES], left_of_node: 0, kind: None };
    let mut plans = vec![unknown; binary.nodes.len()];
    // Children come after their parents. So do items in leaves: the last leaf holds the last item.
    let mut item = binary.items.len();
    for index in (0..plans.len()).rev() {
        let area = binary.nodes[index].bounds.half_area();
        plans[index] = match binary.children(index) {
            None => {
                item -= 1;
                let kind = Some(Kind::of(&primitives[binary.items[item].prim as usize]));
                Plan { cost: [area * LEAF_COST; LANES], kind, ..unknown }
            }
            Some([left, right]) => plan_inner(&plans[left], &plans[right], area, binary.nodes[index].count),
        };
    }
    plans
}

fn plan_inner(left: &Plan, right: &Plan, area: f32, count: u32) -> Plan {
    let share = |places: usize| {
        let cost = |k: usize| left.cost[k - 1] + right.cost[places - k - 1];
        let best = (1..places).min_by(|&a, &b| cost(a).total_cmp(&cost(b))).unwrap_or(1);
        (cost(best), best as u8)
    };
    let kind = left.kind.filter(|_| left.kind == right.kind);
    let (below, left_of_node) = share(LANES);
    let node = below + area * NODE_COST;
    let leaf = area * LEAF_COST;
    let may_be_leaf = kind.is_some_and(|kind| count as usize <= kind.lanes());
    let mut plan = Plan { cost: [0.0; LANES], choice: [Choice::Fewer; LANES], left_of_node, kind };
    (plan.cost[0], plan.choice[0]) =
        if may_be_leaf && leaf <= node { (leaf, Choice::Leaf) } else { (node, Choice::Node) };
    for places in 2..=LANES {
        let (cost, left_places) = share(places);
        let before = plan.cost[places - 2];
        (plan.cost[places - 1], plan.choice[places - 1]) =
            if cost < before { (cost, Choice::Split(left_places)) } else { (before, Choice::Fewer) };
    }
    plan
}

struct Collapse<'a> {
    binary: &'a Binary,
    primitives: &'a [Primitive],
    plans: Vec<Plan>,
    tree: Tree,
}

impl Collapse<'_> {
    /// Appends the subtree of a binary node, whose first item is `item`, as a leaf or as wide nodes; parents come first.
    fn emit(&mut self, index: usize, item: usize) -> Child {
        if self.plans[index].choice[0] == Choice::Leaf {
            return self.emit_leaf(index, item);
        }
        let wide = self.tree.nodes.len();
        self.tree.nodes.push(Node::new(&[]));
        let mut shown = Vec::with_capacity(LANES);
        if let Some([left, right]) = self.binary.children(index) {
            let left_places = self.plans[index].left_of_node as usize;
            self.show(left, item, left_places, &mut shown);
            self.show(right, item + self.binary.nodes[index].left as usize, LANES - left_places, &mut shown);
        }
        let bounds = |index: usize| self.binary.nodes[index].bounds.into();
        let boxes: Vec<_> = shown.iter().map(|&(index, _)| bounds(index)).collect();
        let children: Vec<_> = shown.iter().map(|&(index, item)| self.emit(index, item)).zip(boxes).collect();
        self.tree.nodes[wide] = Node::new(&children);
        Child::node(wide)
    }

    fn emit_leaf(&mut self, index: usize, item: usize) -> Child {
        let items = &self.binary.items[item..item + self.binary.nodes[index].count as usize];
        let bounds = items.iter().fold(Bounds::EMPTY, |b, item| b.union(item.bounds));
        let primitives = items.iter().map(|item| (item.prim, self.primitives[item.prim as usize]));
        let kind = Kind::of(&self.primitives[items[0].prim as usize]).for_leaf(items.len());
        self.tree.push_leaf(kind, primitives, bounds.longest_side())
    }

    /// The binary nodes, with their first items, that show a subtree in at most so many places.
    fn show(&self, index: usize, item: usize, places: usize, shown: &mut Vec<(usize, usize)>) {
        match (self.plans[index].choice[places - 1], self.binary.children(index)) {
            (Choice::Fewer, _) => self.show(index, item, places - 1, shown),
            (Choice::Split(left_places), Some([left, right])) => {
                self.show(left, item, left_places as usize, shown);
                let right_item = item + self.binary.nodes[index].left as usize;
                self.show(right, right_item, places - left_places as usize, shown);
            }
            _ => shown.push((index, item)),
        }
    }
}
