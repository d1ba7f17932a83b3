//! The hierarchy.

use crate::aabb::Aabb;
use crate::build::{Built, Quality, build, refit};
use crate::error::BuildError;
use crate::geometry::Geometry;
use crate::ray::{Hit, Ray};
use crate::search::{Search, Slot};
use crate::shape::Primitive;
use crate::simd::{Isa, LANES};
use crate::stats::Stats;
use crate::traverse::closest;
use crate::wide::{Child, Kind, Tree};

/// Primitives sorted for rays.
#[derive(Clone, Debug)]
pub struct Bvh {
    pub(crate) tree: Tree,
    bounds: Aabb,
    stats: Stats,
    /// The largest coordinate of `bounds`, by size.
    pub(crate) reach: f32,
    isa: Isa,
    /// Whether rays test everything instead of walking the tree.
    is_list: bool,
}

impl Bvh {
    /// The most primitives that a tree holds.
    pub const MAX_PRIMITIVES: usize = Child::MAX_BLOCKS;

    /// Builds the tree, in O(n log n).
    ///
    /// # Errors
    /// Numbers that are not finite, and more than [`MAX_PRIMITIVES`](Self::MAX_PRIMITIVES) primitives.
    pub fn build(geometry: &(impl Geometry + ?Sized), quality: Quality) -> Result<Self, BuildError> {
        Ok(Self::new(build(geometry, quality)?))
    }

    fn new(built: Built) -> Self {
        let Built { tree, bounds, stats } = built;
        let reach = if stats.primitives == 0 { 0.0 } else { bounds.lo.abs().max(bounds.hi.abs()).max_element() };
        Self { tree, bounds, stats, reach, isa: Isa::detect(), is_list: false }
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
        *self = Self { isa: self.isa, is_list: self.is_list, ..Self::new(built) };
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
        Self { isa, ..self }
    }

    /// The box around everything; empty if there is nothing.
    pub fn bounds(&self) -> Aabb {
        self.bounds
    }

    /// The primitive that was hit.
    #[inline]
    pub fn primitive(&self, hit: &Hit) -> Primitive {
        let (kind, block, lane) = hit.slot.unpack();
        self.tree.primitive(kind, block, lane)
    }

    /// The nearest hit with 0 < t ≤ `t_max`; of several at the same distance, the one of lowest index.
    ///
    /// A ray whose numbers are not finite hits nothing or something, but ends.
    #[inline]
    pub fn intersect(&self, ray: &Ray) -> Option<Hit> {
        if self.is_list { self.intersect_all(ray) } else { closest(self, ray, self.isa) }
    }

    /// Whether anything is hit with 0 < t ≤ `t_max`: as [`intersect`](Self::intersect) finds it, in less time.
    #[inline]
    pub fn occluded(&self, ray: &Ray) -> bool {
        self.intersect(ray).is_some()
    }

    /// As [`intersect`](Self::intersect), for many rays.
    ///
    /// # Panics
    /// If there are fewer `hits` than `rays`.
    pub fn intersect_batch(&self, rays: &[Ray], hits: &mut [Option<Hit>]) {
        for (ray, hit) in rays.iter().zip(&mut hits[..rays.len()]) {
            *hit = self.intersect(ray);
        }
    }

    /// As [`occluded`](Self::occluded), for many rays.
    ///
    /// # Panics
    /// If there are fewer `occluded` than `rays`.
    pub fn occluded_batch(&self, rays: &[Ray], occluded: &mut [bool]) {
        for (ray, occluded) in rays.iter().zip(&mut occluded[..rays.len()]) {
            *occluded = self.occluded(ray);
        }
    }

    /// What the tree is made of.
    pub fn stats(&self) -> Stats {
        self.stats
    }

    fn intersect_all(&self, ray: &Ray) -> Option<Hit> {
        let mut search = Search::new(ray);
        let tree = &self.tree;
        let counts = [
            (Kind::Triangle, tree.triangles.len()),
            (Kind::Quad, tree.quads.len()),
            (Kind::Sphere, tree.spheres.len()),
        ];
        for (kind, count) in counts {
            for (block, lane) in (0..count).flat_map(|block| (0..LANES).map(move |lane| (block, lane))) {
                if tree.id(kind, block, lane) != Hit::NO_PRIM {
                    search.test(tree, Slot::new(kind, block, lane));
                }
            }
        }
        search.hit()
    }
}
