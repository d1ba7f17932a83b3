//! What the camera sees first: one ray a sample, and no light.
//!
//! The rays are those of the picture's own samples, so what is found has the edges and the blur of the picture. Through
//! mirrors and smooth glass, rays go on as the paths of the picture do: with the same numbers they take the same way.

use glam::{DVec2, DVec3, UVec2, Vec3};

use crate::color::Spectrum;
use crate::film::{FirstHit, Ids};
use crate::integrator::Unit;
use crate::medium::Interior;
use crate::sampler::Sampler;
use crate::scene::{Look, Scene};

/// What is seen through a pixel. With `through`, albedo and normals are those of what perfect mirrors and smooth glass show,
/// the albedo times what they let through.
pub(crate) fn first_hit(scene: &Scene, unit: &Unit<'_>, pixel: UVec2, through: bool) -> FirstHit {
    let most_mirrors = if through { MOST_MIRRORS } else { 0 };
    let mut mean = Mean::default();
    for sample in unit.samples.clone() {
        let mut camera = unit.camera_sample(pixel, sample);
        let weight = f64::from(camera.weight.max(0.0));
        mean.all += weight;
        if let Some((look, time)) = camera.ray.and_then(|ray| Some((scene.look(&ray)?, ray.time))) {
            let (eye, forward) = unit.camera.axis(time);
            mean.add_place(&look, &Axis { eye, forward }, weight);
            if let Some(shown) = Shown::follow(scene, look, most_mirrors, &mut camera.sampler) {
                mean.add_surface(&shown, weight);
            }
        }
    }
    FirstHit { ids: ids(scene, unit, pixel), ..mean.finish() }
}

/// The most mirrors that are looked into, one in the other.
const MOST_MIRRORS: usize = 8;

/// Numbers of what is at the centre of the pixel.
fn ids(scene: &Scene, unit: &Unit<'_>, pixel: UVec2) -> Ids {
    let ray = unit.camera.central_ray(pixel.as_vec2() + 0.5);
    ray.and_then(|ray| scene.look(&ray)).map(|look| look.ids).unwrap_or_default()
}

/// What depth is measured along.
struct Axis {
    eye: Vec3,
    forward: Vec3,
}

/// A surface as it appears in the picture.
struct Shown {
    albedo: Spectrum,
    ns: Vec3,
    n: Vec3,
}

impl Shown {
    /// What up to `most` perfect mirrors and smooth glasses show; none if that is the background.
    fn follow(scene: &Scene, look: Look<'_>, most: usize, sampler: &mut Sampler<'_>) -> Option<Self> {
        let mut si = look.si;
        // Share of the energy, so that glass is as bright from inside as from outside.
        let mut share = Spectrum::ONE;
        let mut interior = Interior::new(scene, sampler);
        for _ in 0..most {
            let bsdf = interior.bsdf(&si);
            if !bsdf.is_delta() {
                break;
            }
            let (sample, ray) = si.scatter(&bsdf, sampler)?;
            interior.pass(&si, &sample);
            share *= sample.weight * (sample.eta * sample.eta);
            si = scene.intersect(&ray)?;
            interior.absorb(&mut share, ray.o, si.point().p);
        }
        Some(Self { albedo: share * si.bsdf().albedo(), ns: si.point().ns, n: si.point().n })
    }
}

/// Weighted sums in double precision, always in the order of the samples.
#[derive(Default)]
struct Mean {
    /// Weights of all samples, and of those that hit.
    all: f64,
    hit: f64,
    albedo: DVec3,
    ns: DVec3,
    n: DVec3,
    depth: f64,
    distance: f64,
    p: DVec3,
    uv: DVec2,
}

impl Mean {
    fn add_surface(&mut self, shown: &Shown, weight: f64) {
        self.albedo += Vec3::from(shown.albedo.to_rgb()).as_dvec3() * weight;
        self.ns += shown.ns.as_dvec3() * weight;
        self.n += shown.n.as_dvec3() * weight;
    }

    fn add_place(&mut self, look: &Look<'_>, axis: &Axis, weight: f64) {
        let p = look.si.point().p.as_dvec3();
        self.hit += weight;
        self.depth += (p - axis.eye.as_dvec3()).dot(axis.forward.as_dvec3()) * weight;
        self.distance += f64::from(look.t) * weight;
        self.p += p * weight;
        self.uv += look.uv.as_dvec2() * weight;
    }

    fn finish(self) -> FirstHit {
        if self.hit == 0.0 {
            return FirstHit::NOTHING;
        }
        let (all, hit) = (1.0 / self.all, 1.0 / self.hit);
        FirstHit {
            albedo: (self.albedo * all).as_vec3().into(),
            ns: (self.ns * all).as_vec3(),
            n: (self.n * all).as_vec3(),
            depth: (self.depth * hit) as f32,
            distance: (self.distance * hit) as f32,
            p: (self.p * hit).as_vec3(),
            uv: (self.uv * hit).as_vec2(),
            ids: Ids::default(),
        }
    }
}
