//! The textbook program: Ray Tracing in One Weekend, as its text leads one to write it.
//!
//! A list of hittables behind shared pointers, each with a material behind another; every ray asks all of them through
//! virtual calls; recursion from hit to hit; double precision; points in balls and disks by rejection; random numbers from
//! one generator for each thread. It draws what the renderer draws, by other means and without its ideas, so it is both the
//! yardstick of speed and a second opinion on the picture.
//!
//! Two things differ from the book. Glass reflects by Fresnel's equations, where the book takes Schlick's approximation, so
//! that both pictures have the same expected value. A hit borrows its material, where the book copies a shared pointer: in
//! Rust that is the plainer program, and the faster one.
//!
//! Shirley, Ray Tracing in One Weekend, edition of December 2020.

use std::cell::Cell;
use std::sync::Arc;

use eyebeam_core::camera::CameraDesc;
use eyebeam_core::desc::{RenderDesc, SceneDesc};
use eyebeam_core::light::EnvironmentDesc;
use eyebeam_core::material::MaterialDesc;
use eyebeam_core::texture::Color;

use crate::vec3::Vec3;

mod bvh;

use bvh::Aabb;
pub use bvh::Queries;

thread_local! {
    static STATE: Cell<u64> = const { Cell::new(0x2545_f491_4f6c_dd1d) };
}

/// A uniform number in [0, 1): xorshift64* (Vigna 2016, doi:10.1145/2845077).
fn random() -> f64 {
    STATE.with(|state| {
        let mut x = state.get();
        x ^= x >> 12;
        x ^= x << 25;
        x ^= x >> 27;
        state.set(x);
        (x.wrapping_mul(0x2545_f491_4f6c_dd1d) >> 11) as f64 / (1_u64 << 53) as f64
    })
}

fn random_in_unit_sphere() -> Vec3 {
    loop {
        let p = Vec3::new(2.0 * random() - 1.0, 2.0 * random() - 1.0, 2.0 * random() - 1.0);
        if p.length_squared() < 1.0 {
            return p;
        }
    }
}

fn random_in_unit_disk() -> Vec3 {
    loop {
        let p = Vec3::new(2.0 * random() - 1.0, 2.0 * random() - 1.0, 0.0);
        if p.length_squared() < 1.0 {
            return p;
        }
    }
}

/// The book's ray.
#[derive(Clone, Copy)]
pub struct Ray {
    origin: Vec3,
    direction: Vec3,
}

impl Ray {
    fn at(&self, t: f64) -> Vec3 {
        self.origin + t * self.direction
    }
}

struct HitRecord<'a> {
    p: Vec3,
    /// Of unit length, against the ray.
    normal: Vec3,
    t: f64,
    front_face: bool,
    material: &'a dyn Material,
}

trait Hittable: Send + Sync {
    fn hit(&self, ray: &Ray, t_min: f64, t_max: f64) -> Option<HitRecord<'_>>;

    fn bounding_box(&self) -> Aabb;
}

struct Sphere {
    center: Vec3,
    radius: f64,
    material: Arc<dyn Material>,
}

impl Hittable for Sphere {
    fn hit(&self, ray: &Ray, t_min: f64, t_max: f64) -> Option<HitRecord<'_>> {
        let oc = ray.origin - self.center;
        let a = ray.direction.length_squared();
        let half_b = oc.dot(ray.direction);
        let c = oc.length_squared() - self.radius * self.radius;
        let discriminant = half_b * half_b - a * c;
        if discriminant < 0.0 {
            return None;
        }
        let root = discriminant.sqrt();
        let mut t = (-half_b - root) / a;
        if t < t_min || t_max < t {
            t = (-half_b + root) / a;
            if t < t_min || t_max < t {
                return None;
            }
        }
        let p = ray.at(t);
        let outward = (p - self.center) / self.radius;
        let front_face = ray.direction.dot(outward) < 0.0;
        let normal = if front_face { outward } else { -outward };
        Some(HitRecord { p, normal, t, front_face, material: &*self.material })
    }

    fn bounding_box(&self) -> Aabb {
        let r = self.radius;
        let corner = Vec3::new(r, r, r);
        Aabb { minimum: self.center - corner, maximum: self.center + corner }
    }
}

struct HittableList {
    objects: Vec<Arc<dyn Hittable>>,
}

impl Hittable for HittableList {
    fn hit(&self, ray: &Ray, t_min: f64, t_max: f64) -> Option<HitRecord<'_>> {
        let mut closest = None;
        let mut closest_so_far = t_max;
        for object in &self.objects {
            if let Some(record) = object.hit(ray, t_min, closest_so_far) {
                closest_so_far = record.t;
                closest = Some(record);
            }
        }
        closest
    }

    fn bounding_box(&self) -> Aabb {
        Aabb::around(&self.objects)
    }
}

trait Material: Send + Sync {
    /// The attenuation and the scattered ray; none if the ray is absorbed.
    fn scatter(&self, ray: &Ray, hit: &HitRecord<'_>) -> Option<(Vec3, Ray)>;
}

struct Lambertian {
    albedo: Vec3,
}

impl Material for Lambertian {
    fn scatter(&self, _: &Ray, hit: &HitRecord<'_>) -> Option<(Vec3, Ray)> {
        let mut direction = hit.normal + random_in_unit_sphere().unit();
        if direction.near_zero() {
            direction = hit.normal;
        }
        Some((self.albedo, Ray { origin: hit.p, direction }))
    }
}

struct Metal {
    albedo: Vec3,
    fuzz: f64,
}

impl Material for Metal {
    fn scatter(&self, ray: &Ray, hit: &HitRecord<'_>) -> Option<(Vec3, Ray)> {
        let reflected = ray.direction.unit().reflect(hit.normal);
        let direction = reflected + self.fuzz * random_in_unit_sphere();
        (direction.dot(hit.normal) > 0.0).then_some((self.albedo, Ray { origin: hit.p, direction }))
    }
}

struct Dielectric {
    index_of_refraction: f64,
}

impl Dielectric {
    /// Fresnel's equations; `ratio` is the index before the surface over the one behind.
    fn reflectance(cos: f64, sin: f64, ratio: f64) -> f64 {
        let cos_t = (1.0 - (ratio * sin).powi(2)).sqrt();
        let parallel = (cos - ratio * cos_t) / (cos + ratio * cos_t);
        let perpendicular = (ratio * cos - cos_t) / (ratio * cos + cos_t);
        0.5 * (parallel * parallel + perpendicular * perpendicular)
    }
}

impl Material for Dielectric {
    fn scatter(&self, ray: &Ray, hit: &HitRecord<'_>) -> Option<(Vec3, Ray)> {
        let ratio = if hit.front_face { 1.0 / self.index_of_refraction } else { self.index_of_refraction };
        let unit = ray.direction.unit();
        let cos = (-unit).dot(hit.normal).min(1.0);
        let sin = (1.0 - cos * cos).sqrt();
        let cannot_refract = ratio * sin > 1.0;
        let direction = if cannot_refract || Self::reflectance(cos, sin, ratio) > random() {
            unit.reflect(hit.normal)
        } else {
            unit.refract(hit.normal, ratio)
        };
        Some((Vec3::new(1.0, 1.0, 1.0), Ray { origin: hit.p, direction }))
    }
}

struct Camera {
    origin: Vec3,
    lower_left_corner: Vec3,
    horizontal: Vec3,
    vertical: Vec3,
    u: Vec3,
    v: Vec3,
    lens_radius: f64,
}

impl Camera {
    fn new(desc: &SceneDesc) -> Self {
        let camera = &desc.camera;
        let (look_from, look_at) = (Vec3::from(camera.look_from), Vec3::from(camera.look_at));
        let focus_distance = camera.focus_distance.map_or_else(|| (look_from - look_at).length(), f64::from);
        let half_tan = |degrees: f32| (0.5 * f64::from(degrees).to_radians()).tan();
        let viewport_height = 2.0 * half_tan(camera.vfov.unwrap_or(CameraDesc::DEFAULT_VFOV));
        let viewport_width = viewport_height * f64::from(desc.render.width) / f64::from(desc.render.height);
        let w = (look_from - look_at).unit();
        let u = Vec3::from(camera.up).cross(w).unit();
        let v = w.cross(u);
        let horizontal = focus_distance * viewport_width * u;
        let vertical = focus_distance * viewport_height * v;
        let aperture = camera.aperture.map_or(0.0, f64::from);
        Self {
            origin: look_from,
            lower_left_corner: look_from - horizontal / 2.0 - vertical / 2.0 - focus_distance * w,
            horizontal,
            vertical,
            u,
            v,
            lens_radius: camera.defocus_angle.map_or(aperture / 2.0, |angle| focus_distance * half_tan(angle)),
        }
    }

    fn get_ray(&self, s: f64, t: f64) -> Ray {
        let lens = self.lens_radius * random_in_unit_disk();
        let origin = self.origin + self.u * lens.x + self.v * lens.y;
        let target = self.lower_left_corner + s * self.horizontal + t * self.vertical;
        Ray { origin, direction: target - origin }
    }
}

/// Radiance from straight below and straight above.
struct Background {
    bottom: Vec3,
    top: Vec3,
}

/// The textbook program, ready to render one scene.
pub struct Textbook {
    world: HittableList,
    background: Background,
    camera: Camera,
    settings: RenderDesc,
}

impl Textbook {
    /// The program for a scene of spheres of the book's three materials under a sky.
    ///
    /// # Errors
    /// What the book does not know.
    pub fn new(desc: &SceneDesc) -> Result<Self, String> {
        if !(desc.shape.quad.is_empty() && desc.shape.mesh.is_empty()) {
            return Err("the book draws spheres only".to_owned());
        }
        let background = match &desc.environment {
            EnvironmentDesc::Gradient(g) => Background { bottom: g.bottom.0.into(), top: g.top.0.into() },
            EnvironmentDesc::Constant(k) => Background { bottom: k.radiance.0.into(), top: k.radiance.0.into() },
            EnvironmentDesc::Image(_) | EnvironmentDesc::Sky(_) | EnvironmentDesc::None(_) => {
                return Err("the book has no other light than its sky".to_owned());
            }
        };
        let textured = || "this book has no textures yet".to_owned();
        let constant = |color: &Color| color.rgb().map(|rgb| rgb.0.into()).ok_or_else(textured);
        let mut objects: Vec<Arc<dyn Hittable>> = Vec::new();
        for sphere in &desc.shape.sphere {
            let named = sphere.material.as_ref().and_then(|name| desc.material.get(name)).cloned();
            let material: Arc<dyn Material> = match named.unwrap_or_default() {
                MaterialDesc::Lambertian(m) => Arc::new(Lambertian { albedo: constant(&m.albedo)? }),
                MaterialDesc::Metal(m) => Arc::new(Metal {
                    albedo: constant(&m.albedo)?,
                    fuzz: m.roughness.number().ok_or_else(textured)?.into(),
                }),
                MaterialDesc::Dielectric(m) => Arc::new(Dielectric { index_of_refraction: m.eta.into() }),
                _ => return Err("the book has only matte, metal and clear materials".to_owned()),
            };
            objects.push(Arc::new(Sphere { center: sphere.center.into(), radius: sphere.radius.into(), material }));
        }
        Ok(Self {
            world: HittableList { objects },
            background,
            camera: Camera::new(desc),
            settings: desc.render.clone(),
        })
    }

    fn ray_color(&self, ray: &Ray, depth: u32) -> Vec3 {
        if depth == 0 {
            return Vec3::default();
        }
        if let Some(hit) = self.world.hit(ray, 0.001, f64::INFINITY) {
            return match hit.material.scatter(ray, &hit) {
                Some((attenuation, scattered)) => attenuation * self.ray_color(&scattered, depth - 1),
                None => Vec3::default(),
            };
        }
        let t = 0.5 * (ray.direction.unit().y + 1.0);
        (1.0 - t) * self.background.bottom + t * self.background.top
    }

    /// The mean radiance of every pixel, row by row from the top left.
    pub fn render(&self) -> Vec<[f64; 3]> {
        let RenderDesc { width, height, spp, max_depth, .. } = self.settings;
        let mut pixels = Vec::new();
        for j in (0..height).rev() {
            for i in 0..width {
                let mut color = Vec3::default();
                for _ in 0..spp {
                    let s = (f64::from(i) + random()) / f64::from(width);
                    let t = (f64::from(j) + random()) / f64::from(height);
                    color = color + self.ray_color(&self.camera.get_ray(s, t), max_depth);
                }
                let mean = color / f64::from(spp);
                pixels.push([mean.x, mean.y, mean.z]);
            }
        }
        pixels
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::SQRT_2;
    use std::num::NonZeroUsize;

    use eyebeam_core::scene::Scene;
    use eyebeam_core::testing::z_test;

    use super::*;
    use crate::measure;
    use eyebeam_core::color::luminance;

    const SCENE: &str = r#"
        [camera]
        look_from = [0, 1, 5]
        look_at = [0, 0.5, 0]
        aperture = 0.2
        [material]
        ground.lambertian.albedo = 0.5
        gold.metal = {albedo = [0.9, 0.7, 0.3], roughness = 0.3}
        glass.dielectric.eta = 1.5
        [shape]
        sphere = [
            {center = [0, -1000, 0], radius = 1000, material = "ground"},
            {center = [-1.1, 0.5, 0], radius = 0.5, material = "gold"},
            {center = [0, 0.5, 0], radius = 0.5, material = "glass"},
            {center = [1.1, 0.5, 0], radius = 0.5},
        ]
    "#;

    fn scene() -> SceneDesc {
        eyebeam_io::scene::read_str("spheres", SCENE, &[]).unwrap().desc
    }

    /// Matte, metal and glass through a lens: block by block, both pictures are as far apart as their noise allows.
    #[test]
    fn draws_what_the_renderer_draws() {
        let mut desc = scene();
        measure::shrink(&mut desc, 64, 2048);
        let (mut film, _) = measure::render(&Scene::build(&desc).unwrap(), &desc, NonZeroUsize::MIN);
        let (image, width) = (film.develop(), desc.render.width);
        let index = |x: u32, y: u32| (y * width + x) as usize;
        let mut errors = vec![0.0; image.pixels().len()];
        for tile in film.tiles_mut() {
            for (pixel, sum) in tile.pixels() {
                errors[index(pixel.x, pixel.y)] = sum.standard_error().unwrap();
            }
        }
        let textbook = Textbook::new(&desc).unwrap().render();
        // As many samples of the same distribution: each picture is as noisy as the other.
        z_test(&image, |x, y| luminance(textbook[index(x, y)]), |x, y| SQRT_2 * errors[index(x, y)], 8).unwrap();
        let ours: f64 = image.pixels().iter().map(|rgb| luminance(rgb.map(f64::from))).sum();
        let theirs: f64 = textbook.iter().map(|&rgb| luminance(rgb)).sum();
        assert!((ours / theirs - 1.0).abs() < 0.01, "mean radiance differs by a factor of {}", ours / theirs);
    }

    #[test]
    fn refuses_what_the_book_does_not_know() {
        let lamp = MaterialDesc::Emissive(Default::default());
        let changes: [fn(&mut SceneDesc, MaterialDesc); 2] = [
            |desc, _| desc.environment = EnvironmentDesc::None(Default::default()),
            |desc, lamp| *desc.material.get_mut("gold").unwrap() = lamp,
        ];
        assert!(Textbook::new(&scene()).is_ok());
        for change in changes {
            let mut desc = scene();
            change(&mut desc, lamp.clone());
            assert!(Textbook::new(&desc).is_err());
        }
    }
}
