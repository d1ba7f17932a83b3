//! A model that turns before a camera and lamps at rest; in a room without an open side, an eye that turns in the middle.
//!
//! What turns here is the camera, and with it the light from outside, about the vertical axis through the middle of the model: that is
//! the same picture, and nothing of the scene moves. A camera that was made up stands so far away that the model fits at every angle: a
//! point at a distance r from the axis is seen anywhere on a circle, whose outermost places for each side of the picture are known.

use glam::Vec3;

use crate::camera::CameraDesc;
use crate::desc::SceneDesc;
use crate::light::EnvironmentDesc;
use crate::light::sky::SkyDesc;
use crate::math::sin_cos_turns;
use crate::setup::extent::{self, Extent};
use crate::setup::eye::FILL;
use crate::setup::has_lamps;
use crate::setup::room::Room;

/// Where the axis is, and what turns about it.
#[derive(Clone, Debug)]
pub struct Turntable {
    center: Vec3,
    /// Of each point, the distance from the axis and the height above the middle.
    points: Vec<[f32; 2]>,
    /// Whether the eye is in a room and turns, and the light stays where it is.
    is_inside: bool,
}

/// What a camera sees at an angle.
#[derive(Clone, Debug, PartialEq)]
pub struct View {
    /// The camera.
    pub camera: CameraDesc,
    /// Light from outside.
    pub environment: EnvironmentDesc,
}

impl Turntable {
    /// For a model before anything is made up for it; none if there is nothing to see.
    pub fn around(desc: &SceneDesc) -> Option<Self> {
        let points = extent::points(desc);
        let extent = Extent::of(&points)?;
        let center = extent.center();
        let seen = points.iter().filter(|&&p| extent.holds(p)).map(|&p| p - center);
        let points = seen.map(|p| [(p.x * p.x + p.z * p.z).sqrt(), p.y]).collect();
        let is_inside = Room::find(&extent::faces(desc), &extent, has_lamps(desc)).is_some_and(|room| room.is_closed());
        Some(Self { center, points, is_inside })
    }

    /// Lets a perspective camera look at the axis, from its side, from so far that the model fits at every angle; in a room, from the
    /// axis.
    pub fn fit(&self, camera: &mut CameraDesc, aspect: f32) {
        if self.is_inside {
            /// Down for each metre ahead: more stands on the floor than hangs from the ceiling.
            const DOWN: f32 = 0.2;
            let ahead = (Vec3::from(camera.look_at) - Vec3::from(camera.look_from)).with_y(0.0);
            camera.look_from = self.center.into();
            camera.look_at = (self.center + ahead - DOWN * ahead.length() * Vec3::Y).into();
            return;
        }
        let back = (Vec3::from(camera.look_from) - Vec3::from(camera.look_at)).normalize_or(Vec3::Z);
        let right = Vec3::Y.cross(back).normalize_or(Vec3::X);
        let up = back.cross(right);
        let (sin_half, cos_half) = sin_cos_turns(camera.vfov.unwrap_or(CameraDesc::DEFAULT_VFOV) / 720.0);
        let t_y = FILL * sin_half / cos_half;
        let t_x = t_y * aspect;
        // Of the line of sight over the ground.
        let (sin, cos) = (back.y, up.y);
        // To the side, above and below.
        let mut sides = [f32::NEG_INFINITY; 3];
        for &[r, h] in &self.points {
            let side = [
                h * sin + r * (1.0 / (t_x * t_x) + cos * cos).sqrt(),
                h * (sin + cos / t_y) + r * (cos - sin / t_y).abs(),
                h * (sin - cos / t_y) + r * (cos + sin / t_y).abs(),
            ];
            sides = [0, 1, 2].map(|i| sides[i].max(side[i]));
        }
        let distance = sides[0].max(0.5 * (sides[1] + sides[2]));
        let distance = if distance > 1e-12 { distance } else { 1.0 };
        let at = self.center + up * (0.5 * t_y * (sides[1] - sides[2]));
        camera.look_at = at.into();
        camera.look_from = (at + back * distance).into();
    }

    /// A view turned by a part of a full turn, counter-clockwise as seen from above.
    pub fn turned(&self, view: &View, turns: f32) -> View {
        let View { mut camera, mut environment } = view.clone();
        if turns == 0.0 {
            return View { camera, environment };
        }
        let (sin, cos) = sin_cos_turns(turns);
        let center = if self.is_inside { camera.look_from.into() } else { self.center };
        let turn = |v: [f32; 3]| [v[0] * cos + v[2] * sin, v[1], v[2] * cos - v[0] * sin];
        let place = |p: [f32; 3]| (center + Vec3::from(turn((Vec3::from(p) - center).into()))).into();
        camera.look_from = place(camera.look_from);
        camera.look_at = place(camera.look_at);
        camera.up = turn(camera.up);
        for key in &mut camera.motion {
            key.look_from = key.look_from.map(place);
            key.look_at = key.look_at.map(place);
            key.up = key.up.map(turn);
        }
        match &mut environment {
            _ if self.is_inside => {}
            EnvironmentDesc::Image(map) => map.rotation = (map.rotation + 360.0 * turns) % 360.0,
            EnvironmentDesc::Sky(sky) => {
                let sun = turn(sky.direction_to_sun().into());
                let nothing = SkyDesc::default();
                let SkyDesc { sun_elevation, sun_azimuth, latitude, longitude, time, .. } = nothing;
                *sky = SkyDesc {
                    sun_direction: Some(sun),
                    sun_elevation,
                    sun_azimuth,
                    latitude,
                    longitude,
                    time,
                    ..sky.clone()
                };
            }
            // The same all around.
            EnvironmentDesc::Gradient(_) | EnvironmentDesc::Constant(_) | EnvironmentDesc::None(_) => {}
        }
        View { camera, environment }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::setup::{Given, Setup};
    use crate::shape::{MeshDesc, QuadDesc};

    /// A long bar.
    fn bar() -> SceneDesc {
        let corner = |i: u32| [0, 1, 2].map(|axis| if i >> axis & 1 == 0 { -1.0 } else { 1.0 });
        let vertices = (0..8).map(corner).map(|[x, y, z]| [4.0 * x + 7.0, y, 0.5 * z - 3.0]).collect();
        let mut desc = SceneDesc::default();
        desc.shape.mesh.push(MeshDesc { vertices, ..MeshDesc::default() });
        desc
    }

    /// How far from the middle of the picture the outermost point is, 1 at the edge.
    fn outermost(points: &[Vec3], camera: &CameraDesc, aspect: f32) -> f32 {
        let (from, at) = (Vec3::from(camera.look_from), Vec3::from(camera.look_at));
        let back = (from - at).normalize();
        let right = Vec3::from(camera.up).cross(back).normalize();
        let up = back.cross(right);
        let t = (camera.vfov.unwrap() / 2.0).to_radians().tan();
        let place = |p: &Vec3| {
            let d = *p - from;
            (d.dot(right) / (t * aspect)).abs().max((d.dot(up) / t).abs()) / -d.dot(back)
        };
        points.iter().map(place).fold(0.0, f32::max)
    }

    #[test]
    fn the_model_fits_at_every_angle_from_one_distance() {
        for aspect in [0.4, 1.0, 1.8] {
            let mut desc = bar();
            let points = extent::points(&desc);
            let turntable = Turntable::around(&desc).unwrap();
            Setup { ground: Some(false), ..Setup::default() }.complete(&mut desc, Given::default());
            turntable.fit(&mut desc.camera, aspect);
            let view = View { camera: desc.camera, environment: desc.environment };
            let of = |i: u32| outermost(&points, &turntable.turned(&view, i as f32 / 360.0).camera, aspect);
            let most = (0..360).map(of).fold(0.0, f32::max);
            assert!((0.7..0.7401).contains(&most), "{most} at {aspect}");
        }
    }

    #[test]
    fn in_a_room_the_eye_turns() {
        let mut desc = SceneDesc::default();
        for axis in 0..3 {
            let [x, y] = [1, 2].map(|i| Vec3::from([0, 1, 2].map(|k| if k == (axis + i) % 3 { 4.0 } else { 0.0 })));
            let near = Vec3::splat(-2.0);
            let far = near + x.cross(y).normalize() * 4.0;
            for [corner, u, v] in [[near, x, y], [far, y, x]] {
                let [corner, u, v] = [corner, u, v].map(Into::into);
                desc.shape.quad.push(QuadDesc { corner, u, v, ..QuadDesc::default() });
            }
        }
        let table = [[-0.5; 3], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]];
        let [corner, u, v] = table;
        desc.shape.quad.push(QuadDesc { corner, u, v, ..QuadDesc::default() });
        let turntable = Turntable::around(&desc).unwrap();
        Setup::default().complete(&mut desc, Given::default());
        turntable.fit(&mut desc.camera, 1.5);
        let sky = EnvironmentDesc::Sky(SkyDesc::default());
        let view = View { camera: desc.camera, environment: sky.clone() };
        let half = turntable.turned(&view, 0.5);
        let ahead = |view: &View| Vec3::from(view.camera.look_at) - Vec3::from(view.camera.look_from);
        assert_eq!(view.camera.look_from, [0.0; 3]);
        assert_eq!((half.camera.look_from, half.environment), ([0.0; 3], sky));
        let [one, other] = [ahead(&view), ahead(&turntable.turned(&view, 0.5))];
        assert!((one + other).with_y(0.0).length() < 1e-5 && one.y == other.y && one.y < 0.0, "{one} {other}");
    }

    #[test]
    fn a_full_turn_is_none_and_light_goes_along() {
        let mut desc = bar();
        let turntable = Turntable::around(&desc).unwrap();
        Setup::default().complete(&mut desc, Given::default());
        let view = View { camera: desc.camera, environment: desc.environment };
        assert_eq!(turntable.turned(&view, 0.0), view);
        let EnvironmentDesc::Image(studio) = &view.environment else { panic!("{view:?}") };
        let quarter = turntable.turned(&view, 0.25);
        let EnvironmentDesc::Image(turned) = &quarter.environment else { panic!("{quarter:?}") };
        assert!((turned.rotation - studio.rotation - 90.0).abs() < 1e-3);
        let [from, to] = [&view, &quarter].map(|v| Vec3::from(v.camera.look_from) - turntable.center);
        assert!((to - Vec3::new(from.z, from.y, -from.x)).length() < 1e-3, "{from} to {to}");
        let sky = View { environment: EnvironmentDesc::Sky(SkyDesc::default()), ..view };
        let EnvironmentDesc::Sky(turned) = turntable.turned(&sky, 0.25).environment else { panic!() };
        let (from, to) = (SkyDesc::default().direction_to_sun(), turned.direction_to_sun());
        assert!((to - Vec3::new(from.z, from.y, -from.x)).length() < 1e-5, "{from} to {to}");
    }
}
