//! The same scene, seen from elsewhere or in other light from outside.

use crate::desc::SceneDesc;
use crate::light::EnvironmentSampling;
use crate::scene::Scene;
use crate::validate::Problem;

impl Scene {
    /// The same shapes and lamps with the camera and the environment of a description, and its suns; nothing else is looked at, but it
    /// is checked.
    ///
    /// # Errors
    /// All that [`SceneDesc::check`] finds.
    pub fn seen(self, view: &SceneDesc) -> Result<Self, Vec<Problem>> {
        let problems = view.check();
        if !problems.is_empty() {
            return Err(problems);
        }
        let (environment, sun) = view.environment.compile(EnvironmentSampling::default());
        let lights = self.lights.surrounded(environment, view.light.far().chain(sun).collect());
        Ok(Self { lights, camera: view.camera.clone(), ..self })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::Image;
    use crate::light::EnvironmentDesc;
    use crate::light::sky::SkyDesc;
    use crate::render::{Monitor, Render, Settings};
    use crate::shape::SphereDesc;

    fn picture(scene: &Scene, desc: &SceneDesc) -> Image {
        let mut render = Render::new(scene, Settings::from(&desc.render));
        while !render.is_done() {
            render.step(&Monitor::default());
        }
        render.film().develop()
    }

    #[test]
    fn it_is_as_if_it_had_been_built_so() {
        let mut desc = SceneDesc::default();
        let sphere = serde_json::json!({ "radius": 1 });
        desc.shape.sphere.push(serde_json::from_value::<SphereDesc>(sphere).unwrap());
        (desc.render.width, desc.render.height, desc.render.spp) = (16, 12, 2);
        let first = Scene::build(&desc).unwrap();
        desc.environment = EnvironmentDesc::Sky(SkyDesc::default());
        desc.camera.look_from = [3.0, 1.0, 0.0];
        let built = picture(&Scene::build(&desc).unwrap(), &desc);
        assert!(picture(&first, &desc) != built);
        assert!(picture(&first.seen(&desc).unwrap(), &desc) == built);
    }
}
