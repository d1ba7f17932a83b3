//! What is rendered: immutable, indices instead of names, ready for rays.

use std::collections::BTreeMap;

pub use eyebeam_bvh::{Bvh, Ray};

use eyebeam_bvh::{BuildError, Quality};

use crate::camera::{Camera, CameraDesc};
use crate::desc::SceneDesc;
use crate::interaction::SurfaceInteraction;
use crate::light::EnvironmentDesc;
use crate::material::MaterialDesc;
use crate::shape::SurfacePoint;
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

/// A scene that rays can be traced through. After it is built, nothing can fail.
#[derive(Clone, Debug)]
pub struct Scene {
    bvh: Bvh,
    /// Index of each primitive's material.
    material_of: Vec<u32>,
    materials: Vec<MaterialDesc>,
    environment: EnvironmentDesc,
    camera: CameraDesc,
}

impl Scene {
    /// Checks a description and prepares it for rays.
    ///
    /// # Errors
    /// All that [`SceneDesc::check`] finds.
    pub fn build(desc: &SceneDesc) -> Result<Self, Vec<Problem>> {
        Self::build_with(desc, Acceleration::default())
    }

    /// As [`build`](Self::build), with the acceleration structure of choice: the picture is the same, the time is not.
    ///
    /// # Errors
    /// All that [`SceneDesc::check`] finds.
    pub fn build_with(desc: &SceneDesc, acceleration: Acceleration) -> Result<Self, Vec<Problem>> {
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
        let (mut primitives, mut material_of) = (Vec::new(), Vec::new());
        for (_, _, shape) in desc.shape.iter() {
            shape.push_primitives(&mut primitives);
            // The check has found that every name exists.
            let material = index_of.get(shape.material().unwrap_or(SceneDesc::DEFAULT_MATERIAL)).copied().unwrap_or(0);
            material_of.resize(primitives.len(), material);
        }
        let bvh = match acceleration {
            Acceleration::Auto => Bvh::build(&primitives, Quality::auto(expected_rays(desc), primitives.len())),
            Acceleration::Tree(quality) => Bvh::build(&primitives, quality),
            Acceleration::List => Bvh::list(&primitives),
        };
        // The check has found that every number is finite and that the primitives are not too many.
        let refused = |e: BuildError| vec![Problem { path: vec!["shape".into()], message: e.to_string(), hint: None }];
        Ok(Self {
            bvh: bvh.map_err(refused)?,
            material_of,
            materials,
            environment: desc.environment.clone(),
            camera: desc.camera.clone(),
        })
    }

    /// The nearest surface that the ray meets; its direction must have length 1.
    #[inline]
    pub fn intersect(&self, ray: &Ray) -> Option<SurfaceInteraction<'_>> {
        let hit = self.bvh.intersect(ray)?;
        let point = SurfacePoint::new(&self.bvh.surface(&hit, ray.time), ray, &hit);
        let material = &self.materials[self.material_of[hit.prim as usize] as usize];
        Some(SurfaceInteraction::new(point, ray.d, material))
    }

    /// Light from outside.
    #[inline]
    pub fn environment(&self) -> &EnvironmentDesc {
        &self.environment
    }

    /// The camera for a picture of this size.
    pub fn camera(&self, width: u32, height: u32) -> Camera {
        Camera::new(&self.camera, width, height)
    }

    /// The number of primitives.
    pub fn primitive_count(&self) -> usize {
        self.material_of.len()
    }
}

/// About how many rays the picture takes.
fn expected_rays(desc: &SceneDesc) -> u64 {
    /// Of a path.
    const RAYS: u64 = 4;
    let render = &desc.render;
    let pixels = u64::from(render.width) * u64::from(render.height);
    pixels.saturating_mul(u64::from(render.spp)).saturating_mul(RAYS)
}
