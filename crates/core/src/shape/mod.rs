//! What there is to see: spheres, quads and triangle meshes.
//!
//! Each file holds a shape as a scene states it, the primitives that rays meet, and the point and normal of a hit.

mod mesh;
mod quad;
mod smooth;
mod sphere;

use eyebeam_bvh::{Bvh, Hit, Primitive, Ray, Surface};
use glam::{DVec2, DVec3, Vec2, Vec3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::math::offset_ray_origin;
use crate::validate::Checker;

pub use mesh::{MeshData, MeshDesc};
pub use quad::QuadDesc;
pub(crate) use smooth::Smooth;
pub use sphere::SphereDesc;

/// All shapes of a scene: `[[shape.KIND]]` adds one.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct ShapesDesc {
    /// Spheres.
    pub sphere: Vec<SphereDesc>,
    /// Rectangles and other parallelograms.
    pub quad: Vec<QuadDesc>,
    /// Triangle lists.
    pub mesh: Vec<MeshDesc>,
}

impl ShapesDesc {
    /// Every shape with its kind and its place among those of its kind.
    pub(crate) fn iter(&self) -> impl Iterator<Item = (&'static str, usize, &dyn ShapeDesc)> {
        type Entry<'a> = (&'static str, usize, &'a dyn ShapeDesc);
        fn all<'a>(kind: &'static str, shapes: &'a [impl ShapeDesc]) -> impl Iterator<Item = Entry<'a>> {
            shapes.iter().enumerate().map(move |(i, shape)| (kind, i, shape as &dyn ShapeDesc))
        }
        all("sphere", &self.sphere).chain(all("quad", &self.quad)).chain(all("mesh", &self.mesh))
    }

    /// Notes if there are more primitives than can be sorted for rays.
    pub(crate) fn check_count(&self, c: &mut Checker) {
        let triangles: usize = self.mesh.iter().map(MeshDesc::triangle_count).sum();
        let count = self.sphere.len() + self.quad.len() + triangles;
        if count > Bvh::MAX_PRIMITIVES {
            let hint = format!("at most {} are allowed", Bvh::MAX_PRIMITIVES);
            c.problem("mesh", format!("the scene has {count} spheres, quads and triangles"), Some(hint));
        }
    }
}

/// A shape as a scene states it.
pub(crate) trait ShapeDesc {
    /// Notes what is wrong with it.
    fn check(&self, c: &mut Checker);

    /// Appends what rays meet.
    fn push_primitives(&self, primitives: &mut Vec<Primitive>);

    /// The name of its material.
    fn material(&self) -> Option<&str>;

    /// Normals that make it look round.
    fn smooth(&self) -> Option<Smooth> {
        None
    }
}

/// A point of a surface.
#[derive(Clone, Copy, Debug)]
pub struct SurfacePoint {
    /// The point, on the surface but for rounding.
    pub p: Vec3,
    /// The most that each coordinate of `p` is off.
    pub p_error: Vec3,
    /// Unit geometric normal.
    pub n: Vec3,
    /// Unit shading normal, on the side of the geometric one; the same without normals in the mesh.
    pub ns: Vec3,
    /// Whether rays that go into the shape meet it again.
    pub(crate) is_round: bool,
    /// From `p` to where rays start on the viewer's side.
    lift: Vec3,
}

impl SurfacePoint {
    /// Where `ray` hit `surface`, which is triangle `triangle` of a mesh with normals if there is `smooth`.
    #[inline]
    pub(crate) fn new(surface: &Surface, ray: &Ray, hit: &Hit, smooth: Option<&Smooth>, triangle: u32) -> Self {
        match surface {
            Surface::Sphere(s) => sphere::point(s, ray, hit),
            Surface::Flat { corner, edges } => {
                let flat = Self::on_plane(*corner, *edges, Vec2::new(hit.u, hit.v));
                let Some(smooth) = smooth else {
                    return flat;
                };
                let shading = smooth.shading(triangle, *edges, flat.n, ray.d, hit);
                Self { ns: shading.ns, lift: shading.lift, ..flat }
            }
        }
    }

    /// Where a ray along `w` starts, so that it does not meet this surface again. `viewer` is a direction to the side that
    /// the point was seen from.
    #[inline]
    pub(crate) fn ray_origin(&self, viewer: Vec3, w: Vec3) -> Vec3 {
        let lift = if (w.dot(self.n) > 0.0) == (viewer.dot(self.n) > 0.0) { self.lift } else { Vec3::ZERO };
        offset_ray_origin(self.p + lift, self.p_error, self.n, w)
    }

    /// From a point that double precision has computed from lengths up to `reach`: rounding it to single precision is the
    /// larger error, except where coordinates are near 0.
    #[inline]
    pub(crate) fn rounded(p: DVec3, reach: f64, n: Vec3) -> Self {
        /// What the point and the next intersection with the shape may be off, in double precision, relative to `reach`.
        const DOUBLE: f64 = 16.0 * f64::EPSILON;
        let p = p.as_vec3();
        let p_error = p.abs() * f32::EPSILON + (DOUBLE * reach) as f32;
        Self { p, p_error, n, ns: n, is_round: false, lift: Vec3::ZERO }
    }

    /// From a sphere and the direction of a point of it from its centre.
    #[inline]
    pub(crate) fn on_sphere(center: DVec3, radius: f64, n: DVec3) -> Self {
        let point = Self::rounded(center + n * radius, center.abs().max_element() + radius, n.as_vec3());
        Self { is_round: true, ..point }
    }

    /// From a point of the plane that two edges from `corner` span.
    #[inline]
    pub(crate) fn on_plane(corner: DVec3, edges: [DVec3; 2], uv: Vec2) -> Self {
        let normal = edges[0].cross(edges[1]);
        // Nothing without area is ever hit.
        let area_inv = 1.0 / normal.length();
        let [u, v] = edges.map(|e| e.abs());
        let reach = corner.abs().max(u).max(v).max_element();
        // Twice as far as the point may be off, in edges of the shape.
        let margin = 4.0 * f64::from(f32::EPSILON) * reach * (u + v).element_sum() * area_inv;
        let uv = inset(uv.as_dvec2(), margin.min(1e-4));
        Self::rounded(corner + edges[0] * uv.x + edges[1] * uv.y, reach, (normal * area_inv).as_vec3())
    }
}

/// Where on its shape a point of normal `n` is, each in 0..1: along the edges `u` and `v` of a quad, weights of the second
/// and third vertex of a triangle, longitude and latitude on a sphere.
pub(crate) fn surface_uv(surface: &Surface, hit: &Hit, n: Vec3) -> Vec2 {
    match surface {
        Surface::Sphere(_) => sphere::uv(n),
        Surface::Flat { .. } => Vec2::new(hit.u, hit.v),
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
