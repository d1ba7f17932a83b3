//! A ray's meeting with a surface.

use eyebeam_bvh::{Ray, Slot};
use glam::{Vec2, Vec3};

use crate::color::Spectrum;
use crate::light::{LightSample, Target};
use crate::material::{Bsdf, BsdfSample, MaterialDesc};
use crate::math::{Frame, renormalize};
use crate::sampler::Sampler;
use crate::scene::{Met, bent};
use crate::shape::SurfacePoint;
use crate::texture::Textures;

/// A point of a surface, seen along a ray.
///
/// Materials work in the frame of the shading normal. Directions that are above the surface by that normal and below by the
/// geometric one, or the other way round, carry no light: it would leak through the surface (Veach 1997, §5.3).
#[derive(Clone, Copy, Debug)]
pub struct SurfaceInteraction<'s> {
    point: SurfacePoint,
    frame: Frame,
    /// To where the ray came from.
    wo_world: Vec3,
    /// The same; local.
    wo: Vec3,
    /// The direction in which the first coordinate on the shape grows, if anything asks for that.
    along_u: Vec3,
    material: &'s MaterialDesc,
    light: Option<u32>,
    on: Slot,
    met: Met<'s>,
}

impl<'s> SurfaceInteraction<'s> {
    /// Where a ray of unit direction `d` met the surface; `light` is its number among the scene's lights if it shines.
    #[inline(always)]
    pub(crate) fn new(
        point: SurfacePoint,
        d: Vec3,
        along_u: Vec3,
        material: &'s MaterialDesc,
        light: Option<u32>,
        on: Slot,
        met: Met<'s>,
    ) -> Self {
        let frame = Frame::from_z(point.ns);
        Self { point, frame, wo_world: -d, wo: frame.to_local(-d), along_u, material, light, on, met }
    }

    /// Where the surface was met.
    #[inline]
    pub fn point(&self) -> &SurfacePoint {
        &self.point
    }

    /// The number of the light that this surface is.
    #[inline]
    pub(crate) fn light(&self) -> Option<u32> {
        self.light
    }

    /// Radiance that the surface itself sends back along the ray.
    #[inline]
    pub fn le(&self) -> Spectrum {
        self.material.le(self.wo, self)
    }

    /// How the surface scatters light here.
    #[inline]
    pub fn bsdf(&self) -> Bsdf {
        self.material.bsdf(self)
    }

    /// Coordinates on the shape, as [textures](crate::texture) see them.
    #[inline]
    pub fn uv(&self) -> Vec2 {
        self.met.uv(&self.point)
    }

    /// Whether a direction is on the same side of the surface by both normals.
    #[inline]
    fn agrees(&self, w_world: Vec3, w: Vec3) -> bool {
        w_world.dot(self.point.n) * w.z > 0.0
    }

    /// The BSDF times |cos θ| for light from the unit direction `wi_world`, and the density (1/sr) with which
    /// [`scatter`](Self::scatter) draws it.
    #[inline]
    pub fn eval_pdf(&self, bsdf: &Bsdf, wi_world: Vec3) -> (Spectrum, f32) {
        let wi = self.frame.to_local(wi_world);
        if self.agrees(wi_world, wi) { bsdf.eval_pdf(self.wo, wi) } else { (Spectrum::BLACK, 0.0) }
    }

    /// Draws where the light that is scattered back along the ray comes from; none if it is absorbed.
    #[inline(always)]
    pub fn scatter(&self, bsdf: &Bsdf, sampler: &mut Sampler<'_>) -> Option<(BsdfSample, Ray)> {
        let (uc, u) = sampler.get_3d();
        let sample = bsdf.sample(self.wo, uc, u)?;
        let wi_world = self.frame.to_world(sample.wi);
        self.agrees(wi_world, sample.wi).then(|| (sample, self.spawn_ray(wi_world)))
    }

    /// The number of the shape's material, which tells what is inside.
    #[inline]
    pub(crate) fn shape_material(&self) -> u32 {
        self.met.material()
    }

    /// Whether the ray came from the side that the normal points to.
    #[inline]
    pub(crate) fn is_outside(&self) -> bool {
        self.wo_world.dot(self.point.n) > 0.0
    }

    /// Whether the light of a sample comes through the surface.
    #[inline]
    pub(crate) fn is_passed(&self, sample: &BsdfSample) -> bool {
        sample.wi.z * self.wo.z < 0.0
    }

    /// Whether light that arrives along `wi_world` comes through the surface.
    #[inline]
    pub(crate) fn is_passed_along(&self, wi_world: Vec3) -> bool {
        (wi_world.dot(self.point.n) > 0.0) != self.is_outside()
    }

    /// Whether the surface is smooth glass that the light of a sample comes through.
    #[inline]
    pub fn is_clear(&self, sample: &BsdfSample) -> bool {
        sample.delta && self.is_passed(sample)
    }

    /// A ray that leaves along `w` and does not meet this surface again at its start.
    #[inline]
    pub fn spawn_ray(&self, w: Vec3) -> Ray {
        let ray = Ray::new(self.point.ray_origin(self.wo_world, w), renormalize(w));
        Ray { apart: [self.left_along(w), Slot::NONE], time: self.met.time(), ..ray }
    }

    /// The primitive, if what leaves it along `w` does not come back to it.
    #[inline]
    fn left_along(&self, w: Vec3) -> Slot {
        if self.point.is_round && w.dot(self.point.n) <= 0.0 { Slot::NONE } else { self.on }
    }

    /// The ray from here to a light, which ends before it.
    #[inline(always)]
    pub fn shadow_ray(&self, light: &LightSample) -> Ray {
        match light.target {
            Target::Infinity => self.spawn_ray(light.wi),
            Target::On { point: target, on } => {
                let o = self.point.ray_origin(self.wo_world, light.wi);
                let to = target - o;
                let distance = to.length();
                // Neither the distance nor the length of the direction is exact.
                let t_max = distance * (1.0 - 8.0 * f32::EPSILON);
                let apart = [self.left_along(light.wi), on];
                Ray { t_max, apart, time: self.met.time(), ..Ray::new(o, to / distance) }
            }
        }
    }
}

impl Textures for SurfaceInteraction<'_> {
    fn is_mirrored(&self) -> bool {
        self.met.is_mirrored()
    }

    fn above_smooth(&self, w: Vec3) -> Vec3 {
        let along = Frame::from_zx(self.met.smooth_normal(&self.point), self.along_u);
        let along = if self.met.is_mirrored() { along.mirrored() } else { along };
        self.frame.to_local(bent(along.to_world(w), self.point.n, -self.wo_world))
    }

    fn u_axis(&self) -> Vec2 {
        self.frame.to_local(self.along_u).truncate().try_normalize().unwrap_or(Vec2::X)
    }

    #[inline(never)]
    fn color(&self, texture: u32) -> Spectrum {
        self.met.textures(&self.point).color(texture)
    }
}
