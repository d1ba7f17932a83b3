//! Triangles and quads, watertight.
//!
//! The vertices are seen from the ray's origin, sheared so that the ray runs along an axis, and what is left is a question in the
//! plane: is the origin inside the triangle? (Woop, Benthin & Wald 2013, Watertight Ray/Triangle Intersection, JCGT 2(1).)
//! Every triangle that has a vertex sees the same numbers for it, and the side of an edge is decided exactly for these. So a ray
//! that meets an edge or a vertex of a closed mesh is seen by one of the triangles that share it.
//!
//! Distance and coordinates are means of those of the vertices with weights of one sign: they lie between them, however
//! obliquely the triangle is seen.

use glam::{DVec2, DVec3};

use crate::ray::{PrimHit, RayF64};

/// A vertex in the space of the ray: across it, and along the axis that is nearest to its direction.
#[derive(Clone, Copy)]
struct Vertex {
    across: DVec2,
    along: f64,
}

/// The vertices in the space of the ray, and the distance at which the ray has moved by 1 along its axis.
#[inline(always)]
fn project<const N: usize>(vertices: [DVec3; N], ray: &RayF64) -> ([Vertex; N], f64) {
    // The axis of the largest component is the last: shears are at most 1.
    let [x, y, z] = ray.order;
    let (o, shear) = (ray.o.to_array(), DVec2::from_array(ray.shear));
    let vertex = |p: DVec3| {
        let p = p.to_array();
        let along = p[z] - o[z];
        Vertex { across: DVec2::new(p[x] - o[x], p[y] - o[y]) - shear * along, along }
    };
    (vertices.map(vertex), ray.along_inv)
}

/// Twice the area that the origin and an edge span, positive if the origin is to its left.
#[inline(always)]
fn side(from: DVec2, to: DVec2) -> f64 {
    from.x * to.y - from.y * to.x
}

/// As [`side`], where the products are the same when they are rounded: what was rounded off decides, so the sign is right.
#[cold]
fn side_of_rest(from: DVec2, to: DVec2) -> f64 {
    let (x, y) = (from.x * to.y, from.y * to.x);
    if x == y { from.x.mul_add(to.y, -x) - from.y.mul_add(to.x, -y) } else { x - y }
}

/// The hit of a triangle: distance, and weights of the second and the third vertex.
#[inline(always)]
fn weigh([a, b, c]: [Vertex; 3], along_inv: f64) -> Option<(f64, [f64; 2])> {
    let edges = [(b.across, c.across), (c.across, a.across), (a.across, b.across)];
    let [mut u, mut v, mut w] = edges.map(|(from, to)| side(from, to));
    if (u == 0.0) | (v == 0.0) | (w == 0.0) {
        [u, v, w] = edges.map(|(from, to)| side_of_rest(from, to));
    }
    let is_split = ((u < 0.0) | (v < 0.0) | (w < 0.0)) & ((u > 0.0) | (v > 0.0) | (w > 0.0));
    let sum = u + v + w;
    // Seen as a line, a triangle is not hit.
    if is_split | (sum == 0.0) {
        return None;
    }
    let t = (u * a.along + v * b.along + w * c.along) / sum * along_inv;
    (t > 0.0).then_some((t, [v / sum, w / sum]))
}

/// The hit of the triangle with these vertices.
#[inline(always)]
pub(super) fn intersect_triangle(vertices: [DVec3; 3], ray: &RayF64) -> Option<PrimHit> {
    let (vertices, along_inv) = project(vertices, ray);
    weigh(vertices, along_inv).map(|(t, [u, v])| PrimHit { t, u, v })
}

/// The hit of the parallelogram with this corner and these edges: of two triangles that share a diagonal.
#[inline(always)]
pub(super) fn intersect_quad(corner: DVec3, [u, v]: [DVec3; 2], ray: &RayF64) -> Option<PrimHit> {
    let ([a, b, c, d], along_inv) = project([corner, corner + u, corner + u + v, corner + v], ray);
    let below = weigh([a, b, c], along_inv).map(|(t, [b, c])| PrimHit { t, u: (b + c).min(1.0), v: c });
    below.or_else(|| weigh([a, c, d], along_inv).map(|(t, [c, d])| PrimHit { t, u: c, v: (c + d).min(1.0) }))
}
