//! Rays and hits.

use glam::{DVec2, DVec3, Vec3};

use crate::aabb::Aabb;
use crate::search::Slot;

/// A half line from `o` along `d`, looked at for `0 < t <= t_max`.
///
/// `d` may have any length from 1e-18 to 1e18, and not be zero; `t` counts in multiples of it. Within instances the same holds
/// for the transformed direction. With other numbers, rays end, but what they hit is not specified.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Origin.
    pub o: Vec3,
    /// Direction; not zero.
    pub d: Vec3,
    /// Hits farther than this do not count, those at this distance do. Infinite by default; at 0 or below, nothing is hit.
    pub t_max: f32,
    /// When it is traced, in the time of the motion keys: usually 0 at the first, 1 at the last. 0 by default. Of no
    /// importance where nothing moves.
    pub time: f32,
    /// Primitives that the ray is known not to meet, so that they need not be tested: the flat one that it begins on, say, and
    /// the one that it goes to and ends before. None by default. Should it meet one nevertheless, that is found or is not.
    pub apart: [Slot; 2],
}

impl Ray {
    /// A ray of infinite length, at time 0.
    pub fn new(o: Vec3, d: Vec3) -> Self {
        Self { o, d, t_max: f32::INFINITY, time: 0.0, apart: [Slot::NONE; 2] }
    }
}

/// The axes in cyclic order, each in turn as the last.
static ORDERS: [[usize; 3]; 3] = [[1, 2, 0], [2, 0, 1], [0, 1, 2]];

/// The axis of the largest of three sizes.
#[inline(always)]
fn longest(size: [f64; 3]) -> usize {
    let yz = 2 - usize::from(size[1] > size[2]);
    if size[0] > size[yz] { 0 } else { yz }
}

/// Where a ray met a primitive. It stands for itself; [`Bvh::surface`](crate::Bvh::surface) makes sense of it only with the
/// tree that it was found in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Distance along the ray, in multiples of its direction: above 0, finite. Rounded from double precision. Within an
    /// instance, at least the distance at which the ray enters its box.
    pub t: f32,
    /// The primitive's index in the list that the tree was built from; if it was met through instances, in that of the
    /// innermost object.
    pub prim: u32,
    /// First parameter of the point on the primitive: along `u` of a quad, weight of vertex `b` of a triangle, 0 on a sphere. In
    /// 0..=1, and the less accurate the more the primitive is seen edge-on.
    pub u: f32,
    /// Second parameter: along `v` of a quad, weight of vertex `c` of a triangle, 0 on a sphere. In 0..=1; on triangles, `u + v`
    /// exceeds 1 by a rounding at most.
    pub v: f32,
    /// Indices of the instances through which it was met, each in the list of the tree that holds it, the outermost first;
    /// [`NO_INSTANCE`](Self::NO_INSTANCE) from where there are no more.
    pub instances: [u32; Hit::MAX_NESTING],
    /// Where the innermost tree keeps the primitive.
    pub(crate) slot: Slot,
}

impl Hit {
    /// The most instances within each other.
    pub const MAX_NESTING: usize = 3;

    /// The index of no instance.
    pub const NO_INSTANCE: u32 = u32::MAX;

    /// The index of no primitive.
    pub(crate) const NO_PRIM: u32 = u32::MAX;

    /// What was hit, for [`Ray::apart`]; [`Slot::NONE`] within an instance.
    #[inline]
    pub fn slot(&self) -> Slot {
        if self.instances[0] == Self::NO_INSTANCE { self.slot } else { Slot::NONE }
    }

    /// Where a search up to `t_max` begins; loses against every hit at a finite distance.
    #[inline(always)]
    pub(crate) fn none(t_max: f32) -> Self {
        let instances = [Self::NO_INSTANCE; Self::MAX_NESTING];
        Self { t: t_max.min(f32::MAX), prim: Self::NO_PRIM, u: 0.0, v: 0.0, instances, slot: Slot::NONE }
    }

    /// Of two hits at the same distance the one that comes first counts: by the index in the outermost list, then by that in the
    /// object, and so on.
    pub(crate) fn precedes(&self, other: &Self) -> bool {
        let order = |hit: &Self| {
            let mut order = [hit.prim; Self::MAX_NESTING + 1];
            for (to, &index) in order.iter_mut().zip(hit.instances.iter().take_while(|&&i| i != Self::NO_INSTANCE)) {
                *to = index;
            }
            order
        };
        order(self) < order(other)
    }
}

/// A ray in double precision, in which the primitives are intersected.
///
/// Inputs are single precision numbers, so differences of them are (nearly) exact here: that is what keeps
/// spheres of radius 1e5 and long thin triangles free of self-intersection.
#[derive(Clone, Copy)]
pub(crate) struct RayF64 {
    pub(crate) o: DVec3,
    pub(crate) d: DVec3,
    pub(crate) time: f32,
    /// In single precision, the origin is off by at most a rounding of this: 0 if it is exact.
    pub(crate) o_error: f32,
    /// The axes, that of the largest component of the direction last.
    pub(crate) order: &'static [usize; 3],
    /// The origin, with its coordinates in that order.
    pub(crate) turned_o: DVec3,
    /// The first two components of the direction in that order, divided by the last: at most 1.
    pub(crate) shear: DVec2,
    /// The distance at which the ray has moved by 1 along the last axis.
    pub(crate) along_inv: f64,
}

impl RayF64 {
    #[inline(always)]
    pub(crate) fn new(o: DVec3, d: DVec3, time: f32) -> Self {
        let order = &ORDERS[longest(d.abs().to_array())];
        let turned = |v: DVec3| DVec3::new(v[order[0]], v[order[1]], v[order[2]]);
        let (turned_o, turned_d) = (turned(o), turned(d));
        let along_inv = 1.0 / turned_d.z;
        let o_error = o.abs().max_element() as f32;
        Self { o, d, time, o_error, order, turned_o, shear: turned_d.truncate() * along_inv, along_inv }
    }

    /// The distance at which the ray enters a box, if it meets it.
    ///
    /// Boxes in the tree are tested in single precision, wider by more than that loses, so a box that is met here is met
    /// there, and no later.
    #[inline]
    pub(crate) fn enters(&self, bounds: Aabb) -> Option<f64> {
        /// Wider by the least that counts, so that rays along a face are inside.
        const PADDING: f64 = 1e-14;
        let (mut near, mut far) = (0.0_f64, f64::INFINITY);
        for axis in 0..3 {
            let (o, d) = (self.o[axis], self.d[axis]);
            let (lo, hi) = (f64::from(bounds.lo[axis]), f64::from(bounds.hi[axis]));
            let padding = PADDING * (lo.abs().max(hi.abs()) + o.abs());
            let (lo, hi) = (lo - padding - o, hi + padding - o);
            if d == 0.0 {
                if lo > 0.0 || hi < 0.0 {
                    return None;
                }
            } else {
                near = near.max((lo / d).min(hi / d));
                far = far.min((lo / d).max(hi / d));
            }
        }
        (near <= far).then_some(near)
    }
}

impl From<&Ray> for RayF64 {
    #[inline(always)]
    fn from(ray: &Ray) -> Self {
        Self { o_error: 0.0, ..Self::new(ray.o.as_dvec3(), ray.d.as_dvec3(), ray.time) }
    }
}

/// A hit of one primitive: distance and surface parameters, not yet rounded.
#[derive(Clone, Copy)]
pub(crate) struct PrimHit {
    pub(crate) t: f64,
    pub(crate) u: f64,
    pub(crate) v: f64,
}
