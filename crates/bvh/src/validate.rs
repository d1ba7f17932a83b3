//! Whether a tree is what rays rely on.

use crate::aabb::Aabb;
use crate::build::MAX_DEPTH;
use crate::bvh::Bvh;
use crate::ray::Hit;
use crate::simd::LANES;
use crate::wide::{Child, Kind, Target, Tree};

impl Bvh {
    /// Checks the tree: every node and leaf is there and reached once, no path is too long, boxes hold what is below them,
    /// and every primitive is in a leaf; in several only where spatial splits cut it. In O(n), for tests: what builds and refits
    /// is right without it. Objects that instances show are not checked.
    ///
    /// # Errors
    /// What is wrong.
    pub fn validate(&self) -> Result<(), String> {
        let mut check = Check::new(&self.tree);
        check.visit(self.tree.root, self.bounds(), 0)?;
        check.all_reached()?;
        check.primitives(self.stats().primitives, self.stats().references)
    }
}

struct Check<'a> {
    tree: &'a Tree,
    nodes: Vec<bool>,
    leaves: [Vec<bool>; Kind::COUNT],
    /// For each primitive: references, the box around the leaves that hold it, and its own box.
    found: Vec<(usize, Aabb, Aabb)>,
}

impl<'a> Check<'a> {
    fn new(tree: &'a Tree) -> Self {
        let mut leaves = [const { Vec::new() }; Kind::COUNT];
        for (kind, blocks) in tree.blocks() {
            leaves[kind as usize] = vec![false; blocks];
        }
        Self { tree, nodes: vec![false; tree.nodes.len()], leaves, found: Vec::new() }
    }

    fn visit(&mut self, child: Child, bounds: Aabb, depth: usize) -> Result<(), String> {
        if depth > MAX_DEPTH {
            return Err(format!("a path is longer than {MAX_DEPTH}"));
        }
        match child.target() {
            Target::Leaf(Kind::Nothing, _) => Ok(()),
            Target::Node(index) => {
                reach(&mut self.nodes, index, "node")?;
                let node = &self.tree.nodes[index];
                for lane in (0..LANES).filter(|&lane| node.child[lane] != Child::NONE) {
                    if !holds(bounds, node.bounds(lane)) {
                        return Err(format!("the box of lane {lane} of node {index} is not in that of the node"));
                    }
                    self.visit(node.child[lane], node.bounds(lane), depth + 1)?;
                }
                Ok(())
            }
            Target::Leaf(kind, block) => {
                reach(&mut self.leaves[kind as usize], block, "leaf")?;
                self.leaf(kind, block, bounds)
            }
        }
    }

    fn leaf(&mut self, kind: Kind, block: usize, bounds: Aabb) -> Result<(), String> {
        let count = self.tree.count(kind, block);
        if count == 0 {
            return Err(format!("leaf {block} is empty"));
        }
        let ids: Vec<_> = (0..count).map(|lane| self.tree.id(kind, block, lane)).collect();
        for (lane, &id) in ids.iter().enumerate() {
            if id == Hit::NO_PRIM || ids[..lane].contains(&id) {
                return Err(format!("leaf {block} holds primitive {id} twice"));
            }
            if self.found.len() <= id as usize {
                self.found.resize(id as usize + 1, (0, Aabb::EMPTY, Aabb::EMPTY));
            }
            let (references, leaves, own) = &mut self.found[id as usize];
            (*references, *leaves) = (*references + 1, leaves.union(bounds));
            *own = self.tree.primitive(kind, block, lane).bounds(&self.tree.objects);
        }
        Ok(())
    }

    fn all_reached(&self) -> Result<(), String> {
        let leaves = self.leaves.iter().flatten();
        let lost = self.nodes.iter().chain(leaves).filter(|reached| !**reached).count();
        if lost > 0 { Err(format!("{lost} nodes and leaves are out of reach")) } else { Ok(()) }
    }

    fn primitives(&self, expected: usize, references: usize) -> Result<(), String> {
        let found = self.found.iter().filter(|found| found.0 > 0).count();
        if found != expected {
            return Err(format!("{found} primitives instead of {expected} are in leaves"));
        }
        let in_leaves: usize = self.found.iter().map(|found| found.0).sum();
        if in_leaves != references {
            return Err(format!("{in_leaves} references instead of {references}"));
        }
        let is_cut = references > expected;
        for (id, &(_, leaves, own)) in self.found.iter().enumerate() {
            // Parts have margins of their own.
            let least = if is_cut { without_margin(own) } else { own };
            if !holds(leaves, least) {
                return Err(format!("primitive {id} is larger than its leaves"));
            }
        }
        Ok(())
    }
}

fn reach(reached: &mut [bool], index: usize, what: &str) -> Result<(), String> {
    match reached.get_mut(index) {
        Some(reached) if !*reached => {
            *reached = true;
            Ok(())
        }
        Some(_) => Err(format!("{what} {index} is reached twice")),
        None => Err(format!("there is no {what} {index}")),
    }
}

fn holds(outer: Aabb, inner: Aabb) -> bool {
    outer.union(inner) == outer
}

fn without_margin(bounds: Aabb) -> Aabb {
    let margin = |p: glam::Vec3| p.abs() * (8.0 * f32::EPSILON) + 1e-17;
    Aabb { lo: bounds.lo + margin(bounds.lo), hi: bounds.hi - margin(bounds.hi) }
}
