//! The rays that a path tracer would trace through a mesh, in the order in which it would make them.

use std::f32::consts::TAU;

use eyebeam_bvh::{Bvh, Hit, Ray};
use glam::Vec3;

use super::meshes::{Model, Patch};
use super::random::Random;

/// What is asked about rays.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Query {
    /// Where is the nearest hit?
    Closest,
    /// Is there any?
    Any,
}

/// Rays of one kind.
pub(crate) struct RaySet {
    pub(crate) name: &'static str,
    pub(crate) query: Query,
    pub(crate) rays: Vec<Ray>,
}

/// The sets: primary rays, first and third diffuse bounce, shadow rays from what primary rays and the first bounce hit.
///
/// `resolution` squared is the number of primary rays, rounded down to whole tiles.
pub(crate) fn sets(model: &Model, bvh: &Bvh, resolution: u32) -> [RaySet; 5] {
    let trace = |rays: &[Ray]| -> Vec<Option<Hit>> { rays.iter().map(|ray| bvh.intersect(ray)).collect() };
    let primary = primary(model, resolution);
    let hits = trace(&primary);
    let bounce_1 = bounce(model, &primary, &hits, 2);
    let hits_1 = trace(&bounce_1);
    let bounce_2 = bounce(model, &bounce_1, &hits_1, 3);
    let bounce_3 = bounce(model, &bounce_2, &trace(&bounce_2), 4);
    let shadow_0 = shadow(model, &primary, &hits, 5);
    let shadow_1 = shadow(model, &bounce_1, &hits_1, 6);
    [
        RaySet { name: "primary", query: Query::Closest, rays: primary },
        RaySet { name: "bounce 1", query: Query::Closest, rays: bounce_1 },
        RaySet { name: "bounce 3", query: Query::Closest, rays: bounce_3 },
        RaySet { name: "shadow of primary", query: Query::Any, rays: shadow_0 },
        RaySet { name: "shadow of bounce 1", query: Query::Any, rays: shadow_1 },
    ]
}

/// One ray somewhere in each pixel of a square picture, in the order of its tiles.
fn primary(model: &Model, resolution: u32) -> Vec<Ray> {
    let camera = Camera::new(model, resolution);
    let mut random = Random(1);
    (0..camera.pixels()).map(|pixel| camera.ray(pixel, [random.unit(), random.unit()])).collect()
}

/// A pinhole camera for a square picture of whole tiles.
#[derive(Clone, Copy)]
pub(crate) struct Camera {
    eye: Vec3,
    forward: Vec3,
    right: Vec3,
    up: Vec3,
    half: f32,
    resolution: u32,
}

impl Camera {
    /// Pixels along the side of a tile.
    pub(crate) const TILE: u32 = 16;

    pub(crate) fn new(model: &Model, resolution: u32) -> Self {
        let view = model.view;
        let forward = (view.look_at - view.eye).normalize();
        let right = forward.cross(Vec3::Y).normalize();
        let half = (view.vfov_deg.to_radians() * 0.5).tan();
        Self { eye: view.eye, forward, right, up: right.cross(forward), half, resolution }
    }

    /// Their number: tile by tile, row by row inside a tile.
    pub(crate) fn pixels(&self) -> u32 {
        (self.resolution / Self::TILE * Self::TILE).pow(2)
    }

    /// Through the point `u` of a pixel, from (0, 0) to (1, 1).
    pub(crate) fn ray(&self, pixel: u32, u: [f32; 2]) -> Ray {
        let tiles = self.resolution / Self::TILE;
        let (tile, pixel) = (pixel / Self::TILE.pow(2), pixel % Self::TILE.pow(2));
        let x = (tile % tiles * Self::TILE + pixel % Self::TILE) as f32 + u[0];
        let y = (tile / tiles * Self::TILE + pixel / Self::TILE) as f32 + u[1];
        let resolution = self.resolution as f32;
        let (x, y) = (x / resolution * 2.0 - 1.0, 1.0 - y / resolution * 2.0);
        Ray::new(self.eye, (self.forward + (self.right * (x * self.half) + self.up * (y * self.half))).normalize())
    }
}

/// A point just above what was hit, and the normal on the ray's side.
pub(crate) fn surface(model: &Model, ray: &Ray, hit: &Hit) -> (Vec3, Vec3) {
    let [a, b, c] = model.corners(hit.prim);
    let normal = (b - a).cross(c - a).normalize_or(-ray.d);
    let normal = if normal.dot(ray.d) > 0.0 { -normal } else { normal };
    let p = ray.o + ray.d * hit.t;
    (p + normal * (1e-4 * (1.0 + p.abs().max_element())), normal)
}

fn surfaces<'a>(model: &'a Model, rays: &'a [Ray], hits: &'a [Option<Hit>]) -> impl Iterator<Item = (Vec3, Vec3)> + 'a {
    rays.iter().zip(hits).filter_map(|(ray, hit)| Some(surface(model, ray, hit.as_ref()?)))
}

/// From each hit on, in a direction of cosine density.
fn bounce(model: &Model, rays: &[Ray], hits: &[Option<Hit>], seed: u64) -> Vec<Ray> {
    let mut random = Random(seed);
    let scatter = |(p, normal)| Ray::new(p, cosine_direction(normal, [random.unit(), random.unit()]));
    surfaces(model, rays, hits).map(scatter).collect()
}

/// A direction of cosine density about the normal.
pub(crate) fn cosine_direction(normal: Vec3, u: [f32; 2]) -> Vec3 {
    let (s, t) = normal.any_orthonormal_pair();
    let (sin_sq, angle) = (u[0], u[1] * TAU);
    let sin = sin_sq.sqrt();
    let cos = (1.0 - sin_sq).sqrt().max(1e-3);
    (s * (sin * angle.cos()) + t * (sin * angle.sin()) + normal * cos).normalize()
}

/// From each hit to a point on a light, if that is on the normal's side.
fn shadow(model: &Model, rays: &[Ray], hits: &[Option<Hit>], seed: u64) -> Vec<Ray> {
    let mut random = Random(seed);
    let connect = |(p, normal)| {
        let light = model.lights[random.integer() as usize % model.lights.len()];
        connection(p, normal, light, [random.unit(), random.unit()]).map(|(ray, _)| ray)
    };
    surfaces(model, rays, hits).filter_map(connect).collect()
}

/// The shadow ray to a point on a light and the distance of that, unless it is below the surface.
pub(crate) fn connection(p: Vec3, normal: Vec3, light: Patch, random: [f32; 2]) -> Option<(Ray, f32)> {
    let [corner, u, v] = light;
    let to_light = corner + (u * random[0] + v * random[1]) - p;
    let distance = to_light.length();
    let ray = Ray { t_max: distance * 0.999, ..Ray::new(p, to_light / distance) };
    (to_light.dot(normal) > 0.0).then_some((ray, distance))
}
