//! What is seen for a known share of the time while the shutter is open.

use std::f64::consts::PI;

use super::KnownScene;
use super::build::*;
use crate::camera::CameraKey;
use crate::color::Rgb;
use crate::desc::SceneDesc;
use crate::light::DirectionalLight;
use crate::material::{Emissive, MaterialDesc};
use crate::motion::{MotionKey, Rotation};

pub(super) fn scenes() -> Vec<KnownScene> {
    let seen = [crossing(), stopping(), turning(), growing(), passing_by(), passing_lamp()];
    seen.into_iter().chain([shadow(), in_a_lamp(), furnace()]).collect()
}

/// A key that only moves.
fn moved(time: f32, offset: [f32; 3]) -> MotionKey {
    MotionKey { time, offset, ..MotionKey::default() }
}

fn turned(time: f32, axis: [f32; 3], angle: f32) -> MotionKey {
    MotionKey { time, rotation: Some(Rotation { axis, angle }), ..MotionKey::default() }
}

/// A square of side 1 around a point beside the line of sight, before a sky.
fn square(name: &str, material: MaterialDesc) -> SceneDesc {
    let mut desc = empty(WHITE, stare([0.0, 0.1, 5.0], [0.0, 0.1, 0.0]));
    add_quad(&mut desc, [[-0.5, -0.5, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], name, material);
    desc
}

/// A black square that crosses the line of sight, once.
fn crossing() -> KnownScene {
    let mut desc = square("black", matte(0.0));
    desc.shape.quad[0].motion = vec![moved(0.0, [-2.0, 0.0, 0.0]), moved(1.0, [2.0, 0.0, 1.0])];
    KnownScene::new("a square crosses", desc, 2, 0.75)
}

/// A black square that comes, waits before the eye, and goes, while the shutter is open for a part of that: from 2 to 7 it
/// is there from 3 to 5.5.
fn stopping() -> KnownScene {
    let mut desc = square("black", matte(0.0));
    let at = |time, x| moved(time, [x, 0.0, 0.0]);
    desc.shape.quad[0].motion = vec![at(1.0, -2.5), at(3.0, -0.5), at(4.0, 0.0), at(5.0, 0.0), at(6.0, 1.0)];
    desc.render.shutter = [2.0, 7.0];
    KnownScene::new("a square stops", desc, 2, 0.5)
}

/// The edge of a black half plane turns about a point of it; after 30 of 90 degrees it hides what is at 120.
fn turning() -> KnownScene {
    let (sin, cos) = (120.0_f32.to_radians()).sin_cos();
    let mut desc = empty(WHITE, stare([cos, sin, 5.0], [cos, sin, 0.0]));
    add_quad(&mut desc, [[0.0, -9.0, 0.0], [9.0, 0.0, 0.0], [0.0, 18.0, 0.0]], "black", matte(0.0));
    desc.shape.quad[0].motion = vec![turned(0.0, [0.0, 0.0, 2.0], 0.0), turned(1.0, [0.0, 0.0, 1.0], 90.0)];
    desc.shape.quad[0].pivot = Some([0.0; 3]);
    KnownScene::new("an edge turns", desc, 2, 1.0 / 3.0)
}

/// The radius of a black ball grows evenly from 1/2 to 3/2, and the eye looks past it at 1.
fn growing() -> KnownScene {
    let mut desc = empty(WHITE, stare([2.0, 0.0, 5.0], [2.0, 0.0, 0.0]));
    add_sphere(&mut desc, [1.0, 0.0, 0.0], 0.5, "black", matte(0.0));
    desc.shape.sphere[0].motion = vec![moved(0.0, [0.0; 3]), MotionKey { scale: 3.0, ..moved(1.0, [0.0; 3]) }];
    KnownScene::new("a ball grows", desc, 2, 0.5)
}

/// The eye moves past a black square, which it sees a quarter of the time.
fn passing_by() -> KnownScene {
    let mut desc = square("black", matte(0.0));
    let key = |time, x| CameraKey {
        time,
        look_from: Some([x, 0.1, 5.0]),
        look_at: Some([x, 0.1, 0.0]),
        up: Some([0.3, 1.0, 0.0]),
    };
    desc.camera.motion = vec![key(0.0, -1.0), key(0.5, 1.0), key(1.0, 3.0)];
    KnownScene::new("the eye moves", desc, 2, 0.75)
}

/// A lamp crosses the line of sight.
fn passing_lamp() -> KnownScene {
    let mut desc = square("lamp", lamp(3.0));
    desc.environment = DARK;
    desc.shape.quad[0].motion = vec![moved(0.0, [-2.0, 0.0, 0.0]), moved(1.0, [2.0, 0.0, 0.0])];
    KnownScene::new("a lamp crosses", desc, 1, 0.75)
}

/// A floor in the sun, over which a square passes: its shadow is there half of the time.
fn shadow() -> KnownScene {
    let mut desc = lit_floor(DARK);
    let sun = DirectionalLight { direction: [0.0, 1.0, 0.0], irradiance: Rgb::grey(3.0), angle: 0.0 };
    desc.light.directional.push(sun);
    add_quad(&mut desc, [[-0.5, 2.0, 0.7], [1.0, 0.0, 0.0], [0.0, 0.0, -1.0]], "black", matte(0.0));
    desc.shape.quad[1].motion = vec![moved(0.0, [-1.5, 0.0, 0.0]), moved(1.0, [0.5, 0.0, 0.0])];
    KnownScene::new("a shadow passes", desc, 2, floor_at(3.0 * 0.5)).hidden()
}

/// A floor within a ball that shines inwards and moves; another lamp, at rest below the floor, is asked for light in vain.
fn in_a_lamp() -> KnownScene {
    let mut desc = lit_floor(DARK);
    let both = |radiance| {
        let radiance = Rgb::grey(radiance).into();
        MaterialDesc::Emissive(Emissive { radiance, two_sided: true, ..Emissive::default() })
    };
    add_sphere(&mut desc, [0.0, 0.0, 0.0], 50.0, "shell", both(1.0));
    desc.shape.sphere[0].motion = vec![moved(0.0, [0.0; 3]), turned(1.0, [1.0, 2.0, 3.0], 300.0)];
    desc.shape.sphere[0].motion[1].offset = [3.0, 5.0, -7.0];
    add_sphere(&mut desc, [0.0, -3.0, 0.0], 1.0, "below", both(9.0));
    KnownScene::new("floor in a lamp that moves", desc, 2, floor_at(PI))
}

/// A white ball that flies and spins in a white furnace.
fn furnace() -> KnownScene {
    let mut desc = empty(WHITE, look([0.0, 0.0, 5.0], [0.0; 3], 30.0));
    add_sphere(&mut desc, [0.3, -0.2, 0.1], 1.0, "white", matte(1.0));
    desc.shape.sphere[0].motion = vec![moved(0.0, [-1.0, 0.0, 0.0]), turned(1.0, [3.0, 1.0, 2.0], 500.0)];
    KnownScene::new("white furnace, ball that spins", desc, 2, 1.0)
}
