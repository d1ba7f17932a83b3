//! Leaves: many primitives at once roughly, those that may be met exactly.

use crate::filter::{Block, FilterRay, Flats, Outline, View, meets_spheres};
use crate::search::{Accept, Search, Slot};
use crate::simd::{Cpu, LANES, Simd, Task};
use crate::traverse::{Within, take_lane};
use crate::wide::{FEW, Kind, SphereBlock, Tree};

/// Tests the primitives of a leaf; whether one is hit, if `ANY`. All but triangles are tested out of line, so that the walk
/// keeps its registers for these.
#[inline(always)]
pub(super) fn test_leaf<const ANY: bool, C: Cpu, A: Accept>(
    cpu: C,
    tree: &Tree,
    kind: Kind,
    block: usize,
    ray: &FilterRay,
    search: &mut Search,
    accept: A,
) -> bool {
    let leaf = Leaf { tree, kind, block };
    match kind {
        Kind::Triangles => {
            let b = &tree.triangles[block];
            let outline = View::<LANES, C>::new(cpu, ray).triangles(&b.points);
            leaf.test_flats::<ANY, LANES, _, _>(cpu, ray, b.block(), &outline, search, accept)
        }
        Kind::FewTriangles => {
            let b = &tree.few_triangles[block];
            let outline = View::<FEW, C>::new(cpu, ray).triangles(&b.points);
            leaf.test_flats::<ANY, FEW, _, _>(cpu, ray, b.block(), &outline, search, accept)
        }
        _ => cpu.call(OtherLeaf::<ANY, A> { leaf, ray, search, accept }),
    }
}

/// A leaf of quads, spheres, moving triangles or an instance.
struct OtherLeaf<'a, const ANY: bool, A> {
    leaf: Leaf<'a>,
    ray: &'a FilterRay,
    search: &'a mut Search,
    accept: A,
}

impl<const ANY: bool, A: Accept> Task for OtherLeaf<'_, ANY, A> {
    type Output = bool;

    #[inline(always)]
    fn run<C: Cpu>(self, cpu: C) -> bool {
        let Self { leaf, ray, search, accept } = self;
        let (tree, block) = (leaf.tree, leaf.block);
        match leaf.kind {
            Kind::Quads => {
                let b = &tree.quads[block];
                let outline = View::<LANES, C>::new(cpu, ray).quads(&b.points);
                leaf.test_flats::<ANY, LANES, _, _>(cpu, ray, b.block(), &outline, search, accept)
            }
            Kind::Spheres => {
                let met = meets_spheres::<LANES, C>(cpu, ray, &tree.spheres[block], search.t_max());
                if met != 0 {
                    search.settle(tree, accept);
                }
                test_spheres::<ANY>(met, &tree.spheres[block], block, search, accept)
            }
            Kind::Moving => {
                let (b, time) = (&tree.moving[block], search.ray.time);
                let outline = View::<FEW, C>::new(cpu, ray).triangles(&b.points_at(time));
                leaf.test_flats::<ANY, FEW, _, _>(cpu, ray, b.block_at(time), &outline, search, accept)
            }
            Kind::Instance => test_instance::<ANY>(tree, block, search, accept),
            Kind::Triangles | Kind::FewTriangles | Kind::Nothing => false,
        }
    }
}

/// A block of primitives.
struct Leaf<'a> {
    tree: &'a Tree,
    kind: Kind,
    block: usize,
}

impl Leaf<'_> {
    /// Triangles or quads: notes certain hits, and tests what may be hit.
    #[inline(always)]
    fn test_flats<const ANY: bool, const N: usize, S: Simd<N>, A: Accept>(
        &self,
        s: S,
        ray: &FilterRay,
        block: Block,
        outline: &impl Outline<N, S>,
        search: &mut Search,
        accept: A,
    ) -> bool {
        let block = Block { used: block.used & !search.apart(self.kind, self.block), ..block };
        let Some(flats) = Flats::meet(s, ray, block, outline, search.range()) else {
            return false;
        };
        // Whether a hit is accepted is known only when it is known exactly.
        if !A::EVERYTHING {
            return self.test::<ANY>(flats.met, search, accept);
        }
        let certain = flats.certain(s, search.t_max());
        if ANY {
            return certain != 0 || self.test::<ANY>(flats.met, search, accept);
        }
        let (near, far) = flats.distances(s);
        let mut met = flats.met;
        while met != 0 {
            let lane = take_lane(&mut met) & (N - 1);
            let slot = Slot::new(self.kind, self.block, lane);
            if certain >> lane & 1 == 0 {
                search.test(self.tree, slot, accept);
            } else if far[lane] < search.t_max() {
                search.certain(self.tree, slot, near[lane], far[lane], accept);
            } else if near[lane] <= search.t_max() {
                search.test(self.tree, slot, accept);
            }
        }
        false
    }

    /// Tests what may be hit.
    #[inline(always)]
    fn test<const ANY: bool>(&self, mut met: u32, search: &mut Search, accept: impl Accept) -> bool {
        while met != 0 {
            let lane = take_lane(&mut met);
            search.test(self.tree, Slot::new(self.kind, self.block, lane), accept);
            if ANY && search.found() {
                return true;
            }
        }
        false
    }
}

/// Tests the spheres that may be hit; nothing must be pending if there are any.
#[inline(always)]
pub(super) fn test_spheres<const ANY: bool>(
    met: u32,
    spheres: &SphereBlock,
    block: usize,
    search: &mut Search,
    accept: impl Accept,
) -> bool {
    let mut met = met & !search.apart(Kind::Spheres, block);
    while met != 0 {
        let lane = take_lane(&mut met);
        if let Some(hit) = spheres.sphere(lane).intersect(&search.ray) {
            search.offer(&hit, spheres.id[lane], Slot::new(Kind::Spheres, block, lane), accept);
            if ANY && search.found() {
                return true;
            }
        }
    }
    false
}

/// Goes on within an instance.
#[inline(never)]
pub(super) fn test_instance<const ANY: bool>(
    tree: &Tree,
    block: usize,
    search: &mut Search,
    accept: impl Accept,
) -> bool {
    search.settle(tree, accept);
    let instance = &tree.instances[block].instance;
    let object = &*tree.objects[instance.object as usize];
    let Some(entry) = search.ray.enters(instance.bounds(object)) else {
        return false;
    };
    let Some(ray) = instance.ray_in_object(&search.ray) else {
        return false;
    };
    let Some(mut inner) = search.enter(ray, tree.instances[block].id, entry as f32) else {
        return false;
    };
    let is_hit = object.cpu.call(Within::<ANY, _> { object, search: &mut inner, accept });
    search.leave(&inner);
    is_hit
}
