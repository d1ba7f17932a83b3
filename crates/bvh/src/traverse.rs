//! The hierarchy and the walk through it.

use crate::aabb::Aabb;
use crate::build::{MAX_DEPTH, build};
use crate::node::{Child, Node, NodeRay};
use crate::primitive::Primitive;
use crate::ray::{Hit, Ray, RayF64};

/// Primitives sorted for rays.
#[derive(Clone, Debug)]
pub struct Bvh {
    /// Four-wide nodes, the root first; none if the primitives are a plain list.
    nodes: Vec<Node>,
    /// In the order of the leaves.
    prims: Vec<Primitive>,
    /// The box of each of `prims`.
    boxes: Vec<Aabb>,
    /// Index of each of `prims` in the list that the caller gave.
    ids: Vec<u32>,
    bounds: Aabb,
}

impl Bvh {
    /// The most primitives that a tree can hold.
    pub const MAX_PRIMITIVES: usize = Child::MAX_SLOTS;

    /// Builds the tree, in O(n log n).
    ///
    /// # Panics
    /// Above [`MAX_PRIMITIVES`](Self::MAX_PRIMITIVES).
    pub fn build(prims: Vec<Primitive>) -> Self {
        let tree = build(&prims);
        let sorted = tree.order.iter().map(|&i| prims[i as usize]).collect();
        Self::new(tree.nodes, sorted, tree.order)
    }

    /// Keeps the primitives as a list, every one of which is tested by every ray: the same hits in time O(n),
    /// for comparison.
    pub fn list(prims: Vec<Primitive>) -> Self {
        let ids = (0..prims.len() as u32).collect();
        Self::new(Vec::new(), prims, ids)
    }

    fn new(nodes: Vec<Node>, prims: Vec<Primitive>, ids: Vec<u32>) -> Self {
        let boxes: Vec<_> = prims.iter().map(Primitive::bounds).collect();
        let bounds = boxes.iter().fold(Aabb::EMPTY, |whole, &b| whole.union(b));
        Self { nodes, prims, boxes, ids, bounds }
    }

    /// The box around everything; empty if there is nothing.
    pub fn bounds(&self) -> Aabb {
        self.bounds
    }

    /// The primitive that was hit.
    #[inline]
    pub fn primitive(&self, hit: &Hit) -> &Primitive {
        &self.prims[hit.slot as usize]
    }

    /// The nearest hit with 0 < t ≤ `t_max`; of several at the same distance, the one of lowest index.
    ///
    /// A ray whose numbers are not finite hits nothing or something, but ends.
    #[inline]
    pub fn intersect(&self, ray: &Ray) -> Option<Hit> {
        let mut search = Search { ray: RayF64::from(ray), node_ray: NodeRay::from(ray), nearest: Hit::none(ray.t_max) };
        if self.nodes.is_empty() {
            self.test_slots(0..self.prims.len(), &mut search);
        } else {
            self.walk(&mut search);
        }
        (search.nearest.prim != Hit::NO_PRIM).then_some(search.nearest)
    }

    /// Visits the nodes that the ray meets, near ones first.
    fn walk(&self, search: &mut Search) {
        let mut stack = [(0.0_f32, Child::ROOT); STACK];
        let mut height = 0;
        let mut next = Child::ROOT;
        loop {
            match next.unpack() {
                Ok(slots) => self.test_slots(slots, search),
                Err(index) => {
                    let node = &self.nodes[index];
                    let (near, met) = node.intersect(&search.node_ray, search.nearest.t);
                    let mut met = met.bitmask();
                    let entry = |lane: u32| (near[lane as usize], node.child[lane as usize]);
                    if met.is_power_of_two() {
                        next = entry(met.trailing_zeros()).1;
                        continue;
                    }
                    let base = height;
                    while met != 0 {
                        let entry = entry(met.trailing_zeros());
                        met &= met - 1;
                        // Insert so that the nearest lies on top.
                        let mut at = height;
                        while at > base && stack[at - 1].0 < entry.0 {
                            stack[at] = stack[at - 1];
                            at -= 1;
                        }
                        stack[at] = entry;
                        height += 1;
                    }
                }
            }
            next = loop {
                if height == 0 {
                    return;
                }
                height -= 1;
                let (t, child) = stack[height];
                if t <= search.nearest.t * SLACK {
                    break child;
                }
            };
        }
    }

    #[inline]
    fn test_slots(&self, slots: std::ops::Range<usize>, search: &mut Search) {
        for slot in slots {
            let Some(hit) = self.prims[slot].intersect(&search.ray).filter(|hit| hit.t as f32 <= search.nearest.t)
            else {
                continue;
            };
            if let Some(t) = search.node_ray.confirm(hit.t as f32, self.boxes[slot]) {
                search.offer(Hit { t, prim: self.ids[slot], u: hit.u as f32, v: hit.v as f32, slot: slot as u32 });
            }
        }
    }
}

/// Each level of the four-wide tree leaves at most three entries behind, and has no more levels than the binary one.
const STACK: usize = 3 * MAX_DEPTH + 1;

/// Entry distances are rounded; a box is skipped only if it is farther by more than that.
const SLACK: f32 = 1.0 + 1e-6;

/// A ray and the nearest hit so far.
struct Search {
    ray: RayF64,
    node_ray: NodeRay,
    nearest: Hit,
}

impl Search {
    #[inline]
    fn offer(&mut self, hit: Hit) {
        let nearest = &mut self.nearest;
        // A distance may have been rounded to 0.
        if hit.t > 0.0 && (hit.t < nearest.t || (hit.t == nearest.t && hit.prim < nearest.prim)) {
            *nearest = hit;
        }
    }
}
