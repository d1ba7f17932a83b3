//! The walk of a ray through the tree, written once for every kind of processor.

mod few;
mod flight;
mod leaf;
mod list;
mod stack;

pub(crate) use few::FewSpheres;
pub(crate) use flight::Flight;

use crate::bvh::Bvh;
use crate::filter::{BoxLanes, FilterRay};
use crate::ray::{Hit, Ray};
use crate::search::{Accept, Search};
use crate::simd::{Cpu, LANES, Simd, Task};
use crate::traverse::leaf::test_leaf;
use crate::traverse::stack::{Entry, Stack};
use crate::wide::{Child, Node, Target, Tree};

/// A search for the nearest hit.
pub(crate) struct Nearest<'a, A> {
    pub(crate) bvh: &'a Bvh,
    pub(crate) ray: &'a Ray,
    pub(crate) accept: A,
}

impl<A: Accept> Task for Nearest<'_, A> {
    type Output = Option<Hit>;

    #[inline(always)]
    fn run<C: Cpu>(self, cpu: C) -> Option<Hit> {
        let mut search = Search::new(self.ray);
        walk::<false, _, _>(cpu, self.bvh, &mut search, self.accept);
        search.finish(&self.bvh.tree, self.accept)
    }
}

/// A search for any hit, which ends with the first: whether there is one.
pub(crate) struct Any<'a, A> {
    pub(crate) bvh: &'a Bvh,
    pub(crate) ray: &'a Ray,
    pub(crate) accept: A,
}

impl<A: Accept> Task for Any<'_, A> {
    type Output = bool;

    #[inline(always)]
    fn run<C: Cpu>(self, cpu: C) -> bool {
        walk::<true, _, _>(cpu, self.bvh, &mut Search::new(self.ray), self.accept)
    }
}

/// Either search, within an instance.
struct Within<'a, const ANY: bool, A> {
    object: &'a Bvh,
    search: &'a mut Search,
    accept: A,
}

impl<const ANY: bool, A: Accept> Task for Within<'_, ANY, A> {
    type Output = bool;

    #[inline(always)]
    fn run<C: Cpu>(self, cpu: C) -> bool {
        let is_hit = walk::<ANY, _, _>(cpu, self.object, self.search, self.accept);
        self.search.settle(&self.object.tree, self.accept);
        is_hit
    }
}

/// Visits what the ray may meet, near things first; whether it has ended with a hit, if `ANY`. Otherwise a hit may be pending.
#[inline(always)]
fn walk<const ANY: bool, C: Cpu, A: Accept>(cpu: C, bvh: &Bvh, search: &mut Search, accept: A) -> bool {
    let tree = &bvh.tree;
    if bvh.is_list {
        return list::test_all::<ANY>(tree, search, accept);
    }
    let ray = FilterRay::new(&search.ray, bvh.reach);
    let mut next = tree.root;
    let boxes = match next.target() {
        Target::Node(_) => BoxLanes::new(cpu, &ray, bvh.reach),
        // Few primitives have no boxes.
        Target::Leaf(..) => BoxLanes::unused(cpu),
    };
    let (mut stack, mut height) = (Stack::new(), 0);
    loop {
        let nearest = match next.target() {
            Target::Node(index) => {
                let node = tree.node(index);
                push_children::<ANY, _>(cpu, tree, node, &boxes, search.t_max(), &mut stack, &mut height)
            }
            Target::Leaf(kind, block) => {
                if test_leaf::<ANY, _, _>(cpu, tree, kind, block, &ray, search, accept) {
                    return true;
                }
                None
            }
        };
        next = match nearest {
            Some(child) => child,
            None => match stack.pop(&mut height, search.t_max()) {
                Some(child) => child,
                None => break,
            },
        };
    }
    false
}

/// Puts the children that the ray may meet on the stack, the farthest first, but for the nearest, which it returns. If `ANY`, in
/// no order.
#[inline(always)]
fn push_children<const ANY: bool, C: Cpu>(
    cpu: C,
    tree: &Tree,
    node: &Node,
    boxes: &BoxLanes<C>,
    t_max: f32,
    stack: &mut Stack,
    height: &mut usize,
) -> Option<Child> {
    let (near, mut met) = boxes.meets(cpu, &node.planes, t_max);
    if met == 0 {
        return None;
    }
    let first = take_lane(&mut met);
    if met == 0 {
        return Some(node.child[first]);
    }
    if ANY {
        while met != 0 {
            let child = node.child[take_lane(&mut met)];
            prefetch(cpu, tree, child);
            stack.push(height, Entry::new(0.0, child));
        }
        return Some(node.child[first]);
    }
    let near = Simd::<LANES>::store(cpu, near);
    let entry = |lane: usize| {
        prefetch(cpu, tree, node.child[lane]);
        Entry::new(near[lane], node.child[lane])
    };
    let (a, b) = (entry(first), entry(take_lane(&mut met)));
    let (nearer, farther) = (a.min(b), a.max(b));
    let base = *height;
    stack.push(height, farther);
    if met == 0 {
        return Some(nearer.child());
    }
    stack.push(height, nearer);
    while met != 0 {
        stack.insert(base, height, entry(take_lane(&mut met)));
    }
    stack.pop(height, f32::INFINITY)
}

/// Takes the lowest lane off a set that is not empty.
#[inline(always)]
fn take_lane(lanes: &mut u32) -> usize {
    let lane = lanes.trailing_zeros() as usize & (LANES - 1);
    *lanes &= *lanes - 1;
    lane
}

/// Leaves are not worth the branch.
#[inline(always)]
fn prefetch<C: Cpu>(cpu: C, tree: &Tree, child: Child) {
    if let Target::Node(index) = child.target() {
        cpu.prefetch(&tree.nodes, index);
    }
}
