//! The hierarchy.

use glam::{DAffine3, DVec3};

use crate::aabb::Aabb;
use crate::build::{Built, Quality, build, refit};
use crate::error::BuildError;
use crate::geometry::Geometry;
use crate::instance::Instance;
use crate::ray::{Hit, Ray};
use crate::search::{Accept, Everything, Search, Where};
use crate::shape::Surface;
use crate::simd::{Isa, Processor};
use crate::stats::Stats;
use crate::traverse::{FewSpheres, Flight, Walk};
use crate::wide::{Child, Kind, SphereBlock, Target, Tree};

/// Primitives sorted for rays.
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
}

impl Bvh {
    /// The most primitives that a tree holds.
    pub const MAX_PRIMITIVES: usize = Child::MAX_BLOCKS;

    /// Builds the tree, in O(n log n).
    ///
    /// # Errors
    /// Numbers that are not finite, more than [`MAX_PRIMITIVES`](Self::MAX_PRIMITIVES) primitives, instances of what is not
    /// in the list of objects, and more than [`Hit::MAX_NESTING`] instances within each other.
    pub fn build(geometry: &(impl Geometry + ?Sized), quality: Quality) -> Result<Self, BuildError> {
        Ok(Self::new(build(geometry, quality)?))
    }

    fn new(built: Built) -> Self {
        let Built { tree, bounds, stats } = built;
        let reach = if stats.primitives == 0 { 0.0 } else { bounds.lo.abs().max(bounds.hi.abs()).max_element() };
        let nesting = tree.objects.iter().map(|object| object.nesting + 1).max().unwrap_or(0);
        Self { tree, bounds, stats, nesting, reach, cpu: Isa::detect().processor(), is_list: false }
    }

    /// Moves the primitives to where `geometry` has them now, in O(n); the hits are those of a new tree. The more they move
    /// relative to one another, the slower rays become. If there is another number of them, or some have become degenerate
    /// or another shape, the tree is built anew.
    ///
    /// # Errors
    /// As for [`build`](Self::build); the tree is as it was then.
    pub fn refit(&mut self, geometry: &(impl Geometry + ?Sized)) -> Result<(), BuildError> {
        let built = match refit(self.tree.clone(), self.stats, geometry)? {
            Some(built) => built,
            None => build(geometry, Quality::Balanced)?,
        };
        *self = Self { cpu: self.cpu, is_list: self.is_list, ..Self::new(built) };
        Ok(())
    }

    /// As [`build`](Self::build), but every ray tests every primitive: the same hits in time O(n), for comparison.
    ///
    /// # Errors
    /// As for [`build`](Self::build).
    pub fn list(geometry: &(impl Geometry + ?Sized)) -> Result<Self, BuildError> {
        Ok(Self { is_list: true, ..Self::build(geometry, Quality::Balanced)? })
    }

    /// The same tree, walked with other instructions: the same hits, for comparison. What the processor lacks is not used.
    pub fn with_isa(self, isa: Isa) -> Self {
        Self { cpu: isa.processor(), ..self }
    }

    /// The most instances within each other, 0 without any.
    pub(crate) fn nesting(&self) -> usize {
        self.nesting
    }

    /// The box around everything; empty if there is nothing.
    pub fn bounds(&self) -> Aabb {
        self.bounds
    }

    /// What was hit, in the space of the innermost object, at the time of the ray.
    ///
    /// # Panics
    /// If the hit is one of another tree.
    #[inline]
    pub fn surface(&self, hit: &Hit, time: f32) -> Surface {
        let (kind, block, lane) = hit.slot.unpack();
        let innermost = self.instances(hit).last().map_or(self, |(_, object)| object);
        // A hit is never of an instance itself.
        let surface = innermost.tree.primitive(kind, block, lane).surface(time);
        surface.unwrap_or(Surface::Flat { corner: DVec3::ZERO, edges: [DVec3::ZERO; 2] })
    }

    /// From the space of the primitive that was hit to that of the ray, at its time: the identity outside instances.
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
    /// A ray whose numbers are not finite hits nothing or something, but ends.
    #[inline]
    pub fn intersect(&self, ray: &Ray) -> Option<Hit> {
        if let Some((block, index)) = self.few_spheres() {
            return self.cpu.call(FewSpheres::<false> { block, index, ray });
        }
        let mut search = Search::new(ray);
        self.search::<false>(ray, &mut search, &Everything);
        search.hit()
    }

    /// As [`intersect`](Self::intersect), but only those hits count that `accept` returns true for: alpha-tested leaves, say.
    ///
    /// It is asked at least once for the hit that is returned, and otherwise for some hits that lie in front of something or
    /// behind; its answers must depend on the hit alone.
    #[inline]
    pub fn intersect_where(&self, ray: &Ray, accept: impl Fn(&Hit) -> bool) -> Option<Hit> {
        let mut search = Search::new(ray);
        self.search::<false>(ray, &mut search, &Where(accept));
        search.hit()
    }

    /// Whether anything is hit with 0 < t ≤ `t_max`: as [`intersect`](Self::intersect) finds it, in less time.
    #[inline]
    pub fn occluded(&self, ray: &Ray) -> bool {
        match self.few_spheres() {
            Some((block, index)) => self.cpu.call(FewSpheres::<true> { block, index, ray }).is_some(),
            None => self.search::<true>(ray, &mut Search::new(ray), &Everything),
        }
    }

    /// As [`occluded`](Self::occluded), but only those hits count that `accept` returns true for.
    #[inline]
    pub fn occluded_where(&self, ray: &Ray, accept: impl Fn(&Hit) -> bool) -> bool {
        self.search::<true>(ray, &mut Search::new(ray), &Where(accept))
    }

    /// The only block, if it is one of spheres.
    #[inline(always)]
    fn few_spheres(&self) -> Option<(&SphereBlock, usize)> {
        match self.tree.root.target() {
            Target::Leaf(Kind::Spheres, index) if !self.is_list => Some((&self.tree.spheres[index], index)),
            _ => None,
        }
    }

    #[inline(always)]
    fn search<const ANY: bool>(&self, ray: &Ray, search: &mut Search, accept: &impl Accept) -> bool {
        Walk::<ANY, _> { bvh: self, ray, o_error: 0.0, search, accept }.search()
    }

    /// As [`intersect`](Self::intersect), for many rays that go different ways, such as those that surfaces have scattered:
    /// several are in flight at a time, which is faster in large trees, and slower for rays that go together or in small trees.
    ///
    /// # Panics
    /// If there are fewer `hits` than `rays`.
    pub fn intersect_batch(&self, rays: &[Ray], hits: &mut [Option<Hit>]) {
        let hits = &mut hits[..rays.len()];
        if self.is_worth_flying() {
            self.cpu.call(Flight::<false, _> { bvh: self, rays, land: |index: usize, _, hit| hits[index] = hit });
        } else {
            hits.iter_mut().zip(rays).for_each(|(hit, ray)| *hit = self.intersect(ray));
        }
    }

    /// As [`occluded`](Self::occluded), for many rays, as [`intersect_batch`](Self::intersect_batch).
    ///
    /// # Panics
    /// If there are fewer `occluded` than `rays`.
    pub fn occluded_batch(&self, rays: &[Ray], occluded: &mut [bool]) {
        let occluded = &mut occluded[..rays.len()];
        if self.is_worth_flying() {
            self.cpu.call(Flight::<true, _> {
                bvh: self,
                rays,
                land: |index: usize, is_hit, _| occluded[index] = is_hit,
            });
        } else {
            occluded.iter_mut().zip(rays).for_each(|(occluded, ray)| *occluded = self.occluded(ray));
        }
    }

    /// Whether the tree is so large that rays wait for memory.
    fn is_worth_flying(&self) -> bool {
        /// About the memory near a core.
        const NEAR: usize = 1 << 20;
        !self.is_list && self.stats.bytes > NEAR
    }

    /// What the tree is made of.
    pub fn stats(&self) -> Stats {
        self.stats
    }
}
