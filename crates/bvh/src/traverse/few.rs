//! A scene of eight spheres or fewer: one block, without a tree, and without what only a tree needs.

use crate::filter::{FilterRay, meets_spheres};
use crate::ray::{Hit, Ray};
use crate::search::{Everything, Search};
use crate::simd::{Cpu, LANES, Task};
use crate::traverse::leaf::test_spheres;
use crate::wide::SphereBlock;

/// A search for the nearest hit, or, if `ANY`, for any.
pub(crate) struct FewSpheres<'a, const ANY: bool> {
    pub(crate) block: &'a SphereBlock,
    /// Where the tree keeps the block.
    pub(crate) index: usize,
    pub(crate) ray: &'a Ray,
}

impl<const ANY: bool> Task for FewSpheres<'_, ANY> {
    type Output = Option<Hit>;

    #[inline(always)]
    fn run<C: Cpu>(self, cpu: C) -> Option<Hit> {
        let mut search = Search::new(self.ray);
        let ray = FilterRay::new(&search.ray, 0.0);
        let met = meets_spheres::<LANES, C>(cpu, &ray, self.block, search.t_max());
        test_spheres::<ANY>(met, self.block, self.index, &mut search, Everything);
        search.hit()
    }
}
