//! The plain backward ray tracer.
//!
//! L(ray, depth) = 0 at depth 0; the environment's radiance if the ray hits nothing; else what the surface emits plus
//! attenuation · L(scattered ray, depth − 1), or nothing more if the material absorbs the ray. With a maximum depth of 1
//! only what shines is drawn. No light is sampled and no path is cut short, so it is slow and has nothing to get wrong:
//! the reference for every faster integrator. Ray Tracing in One Weekend (Shirley 2020); Kajiya 1986,
//! doi:10.1145/15886.15902.

use eyebeam_bvh::Ray;

use crate::color::Spectrum;
use crate::film::{Seen, Tile};
use crate::integrator::{Integrator, Unit};
use crate::medium::Interior;
use crate::sampler::Sampler;
use crate::scene::Scene;

/// Follows each ray from surface to surface until it meets light, is absorbed, or has `max_depth` edges.
#[derive(Clone, Copy, Debug)]
pub struct Weekend {
    /// The most edges of a path; 0 is black.
    pub max_depth: u32,
}

impl Integrator for Weekend {
    fn render(&self, scene: &Scene, unit: &Unit<'_>, tile: &mut Tile) -> u64 {
        let mut rays = 0;
        unit.for_each_sample(tile, |ray, sampler| self.ray_color(scene, ray, sampler, &mut rays));
        rays
    }
}

impl Weekend {
    #[inline]
    fn ray_color(&self, scene: &Scene, mut ray: Ray, sampler: &mut Sampler<'_>, rays: &mut u64) -> Seen {
        let mut l = Spectrum::BLACK;
        let mut beta = Spectrum::ONE;
        let mut interior = Interior::new(scene, sampler);
        // Nothing but smooth glass so far, through which the background shows.
        let mut clear = true;
        for _ in 0..self.max_depth {
            *rays += 1;
            let Some(si) = scene.intersect(&ray) else {
                return Seen::outside(l, beta * scene.lights().le(ray.d, None), clear);
            };
            interior.absorb(&mut beta, ray.o, si.point().p);
            l += beta * si.le();
            let Some((sample, scattered)) = si.scatter(&interior.bsdf(&si), sampler) else {
                break;
            };
            beta *= sample.weight;
            clear &= si.is_clear(&sample);
            interior.pass(&si, &sample);
            ray = scattered;
        }
        Seen::surface(l)
    }
}
