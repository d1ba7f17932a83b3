//! The path tracer.
//!
//! Follows rays backwards as [`weekend`](super::Weekend) does, and at each surface asks one light for what it sends there:
//! next-event estimation. Light that both ways find is weighed between them by multiple importance sampling (Veach & Guibas
//! 1995, doi:10.1145/218380.218498), and paths that carry little are ended by Russian roulette (Arvo & Kirk 1990,
//! doi:10.1145/97879.97886). In the mean it is `weekend`, at every depth: a path of k + 1 edges counts against the depth
//! limit whichever way its last edge was found. Pharr, Jakob & Humphreys, Physically Based Rendering, 4th ed. 2023, §14.4.

use eyebeam_bvh::Ray;

use crate::color::Spectrum;
use crate::film::{Seen, Tile};
use crate::integrator::{Integrator, Unit};
use crate::interaction::SurfaceInteraction;
use crate::light::Scattered;
use crate::material::Bsdf;
use crate::medium::Interior;
use crate::sampler::Sampler;
use crate::sampling::power_heuristic;
use crate::scene::Scene;

/// Paths with light sampling, of at most `max_depth` edges.
#[derive(Clone, Copy, Debug)]
pub struct Path {
    /// The most edges of a path; 0 is black.
    pub max_depth: u32,
}

impl Integrator for Path {
    fn render(&self, scene: &Scene, unit: &Unit<'_>, tile: &mut Tile) -> u64 {
        // Compiled twice, so that plain scenes pay for nothing that they have none of.
        if scene.is_plain() {
            self.render_as::<true>(scene, unit, tile)
        } else {
            self.render_as::<false>(scene, unit, tile)
        }
    }
}

impl Path {
    #[inline(never)]
    fn render_as<const PLAIN: bool>(&self, scene: &Scene, unit: &Unit<'_>, tile: &mut Tile) -> u64 {
        let mut rays = 0;
        unit.for_each_sample(tile, |ray, sampler| self.radiance::<PLAIN>(scene, ray, sampler, &mut rays));
        rays
    }

    #[inline]
    fn radiance<const PLAIN: bool>(
        &self,
        scene: &Scene,
        mut ray: Ray,
        sampler: &mut Sampler<'_>,
        rays: &mut u64,
    ) -> Seen {
        let lights = scene.lights();
        let mut l = Spectrum::BLACK;
        let mut beta = Spectrum::ONE;
        // Refraction squeezes light into another solid angle; that is no reason to end or keep a path.
        let mut eta_sq = 1.0;
        let mut scattered: Option<Scattered> = None;
        let mut interior = if PLAIN { Interior::EMPTY } else { Interior::new(scene, sampler) };
        // Nothing but smooth glass so far, through which the background shows.
        let mut clear = true;
        for depth in 1..=self.max_depth {
            *rays += 1;
            // What is there?
            let Some(si) = scene.intersect_as::<PLAIN>(&ray) else {
                return Seen::outside(l, beta * lights.le(ray.d, scattered), clear);
            };
            interior.absorb(&mut beta, ray.o, si.point().p);
            // Its own light
            if let Some(light) = si.light() {
                l += beta * si.le() * lights.weight(scattered, light, si.point().p);
            }
            if depth == self.max_depth {
                break;
            }
            // A light's light on it
            let bsdf = interior.bsdf(&si);
            if lights.is_sampled() && !bsdf.is_delta() {
                l += beta * direct(scene, &si, &bsdf, &interior, sampler, rays);
            }
            // Where to next?
            let Some((sample, next)) = si.scatter(&bsdf, sampler) else {
                break;
            };
            beta *= sample.weight;
            eta_sq *= sample.eta * sample.eta;
            clear &= si.is_clear(&sample);
            interior.pass(&si, &sample);
            scattered = (!sample.delta).then(|| Scattered { p: si.point().p, n: si.point().ns, pdf: sample.pdf });
            ray = next;
            // Russian roulette
            let survival = Self::PATIENCE * beta.max_component() * eta_sq;
            if depth >= Self::CERTAIN_DEPTH && survival < 1.0 {
                if sampler.get_1d() >= survival {
                    break;
                }
                beta = beta * (1.0 / survival);
            }
        }
        Seen::surface(l)
    }

    /// Paths that carry more than one part of this of the light from their end are sure to go on. To end them sooner saves
    /// few rays and costs much noise (docs/performance.md).
    const PATIENCE: f32 = 4.0;
    /// Edges before the first that may be left out.
    const CERTAIN_DEPTH: u32 = 3;
}

/// Light that one of the lights sends to a point and from there back along the ray, unless something is in between.
#[inline(always)]
fn direct(
    scene: &Scene,
    si: &SurfaceInteraction<'_>,
    bsdf: &Bsdf,
    interior: &Interior,
    sampler: &mut Sampler<'_>,
    rays: &mut u64,
) -> Spectrum {
    let (uc, u) = sampler.get_3d();
    let Some(light) = scene.lights().sample(si.point().p, si.point().ns, uc, u) else {
        return Spectrum::BLACK;
    };
    let (f, pdf) = si.eval_pdf(bsdf, light.wi);
    if f.is_black() {
        return Spectrum::BLACK;
    }
    *rays += 1;
    let mut l = scene.arriving(&light, si);
    interior.absorb_from(&mut l, &light, si);
    let weight = if light.delta { 1.0 } else { power_heuristic(light.pdf, pdf) };
    f * l * (weight / light.pdf)
}
