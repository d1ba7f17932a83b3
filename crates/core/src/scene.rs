//! What is rendered: immutable, indices instead of names, ready for rays.

use std::collections::BTreeMap;

pub use eyebeam_bvh::{Bvh, Ray, Slot};

use eyebeam_bvh::{BuildError, Hit, Primitive, Quality};
use glam::Vec2;

use crate::camera::{Camera, CameraDesc};
use crate::desc::SceneDesc;
use crate::film::Ids;
use crate::interaction::SurfaceInteraction;
use crate::light::{AreaLight, EnvironmentSampling, Light, Lights};
use crate::material::MaterialDesc;
use crate::shape::{MeshUvs, Plane, Smooth, SurfacePoint, sphere_uv};
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
    lights: Lights,
    camera: CameraDesc,
}

/// What the primitives of a shape have in common.
#[derive(Clone, Debug)]
struct Object {
    material: u32,
    first_primitive: u32,
    /// Number of the first primitive's light; the next ones follow.
    first_light: Option<u32>,
    smooth: Option<Smooth>,
    /// If it is a single quad.
    plane: Option<Plane>,
    /// Coordinates for textures, if the mesh has them.
    uvs: Option<MeshUvs>,
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
        let mut index_of = BTreeMap::from([(SceneDesc::DEFAULT_MATERIAL, 0)]);
        for (name, material) in &desc.material {
            index_of.insert(name, materials.len() as u32);
            materials.push(material.clone());
        }
        let numbers = texture::numbers(&desc.texture);
        materials.iter_mut().for_each(|material| numbers.resolve(material.textures().1));
        let textures = texture::compile(&desc.texture);
        let (mut primitives, mut object_of, mut objects) = (Vec::new(), Vec::new(), Vec::new());
        for (_, _, shape) in desc.shape.iter() {
            let first = primitives.len();
            shape.push_primitives(&mut primitives);
            // The check has found that every name exists.
            let material = index_of.get(shape.material().unwrap_or(SceneDesc::DEFAULT_MATERIAL)).copied().unwrap_or(0);
            object_of.resize(primitives.len(), objects.len() as u32);
            objects.push(Object {
                material,
                first_primitive: first as u32,
                first_light: None,
                smooth: shape.smooth(),
                plane: shape.plane(),
                uvs: shape.uvs(),
            });
        }
        let bvh = match options.acceleration {
            Acceleration::Auto => Bvh::build(&primitives, Quality::auto(expected_rays(desc), primitives.len())),
            Acceleration::Tree(quality) => Bvh::build(&primitives, quality),
            Acceleration::List => Bvh::list(&primitives),
        };
        // The check has found that every number is finite and that the primitives are not too many.
        let refused = |e: BuildError| vec![Problem { path: vec!["shape".into()], message: e.to_string(), hint: None }];
        let bvh = bvh.map_err(refused)?;
        let mut lights = area_lights(&primitives, &bvh, &object_of, &mut objects, &materials);
        lights.extend(desc.light.near());
        let (environment, sun) = desc.environment.compile(options.environment);
        let far = desc.light.far().chain(sun).collect();
        let lights = Lights::new(lights, desc.render.light_selection, environment, far);
        Ok(Self { bvh, object_of, objects, materials, textures, lights, camera: desc.camera.clone() })
    }

    /// The nearest surface that the ray meets; its direction must have length 1.
    #[inline(always)]
    pub fn intersect(&self, ray: &Ray) -> Option<SurfaceInteraction<'_>> {
        let hit = self.bvh.intersect(ray)?;
        Some(self.interaction(ray, &hit))
    }

    #[inline(always)]
    fn interaction(&self, ray: &Ray, hit: &Hit) -> SurfaceInteraction<'_> {
        let object = &self.objects[self.object_of[hit.prim as usize] as usize];
        let primitive = hit.prim - object.first_primitive;
        let point = match &object.plane {
            Some(plane) => plane.point(Vec2::new(hit.u, hit.v)),
            None => {
                let surface = self.bvh.surface(hit, ray.time);
                SurfacePoint::new(&surface, ray, hit, object.smooth.as_ref(), primitive)
            }
        };
        let met = Met { scene: self, object, primitive, uv: Vec2::new(hit.u, hit.v) };
        let light = object.first_light.map(|first| first + primitive);
        SurfaceInteraction::new(point, ray.d, &self.materials[object.material as usize], light, hit.slot(), met)
    }

    /// As [`intersect`](Self::intersect), with what a picture can tell of the surface besides.
    pub(crate) fn look(&self, ray: &Ray) -> Option<Look<'_>> {
        let hit = self.bvh.intersect(ray)?;
        let si = self.interaction(ray, &hit);
        let object = self.object_of[hit.prim as usize];
        // One more than the index; none wraps around to 0.
        let [object, material, instance] =
            [object, self.objects[object as usize].material, hit.instances[0]].map(|index| index.wrapping_add(1));
        Some(Look { si, t: hit.t, uv: si.uv(), ids: Ids { object, material, instance } })
    }

    /// Whether anything is in the way of the ray before its `t_max`.
    #[inline]
    pub fn occluded(&self, ray: &Ray) -> bool {
        self.bvh.occluded(ray)
    }

    /// All that shines.
    #[inline]
    pub(crate) fn lights(&self) -> &Lights {
        &self.lights
    }

    /// The camera for a picture of this size.
    pub fn camera(&self, width: u32, height: u32) -> Camera {
        Camera::new(&self.camera, width, height)
    }

    /// The number of primitives.
    pub fn primitive_count(&self) -> usize {
        self.object_of.len()
    }
}

/// Which part of the scene a ray met, for what is asked only of some.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Met<'s> {
    scene: &'s Scene,
    object: &'s Object,
    primitive: u32,
    /// Coordinates on the primitive.
    uv: Vec2,
}

impl<'s> Met<'s> {
    /// Coordinates on the shape: along the edges of a quad, longitude and latitude on a sphere, what a mesh says, or the weights
    /// of a triangle's second and third vertex.
    pub(crate) fn uv(&self, point: &SurfacePoint) -> Vec2 {
        if point.is_round {
            return sphere_uv(point.n);
        }
        self.object.uvs.as_ref().map_or(self.uv, |uvs| uvs.at(self.primitive, self.uv))
    }

    pub(crate) fn textures(&self) -> &'s [TextureDesc] {
        &self.scene.textures
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

/// The lights that primitives are by their materials; notes in the objects which these are.
fn area_lights(
    primitives: &[Primitive],
    bvh: &Bvh,
    object_of: &[u32],
    objects: &mut [Object],
    materials: &[MaterialDesc],
) -> Vec<Light> {
    let mut lights = Vec::new();
    if !materials.iter().any(|material| matches!(material, MaterialDesc::Emissive(_))) {
        return lights;
    }
    let slots = bvh.slots();
    for (i, (primitive, &object)) in primitives.iter().zip(object_of).enumerate() {
        let object = &mut objects[object as usize];
        let MaterialDesc::Emissive(emissive) = &materials[object.material as usize] else {
            continue;
        };
        let slot = slots.get(i).copied().unwrap_or(Slot::NONE);
        if let Some(light) = AreaLight::new(primitive, slot, emissive.radiance.into(), emissive.two_sided) {
            object.first_light.get_or_insert(lights.len() as u32);
            lights.push(Light::Area(light));
        }
    }
    lights
}

/// About how many rays the picture takes.
fn expected_rays(desc: &SceneDesc) -> u64 {
    /// Of a path.
    const RAYS: u64 = 4;
    let render = &desc.render;
    let pixels = u64::from(render.width) * u64::from(render.height);
    pixels.saturating_mul(u64::from(render.spp)).saturating_mul(RAYS)
}
