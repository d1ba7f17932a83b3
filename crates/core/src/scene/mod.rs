//! What is rendered: immutable, indices instead of names, ready for rays.

mod dress;
mod geometry;
mod lamps;
mod met;
mod placement;
mod view;

pub use eyebeam_bvh::{Bvh, Ray, Slot};

use eyebeam_bvh::{BuildError, Hit, Quality};
use glam::{Vec2, Vec3};

pub(crate) use self::met::Met;

use self::dress::Holes;
pub(crate) use self::dress::{Dress, bent};
use self::geometry::Geometry;
use self::placement::Placement;
use crate::camera::{Camera, CameraDesc};
use crate::color::Spectrum;
use crate::desc::SceneDesc;
use crate::film::Ids;
use crate::interaction::SurfaceInteraction;
use crate::light::{EnvironmentSampling, LightSample, Lights};
use crate::material::MaterialDesc;
use crate::medium::Filling;
use crate::motion::Course;
use crate::names::Numbers;
use crate::shape::{ShapeDesc, Single, Smooth, VertexData};
use crate::texture::{self, TextureDesc};
use crate::validate::Problem;

/// How rays find what they hit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Acceleration {
    /// Through a hierarchy of boxes, of the quality that suits the picture's size and samples.
    #[default]
    Auto,
    /// Through a hierarchy of boxes.
    Tree(Quality),
    /// By a test of everything.
    List,
}

/// How a scene is prepared: nothing of it is seen in the picture but its noise and how long it takes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct BuildOptions {
    /// How rays find what they hit.
    pub acceleration: Acceleration,
    /// How light from a picture of the surroundings is found.
    pub environment: EnvironmentSampling,
}

/// A scene that rays can be traced through. After it is built, nothing can fail.
#[derive(Clone, Debug)]
pub struct Scene {
    bvh: Bvh,
    /// Index of each primitive's object.
    object_of: Vec<u32>,
    objects: Vec<Object>,
    materials: Vec<MaterialDesc>,
    textures: Vec<TextureDesc>,
    /// What is inside shapes, by their material; empty if that matters nowhere.
    fillings: Vec<Option<Filling>>,
    /// Whether one of these bends light of some colours more than that of others.
    disperses: bool,
    lights: Lights,
    camera: CameraDesc,
    holes: Holes,
    is_plain: bool,
    primitive_count: usize,
    shutter: [f32; 2],
    /// Whether a shape moves while the shutter is open.
    moves: bool,
}

/// What the primitives of a shape have in common.
#[derive(Clone, Debug)]
struct Object {
    material: u32,
    /// Index of the first primitive, or of the first instance if it is placed.
    first_primitive: u32,
    /// Number of the first primitive's light; the next ones follow.
    first_light: Option<u32>,
    smooth: Option<Smooth>,
    /// If it is placed elsewhere than it says.
    placement: Option<Box<Placement>>,
    /// If it is one primitive that is where it says.
    single: Option<Single>,
    /// What vertices say to textures, if they do.
    vertices: Option<Box<VertexData>>,
    /// Where the shape's own coordinates begin.
    origin: Vec3,
    /// Whether it is a sphere.
    is_round: bool,
    /// Whether its material is made of others or follows the coordinates.
    is_dressed: bool,
    /// Whether rays may pass it.
    has_holes: bool,
}

impl Object {
    fn is_plain(&self) -> bool {
        !self.is_dressed && !self.has_holes && self.placement.is_none()
    }

    fn holes(&self) -> Holes {
        match (self.has_holes, self.is_round) {
            (false, _) => Holes::None,
            (true, false) => Holes::Flat,
            (true, true) => Holes::Round,
        }
    }
}

/// What a material asks for, itself or by its parts.
#[derive(Clone, Copy, Debug, Default)]
struct Wear {
    is_dressed: bool,
    has_holes: bool,
}

impl Wear {
    /// Of a material by its number.
    fn of(materials: &[MaterialDesc], index: u32) -> Self {
        let Some(material) = materials.get(index as usize) else { return Self::default() };
        let parts =
            material.clone().parts().into_iter().filter_map(|(_, name)| name.map(|name| name.index())).collect();
        let parts: Vec<_> = parts;
        let here = Self {
            is_dressed: !parts.is_empty() || material.has_directions(),
            has_holes: matches!(material, MaterialDesc::Mask(_) | MaterialDesc::Null(_)),
        };
        parts
            .into_iter()
            .map(|part| Self::of(materials, part))
            .fold(here, |a, b| Self { is_dressed: a.is_dressed || b.is_dressed, has_holes: a.has_holes || b.has_holes })
    }
}

impl Scene {
    /// Checks a description and prepares it for rays.
    ///
    /// # Errors
    /// All that [`SceneDesc::check`] finds.
    pub fn build(desc: &SceneDesc) -> Result<Self, Vec<Problem>> {
        Self::build_with(desc, BuildOptions::default())
    }

    /// As [`build`](Self::build), with choices that are not part of the scene.
    ///
    /// # Errors
    /// All that [`SceneDesc::check`] finds.
    pub fn build_with(desc: &SceneDesc, options: BuildOptions) -> Result<Self, Vec<Problem>> {
        let problems = desc.check();
        if !problems.is_empty() {
            return Err(problems);
        }
        let mut materials = vec![MaterialDesc::default()];
        materials.extend(desc.material.values().cloned());
        let (numbers, texture_numbers) = (Numbers::new(desc.material_names()), texture::numbers(&desc.texture));
        for material in &mut materials {
            texture_numbers.resolve(material.textures().1);
            numbers.resolve(material.parts());
        }
        let textures = texture::compile(&desc.texture);
        // The check has found that every number is finite and that the primitives are not too many.
        let refused = |e: BuildError| vec![Problem { path: vec!["shape".into()], message: e.to_string(), hint: None }];
        let build = |geometry: &Geometry| match options.acceleration {
            Acceleration::Auto => Bvh::build(geometry, Quality::auto(expected_rays(desc), geometry.primitives.len())),
            Acceleration::Tree(quality) => Bvh::build(geometry, quality),
            Acceleration::List => Bvh::list(geometry),
        };
        let (mut geometry, mut object_of, mut objects) = (Geometry::default(), Vec::new(), Vec::new());
        for (_, _, shape) in desc.shape.iter() {
            let first = geometry.primitives.len();
            let placement = placement(shape, desc.render.shutter, geometry.objects.len() as u32);
            let is_round = geometry.add(shape, placement.as_ref(), build).map_err(refused)?;
            let material = numbers.get(shape.material().unwrap_or(SceneDesc::DEFAULT_MATERIAL));
            let wear = Wear::of(&materials, material);
            object_of.resize(geometry.primitives.len(), objects.len() as u32);
            objects.push(Object {
                material,
                first_primitive: first as u32,
                first_light: None,
                smooth: shape.smooth(),
                single: shape.single().filter(|_| placement.is_none()),
                placement: placement.map(Box::new),
                vertices: shape.vertex_data().map(Box::new),
                origin: shape.origin(),
                is_round,
                is_dressed: wear.is_dressed,
                has_holes: wear.has_holes,
            });
        }
        let bvh = build(&geometry).map_err(refused)?;
        let holes = objects.iter().map(Object::holes).max().unwrap_or_default();
        let (environment, sun) = desc.environment.compile(options.environment);
        let lights = Lights::far(environment, desc.light.far().chain(sun).collect());
        let camera = desc.camera.clone();
        let fillings = fillings(&materials);
        let (primitive_count, shutter) = (geometry.primitive_count, desc.render.shutter);
        let is_plain = fillings.is_empty() && objects.iter().all(Object::is_plain);
        let moves =
            objects.iter().filter_map(|object| object.placement.as_ref()).any(|placement| placement.is_moving());
        let mut scene = Self {
            bvh,
            object_of,
            objects,
            materials,
            textures,
            disperses: fillings.iter().flatten().any(Filling::disperses),
            fillings,
            lights,
            camera,
            holes,
            is_plain,
            primitive_count,
            shutter,
            moves,
        };
        let mut near = scene.find_lamps(&geometry.primitives);
        near.extend(desc.light.near());
        scene.lights = scene.lights.with_near(near, desc.render.light_selection);
        Ok(scene)
    }

    /// The nearest surface that the ray meets; its direction must have length 1. What moves is there while the shutter is open, where it
    /// is at the time of the ray.
    #[inline]
    pub fn intersect(&self, ray: &Ray) -> Option<SurfaceInteraction<'_>> {
        self.intersect_as::<false>(ray)
    }

    /// Whether its surfaces are no more than shapes that lie still, each of one material, with nothing inside.
    #[inline]
    pub(crate) fn is_plain(&self) -> bool {
        self.is_plain
    }

    /// As [`intersect`](Self::intersect), in a scene that may be known to be [plain](Self::is_plain).
    #[inline(always)]
    pub(crate) fn intersect_as<const PLAIN: bool>(&self, ray: &Ray) -> Option<SurfaceInteraction<'_>> {
        if !PLAIN && self.holes != Holes::None {
            return self.intersect_with_holes(ray);
        }
        let hit = self.bvh.intersect(ray)?;
        Some(self.interaction::<PLAIN>(ray, &hit))
    }

    #[inline(never)]
    fn intersect_with_holes(&self, ray: &Ray) -> Option<SurfaceInteraction<'_>> {
        self.meet(ray).map(|(ray, hit)| self.interaction::<false>(&ray, &hit))
    }

    #[inline(always)]
    fn interaction<const PLAIN: bool>(&self, ray: &Ray, hit: &Hit) -> SurfaceInteraction<'_> {
        let met = Met::new::<PLAIN>(self, hit, ray.time);
        let light = met.object.first_light.map(|first| first.saturating_add(met.primitive));
        let point = met.point::<PLAIN>(ray, hit);
        let (on, material) = (hit.slot(), self.material(&met));
        if PLAIN || !met.object.is_dressed {
            return SurfaceInteraction::new(point, ray.d, Vec3::ZERO, material, light, on, met);
        }
        let Dress { ns, along_u, material } = self.dress(point, &met, ray, hit);
        SurfaceInteraction::new(point.with_ns(ns), ray.d, along_u, material, light, on, met)
    }

    /// Index of the object that was hit. What moves is an object of its own tree.
    #[inline(always)]
    fn object_of<const PLAIN: bool>(&self, hit: &Hit) -> u32 {
        let [instance, ..] = hit.instances;
        self.object_of[if PLAIN || instance == Hit::NO_INSTANCE { hit.prim } else { instance } as usize]
    }

    /// The material that a shape names.
    #[inline]
    fn material(&self, met: &Met<'_>) -> &MaterialDesc {
        &self.materials[met.object.material as usize]
    }

    /// As [`intersect`](Self::intersect), with what a picture can tell of the surface besides.
    pub(crate) fn look(&self, ray: &Ray) -> Option<Look<'_>> {
        let (last, hit) = self.meet(ray)?;
        let si = self.interaction::<false>(&last, &hit);
        let object = self.object_of::<false>(&hit);
        let instance = match self.objects[object as usize].placement.as_deref() {
            Some(Placement::Copies(_)) => Met::new::<false>(self, &hit, ray.time).instance + 1,
            _ => 0,
        };
        let [object, material] = [object, self.objects[object as usize].material].map(|index| index + 1);
        let t = last.o.distance(ray.o) + hit.t;
        Some(Look { si, t, uv: si.uv(), ids: Ids { object, material, instance } })
    }

    /// Whether anything is in the way of the ray before its `t_max`.
    #[inline(always)]
    pub fn occluded(&self, ray: &Ray) -> bool {
        match self.holes {
            Holes::None => self.bvh.occluded(ray),
            Holes::Flat => self.bvh.occluded_where(ray, |hit| self.is_there(ray, hit)),
            Holes::Round => self.meet(ray).is_some(),
        }
    }

    /// Radiance that arrives from a light at a surface; irradiance if it has no size.
    #[inline(always)]
    pub(crate) fn arriving(&self, light: &LightSample, si: &SurfaceInteraction<'_>) -> Spectrum {
        match light.varies {
            None if self.occluded(&si.shadow_ray(light)) => Spectrum::BLACK,
            None => light.l,
            Some(index) => self.seen_of(index, &si.spawn_ray(light.wi)),
        }
    }

    /// Radiance along a ray of a light, if the ray meets that first.
    #[inline(never)]
    fn seen_of(&self, light: u32, ray: &Ray) -> Spectrum {
        let si = self.intersect(ray).filter(|si| si.light() == Some(light));
        si.map_or(Spectrum::BLACK, |si| si.le())
    }

    /// Whether light of some colours is bent more than that of others.
    #[inline]
    pub(crate) fn disperses(&self) -> bool {
        self.disperses
    }

    /// What is inside of shapes, by the numbers of their materials; empty if that matters nowhere.
    #[inline]
    pub(crate) fn fillings(&self) -> &[Option<Filling>] {
        &self.fillings
    }

    /// All that shines.
    #[inline]
    pub(crate) fn lights(&self) -> &Lights {
        &self.lights
    }

    /// The camera for a picture of this size.
    pub fn camera(&self, width: u32, height: u32) -> Camera {
        Camera::exposed(&self.camera, width, height, self.shutter, self.moves)
    }

    /// The number of primitives.
    pub fn primitive_count(&self) -> usize {
        self.primitive_count
    }
}

/// What a ray meets first.
pub(crate) struct Look<'s> {
    pub(crate) si: SurfaceInteraction<'s>,
    /// Distance along the ray, metres.
    pub(crate) t: f32,
    /// The point on the shape, each in 0..1.
    pub(crate) uv: Vec2,
    pub(crate) ids: Ids,
}

/// What is inside shapes of materials, if any matters.
fn fillings(materials: &[MaterialDesc]) -> Vec<Option<Filling>> {
    let mut fillings: Vec<_> = (0..materials.len() as u32).map(|index| filling(materials, index)).collect();
    if !fillings.iter().flatten().any(Filling::matters) {
        fillings.clear();
    }
    fillings
}

/// What is inside shapes of a material by its number, itself or one of its parts.
fn filling(materials: &[MaterialDesc], index: u32) -> Option<Filling> {
    let material = materials.get(index as usize)?;
    let mut parts = material.clone();
    match material {
        MaterialDesc::Dielectric(glass) => Some(glass.filling()),
        MaterialDesc::Principled(layers) => layers.filling(),
        _ => parts.parts().into_iter().find_map(|(_, name)| filling(materials, name?.index())),
    }
}

/// Where a shape is, of whose primitives an object is made, if that is not where it says.
fn placement(shape: &dyn ShapeDesc, shutter: [f32; 2], object: u32) -> Option<Placement> {
    let motion = Course::new(&shape.motion(), shape.origin()).motion(shutter, object);
    motion.map(Placement::Motion).or_else(|| Placement::of_copies(&shape.copies(), object))
}

/// About how many rays the picture takes.
fn expected_rays(desc: &SceneDesc) -> u64 {
    /// Of a path.
    const RAYS: u64 = 4;
    let render = &desc.render;
    let pixels = u64::from(render.width) * u64::from(render.height);
    pixels.saturating_mul(u64::from(render.spp)).saturating_mul(RAYS)
}
