//! Which part of a scene a ray has met.

use eyebeam_bvh::{Hit, Surface};
use glam::{Vec2, Vec3};

use crate::scene::{Object, Scene};
use crate::shape::{SurfacePoint, sphere_tangents, sphere_uv};
use crate::texture::{TextureDesc, TexturePoint, TexturesAt};

/// A place on the shapes of a scene, for what is asked only of some.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Met<'s> {
    pub(super) scene: &'s Scene,
    pub(super) object: &'s Object,
    pub(super) primitive: u32,
    /// Coordinates on the primitive.
    pub(super) uv: Vec2,
}

impl<'s> Met<'s> {
    #[inline(always)]
    pub(super) fn new(scene: &'s Scene, hit: &Hit) -> Self {
        let object = &scene.objects[scene.object_of[hit.prim as usize] as usize];
        Self { scene, object, primitive: hit.prim - object.first_primitive, uv: Vec2::new(hit.u, hit.v) }
    }

    /// Coordinates on the shape: along the edges of a quad, longitude and latitude on a sphere, what a mesh says, or the weights
    /// of a triangle's second and third vertex.
    pub(crate) fn uv(&self, point: &SurfacePoint) -> Vec2 {
        if point.is_round {
            return sphere_uv(point.n);
        }
        self.object.vertices.as_ref().and_then(|v| v.uv(self.primitive, self.uv)).unwrap_or(self.uv)
    }

    /// How the point moves, in metres, with these coordinates; nothing where that is not known.
    pub(super) fn tangents(&self, surface: &Surface, point: &SurfacePoint) -> [Vec3; 2] {
        match surface {
            Surface::Sphere(sphere) => sphere_tangents(point.n).map(|tangent| tangent * sphere.radius),
            Surface::Flat { edges, .. } => {
                let edges = edges.map(|edge| edge.as_vec3());
                self.object.vertices.as_ref().and_then(|v| v.tangents(self.primitive, edges)).unwrap_or(edges)
            }
        }
    }

    /// The number of the shape's material.
    #[inline]
    pub(crate) fn material(&self) -> u32 {
        self.object.material
    }

    /// The textures of the scene, at a point of the place.
    pub(crate) fn textures(&self, point: &SurfacePoint) -> TexturesAt<'s> {
        let textures: &[TextureDesc] = &self.scene.textures;
        let at = TexturePoint {
            uv: self.uv(point),
            p: point.p,
            p_object: point.p - self.object.origin,
            n: point.ns,
            vertex_color: self.object.vertices.as_ref().and_then(|v| v.color(self.primitive, self.uv)),
        };
        TexturesAt { textures, at }
    }
}
