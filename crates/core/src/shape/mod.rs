//! What there is to see: spheres, quads and triangle meshes.
//!
//! Each file holds a shape as a scene states it, the primitives that rays meet, and the point and normal of a hit.

mod mesh;
mod moving;
mod plane;
mod point;
mod quad;
mod smooth;
mod sphere;

use eyebeam_bvh::{Bvh, Hit, Primitive, Ray, Sphere, Surface};
use glam::{Affine3A, Vec2, Vec3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::motion::MotionDesc;
use crate::validate::Checker;

pub(crate) use mesh::VertexData;
pub use mesh::{MeshData, MeshDesc};
pub(crate) use plane::Plane;
pub use point::SurfacePoint;
pub use quad::QuadDesc;
pub(crate) use smooth::{Smooth, visible};
pub use sphere::SphereDesc;
pub(crate) use sphere::{tangents as sphere_tangents, uv as sphere_uv};

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
        let of_mesh = |mesh: &MeshDesc| mesh.triangle_count() + mesh.instances.len();
        let count = self.sphere.len() + self.quad.len() + self.mesh.iter().map(of_mesh).sum::<usize>();
        if count > Bvh::MAX_PRIMITIVES {
            let hint = format!("at most {} are allowed", Bvh::MAX_PRIMITIVES);
            c.problem(
                "mesh",
                format!("the scene has {count} spheres, quads, triangles and copies of meshes"),
                Some(hint),
            );
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

    /// How it moves.
    fn motion(&self) -> MotionDesc<'_>;

    /// Where its copies are; none if it is where it says.
    fn copies(&self) -> Vec<Affine3A> {
        Vec::new()
    }

    /// Normals that make it look round.
    fn smooth(&self) -> Option<Smooth> {
        None
    }

    /// What its vertices say to textures.
    fn vertex_data(&self) -> Option<VertexData> {
        None
    }

    /// Where its own coordinates begin, in the world, and what it turns about if it says no pivot.
    fn origin(&self) -> Vec3 {
        Vec3::ZERO
    }

    /// Its only primitive, if it has but one.
    fn single(&self) -> Option<Single> {
        None
    }
}

/// A shape of one primitive, which need not be asked of the tree.
#[derive(Clone, Debug)]
pub(crate) enum Single {
    Plane(Plane),
    Sphere(Sphere),
}

impl Single {
    /// Where `ray` hit it.
    #[inline(always)]
    pub(crate) fn point(&self, ray: &Ray, hit: &Hit) -> SurfacePoint {
        match self {
            Self::Plane(plane) => plane.point(Vec2::new(hit.u, hit.v)),
            Self::Sphere(sphere) => sphere::point(sphere, ray, hit),
        }
    }
}

impl SurfacePoint {
    /// Where `ray` hit `surface`, which is triangle `triangle` of a mesh with normals if there is `smooth`.
    #[inline]
    pub(crate) fn new(surface: &Surface, ray: &Ray, hit: &Hit, smooth: Option<&Smooth>, triangle: u32) -> Self {
        match surface {
            Surface::Sphere(s) => sphere::point(s, ray, hit),
            Surface::Flat { corner, edges } => {
                let flat = Plane::new(*corner, *edges).point(Vec2::new(hit.u, hit.v));
                let Some(smooth) = smooth else {
                    return flat;
                };
                let shading = smooth.shading(triangle, *edges, flat.n, ray.d, hit);
                flat.shaded(shading.ns, shading.lift)
            }
        }
    }
}
