//! The hierarchy.

use glam::{DAffine3, DVec3};

use crate::aabb::Aabb;
use crate::build::{Built, Quality, build, refit};
use crate::error::BuildError;
use crate::geometry::Geometry;
use crate::instance::Instance;
use crate::ray::{Hit, Ray};
use crate::search::{Everything, Slot, Where};
use crate::shape::Surface;
use crate::simd::{Isa, Processor};
use crate::stats::Stats;
use crate::traverse::{Any, FewSpheres, Flight, Nearest};
use crate::wide::{Kind, SphereBlock, Target, Tree};

/// Primitives sorted for rays.
///
/// It keeps its own copy of the primitives, and what the instances show alive. It can be read from many threads at once; to
/// clone it copies everything but the objects. What holds for hits, and what does not, is told [here](crate#what-is-promised).
#[derive(Clone, Debug)]
pub struct Bvh {
    pub(crate) tree: Tree,
    bounds: Aabb,
    stats: Stats,
    /// Instances within each other.
    nesting: usize,
    /// The largest coordinate of `bounds`, by size.
    pub(crate) reach: f32,
    pub(crate) cpu: Processor,
    /// Whether rays test everything instead of walking the tree.
    pub(crate) is_list: bool,
    /// Whether batches keep several rays in flight.
    flies: bool,
}

impl Bvh {
    /// The most primitives that a tree holds: 134 million, in 67 million leaves of each kind. More are possible in several
    /// objects.
    pub const MAX_PRIMITIVES: usize = 1 << 27;

    /// Builds the tree, in O(n log n), in rayon's current pool of threads. The tree does not depend on how many these are.
    ///
    /// What nothing can hit is left out and counted ([`Stats::degenerate`]): primitives without area or radius, times that end
    /// before they begin, instances of empty objects, and transforms that flatten. Indices are not changed by that. A list
    /// without primitives is allowed.
    ///
    /// # Errors
    /// Numbers that are not finite, more than [`MAX_PRIMITIVES`](Self::MAX_PRIMITIVES) primitives or leaves for them, instances of what is not
    /// in the list of objects, and more than [`Hit::MAX_NESTING`] instances within each other.
    pub fn build(geometry: &(impl Geometry + ?Sized), quality: Quality) -> Result<Self, BuildError> {
        Ok(Self::new(build(geometry, quality)?))
    }

    fn new(built: Built) -> Self {
        let Built { tree, bounds, stats } = built;
        let reach = if stats.primitives == 0 { 0.0 } else { bounds.lo.abs().max(bounds.hi.abs()).max_element() };
        let nesting = tree.objects.iter().map(|object| object.nesting + 1).max().unwrap_or(0);
        /// In between the trees for which it did not pay and those for which it did (docs/performance.md).
        const LARGE: usize = 96 << 20;
        let flies = stats.bytes > LARGE;
        Self { tree, bounds, stats, nesting, reach, cpu: Isa::detect().processor(), is_list: false, flies }
    }

    /// Moves the primitives to where `geometry` has them now, in O(n), in rayon's current pool; the hits are those of a new
    /// tree. The more they move relative to one another, the slower rays become: compare [`Stats::sah_cost`]. If there is
    /// another number of them, or some have become degenerate or another shape, the tree is built anew, as
    /// [`Quality::Balanced`]. For a while there are two trees in memory.
    ///
    /// A tree shows its objects as they were given to it. Where these have changed, it is refitted with the new ones, too.
    ///
    /// # Errors
    /// As for [`build`](Self::build); the tree is as it was then.
    pub fn refit(&mut self, geometry: &(impl Geometry + ?Sized)) -> Result<(), BuildError> {
        let built = match refit(self.tree.clone(), self.stats, geometry)? {
            Some(built) => built,
            None => build(geometry, Quality::Balanced)?,
        };
        *self = Self { cpu: self.cpu, is_list: self.is_list, flies: self.flies, ..Self::new(built) };
        Ok(())
    }

    /// As [`build`](Self::build), but every ray tests every primitive: the same hits in time O(n), for comparison. Objects that
    /// instances show are what they were built as.
    ///
    /// # Errors
    /// As for [`build`](Self::build).
    pub fn list(geometry: &(impl Geometry + ?Sized)) -> Result<Self, BuildError> {
        Ok(Self { is_list: true, flies: false, ..Self::build(geometry, Quality::Balanced)? })
    }

    /// The same tree, walked with other instructions: the same hits, for comparison. What the processor lacks is not used. Of
    /// objects that instances show, each keeps to its own.
    pub fn with_isa(self, isa: Isa) -> Self {
        Self { cpu: isa.processor(), ..self }
    }

    /// The same tree, whose batches keep several rays in flight or do not, however large it is: the same hits, for comparison.
    pub fn with_rays_in_flight(self, flies: bool) -> Self {
        Self { flies: flies && !self.is_list, ..self }
    }

    /// The most instances within each other, 0 without any.
    pub(crate) fn nesting(&self) -> usize {
        self.nesting
    }

    /// The box around everything at all times; [empty](Aabb::EMPTY) if there is nothing. Wider than what is in it by a few
    /// roundings, and around instances by what the box of their object leaves in the corners.
    pub fn bounds(&self) -> Aabb {
        self.bounds
    }

    /// What was hit, in the space of the innermost object, at the `time` of the ray. The point is there at the hit's `u` and
    /// `v`, for triangles and quads in double precision; [`to_world`](Self::to_world) takes it to the space of the ray.
    ///
    /// Takes O(log n) for each instance, otherwise O(1). The hit must be one of this tree since it was last refitted.
    ///
    /// # Panics
    /// Maybe, if the hit is one of another tree; or the surface is another one.
    #[inline]
    pub fn surface(&self, hit: &Hit, time: f32) -> Surface {
        let (kind, block, lane) = hit.slot.unpack();
        let innermost = self.instances(hit).last().map_or(self, |(_, object)| object);
        // A hit is never of an instance itself.
        let surface = innermost.tree.primitive(kind, block, lane).surface(time);
        surface.unwrap_or(Surface::Flat { corner: DVec3::ZERO, edges: [DVec3::ZERO; 2] })
    }

    /// Where each primitive is kept, by its index, for [`Ray::apart`]: [`Slot::NONE`] for what cannot be hit. Of one that is kept
    /// in several places, any.
    pub fn slots(&self) -> Vec<Slot> {
        let mut slots = Vec::new();
        for (kind, blocks) in self.tree.blocks() {
            for (block, lane) in (0..blocks).flat_map(|block| (0..kind.lanes()).map(move |lane| (block, lane))) {
                if self.tree.is_used(kind, block, lane) {
                    let id = self.tree.id(kind, block, lane) as usize;
                    slots.resize(slots.len().max(id + 1), Slot::NONE);
                    slots[id] = Slot::new(kind, block, lane);
                }
            }
        }
        slots
    }

    /// From the space of the primitive that was hit to that of the ray, at its `time`: the identity outside instances. For
    /// normals, that is the transposed inverse of the matrix. Costs what [`surface`](Self::surface) does.
    pub fn to_world(&self, hit: &Hit, time: f32) -> DAffine3 {
        let transforms = self.instances(hit).map(|(instance, _)| instance.to_world(time).unwrap_or(DAffine3::IDENTITY));
        transforms.fold(DAffine3::IDENTITY, |outer, inner| outer * inner)
    }

    /// The instances through which a hit was found, with what they show, the outermost first.
    fn instances(&self, hit: &Hit) -> impl Iterator<Item = (Instance, &Self)> {
        let indices = hit.instances.into_iter().take_while(|&index| index != Hit::NO_INSTANCE);
        indices.scan(self, |outer, index| {
            let instance = outer.tree.instances.get(outer.tree.block_of_instance(index)?)?.instance;
            *outer = outer.tree.objects.get(instance.object as usize)?;
            Some((instance, *outer))
        })
    }

    /// The nearest hit with 0 < t ≤ `t_max`; of several at the same distance, the one of lowest index.
    ///
    /// About O(log n) for usual scenes, and O(n) at worst. A ray whose numbers are not finite hits nothing or something, but
    /// ends.
    #[inline]
    pub fn intersect(&self, ray: &Ray) -> Option<Hit> {
        if let Some((block, index)) = self.few_spheres() {
            return self.cpu.call(FewSpheres::<false> { block, index, ray });
        }
        self.cpu.call(Nearest { bvh: self, ray, accept: Everything })
    }

    /// As [`intersect`](Self::intersect), but only those hits count that `accept` returns true for: alpha-tested leaves, say.
    ///
    /// It is asked at least once for the hit that is returned, and otherwise for some hits that lie in front of something or
    /// behind, in no certain order, for some more than once; its answers must depend on the hit alone. What is rejected is as
    /// if it were not there. A primitive has one hit: a sphere that is rejected where the ray enters is passed.
    ///
    /// Takes longer than [`intersect`](Self::intersect), as every hit must be known exactly.
    #[inline]
    pub fn intersect_where(&self, ray: &Ray, accept: impl Fn(&Hit) -> bool) -> Option<Hit> {
        self.cpu.call(Nearest { bvh: self, ray, accept: Where(&accept) })
    }

    /// Whether anything is hit with 0 < t ≤ `t_max`: exactly if [`intersect`](Self::intersect) finds something, in less time.
    #[inline]
    pub fn occluded(&self, ray: &Ray) -> bool {
        match self.few_spheres() {
            Some((block, index)) => self.cpu.call(FewSpheres::<true> { block, index, ray }).is_some(),
            None => self.cpu.call(Any { bvh: self, ray, accept: Everything }),
        }
    }

    /// As [`occluded`](Self::occluded), but only those hits count that `accept` returns true for, under the conditions of
    /// [`intersect_where`](Self::intersect_where).
    #[inline]
    pub fn occluded_where(&self, ray: &Ray, accept: impl Fn(&Hit) -> bool) -> bool {
        self.cpu.call(Any { bvh: self, ray, accept: Where(&accept) })
    }

    /// The only block, if it is one of spheres.
    #[inline(always)]
    fn few_spheres(&self) -> Option<(&SphereBlock, usize)> {
        match self.tree.root.target() {
            Target::Leaf(Kind::Spheres, index) if !self.is_list => Some((&self.tree.spheres[index], index)),
            _ => None,
        }
    }

    /// As [`intersect`](Self::intersect), for many rays that go different ways, such as those that surfaces have scattered:
    /// `hits[i]` is what `rays[i]` finds. In trees above 96 MiB, several are in flight at a time: faster for such rays, and slower
    /// for rays that go together. It runs on the thread that calls it.
    ///
    /// # Panics
    /// If there are fewer `hits` than `rays`.
    pub fn intersect_batch(&self, rays: &[Ray], hits: &mut [Option<Hit>]) {
        let hits = &mut hits[..rays.len()];
        if self.flies {
            self.cpu.call(Flight::<false, _> { bvh: self, rays, land: |index: usize, _, hit| hits[index] = hit });
        } else {
            hits.iter_mut().zip(rays).for_each(|(hit, ray)| *hit = self.intersect(ray));
        }
    }

    /// As [`occluded`](Self::occluded), for many rays, as [`intersect_batch`](Self::intersect_batch): `occluded[i]` is true if
    /// `rays[i]` hits anything.
    ///
    /// # Panics
    /// If there are fewer `occluded` than `rays`.
    pub fn occluded_batch(&self, rays: &[Ray], occluded: &mut [bool]) {
        let occluded = &mut occluded[..rays.len()];
        if self.flies {
            self.cpu.call(Flight::<true, _> {
                bvh: self,
                rays,
                land: |index: usize, is_hit, _| occluded[index] = is_hit,
            });
        } else {
            occluded.iter_mut().zip(rays).for_each(|(occluded, ray)| *occluded = self.occluded(ray));
        }
    }

    /// What the tree is made of, in O(1).
    pub fn stats(&self) -> Stats {
        self.stats
    }
}
