//! Wrong numbers, filters and cameras.

use eyebeam_core::film::FilterSample;
use eyebeam_core::sampler::Sampler;
use eyebeam_core::scene::Ray;
use eyebeam_core::testing::{CameraRays, Numbers, PixelFilter};
use glam::{Vec2, Vec3};

use crate::mistake::Mistake;

pub(crate) fn numbers<'s>(mistake: Mistake, inner: Box<dyn Numbers + 's>) -> Box<dyn Numbers + 's> {
    Box::new(WrongNumbers(mistake, inner))
}

struct WrongNumbers<'s>(Mistake, Box<dyn Numbers + 's>);

impl WrongNumbers<'_> {
    fn wrong(&self, u: Vec2) -> Vec2 {
        match self.0 {
            Mistake::EqualDimensions => Vec2::splat(u.x),
            Mistake::CoarseNumbers => (u * 10.0).floor() / 10.0,
            _ => u,
        }
    }
}

impl Numbers for WrongNumbers<'_> {
    fn get_1d(&mut self) -> f32 {
        self.1.get_1d()
    }

    fn get_2d(&mut self) -> Vec2 {
        let u = self.1.get_2d();
        self.wrong(u)
    }

    fn get_3d(&mut self) -> (f32, Vec2) {
        let (uc, u) = self.1.get_3d();
        (uc, self.wrong(u))
    }
}

pub(crate) struct Filter(pub(crate) Mistake, pub(crate) Box<dyn PixelFilter>);

impl PixelFilter for Filter {
    fn radius(&self) -> f32 {
        self.1.radius()
    }

    fn sample(&self, u: Vec2) -> FilterSample {
        let sample = self.1.sample(u);
        match self.0 {
            Mistake::FilterOffByHalfAPixel => FilterSample { offset: sample.offset + 0.5, ..sample },
            Mistake::FilterWithoutSign => FilterSample { weight: sample.weight.abs(), ..sample },
            _ => sample,
        }
    }

    fn eval(&self, offset: Vec2) -> f32 {
        self.1.eval(offset)
    }
}

pub(crate) struct Camera {
    pub(crate) mistake: Mistake,
    pub(crate) inner: Box<dyn CameraRays>,
    pub(crate) width: f32,
}

impl Camera {
    fn wrong(&self, film: Vec2) -> Vec2 {
        if self.mistake == Mistake::MirroredCamera { Vec2::new(self.width - film.x, film.y) } else { film }
    }
}

impl CameraRays for Camera {
    fn ray(&self, film: Vec2, sampler: &mut Sampler<'_>) -> Option<Ray> {
        let ray = self.inner.ray(self.wrong(film), sampler)?;
        Some(if self.mistake == Mistake::LongDirections { Ray { d: ray.d * 1.01, ..ray } } else { ray })
    }

    fn project(&self, p: Vec3) -> Option<Vec2> {
        Some(self.wrong(self.inner.project(p)?))
    }
}
