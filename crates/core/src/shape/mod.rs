//! What there is to see: spheres, quads and triangle meshes.
//!
//! Each file holds a shape as a scene states it, the primitives that rays meet, and the point and normal of a hit.

mod mesh;
mod quad;
mod sphere;

use eyebeam_bvh::{Hit, Primitive, Ray};
use glam::{DVec3, Vec3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::validate::Checker;

pub use mesh::MeshDesc;
pub use quad::QuadDesc;
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
    pub(crate) fn check(&self, c: &mut Checker) {
        fn each<T>(c: &mut Checker, kind: &str, shapes: &[T], check: impl Fn(&T, &mut Checker)) {
            c.within(kind, |c| shapes.iter().enumerate().for_each(|(i, shape)| c.within(i, |c| check(shape, c))));
        }
        each(c, "sphere", &self.sphere, SphereDesc::check);
        each(c, "quad", &self.quad, QuadDesc::check);
        each(c, "mesh", &self.mesh, MeshDesc::check);
    }

    /// Every shape's place in the description, its primitives, and the name of its material.
    pub(crate) fn iter(&self) -> impl Iterator<Item = ShapeRef<'_>> {
        let spheres =
            self.sphere.iter().enumerate().map(|(i, s)| ShapeRef::new("sphere", i, s.primitives(), &s.material));
        let quads = self.quad.iter().enumerate().map(|(i, q)| ShapeRef::new("quad", i, q.primitives(), &q.material));
        let meshes = self.mesh.iter().enumerate().map(|(i, m)| ShapeRef::new("mesh", i, m.primitives(), &m.material));
        spheres.chain(quads).chain(meshes)
    }
}

/// One shape among all kinds.
pub(crate) struct ShapeRef<'a> {
    pub(crate) kind: &'static str,
    pub(crate) index: usize,
    pub(crate) primitives: Vec<Primitive>,
    pub(crate) material: Option<&'a str>,
}

impl<'a> ShapeRef<'a> {
    fn new(kind: &'static str, index: usize, primitives: Vec<Primitive>, material: &'a Option<String>) -> Self {
        Self { kind, index, primitives, material: material.as_deref() }
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
}

impl SurfacePoint {
    /// Where `ray` hit `primitive`.
    #[inline]
    pub fn new(primitive: &Primitive, ray: &Ray, hit: &Hit) -> Self {
        match primitive {
            Primitive::Sphere(s) => sphere::point(s, ray, hit),
            Primitive::Quad(q) => quad::point(q, hit),
            Primitive::Triangle(t) => mesh::point(t, hit),
        }
    }

    /// From a point that double precision knows to be on the surface: rounding it is the only error.
    #[inline]
    fn rounded(p: DVec3, n: Vec3) -> Self {
        let p = p.as_vec3();
        Self { p, p_error: p.abs() * f32::EPSILON, n }
    }

    /// From a point of the plane that two edges span.
    #[inline]
    fn on_plane(p: DVec3, edges: [Vec3; 2]) -> Self {
        let n = edges[0].as_dvec3().cross(edges[1].as_dvec3()).normalize_or_zero().as_vec3();
        Self::rounded(p, n)
    }
}
