//! Which part of a scene a ray has met.

use eyebeam_bvh::{Hit, Ray, Surface};
use glam::{Vec2, Vec3};

use crate::motion::Motion;
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
    /// When.
    pub(super) time: f32,
}

impl<'s> Met<'s> {
    #[inline(always)]
    pub(super) fn new<const PLAIN: bool>(scene: &'s Scene, hit: &Hit, time: f32) -> Self {
        let (object, uv) = (&scene.objects[scene.object_of::<PLAIN>(hit) as usize], Vec2::new(hit.u, hit.v));
        let is_moved = !PLAIN && hit.instances[0] != Hit::NO_INSTANCE;
        let primitive = if is_moved { hit.prim } else { hit.prim - object.first_primitive };
        Self { scene, object, primitive, uv, time }
    }

    /// When it was met.
    #[inline]
    pub(crate) fn time(&self) -> f32 {
        self.time
    }

    /// Where the ray met it.
    #[inline(always)]
    pub(super) fn point<const PLAIN: bool>(&self, ray: &Ray, hit: &Hit) -> SurfacePoint {
        match (&self.object.single, &self.object.motion) {
            (Some(single), _) => single.point(ray, hit),
            (None, Some(motion)) if !PLAIN => self.moved_point(motion, ray, hit),
            (None, _) => {
                let surface = self.scene.bvh.surface(hit, ray.time);
                SurfacePoint::new(&surface, ray, hit, self.object.smooth.as_ref(), self.primitive)
            }
        }
    }

    #[inline(never)]
    fn moved_point(&self, motion: &Motion, ray: &Ray, hit: &Hit) -> SurfacePoint {
        let surface = self.scene.bvh.surface(hit, ray.time);
        let to_world = motion.to_world(self.time);
        SurfacePoint::moved(&surface, &to_world, ray, hit, self.object.smooth.as_ref(), self.primitive)
    }

    /// The direction in the space of the shape of a normal in the world.
    fn normal_on_shape(&self, n: Vec3) -> Vec3 {
        let Some(motion) = &self.object.motion else { return n };
        let matrix = motion.to_world(self.time).matrix3;
        (matrix.transpose() * n.as_dvec3()).normalize().as_vec3()
    }

    /// The place on the shape, where that is without motion, of a place in the world.
    fn place_on_shape(&self, p: Vec3) -> Vec3 {
        let Some(motion) = &self.object.motion else { return p };
        motion.to_world(self.time).inverse().transform_point3(p.as_dvec3()).as_vec3()
    }

    /// The way on the shape, where that is without motion, of a way in the world.
    pub(super) fn way_on_shape(&self, by: Vec3) -> Vec3 {
        let Some(motion) = &self.object.motion else { return by };
        motion.to_world(self.time).inverse().transform_vector3(by.as_dvec3()).as_vec3()
    }

    /// Coordinates on the shape: along the edges of a quad, longitude and latitude on a sphere, what a mesh says, or the weights
    /// of a triangle's second and third vertex.
    pub(crate) fn uv(&self, point: &SurfacePoint) -> Vec2 {
        if point.is_round {
            return sphere_uv(self.normal_on_shape(point.n));
        }
        self.object.vertices.as_ref().and_then(|v| v.uv(self.primitive, self.uv)).unwrap_or(self.uv)
    }

    /// How the point moves, in metres, with these coordinates; nothing where that is not known.
    pub(super) fn tangents(&self, surface: &Surface, point: &SurfacePoint) -> [Vec3; 2] {
        let on_shape = match surface {
            Surface::Sphere(sphere) => {
                sphere_tangents(self.normal_on_shape(point.n)).map(|tangent| tangent * sphere.radius)
            }
            Surface::Flat { edges, .. } => {
                let edges = edges.map(|edge| edge.as_vec3());
                self.object.vertices.as_ref().and_then(|v| v.tangents(self.primitive, edges)).unwrap_or(edges)
            }
        };
        let Some(motion) = &self.object.motion else { return on_shape };
        let to_world = motion.to_world(self.time);
        on_shape.map(|tangent| to_world.transform_vector3(tangent.as_dvec3()).as_vec3())
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
            p_object: self.place_on_shape(point.p) - self.object.origin,
            n: point.ns,
            n_object: self.normal_on_shape(point.ns),
            vertex_color: self.object.vertices.as_ref().and_then(|v| v.color(self.primitive, self.uv)),
        };
        TexturesAt { textures, at }
    }
}
