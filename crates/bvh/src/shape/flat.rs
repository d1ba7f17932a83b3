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

impl Vertex {
    #[inline(always)]
    fn seen_from(ray: &RayF64, p: DVec3) -> Self {
        let ([x, y, z], o, p) = (*ray.order, ray.turned_o, p.to_array());
        let along = p[z] - o.z;
        Self { across: DVec2::new(p[x] - o.x, p[y] - o.y) - ray.shear * along, along }
    }
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

/// The areas at the edges of a polygon, if the ray passes it on the inside.
#[inline(always)]
fn areas<const N: usize>(edges: [(DVec2, DVec2); N]) -> Option<[f64; N]> {
    let mut areas = [0.0; N];
    let (mut left, mut right, mut on_edge) = (false, false, false);
    for i in 0..N {
        areas[i] = side(edges[i].0, edges[i].1);
        (left, right, on_edge) = (left | (areas[i] > 0.0), right | (areas[i] < 0.0), on_edge | (areas[i] == 0.0));
    }
    if on_edge {
        (areas, left, right) = decide(edges);
    }
    (!(left & right)).then_some(areas)
}

/// As [`areas`], exactly, with whether some are positive and some are negative.
#[cold]
fn decide<const N: usize>(edges: [(DVec2, DVec2); N]) -> ([f64; N], bool, bool) {
    let areas = edges.map(|(from, to)| side_of_rest(from, to));
    (areas, areas.iter().any(|&x| x > 0.0), areas.iter().any(|&x| x < 0.0))
}

/// The hit of the triangle with these vertices.
#[inline(always)]
pub(super) fn intersect_triangle([a, b, c]: [DVec3; 3], ray: &RayF64) -> Option<PrimHit> {
    let see = |p| Vertex::seen_from(ray, p);
    let (a, b, c) = (see(a), see(b), see(c));
    let [u, v, w] = areas([(b.across, c.across), (c.across, a.across), (a.across, b.across)])?;
    let sum = u + v + w;
    let t = (u * a.along + v * b.along + w * c.along) / sum * ray.along_inv;
    // Seen as a line, a triangle is not hit.
    (sum != 0.0 && t > 0.0).then_some(PrimHit { t, u: v / sum, v: w / sum })
}

/// The hit of the parallelogram with this corner and these edges. The coordinate along an edge is the share that the area at one
/// of the other two has in both.
#[inline(always)]
pub(super) fn intersect_quad(corner: DVec3, [u, v]: [DVec3; 2], ray: &RayF64) -> Option<PrimHit> {
    let see = |p| Vertex::seen_from(ray, p);
    let (a, b, c, d) = (see(corner), see(corner + u), see(corner + u + v), see(corner + v));
    let edges = [(a.across, b.across), (b.across, c.across), (c.across, d.across), (d.across, a.across)];
    let [ab, bc, cd, da] = areas(edges)?;
    let (width, height) = (da + bc, ab + cd);
    let (u, v) = (da / width, ab / height);
    let near = a.along * (1.0 - u) + b.along * u;
    let far = d.along * (1.0 - u) + c.along * u;
    let t = (near * (1.0 - v) + far * v) * ray.along_inv;
    (width != 0.0 && height != 0.0 && t > 0.0).then_some(PrimHit { t, u, v })
}
