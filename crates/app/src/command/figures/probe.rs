//! Which pixels show what: found by rays, from the scene's own geometry.

use eyebeam_core::desc::SceneDesc;
use eyebeam_core::film::Image;
use eyebeam_core::sampler::{Independent, Sampler};
use eyebeam_core::scene::{Ray, Scene};
use glam::{UVec2, Vec2, Vec3};

/// A pinhole picture of spheres, of which some are perfect mirrors.
pub(super) struct Probe<'a> {
    pub(super) desc: &'a SceneDesc,
    pub(super) scene: &'a Scene,
    pub(super) width: u32,
    pub(super) height: u32,
}

/// A point of the sphere of this index in the scene file.
#[derive(Clone, Copy, Debug)]
pub(super) struct Seen {
    pub(super) sphere: usize,
    pub(super) p: Vec3,
}

impl Probe<'_> {
    /// The pixels where the rays through the centre and the four corners all see what is asked for, straight from the
    /// eye: such a pixel shows nothing else.
    pub(super) fn pixels(&self, wanted: impl Fn(Option<Seen>) -> bool) -> Vec<UVec2> {
        self.pixels_of(|ray| wanted(self.meet(&ray).map(|(seen, _)| seen)))
    }

    /// As [`pixels`](Self::pixels), for what is seen in the mirror of index `mirror`.
    pub(super) fn pixels_mirrored(&self, mirror: usize, wanted: impl Fn(Seen) -> bool) -> Vec<UVec2> {
        self.pixels_of(|ray| {
            let reflected = self.meet(&ray).filter(|(seen, _)| seen.sphere == mirror).and_then(|(_, ray)| ray);
            reflected.and_then(|ray| self.meet(&ray)).is_some_and(|(seen, _)| wanted(seen))
        })
    }

    fn pixels_of(&self, wanted: impl Fn(Ray) -> bool) -> Vec<UVec2> {
        const PLACES: [Vec2; 5] =
            [Vec2::splat(0.5), Vec2::ZERO, Vec2::new(1.0, 0.0), Vec2::new(0.0, 1.0), Vec2::splat(1.0)];
        let camera = self.scene.camera(self.width, self.height);
        let all = (0..self.height).flat_map(|y| (0..self.width).map(move |x| UVec2::new(x, y)));
        all.filter(|pixel| {
            PLACES.iter().all(|&place| camera.ray(pixel.as_vec2() + place, &mut numbers()).is_some_and(&wanted))
        })
        .collect()
    }

    /// What a ray meets, and the ray that is scattered there.
    fn meet(&self, ray: &Ray) -> Option<(Seen, Option<Ray>)> {
        let si = self.scene.intersect(ray)?;
        let p = si.point().p;
        let spheres = &self.desc.shape.sphere;
        let off = |i: &usize| (p.distance(Vec3::from(spheres[*i].center)) - spheres[*i].radius).abs();
        let sphere = (0..spheres.len()).min_by(|a, b| off(a).total_cmp(&off(b)))?;
        Some((Seen { sphere, p }, si.scatter(&si.bsdf(), &mut numbers()).map(|(_, ray)| ray)))
    }
}

/// Numbers for what does not depend on them: a pinhole, a perfect mirror.
fn numbers() -> Sampler<'static> {
    Sampler::Independent(Independent::new(0, UVec2::ZERO, 0))
}

/// Mean colour of some pixels; black if there are none.
pub(super) fn mean(image: &Image, pixels: &[UVec2]) -> [f64; 3] {
    let count = pixels.len().max(1) as f64;
    [0, 1, 2].map(|c| pixels.iter().map(|p| f64::from(image.pixel(p.x, p.y)[c])).sum::<f64>() / count)
}
