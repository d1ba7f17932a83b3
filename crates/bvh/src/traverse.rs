//! The walk of a ray through the tree, written once for every kind of processor.

use std::mem::MaybeUninit;

use crate::build::MAX_DEPTH;
use crate::bvh::Bvh;
use crate::filter::{BoxLanes, RayLanes};
use crate::ray::{Hit, Ray};
use crate::search::{Search, Slot};
#[cfg(target_arch = "x86_64")]
use crate::simd::Avx2;
#[cfg(target_arch = "aarch64")]
use crate::simd::Neon;
use crate::simd::{Isa, LANES, Scalar, Simd};
use crate::wide::{Child, Kind, Node, Target, Tree};

/// The nearest hit, found with the instructions of choice, if the processor has them.
#[inline]
pub(crate) fn closest(bvh: &Bvh, ray: &Ray, isa: Isa) -> Option<Hit> {
    match isa {
        #[cfg(target_arch = "x86_64")]
        Isa::Avx2 => match Avx2::detect() {
            // SAFETY: `avx2` is the proof that the processor has AVX2 and FMA.
            Some(avx2) => unsafe { walk_avx2(avx2, bvh, ray) },
            None => walk(Scalar, bvh, ray),
        },
        #[cfg(target_arch = "aarch64")]
        Isa::Neon => match Neon::detect() {
            // SAFETY: `neon` is the proof that the processor has NEON.
            Some(neon) => unsafe { walk_neon(neon, bvh, ray) },
            None => walk(Scalar, bvh, ray),
        },
        Isa::Scalar => walk(Scalar, bvh, ray),
    }
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,fma")]
fn walk_avx2(avx2: Avx2, bvh: &Bvh, ray: &Ray) -> Option<Hit> {
    walk(avx2, bvh, ray)
}

#[cfg(target_arch = "aarch64")]
#[target_feature(enable = "neon")]
fn walk_neon(neon: Neon, bvh: &Bvh, ray: &Ray) -> Option<Hit> {
    walk(neon, bvh, ray)
}

/// Visits what the ray may meet, near things first.
#[inline(always)]
fn walk<S: Simd>(s: S, bvh: &Bvh, ray: &Ray) -> Option<Hit> {
    let tree = &bvh.tree;
    let (boxes, lanes) = (BoxLanes::new(s, ray, bvh.reach), RayLanes::new(s, ray));
    let mut search = Search::new(ray);
    let mut stack = Stack::new();
    let mut next = tree.root;
    loop {
        let nearest = match next.target() {
            Target::Node(index) => push_children(s, tree, &tree.nodes[index], &boxes, search.t_max(), &mut stack),
            Target::Leaf(kind, block) => {
                test_leaf(s, tree, kind, block, &lanes, &mut search);
                None
            }
            Target::Nothing => None,
        };
        next = match nearest {
            Some(child) => child,
            None => match stack.pop(search.t_max()) {
                Some(child) => child,
                None => return search.hit(),
            },
        };
    }
}

/// Puts the children that the ray may meet on the stack, the farthest first, but for the nearest, which it returns.
#[inline(always)]
fn push_children<S: Simd>(
    s: S,
    tree: &Tree,
    node: &Node,
    boxes: &BoxLanes<S>,
    t_max: f32,
    stack: &mut Stack,
) -> Option<Child> {
    let (near, mut met) = boxes.meets(s, &node.planes, t_max);
    if met == 0 {
        return None;
    }
    let mut take_lane = || {
        let lane = met.trailing_zeros() as usize & (LANES - 1);
        met &= met - 1;
        (lane, met)
    };
    let (first, mut rest) = take_lane();
    if rest == 0 {
        return Some(node.child[first]);
    }
    let near = s.store(near);
    let base = stack.height;
    let mut lane = first;
    loop {
        let child = node.child[lane];
        prefetch(s, tree, child);
        stack.insert(base, Entry::new(near[lane], child));
        if rest == 0 {
            return stack.pop(f32::INFINITY);
        }
        (lane, rest) = take_lane();
    }
}

#[inline(always)]
fn prefetch<S: Simd>(s: S, tree: &Tree, child: Child) {
    match child.target() {
        Target::Node(index) => s.prefetch(&tree.nodes, index),
        Target::Leaf(Kind::Triangle, block) => s.prefetch(&tree.triangles, block),
        Target::Leaf(Kind::Quad, block) => s.prefetch(&tree.quads, block),
        Target::Leaf(Kind::Sphere, block) => s.prefetch(&tree.spheres, block),
        Target::Nothing => {}
    }
}

/// Tests a leaf: eight primitives at once roughly, those that may be met exactly.
#[inline(always)]
fn test_leaf<S: Simd>(s: S, tree: &Tree, kind: Kind, block: usize, lanes: &RayLanes<S>, search: &mut Search) {
    let t_max = search.t_max();
    let mut met = match kind {
        Kind::Triangle => lanes.meets_corners::<false>(s, &tree.triangles[block], t_max),
        Kind::Quad => lanes.meets_corners::<true>(s, &tree.quads[block], t_max),
        Kind::Sphere => lanes.meets_spheres(s, &tree.spheres[block], t_max),
    };
    while met != 0 {
        let lane = met.trailing_zeros() as usize & (LANES - 1);
        met &= met - 1;
        search.test(tree, Slot::new(kind, block, lane));
    }
}

/// A child and the distance before which the ray is not in its box, in one number that sorts by distance.
#[derive(Clone, Copy)]
struct Entry(u64);

impl Entry {
    #[inline(always)]
    fn new(t: f32, child: Child) -> Self {
        Self(u64::from(t.to_bits()) << 32 | u64::from(child.bits()))
    }

    #[inline(always)]
    fn t(self) -> f32 {
        f32::from_bits((self.0 >> 32) as u32)
    }

    #[inline(always)]
    fn child(self) -> Child {
        Child::from_bits(self.0 as u32)
    }
}

/// What is still to be visited. A level of the tree leaves seven entries at most.
struct Stack {
    entries: [MaybeUninit<Entry>; 7 * MAX_DEPTH + 1],
    height: usize,
}

impl Stack {
    #[inline(always)]
    fn new() -> Self {
        Self { entries: [const { MaybeUninit::uninit() }; 7 * MAX_DEPTH + 1], height: 0 }
    }

    /// Puts an entry where it belongs among those above `base`, of which the nearest is on top.
    #[inline(always)]
    fn insert(&mut self, base: usize, entry: Entry) {
        let mut at = self.height;
        while at > base {
            let below = self.get(at - 1);
            if below.0 >= entry.0 {
                break;
            }
            self.entries[at].write(below);
            at -= 1;
        }
        self.entries[at].write(entry);
        self.height += 1;
    }

    /// The entry on top that is not farther than `t_max`.
    #[inline(always)]
    fn pop(&mut self, t_max: f32) -> Option<Child> {
        while self.height > 0 {
            self.height -= 1;
            let entry = self.get(self.height);
            if entry.t() <= t_max {
                return Some(entry.child());
            }
        }
        None
    }

    #[inline(always)]
    fn get(&self, at: usize) -> Entry {
        // SAFETY: entries below a height that the stack has had were written by `insert`.
        unsafe { self.entries[at].assume_init() }
    }
}
