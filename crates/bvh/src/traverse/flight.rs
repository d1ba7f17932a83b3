//! Several rays in flight: while the memory that one ray needs next is on its way, others are served.
//!
//! Each ray takes one step in turn, to a node or a leaf, and what it will look at next is fetched ahead. That hides the time
//! that a large tree takes to come from memory, and costs some for the change from ray to ray.

use crate::bvh::Bvh;
use crate::filter::{BoxLanes, FilterRay};
use crate::ray::{Hit, Ray};
use crate::search::{Everything, Search};
use crate::simd::{Cpu, Task};
use crate::traverse::leaf::test_leaf;
use crate::traverse::push_children;
use crate::traverse::stack::Stack;
use crate::wide::{Child, Kind, Target, Tree};

/// Rays in flight.
const RAYS: usize = 12;

/// A search for the nearest hit of each ray, or, if `ANY`, for any.
pub(crate) struct Flight<'a, const ANY: bool, F> {
    pub(crate) bvh: &'a Bvh,
    pub(crate) rays: &'a [Ray],
    /// Takes the index of a ray, whether a search for any hit has found one, and the nearest hit.
    pub(crate) land: F,
}

impl<const ANY: bool, F: FnMut(usize, bool, Option<Hit>)> Task for Flight<'_, ANY, F> {
    type Output = ();

    #[inline(always)]
    fn run<C: Cpu>(mut self, cpu: C) {
        let mut waiting = 0..self.rays.len();
        let mut stacks = [const { Stack::new() }; RAYS];
        let mut flying: Vec<Flyer<C>> = Vec::with_capacity(RAYS);
        // A ray that has landed leaves its stack to the next.
        flying.extend(waiting.by_ref().take(RAYS).map(|index| Flyer::new(cpu, self.bvh, self.rays, index, index)));
        while !flying.is_empty() {
            let mut place = 0;
            while place < flying.len() {
                let flyer = &mut flying[place];
                let (is_hit, is_done) = flyer.step::<ANY>(cpu, &self.bvh.tree, &mut stacks[flyer.stack]);
                if !is_done {
                    place += 1;
                    continue;
                }
                (self.land)(flyer.index, is_hit, flyer.search.hit());
                match waiting.next() {
                    Some(index) => *flyer = Flyer::new(cpu, self.bvh, self.rays, index, flyer.stack),
                    None => {
                        flying.swap_remove(place);
                    }
                }
            }
        }
    }
}

/// A ray on its way.
struct Flyer<C: Cpu> {
    next: Child,
    height: usize,
    index: usize,
    boxes: BoxLanes<C>,
    ray: FilterRay,
    search: Search,
    /// Which stack is its own.
    stack: usize,
}

impl<C: Cpu> Flyer<C> {
    #[inline(always)]
    fn new(cpu: C, bvh: &Bvh, rays: &[Ray], index: usize, stack: usize) -> Self {
        let search = Search::new(&rays[index]);
        let ray = FilterRay::new(&search.ray, bvh.reach);
        let boxes = BoxLanes::new(cpu, &ray, bvh.reach);
        Self { next: bvh.tree.root, height: 0, index, boxes, ray, search, stack }
    }

    /// Visits a node or a leaf. Whether the search has found any hit, and whether it is done.
    #[inline(always)]
    fn step<const ANY: bool>(&mut self, cpu: C, tree: &Tree, stack: &mut Stack) -> (bool, bool) {
        let Self { next, height, boxes, ray, search, .. } = self;
        let nearest = match next.target() {
            Target::Node(index) => {
                push_children::<ANY, _>(cpu, tree, tree.node(index), boxes, search.t_max(), stack, height)
            }
            Target::Leaf(kind, block) => {
                if test_leaf::<ANY, _, _>(cpu, tree, kind, block, ray, search, Everything) {
                    return (true, true);
                }
                None
            }
        };
        let Some(child) = nearest.or_else(|| stack.pop(height, search.t_max())) else {
            search.settle(tree, Everything);
            return (false, true);
        };
        *next = child;
        match child.target() {
            Target::Node(index) => cpu.prefetch(&tree.nodes, index),
            Target::Leaf(Kind::Triangles, block) => cpu.prefetch(&tree.triangles, block),
            Target::Leaf(Kind::FewTriangles, block) => cpu.prefetch(&tree.few_triangles, block),
            Target::Leaf(..) => {}
        }
        (false, false)
    }
}
