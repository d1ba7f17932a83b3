//! Flat shapes: what the points of a triangle or a quad have in common.

use glam::{DVec2, DVec3, Vec2, Vec3};

use crate::shape::SurfacePoint;

/// The points `corner + x edges[0] + y edges[1]`.
#[derive(Clone, Debug)]
pub(crate) struct Plane {
    corner: DVec3,
    edges: [DVec3; 2],
    /// Of unit length.
    n: Vec3,
    /// The largest coordinate of the corner and the edges, by size.
    reach: f64,
    /// Twice as far as a point may be off, in edges of the shape.
    margin: f64,
}

impl Plane {
    /// The plane that two edges from `corner` span.
    #[inline]
    pub(crate) fn new(corner: DVec3, edges: [DVec3; 2]) -> Self {
        let normal = edges[0].cross(edges[1]);
        // Nothing without area is ever hit.
        let area_inv = 1.0 / normal.length();
        let [u, v] = edges.map(|e| e.abs());
        let reach = corner.abs().max(u).max(v).max_element();
        let margin = 4.0 * f64::from(f32::EPSILON) * reach * (u + v).element_sum() * area_inv;
        Self { corner, edges, n: (normal * area_inv).as_vec3(), reach, margin: margin.min(1e-4) }
    }

    /// The same, seen through a transform that mirrors if `is_mirrored`; its points are computed from lengths up to `reach`.
    pub(super) fn seen_through(self, is_mirrored: bool, reach: f64) -> Self {
        let n = if is_mirrored { -self.n } else { self.n };
        Self { n, reach: self.reach.max(reach), ..self }
    }

    /// A point of a triangle or quad.
    #[inline]
    pub(crate) fn point(&self, uv: Vec2) -> SurfacePoint {
        let uv = inset(uv.as_dvec2(), self.margin);
        SurfacePoint::rounded(self.corner + self.edges[0] * uv.x + self.edges[1] * uv.y, self.reach, self.n)
    }
}

/// Moves what is nearer than `margin` to an edge of a triangle or quad away from it: otherwise rounding could put the point
/// into or behind the surface that it meets there, and rays would leave a closed room.
#[inline]
fn inset(uv: DVec2, margin: f64) -> DVec2 {
    let inner = uv.clamp(DVec2::splat(margin), DVec2::splat(1.0 - margin));
    // The edge opposite to the corner, if it is a triangle; else a line like any other.
    let beyond = inner.element_sum() - 1.0;
    if beyond.abs() < margin { inner - 0.5 * (beyond + margin) } else { inner }
}
