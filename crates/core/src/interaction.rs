//! A ray's meeting with a surface.

use eyebeam_bvh::Ray;
use glam::{Vec2, Vec3};

use crate::color::Spectrum;
use crate::material::{BsdfSample, MaterialDesc};
use crate::math::{Frame, offset_ray_origin};
use crate::sampler::Sampler;
use crate::shape::SurfacePoint;

/// A point of a surface, seen along a ray.
#[derive(Clone, Copy, Debug)]
pub struct SurfaceInteraction<'s> {
    point: SurfacePoint,
    frame: Frame,
    /// To where the ray came from; local.
    wo: Vec3,
    material: &'s MaterialDesc,
}

impl<'s> SurfaceInteraction<'s> {
    /// Where a ray of unit direction `d` met the surface.
    #[inline]
    pub fn new(point: SurfacePoint, d: Vec3, material: &'s MaterialDesc) -> Self {
        let frame = Frame::from_z(point.n);
        Self { point, frame, wo: frame.to_local(-d), material }
    }

    /// Where the surface was met.
    #[inline]
    pub fn point(&self) -> SurfacePoint {
        self.point
    }

    /// Radiance that the surface itself sends back along the ray.
    #[inline]
    pub fn le(&self) -> Spectrum {
        self.material.le(self.wo)
    }

    /// Draws where the light that is scattered back along the ray comes from; none if it is absorbed.
    #[inline]
    pub fn scatter(&self, sampler: &mut Sampler) -> Option<(BsdfSample, Ray)> {
        let (uc, u): (f32, Vec2) = (sampler.get_1d(), sampler.get_2d());
        let sample = self.material.bsdf().sample(self.wo, uc, u)?;
        Some((sample, self.spawn_ray(self.frame.to_world(sample.wi))))
    }

    /// A ray that leaves along `w` and does not meet this surface again at its start.
    #[inline]
    pub fn spawn_ray(&self, w: Vec3) -> Ray {
        Ray::new(offset_ray_origin(self.point.p, self.point.p_error, self.point.n, w), w.normalize())
    }
}
