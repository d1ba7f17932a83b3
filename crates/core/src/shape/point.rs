//! Where a ray meets a shape.

use glam::{DVec3, Vec3};

use crate::math::clearance;

/// A point of a surface.
#[derive(Clone, Copy, Debug)]
pub struct SurfacePoint {
    /// The point, on the surface but for rounding.
    pub p: Vec3,
    /// Unit geometric normal.
    pub n: Vec3,
    /// Unit shading normal, on the side of the geometric one; the same without normals in the mesh.
    pub ns: Vec3,
    /// How far from `p` rays start, along the normal.
    clearance: f32,
    /// From `p` to where rays start on the viewer's side.
    lift: Vec3,
    /// Whether rays that go into the shape meet it again.
    pub(crate) is_round: bool,
}

impl SurfacePoint {
    /// From a point that double precision has computed from lengths up to `reach`: rounding it to single precision is the
    /// larger error, except where coordinates are near 0.
    #[inline]
    pub(crate) fn rounded(p: DVec3, reach: f64, n: Vec3) -> Self {
        /// What the point and the next intersection with the shape may be off, in double precision, relative to `reach`.
        const DOUBLE: f64 = 16.0 * f64::EPSILON;
        let p = p.as_vec3();
        let p_error = p.abs() * f32::EPSILON + (DOUBLE * reach) as f32;
        Self { p, n, ns: n, clearance: clearance(p, p_error, n), lift: Vec3::ZERO, is_round: false }
    }

    /// From a sphere and the direction of a point of it from its centre.
    #[inline]
    pub(crate) fn on_sphere(center: DVec3, radius: f64, n: DVec3) -> Self {
        Self::rounded(center + n * radius, center.abs().max_element() + radius, n.as_vec3()).round()
    }

    /// The same, of a shape that rays meet again when they go into it.
    #[inline]
    pub(super) fn round(self) -> Self {
        Self { is_round: true, ..self }
    }

    /// The same with another shading normal, and with rays on the viewer's side that start at `p + lift`.
    #[inline]
    pub(crate) fn shaded(self, ns: Vec3, lift: Vec3) -> Self {
        // The sum is rounded.
        let clearance = self.clearance + self.n.abs().dot(lift.abs()) * f32::EPSILON;
        Self { ns, lift, clearance, ..self }
    }

    /// The same with another shading normal.
    #[inline]
    pub(crate) fn with_ns(self, ns: Vec3) -> Self {
        Self { ns, ..self }
    }

    /// Where a ray along `w` starts, so that it does not meet this surface again. `viewer` is a direction to the side that
    /// the point was seen from.
    #[inline]
    pub(crate) fn ray_origin(&self, viewer: Vec3, w: Vec3) -> Vec3 {
        let cos = w.dot(self.n);
        let lift = if (cos > 0.0) == (viewer.dot(self.n) > 0.0) { self.lift } else { Vec3::ZERO };
        self.p + lift + self.n * self.clearance.copysign(cos)
    }
}
