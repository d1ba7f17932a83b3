//! Instances: an object shown again, elsewhere.
//!
//! The ray is transformed, not the object: with the inverse of the transform at the ray's time, in double precision. Its
//! direction is not normalised, so distances are the same inside and outside.

use glam::{DAffine3, DMat3, DVec3, Vec3};

use crate::aabb::Aabb;
use crate::bvh::Bvh;
use crate::ray::RayF64;
use crate::shape::MovingTriangle;

/// An affine transform: a point p goes to `p.x axes[0] + p.y axes[1] + p.z axes[2] + offset`. It may mirror, shear and scale as
/// it likes, but what it flattens is not seen. It is undone in double precision: of 16 digits, as many are lost as the
/// ratio between the directions that it stretches most and least has.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Affine {
    /// Where the axes go.
    pub axes: [Vec3; 3],
    /// Where the origin goes.
    pub offset: Vec3,
}

impl Affine {
    /// Leaves everything where it is.
    pub const IDENTITY: Self = Self { axes: Vec3::AXES, offset: Vec3::ZERO };

    /// A shift.
    pub fn from_translation(offset: Vec3) -> Self {
        Self { axes: Vec3::AXES, offset }
    }

    fn as_daffine3(&self) -> DAffine3 {
        let [x, y, z] = self.axes.map(|axis| axis.as_dvec3());
        DAffine3 { matrix3: DMat3::from_cols(x, y, z), translation: self.offset.as_dvec3() }
    }
}

/// An object shown where a transform puts it. A motion of several keys is one of these for each interval between them.
///
/// A ray tests the box around the object's box, transformed, before it is transformed itself: many objects that are far larger
/// than what they show, or overlap, are slow. Instances that touch are not watertight against each other. A tree takes about
/// 160 bytes for each.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Instance {
    /// Index in the list of [`objects`](crate::Geometry::objects).
    pub object: u32,
    /// From the object's space to that of the instance, at the beginning and at the end of its time; between them, the
    /// matrices are interpolated, number by number: points move on straight lines. If either flattens, nothing is seen at any
    /// time; if only one between them does, nothing is seen then.
    pub at: [Affine; 2],
    /// When it begins and ends to exist, both inclusive, in the time of [`Ray::time`](crate::Ray::time). Finite if it moves.
    pub time: [f32; 2],
}

impl Instance {
    /// One that does not move, and is there always.
    pub fn new(object: u32, to_world: Affine) -> Self {
        Self { object, at: [to_world; 2], time: [f32::NEG_INFINITY, f32::INFINITY] }
    }

    /// The transform at a time, if the instance exists then; in double precision, as rays see it.
    pub fn to_world(&self, time: f32) -> Option<DAffine3> {
        let [start, end] = self.time;
        if !(start <= time && time <= end) {
            return None;
        }
        let [from, to] = self.at.each_ref().map(Affine::as_daffine3);
        if self.at[0] == self.at[1] {
            return Some(from);
        }
        let share = MovingTriangle::share(start, end, time);
        let matrix3 = from.matrix3 + (to.matrix3 - from.matrix3) * share;
        Some(DAffine3 { matrix3, translation: from.translation.lerp(to.translation, share) })
    }

    pub(crate) fn is_finite(&self) -> bool {
        let [from, to] = self.at;
        let is_at_rest = from == to && !self.time.into_iter().any(f32::is_nan);
        [from, to].iter().all(|at| at.offset.is_finite() && at.axes.into_iter().all(Vec3::is_finite))
            && (is_at_rest || self.time.into_iter().all(f32::is_finite))
    }

    /// Whether it shows nothing: at the beginning or at the end, the transform flattens the object or cannot be undone.
    pub(crate) fn is_degenerate(&self) -> bool {
        self.at.iter().any(|at| is_flat(&at.as_daffine3().matrix3)) || self.time[0] > self.time[1]
    }

    /// The box around the object at all times: points move on straight lines, so two times tell.
    pub(crate) fn bounds(&self, object: &Bvh) -> Aabb {
        let Aabb { lo, hi } = object.bounds();
        if !(lo.cmple(hi).all()) {
            return Aabb::EMPTY;
        }
        let corner =
            |i: u32| DVec3::from_array([0, 1, 2].map(|axis| f64::from(if i >> axis & 1 == 1 { hi } else { lo }[axis])));
        let at = self.at.each_ref().map(Affine::as_daffine3);
        Aabb::around(at.into_iter().flat_map(|at| (0..8).map(move |i| at.transform_point3(corner(i)).as_vec3())))
    }

    /// The ray in the object's space, if the instance exists then and its transform can be undone.
    #[inline]
    pub(crate) fn ray_in_object(&self, ray: &RayF64) -> Option<RayF64> {
        let to_world = self.to_world(ray.time)?;
        if self.at[0] != self.at[1] && is_flat(&to_world.matrix3) {
            return None;
        }
        let to_object = to_world.inverse();
        let local = RayF64::new(to_object.transform_point3(ray.o), to_object.transform_vector3(ray.d), ray.time);
        (local.o.is_finite() && local.d.is_finite() && local.d != DVec3::ZERO).then_some(local)
    }
}

/// Whether a matrix cannot be undone: its determinant is 0, or what rounding makes of that.
fn is_flat(m: &DMat3) -> bool {
    /// More than the roundings of the determinant's products lose, and far less than single precision tells from flat.
    const ROUNDING: f64 = 1e-14;
    let [x, y, z] = [m.x_axis.abs(), m.y_axis.abs(), m.z_axis.abs()];
    let products = x.x * (y.y * z.z + y.z * z.y) + x.y * (y.z * z.x + y.x * z.z) + x.z * (y.x * z.y + y.y * z.x);
    let determinant = m.determinant();
    !(determinant.abs() > ROUNDING * products && determinant.recip().is_finite())
}
