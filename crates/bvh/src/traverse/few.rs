//! A scene of eight spheres or fewer: one block, without a tree, and without what only a tree needs.

use crate::filter::{FilterRay, meets_spheres};
use crate::ray::{Hit, Ray, RayF64};
use crate::search::Slot;
use crate::simd::{Cpu, LANES, Task};
use crate::wide::{Kind, SphereBlock};

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
        let mut nearest = Hit::none(self.ray.t_max);
        let ray = RayF64::from(self.ray);
        let mut met = meets_spheres::<LANES, C>(cpu, &FilterRay::new(&ray, 0.0), self.block, nearest.t);
        while met != 0 {
            let lane = met.trailing_zeros() as usize & (LANES - 1);
            met &= met - 1;
            let Some(hit) = self.block.sphere(lane).intersect(&ray) else {
                continue;
            };
            let (t, prim) = (hit.t as f32, self.block.id[lane]);
            if t > 0.0 && (t < nearest.t || (t == nearest.t && prim < nearest.prim)) {
                nearest = Hit { t, prim, slot: Slot::new(Kind::Spheres, self.index, lane), ..nearest };
                if ANY {
                    break;
                }
            }
        }
        (nearest.prim != Hit::NO_PRIM).then_some(nearest)
    }
}
