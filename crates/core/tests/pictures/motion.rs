//! What moves: blurred as it should be, lit the same by every integrator, and still when the shutter is open for a moment.

use std::num::NonZeroUsize;

use eyebeam_core::camera::{CameraDesc, CameraKey, OrthographicDesc, PanoramaDesc};
use eyebeam_core::color::Rgb;
use eyebeam_core::desc::SceneDesc;
use eyebeam_core::film::{FirstHit, Image};
use eyebeam_core::first_hits::FirstHits;
use eyebeam_core::integrator::IntegratorKind;
use eyebeam_core::light::EnvironmentDesc;
use eyebeam_core::material::{Dielectric, Emissive, Lambertian, MaterialDesc};
use eyebeam_core::motion::{MotionKey, Rotation};
use eyebeam_core::names::Name;
use eyebeam_core::render::{Monitor, Render, Settings};
use eyebeam_core::sampler::SamplerKind;
use eyebeam_core::scene::{Acceleration, BuildOptions, Scene};
use eyebeam_core::shape::{QuadDesc, SphereDesc};
use eyebeam_core::testing::z_test_films;
use eyebeam_core::texture::{Checker, Color, Gradient, Mapping, Space, TextureDesc};
use glam::{Vec2, Vec3};

use crate::setup::*;

fn key(time: f32, offset: [f32; 3], axis: [f32; 3], angle: f32) -> MotionKey {
    MotionKey { time, offset, rotation: Some(Rotation { axis, angle }), scale: 1.0 }
}

fn moved(time: f32, offset: [f32; 3]) -> MotionKey {
    MotionKey { time, offset, ..MotionKey::default() }
}

fn eye(time: f32, look_from: [f32; 3]) -> CameraKey {
    CameraKey { time, look_from: Some(look_from), look_at: None, up: None }
}

fn named(shape: SphereDesc, material: &str) -> SphereDesc {
    SphereDesc { material: Some(material.to_owned()), ..shape }
}

/// Balls, of which one is of glass and one shines, a tile, and a bar, on a floor; all with a texture that lies on them, a lamp
/// that rests, and nothing that moves.
fn still_life() -> SceneDesc {
    let mut desc = scene(EnvironmentDesc::default(), matte(0.6), look([0.5, 1.5, 5.0], [0.0, 0.5, 0.0], 45.0));
    let mapping = Mapping { space: Some(Space::Uv), scale: [8.0, 4.0, 1.0], ..Mapping::default() };
    let checker = Checker { mapping, ..Checker::default() };
    desc.texture.insert("squares".to_owned(), TextureDesc::Checker(checker));
    let checked = Lambertian { albedo: Color::Texture(Name::new("squares")) };
    let both = Emissive { two_sided: true, ..Emissive::default() };
    for (name, material) in [
        ("checked", MaterialDesc::Lambertian(checked)),
        ("glass", MaterialDesc::Dielectric(Dielectric::default())),
        ("lamp", lamp(5.0)),
        ("both", MaterialDesc::Emissive(both)),
    ] {
        desc.material.insert(name.to_owned(), material);
    }
    desc.shape.quad.push(floor(0.0, 8.0));
    let (u, v) = ([0.0, 0.0, 1.5], [1.5, 0.0, 0.0]);
    desc.shape.quad.push(QuadDesc {
        corner: [-2.0, 2.8, -1.0],
        u,
        v,
        material: Some("lamp".to_owned()),
        ..floor(0.0, 1.0)
    });
    let (u, v) = ([0.0, 0.2, 0.0], [0.9, 0.0, 0.3]);
    desc.shape.quad.push(QuadDesc {
        corner: [0.5, 1.1, 0.0],
        u,
        v,
        material: Some("checked".to_owned()),
        ..floor(0.0, 1.0)
    });
    for (center, name) in [([-1.1, 0.45, 0.0], "checked"), ([1.0, 0.45, 0.4], "glass"), ([0.0, 1.3, -0.5], "both")] {
        desc.shape.sphere.push(named(sphere(center, 0.45), name));
    }
    desc.shape.mesh.push(tile());
    desc
}

/// The still life, in which all but the floor and the lamp move.
fn medley() -> SceneDesc {
    let mut desc = still_life();
    desc.camera.aperture = Some(0.1);
    desc.camera.motion = vec![eye(0.0, [0.4, 1.5, 5.0]), eye(1.0, [0.6, 1.6, 5.0])];
    desc.shape.quad[2].motion =
        vec![key(0.0, [0.0; 3], [0.0, 0.0, 1.0], 0.0), key(0.9, [0.0; 3], [0.0, 0.0, 1.0], 400.0)];
    let roll = [moved(0.2, [0.0; 3]), key(0.6, [0.3, 0.1, 0.2], [0.0, 1.0, 0.2], 60.0), moved(1.0, [0.3, 0.0, 0.0])];
    desc.shape.sphere[0].motion = roll.to_vec();
    desc.shape.sphere[1].motion = vec![moved(0.0, [0.0; 3]), MotionKey { scale: 0.8, ..moved(1.0, [0.2, 0.0, 0.3]) }];
    desc.shape.sphere[2].motion = vec![moved(0.0, [-0.5, 0.0, 0.0]), moved(1.0, [0.5, 0.2, 0.0])];
    desc.shape.mesh[0].motion =
        vec![key(0.0, [0.0; 3], [1.0, 2.0, 0.0], -30.0), key(1.0, [0.0; 3], [1.0, 2.0, 0.0], 50.0)];
    desc
}

fn small(spp: u32, max_depth: u32) -> Settings {
    Settings { height: 24, seed: 3, ..settings(32, spp, max_depth) }
}

#[test]
fn path_is_weekend_in_motion() {
    let desc = medley();
    for (max_depth, spp) in [(1, 64), (2, 512), (20, 512)] {
        let weekend = small(spp, max_depth);
        let path = Settings { integrator: IntegratorKind::Path, seed: 4, ..weekend.clone() };
        let (path, weekend) = (render(&desc, path), render(&desc, weekend));
        for block in [8, 32] {
            z_test_films(&path, &weekend, block)
                .unwrap_or_else(|e| panic!("depth {max_depth}, blocks of {block}: {e}"));
        }
    }
}

/// Neither threads nor the tree change a bit.
#[test]
fn motion_is_deterministic() {
    let settings = Settings { integrator: IntegratorKind::Path, sampler: SamplerKind::Sobol, ..small(20, 20) };
    let picture = |acceleration, threads| {
        let scene = Scene::build_with(&medley(), BuildOptions { acceleration, ..BuildOptions::default() }).unwrap();
        let threads = NonZeroUsize::new(threads).unwrap();
        finish(Render::new(&scene, Settings { threads, ..settings.clone() })).develop()
    };
    let one = picture(Acceleration::Auto, 1);
    assert!(picture(Acceleration::Auto, 7) == one, "threads");
    assert!(picture(Acceleration::List, 2) == one, "the tree");
}

/// The share of pixels that are not the same but for rounding.
fn different(a: &Image, b: &Image) -> f64 {
    let is_same =
        |(a, b): (&[f32; 3], &[f32; 3])| a.iter().zip(b).all(|(a, b)| (a - b).abs() <= 1e-3 * (1.0 + a.abs()));
    let same = a.pixels().iter().zip(b.pixels()).filter(|&pair| is_same(pair)).count();
    1.0 - same as f64 / a.pixels().len() as f64
}

/// Open for a moment, the shutter shows what a scene without motion would show; and so does one that is open longer, if all
/// keys say the same.
#[test]
fn a_moment_is_a_still_picture() {
    let offset = [0.5, 0.25, -0.125];
    let plus = |a: [f32; 3]| (Vec3::from(a) + Vec3::from(offset)).to_array();
    let mut moving = still_life();
    // Lamps that move are not asked for light, and so are pictures of other numbers.
    moving.material.insert("both".to_owned(), matte(0.3));
    let mut still = moving.clone();
    let motion = vec![moved(1.0, [9.0, 0.0, 0.0]), moved(2.0, [0.0; 3]), moved(4.0, offset.map(|x| 2.0 * x))];
    for (a, b) in moving.shape.sphere.iter_mut().zip(&mut still.shape.sphere) {
        (a.motion, b.center) = (motion.clone(), plus(b.center));
    }
    (moving.shape.quad[2].motion, still.shape.quad[2].corner) = (motion.clone(), plus(still.shape.quad[2].corner));
    moving.shape.mesh[0].motion = motion;
    still.shape.mesh[0].vertices.iter_mut().for_each(|v| *v = plus(*v));
    let camera = still.camera.look_from;
    moving.camera.motion = vec![eye(2.0, [0.0, 0.0, 9.0]), eye(3.0, camera), eye(3.5, [0.0, 0.0, 9.0])];
    moving.render.shutter = [3.0; 2];
    for integrator in [IntegratorKind::Weekend, IntegratorKind::Path] {
        let settings = Settings { integrator, sampler: SamplerKind::Sobol, ..small(16, 10) };
        let [a, b] = [&moving, &still].map(|desc| render(desc, settings.clone()).develop());
        let share = different(&a, &b);
        assert!(share < 0.01, "{integrator:?}: {share} of the pixels differ");
    }
    // Where nothing moves, pictures keep their bits.
    let mut resting = still.clone();
    resting.shape.sphere[0].motion = vec![moved(0.0, [0.0; 3]), moved(1.0, [0.0; 3])];
    resting.shape.mesh[0].motion = vec![moved(1.0, [0.0; 3]), moved(2.0, [5.0; 3])];
    resting.camera.motion = vec![eye(0.3, camera)];
    let [a, b] = [&resting, &still].map(|desc| render(desc, small(4, 10)).develop());
    assert!(a == b);
}

/// Convex white things vanish in the furnace, wherever they are moved to and however they turn.
#[test]
fn what_moves_does_not_shade_itself() {
    for (place, away) in [(0.0_f32, 0.0), (1e3, 0.0), (0.0, 1e3), (1e3, -1e3)] {
        let (at, offset) = ([place, -0.5 * place, 0.3 * place], [away, -0.5 * away, 0.3 * away]);
        let seen = [0, 1, 2].map(|i| at[i] + offset[i]);
        let mut desc = scene(WHITE, matte(1.0), look([seen[0], seen[1] + 2.0, seen[2] + 4.0], seen, 40.0));
        let motion = vec![
            key(0.0, offset, [1.0, 2.0, -1.0], 0.0),
            MotionKey { scale: 1.5, ..key(1.0, offset, [1.0, 2.0, -1.0], 300.0) },
        ];
        desc.shape.mesh.push(box_mesh(at.map(|x| x - 0.4), at.map(|x| x + 0.3)));
        (desc.shape.mesh[0].motion, desc.shape.mesh[0].pivot) = (motion.clone(), Some(at));
        assert_everywhere(
            &render(&desc, settings(24, 64, 2)),
            1.0,
            0.0,
            &format!("box at {at:?}, moved by {offset:?}"),
        );
        desc.shape.mesh.clear();
        desc.shape.sphere.push(SphereDesc { motion, ..sphere(at, 0.5) });
        assert_everywhere(
            &render(&desc, settings(24, 64, 2)),
            1.0,
            0.0,
            &format!("ball at {at:?}, moved by {offset:?}"),
        );
    }
}

const SIDE: u32 = 33;

/// A camera at (0, 0, 5) that looks along −z; a pixel is 0.125 wide.
fn parallel() -> CameraDesc {
    let orthographic = Some(OrthographicDesc { height: 0.125 * SIDE as f32 });
    CameraDesc { look_from: [0.0, 0.0, 5.0], look_at: [0.0; 3], orthographic, ..CameraDesc::default() }
}

fn hits(desc: &SceneDesc) -> impl Fn(u32, u32) -> FirstHit + use<> {
    let scene = Scene::build(desc).unwrap();
    let settings = Settings { sampler: SamplerKind::Sobol, ..settings(SIDE, 64, 20) };
    let mut hits = FirstHits::new(&scene, settings, false);
    hits.step(&Monitor::default());
    let pixels = hits.pixels().to_vec();
    move |x, y| pixels[(y * SIDE + x) as usize]
}

/// A ball that turns under its texture takes the coordinates with it, and shows what was aside.
#[test]
fn coordinates_turn_with_the_shape() {
    let mut desc = scene(WHITE, matte(0.5), parallel());
    desc.shape.sphere.push(sphere([0.0; 3], 1.0));
    let turned = |angle: f32, desc: &mut SceneDesc| {
        desc.shape.sphere[0].motion = vec![key(0.0, [0.0, 0.25, 0.0], [0.0, 1.0, 0.0], angle)];
        hits(desc)(16, 14)
    };
    // From 0 to 1 along the shape's x.
    let mapping = Mapping { space: Some(Space::Object), scale: [0.5; 3], offset: [0.5; 3], ..Mapping::default() };
    let gradient = Gradient { from: Rgb::grey(0.0).into(), to: Rgb::grey(1.0).into(), mapping, ..Gradient::default() };
    desc.texture.insert("across".to_owned(), TextureDesc::Gradient(gradient));
    let across = Lambertian { albedo: Color::Texture(Name::new("across")) };
    desc.material.insert("it".to_owned(), MaterialDesc::Lambertian(across));
    for (angle, u, x) in [(0.0, 0.25, 0.0), (45.0, 0.125, -0.5_f32.sqrt()), (-90.0, 0.5, 1.0)] {
        let seen = turned(angle, &mut desc);
        assert!((seen.uv - Vec2::new(u, 0.5)).length() < 2e-3, "{angle} degrees: {seen:?}");
        assert!((seen.albedo[0] - (0.5 + 0.5 * x)).abs() < 2e-3, "{angle} degrees: {seen:?}");
    }
}

/// Means over the time: of a ball that flies by, and of one that comes nearer; the id in the middle of the time.
#[test]
fn first_hits_of_what_moves() {
    let mut desc = scene(WHITE, matte(0.5), parallel());
    let (corner, u, v) = ([-0.5, -0.5, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]);
    desc.shape.quad.push(QuadDesc { corner, u, v, material: Some("it".to_owned()), ..QuadDesc::default() });
    desc.shape.quad[0].motion = vec![moved(0.0, [-1.0, 0.0, 1.0]), moved(1.0, [1.0, 0.0, 3.0])];
    let seen = hits(&desc);
    let middle = seen(16, 16);
    // There from a quarter to three quarters of the time, in the mean at half, 2 nearer.
    assert!((middle.albedo[0] - 0.25).abs() < 0.02 && (middle.n.z - 0.5).abs() < 0.04, "{middle:?}");
    assert!((middle.depth - 3.0).abs() < 0.05 && (middle.p - Vec3::new(0.0, 0.0, 2.0)).length() < 0.1, "{middle:?}");
    assert_eq!((middle.ids.object, middle.ids.material, middle.ids.instance), (1, 2, 0));
    let left = seen(6, 16);
    assert!(left.depth < 4.0 && left.depth > 3.0 && left.ids.object == 0 && left.albedo[0] > 0.0, "{left:?}");
    // The distance is that from where the eye is.
    desc.shape.quad[0].motion = Vec::new();
    desc.camera.motion = vec![eye(0.0, [0.0, 0.0, 3.0]), eye(1.0, [0.0, 0.0, 7.0])];
    let middle = hits(&desc)(16, 16);
    assert!((middle.depth - 5.0).abs() < 0.05 && (middle.distance - middle.depth).abs() < 1e-4, "{middle:?}");
    assert_eq!(middle.p.z, 0.0);
}

/// Cameras of every kind move, also where their heads turn over: rays stay rays.
#[test]
fn cameras_of_every_kind_move() {
    let kinds = [
        CameraDesc::default(),
        CameraDesc { aperture: Some(0.2), ..CameraDesc::default() },
        CameraDesc { orthographic: Some(OrthographicDesc::default()), ..CameraDesc::default() },
        CameraDesc { panorama: Some(PanoramaDesc {}), ..CameraDesc::default() },
        CameraDesc { fisheye: Some(Default::default()), ..CameraDesc::default() },
    ];
    for kind in kinds {
        let mut desc = scene(WHITE, matte(0.5), kind);
        desc.camera.motion = vec![
            CameraKey { up: Some([0.0, 1.0, 0.0]), ..eye(0.0, [0.0, 0.0, 6.0]) },
            // Half way, up is along the line of sight.
            CameraKey { up: Some([0.0, -1.0, -0.5]), ..eye(1.0, [0.0, 0.0, 6.0]) },
        ];
        desc.shape.sphere.push(sphere([0.0; 3], 1.0));
        let film = render(&desc, settings(8, 16, 3));
        assert!(film.develop().pixels().iter().flatten().all(|c| c.is_finite()), "{:?}", desc.camera);
    }
}
