//! What a model lacks to make a picture: where the eye is, and light.
//!
//! The eye looks at the middle of what there is from the front, a little from the right and from above, from so far that it
//! nearly fills the picture; of rooms it sees the inside. A model without light stands on a ground that fades into the light of a
//! studio. Lamps light a room; else they are a part of what is shown in the studio.

mod extent;
mod eye;
mod lamp;
mod room;
mod studio;
mod turntable;

use glam::Vec3;

use crate::camera::CameraDesc;
use crate::desc::SceneDesc;
use crate::light::sky::SkyDesc;
use crate::light::{EnvironmentDesc, ImageEnvironment};

use extent::Extent;
use room::Room;

pub use turntable::{Turntable, View};

/// What a file says, besides what there is to see.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Given {
    /// Where the eye is.
    pub camera: bool,
    /// Light from outside.
    pub light: bool,
}

impl Given {
    /// Everything.
    pub const ALL: Self = Self { camera: true, light: true };
}

/// Light from outside.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Surroundings {
    /// A studio where the file has no light, nothing else where it has.
    #[default]
    Auto,
    /// Softboxes and a pale backdrop.
    Studio,
    /// A clear sky with its sun.
    Sky,
    /// What the file has.
    None,
    /// Of a picture.
    Image(ImageEnvironment),
}

/// How a model is shown.
#[derive(Clone, Debug, Default)]
pub struct Setup {
    /// Whether the eye is put in front of the model even if the file says where it is.
    pub own_camera: bool,
    /// Light from outside.
    pub surroundings: Surroundings,
    /// Whether the model stands on something; if nothing is said, it does in a studio and under the sky.
    pub ground: Option<bool>,
}

/// What was made up, and how bright the result is to be taken.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Assumed {
    /// Each in a few words.
    pub what: Vec<&'static str>,
    /// Whether the light is that of the studio, whose brightness is known.
    pub is_studio: bool,
}

impl Setup {
    /// Adds to a model what it lacks.
    pub fn complete(&self, desc: &mut SceneDesc, given: Given) -> Assumed {
        let mut assumed = Assumed::default();
        let is_as_given = self.surroundings == Surroundings::Auto && !self.own_camera && self.ground.is_none();
        if given == Given::ALL && is_as_given {
            return assumed;
        }
        let points = extent::points(desc);
        let Some(extent) = Extent::of(&points) else { return assumed };
        let has_lamps = has_lamps(desc);
        let (found, camera) = self.look(desc, &points, &extent, given);
        if let Some((camera, what)) = camera {
            desc.camera = camera;
            assumed.what.push(what);
        }
        let room = found.filter(|room| !room.stands());
        let is_lit = given.light || room.is_some() && has_lamps;
        let surroundings = match &self.surroundings {
            Surroundings::Auto if is_lit => &Surroundings::None,
            Surroundings::Auto if room.is_some_and(|room| room.is_closed()) => {
                lamp::add(desc, &extent);
                assumed.what.push("a lamp");
                &Surroundings::None
            }
            Surroundings::Auto => &Surroundings::Studio,
            said => said,
        };
        match surroundings {
            Surroundings::Auto | Surroundings::None => {}
            Surroundings::Studio => {
                desc.environment = studio::environment(desc.camera.look_from, desc.camera.look_at);
                assumed.is_studio = true;
                assumed.what.push("a studio");
            }
            Surroundings::Sky => {
                desc.environment = EnvironmentDesc::Sky(SkyDesc::default());
                assumed.what.push("a sky");
            }
            Surroundings::Image(image) => desc.environment = EnvironmentDesc::Image(image.clone()),
        }
        let stands = room.is_none() && matches!(surroundings, Surroundings::Studio | Surroundings::Sky);
        if self.ground.unwrap_or(stands) {
            studio::add_ground(desc, &extent);
            assumed.what.push("a ground");
        }
        assumed
    }

    /// The room, if it is one, and where the eye is put, if it is.
    fn look(
        &self,
        desc: &SceneDesc,
        points: &[Vec3],
        extent: &Extent,
        given: Given,
    ) -> (Option<Room>, Option<(CameraDesc, &'static str)>) {
        let faces = extent::faces(desc);
        let room = Room::find(&faces, extent, has_lamps(desc));
        if given.camera && !self.own_camera {
            return (room, None);
        }
        let aspect = desc.render.width as f32 / desc.render.height.max(1) as f32;
        let seen = match &room {
            None => (eye::in_front(points, &faces, extent, aspect), "a camera in front"),
            Some(room) => {
                let what = if room.stands() { "a camera in front" } else { "a camera in the room" };
                (room.eye(points, &faces, extent, aspect), what)
            }
        };
        (room, Some(seen))
    }
}

/// Whether there is light that is not from outside.
fn has_lamps(desc: &SceneDesc) -> bool {
    desc.has_lamps() || !desc.light.is_dark()
}

/// The least and the greatest coordinates of all shapes, metres; none if there are none.
pub fn bounds(desc: &SceneDesc) -> Option<[Vec3; 2]> {
    Extent::around(extent::points(desc).into_iter()).map(|Extent { min, max }| [min, max])
}

/// A name that no material and no texture has.
fn unused(desc: &SceneDesc, name: &str) -> String {
    let mut unused = name.to_owned();
    while desc.material.contains_key(&unused) || desc.texture.contains_key(&unused) {
        unused.push('\'');
    }
    unused
}
