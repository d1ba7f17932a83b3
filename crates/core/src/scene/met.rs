//! Which part of a scene a ray has met.

use eyebeam_bvh::{Hit, Ray, Surface};
use glam::{DAffine3, Vec2, Vec3};

use crate::scene::placement::Placement;
use crate::scene::{Object, Scene};
use crate::shape::{SurfacePoint, sphere_tangents, sphere_uv};
use crate::texture::{TextureDesc, TexturePoint, TexturesAt};

/// A place on the shapes of a scene, for what is asked only of some.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Met<'s> {
    pub(super) scene: &'s Scene,
    pub(super) object: &'s Object,
    pub(super) primitive: u32,
    /// Which of the object's instances, if it is placed.
    pub(super) instance: u32,
    /// Coordinates on the primitive.
    pub(super) uv: Vec2,
    /// When.
    pub(super) time: f32,
}

impl<'s> Met<'s> {
    #[inline(always)]
    pub(super) fn new<const PLAIN: bool>(scene: &'s Scene, hit: &Hit, time: f32) -> Self {
        let (object, uv) = (&scene.objects[scene.object_of::<PLAIN>(hit) as usize], Vec2::new(hit.u, hit.v));
        let [instance, ..] = hit.instances;
        let (primitive, instance) = match PLAIN || instance == Hit::NO_INSTANCE {
            true => (hit.prim - object.first_primitive, 0),
            false => (hit.prim, instance - object.first_primitive),
        };
        Self { scene, object, primitive, instance, uv, time }
    }

    /// When it was met.
    #[inline]
    pub(crate) fn time(&self) -> f32 {
        self.time
    }

    /// Where the ray met it.
    #[inline(always)]
    pub(super) fn point<const PLAIN: bool>(&self, ray: &Ray, hit: &Hit) -> SurfacePoint {
        match (&self.object.single, &self.object.placement) {
            (Some(single), _) => single.point(ray, hit),
            (None, Some(placement)) if !PLAIN => self.placed_point(placement, ray, hit),
            (None, _) => {
                let surface = self.scene.bvh.surface(hit, ray.time);
                SurfacePoint::new(&surface, ray, hit, self.object.smooth.as_ref(), self.primitive)
            }
        }
    }

    #[inline(never)]
    fn placed_point(&self, placement: &Placement, ray: &Ray, hit: &Hit) -> SurfacePoint {
        let surface = self.scene.bvh.surface(hit, ray.time);
        let to_world = placement.to_world(self.instance, self.time);
        SurfacePoint::moved(&surface, &to_world, ray, hit, self.object.smooth.as_ref(), self.primitive)
    }

    /// From the space of the shape to the world, if that is another one.
    fn to_world(self) -> Option<DAffine3> {
        self.object.placement.as_ref().map(|placement| placement.to_world(self.instance, self.time))
    }

    /// The direction in the space of the shape of a normal in the world.
    fn normal_on_shape(&self, n: Vec3) -> Vec3 {
        let Some(to_world) = self.to_world() else { return n };
        let matrix = to_world.matrix3;
        (matrix.transpose() * n.as_dvec3()).normalize().as_vec3()
    }

    /// The place on the shape, as it says itself, of a place in the world.
    fn place_on_shape(&self, p: Vec3) -> Vec3 {
        let Some(to_world) = self.to_world() else { return p };
        to_world.inverse().transform_point3(p.as_dvec3()).as_vec3()
    }

    /// The way on the shape, as it says itself, of a way in the world.
    pub(super) fn way_on_shape(&self, by: Vec3) -> Vec3 {
        let Some(to_world) = self.to_world() else { return by };
        to_world.inverse().transform_vector3(by.as_dvec3()).as_vec3()
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
        self.ways_in_world(on_shape)
    }

    /// The same with the second coordinates of a mesh.
    pub(super) fn tangents_1(&self, surface: &Surface) -> [Vec3; 2] {
        let Surface::Flat { edges, .. } = surface else { return [Vec3::ZERO; 2] };
        let edges = edges.map(|edge| edge.as_vec3());
        let on_shape = self.object.vertices.as_ref().and_then(|v| v.tangents_1(self.primitive, edges));
        self.ways_in_world(on_shape.unwrap_or_default())
    }

    /// The directions in which coordinates grow, as normal maps and highlights take them, where the point moves with the coordinates by
    /// `tangents`.
    pub(super) fn axes(&self, surface: &Surface, tangents: [Vec3; 2]) -> [Vec3; 2] {
        let (Surface::Flat { edges, .. }, Some(vertices)) = (surface, &self.object.vertices) else { return tangents };
        let axes = vertices.axes(self.primitive, self.uv, edges.map(|edge| edge.as_vec3()));
        axes.map_or(tangents, |axes| self.ways_in_world(axes))
    }

    /// Whether the second of these is to the right of the first, seen from above.
    pub(crate) fn is_mirrored(&self) -> bool {
        let on_shape = self.object.vertices.as_ref().is_some_and(|v| v.is_mirrored(self.primitive));
        on_shape != self.to_world().is_some_and(|to_world| to_world.matrix3.determinant() < 0.0)
    }

    /// The unit normal that the shape itself says at a point of it, on the side of the geometric one.
    pub(crate) fn smooth_normal(&self, point: &SurfacePoint) -> Vec3 {
        let normal = self.object.smooth.as_ref().and_then(|smooth| smooth.normal(self.primitive, self.uv));
        let in_world = |n: Vec3| match self.to_world() {
            Some(to_world) => (to_world.matrix3.inverse().transpose() * n.as_dvec3()).as_vec3(),
            None => n,
        };
        let Some(n) = normal.and_then(|n| in_world(n).try_normalize()) else { return point.n };
        if n.dot(point.n) < 0.0 { -n } else { n }
    }

    /// Ways on the shape, as it says itself, in the world.
    fn ways_in_world(&self, on_shape: [Vec3; 2]) -> [Vec3; 2] {
        let Some(to_world) = self.to_world() else { return on_shape };
        on_shape.map(|way| to_world.transform_vector3(way.as_dvec3()).as_vec3())
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
            uv_1: self.object.vertices.as_ref().and_then(|v| v.uv_1(self.primitive, self.uv)),
            p: point.p,
            p_object: self.place_on_shape(point.p) - self.object.origin,
            n: point.ns,
            n_object: self.normal_on_shape(point.ns),
            vertex_color: self.object.vertices.as_ref().and_then(|v| v.color(self.primitive, self.uv)),
            vertex_alpha: self.object.vertices.as_ref().and_then(|v| v.alpha(self.primitive, self.uv)),
        };
        TexturesAt { textures, at }
    }
}
