//! What a picture tells besides light, where it is known beforehand; and pictures without a background.

use std::num::NonZeroUsize;

use eyebeam_core::camera::{CameraDesc, OrthographicDesc};
use eyebeam_core::color::Rgb;
use eyebeam_core::desc::SceneDesc;
use eyebeam_core::film::FilterDesc;
use eyebeam_core::film::{Aov, FilmOptions, FirstHit, Mitchell, Values, channels};
use eyebeam_core::first_hits::FirstHits;
use eyebeam_core::material::{Dielectric, MaterialDesc, Metal};
use eyebeam_core::render::{Monitor, Settings};
use eyebeam_core::scene::Scene;
use eyebeam_core::shape::{MeshDesc, QuadDesc};
use glam::{Vec2, Vec3};

use crate::setup::*;

const SIDE: u32 = 33;

/// A camera at (0, 0, 5) that looks along −z; a pixel is 0.125 wide.
fn parallel() -> CameraDesc {
    let orthographic = Some(OrthographicDesc { height: 0.125 * SIDE as f32 });
    CameraDesc { look_from: [0.0, 0.0, 5.0], look_at: [0.0; 3], orthographic, ..CameraDesc::default() }
}

/// World x and y of a place on the film of [`parallel`].
fn at(film: Vec2) -> Vec2 {
    (film - 0.5 * SIDE as f32) * Vec2::new(0.125, -0.125)
}

fn settings_of(spp: u32) -> Settings {
    settings(SIDE, spp, 20)
}

fn hits(desc: &SceneDesc, settings: Settings, through: bool) -> Vec<FirstHit> {
    let scene = Scene::build(desc).unwrap();
    let mut hits = FirstHits::new(&scene, settings, through);
    hits.step(&Monitor::default());
    assert!(hits.is_done());
    hits.pixels().to_vec()
}

fn pixel(hits: &[FirstHit], x: u32, y: u32) -> FirstHit {
    hits[(y * SIDE + x) as usize]
}

fn ball() -> SceneDesc {
    let mut desc = scene(WHITE, matte(0.6), parallel());
    desc.shape.sphere.push(sphere([0.0; 3], 1.5));
    desc
}

#[test]
fn a_sphere_is_where_it_is() {
    let hits = hits(&ball(), settings_of(64), false);
    for (x, y) in [(16, 16), (10, 14), (20, 22), (16, 8)] {
        let hit = pixel(&hits, x, y);
        let center = at(Vec2::new(x as f32, y as f32) + 0.5);
        let p = center.extend((1.5 * 1.5 - center.length_squared()).sqrt());
        // Pixels are small squares of the sphere, not points.
        assert!((hit.p - p).length() < 0.02, "({x}, {y}): {} instead of {p}", hit.p);
        assert!((hit.p / 1.5 - hit.n).length() < 1e-5 && hit.n == hit.ns);
        assert!((hit.depth - (5.0 - hit.p.z)).abs() < 1e-5 && (hit.depth - hit.distance).abs() < 1e-5);
        assert_eq!(hit.albedo, [0.6; 3]);
        assert_eq!((hit.ids.object, hit.ids.material, hit.ids.instance), (1, 2, 0));
    }
    assert!((pixel(&hits, 16, 16).uv - Vec2::new(0.25, 0.5)).length() < 0.01);
    assert_eq!(pixel(&hits, 0, 0), FirstHit::NOTHING);
}

/// Along the ray it is farther than along the camera's axis, by the cosine.
#[test]
fn depth_is_along_the_axis() {
    let mut desc = scene(WHITE, matte(0.5), look([0.0, 2.0, 0.0], [0.0, 0.0, 0.0], 90.0));
    desc.shape.quad.push(floor(0.0, 50.0));
    let hits = hits(&desc, settings_of(16), false);
    for (x, y) in [(16, 16), (0, 0), (32, 7)] {
        let hit = pixel(&hits, x, y);
        assert!((hit.depth - 2.0).abs() < 1e-5, "{}", hit.depth);
        // The mean of lengths is nearly the length of the mean, in a small pixel.
        let distance = hit.p.distance(Vec3::new(0.0, 2.0, 0.0));
        assert!((hit.distance - distance).abs() < 1e-3, "{} instead of {distance}", hit.distance);
        assert!((hit.n - Vec3::Y).length() < 1e-6);
    }
}

/// At an edge, colours are mixed, places and ids are not.
#[test]
fn edges() {
    let mut desc = ball();
    desc.shape.sphere.clear();
    // The edge at x = 0 goes through the middle of column 16.
    let (corner, u, v) = ([0.0, -9.0, 0.0], [9.0, 0.0, 0.0], [0.0, 18.0, 0.0]);
    desc.shape.quad.push(QuadDesc { corner, u, v, material: Some("it".to_owned()), ..QuadDesc::default() });
    let hits = hits(&desc, settings_of(64), false);
    let hit = pixel(&hits, 16, 5);
    assert!((hit.albedo[0] - 0.3).abs() < 0.1 && (hit.n.z - 0.5).abs() < 0.15, "{hit:?}");
    assert!((hit.depth - 5.0).abs() < 1e-5 && hit.p.x > 0.0 && hit.p.x < 0.0625);
    for hit in &hits {
        assert!(hit.ids.object <= 1 && [0, 2].contains(&hit.ids.material));
    }
    assert_eq!((pixel(&hits, 17, 5).ids.object, pixel(&hits, 15, 5).ids.object), (1, 0));
    let ids: Vec<_> = channels(&[Aov::Id], &hits, &render(&desc, settings_of(1)));
    assert!(matches!(&ids[1].values, Values::Id(values) if values[(SIDE * 5 + 17) as usize] == 2));
    assert_eq!(ids.iter().map(|c| c.name).collect::<Vec<_>>(), ["id.object", "id.material", "id.instance"]);
}

#[test]
fn places_on_flat_shapes() {
    let mut desc = ball();
    desc.shape.sphere.clear();
    let (corner, u, v) = ([-1.0, -1.0, 0.0], [2.0, 0.0, 0.0], [1.0, 2.0, 0.0]);
    desc.shape.quad.push(QuadDesc { corner, u, v, material: None, ..QuadDesc::default() });
    let vertices = vec![[-2.0, 1.5, 1.0], [2.0, 1.5, 1.0], [-2.0, 2.0, 1.0]];
    let triangles = vec![[0, 1, 2]];
    desc.shape.mesh.push(MeshDesc { vertices, triangles, normals: vec![[0.0, 0.75, 1.0]; 3], ..MeshDesc::default() });
    let hits = hits(&desc, settings_of(64), false);
    let quad = pixel(&hits, 17, 13);
    let p = at(Vec2::new(17.5, 13.5));
    let v = (p.y + 1.0) / 2.0;
    let expected = Vec2::new((p.x + 1.0 - v) / 2.0, v);
    assert!((quad.uv - expected).length() < 0.01, "{} instead of {expected}", quad.uv);
    assert_eq!((quad.ids.object, quad.ids.material), (1, 1));
    let mesh = pixel(&hits, 8, 3);
    let p = at(Vec2::new(8.5, 3.5));
    let expected = Vec2::new((p.x + 2.0) / 4.0, (p.y - 1.5) / 0.5);
    assert!((mesh.uv - expected).length() < 0.02, "{} instead of {expected}", mesh.uv);
    assert!((mesh.n - Vec3::Z).length() < 1e-6 && (mesh.ns - Vec3::new(0.0, 0.6, 0.8)).length() < 1e-6);
    assert_eq!(mesh.ids.object, 2);
    assert_eq!(desc.object_names().collect::<Vec<_>>(), ["quad.0", "mesh.0"]);
    assert_eq!(desc.material_names().collect::<Vec<_>>(), ["default", "it"]);
}

/// What stands behind a window, and what a tinted mirror shows.
#[test]
fn through_glass_and_mirrors() {
    let mut desc = ball();
    desc.environment = WHITE;
    desc.material.insert("pane".to_owned(), MaterialDesc::Dielectric(Dielectric { eta: 1.0, ..Dielectric::default() }));
    let mirror = Metal { albedo: Rgb([0.9, 0.5, 0.1]).into(), roughness: 0.0.into() };
    desc.material.insert("mirror".to_owned(), MaterialDesc::Metal(mirror));
    let (corner, u, v) = ([-9.0, -9.0, 3.0], [18.0, 0.0, 0.0], [0.0, 18.0, 0.0]);
    desc.shape.quad.push(QuadDesc { corner, u, v, material: Some("pane".to_owned()), ..QuadDesc::default() });
    let without = hits(&desc, settings_of(16), false);
    let with = hits(&desc, settings_of(16), true);
    assert_eq!(pixel(&without, 16, 16).albedo, [1.0; 3]);
    let shown = pixel(&with, 16, 16);
    assert_eq!((shown.albedo, shown.depth, shown.ids.object), ([0.6; 3], 2.0, 2));
    assert!(shown.n.z > 0.99);
    assert_eq!((pixel(&with, 0, 0).albedo, pixel(&with, 0, 0).depth), ([0.0; 3], 2.0));

    // The camera looks at the mirror at 45 degrees and sees the wall to its right.
    desc.shape.quad[0] = QuadDesc {
        corner: [-2.0, -9.0, -2.0],
        u: [4.0, 0.0, 4.0],
        v: [0.0, 18.0, 0.0],
        material: Some("mirror".to_owned()),
        ..QuadDesc::default()
    };
    desc.shape.sphere.clear();
    let (corner, u, v) = ([-6.0, -9.0, -9.0], [0.0, 18.0, 0.0], [0.0, 0.0, 18.0]);
    desc.shape.quad.push(QuadDesc { corner, u, v, material: Some("it".to_owned()), ..QuadDesc::default() });
    let shown = pixel(&hits(&desc, settings_of(16), true), 16, 16);
    for (albedo, expected) in shown.albedo.into_iter().zip([0.54, 0.3, 0.06]) {
        assert!((albedo - expected).abs() < 1e-6, "{:?}", shown.albedo);
    }
    assert!((shown.n.x.abs() - 1.0).abs() < 1e-6 && shown.ids.material == 3);
}

#[test]
fn threads_and_pauses_change_nothing() {
    let mut desc = ball();
    desc.camera = CameraDesc { aperture: Some(0.2), ..look([1.0, 2.0, 5.0], [0.0; 3], 40.0) };
    desc.shape.quad.push(floor(-1.0, 20.0));
    let filter = FilterDesc::Mitchell(Mitchell::default());
    let with = |threads, spp| Settings {
        threads: NonZeroUsize::new(threads).unwrap(),
        filter: filter.clone(),
        ..settings_of(spp)
    };
    let one = hits(&desc, with(1, 100), true);
    for threads in [2, 7, 64] {
        assert!(hits(&desc, with(threads, 100), true) == one, "{threads} threads");
    }
    assert!(hits(&desc, with(2, 1000), true) == one, "no more samples than are needed");
    assert!(hits(&desc, with(2, 16), true) != one);
    assert!(one.iter().all(|hit| hit.albedo.iter().all(|c| (0.0..=1.0).contains(c))));

    let scene = Scene::build(&desc).unwrap();
    let mut paused = FirstHits::new(&scene, with(2, 100), true);
    let monitor = Monitor::default();
    monitor.pause.store(true, std::sync::atomic::Ordering::Relaxed);
    paused.step(&monitor);
    assert!(!paused.is_done() && paused.pixels().iter().all(|hit| *hit == FirstHit::NOTHING));
    paused.step(&Monitor::default());
    assert!(paused.is_done() && paused.pixels() == one);
}

fn transparent(settings: Settings) -> Settings {
    Settings { film: FilmOptions { transparent: true, ..FilmOptions::default() }, ..settings }
}

/// By every integrator: black and clear beside the ball, the same as ever on it, half of it at a straight edge.
#[test]
fn alpha_is_coverage() {
    let mut desc = ball();
    let (corner, u, v) = ([1.5, -9.0, 0.0], [9.0, 0.0, 0.0], [0.0, 18.0, 0.0]);
    desc.shape.quad.push(QuadDesc { corner, u, v, material: Some("it".to_owned()), ..QuadDesc::default() });
    render_every_way(&desc, &transparent(settings_of(400)), |way, film| {
        let image = film.develop();
        let alpha = |x: u32, y: u32| image.alpha().unwrap()[(y * SIDE + x) as usize];
        assert_eq!((alpha(0, 0), image.pixel(0, 0)), (0.0, [0.0; 3]), "{way}");
        assert_eq!(alpha(16, 16), 1.0, "{way}");
        // The edge is in the middle of column 28.
        assert!((alpha(28, 3) - 0.5).abs() < 0.1, "{way}: {}", alpha(28, 3));
    });
    let opaque = render(&desc, settings_of(64)).develop();
    let image = render(&desc, transparent(settings_of(64))).develop();
    assert!(opaque.alpha().is_none());
    // With a white background behind it, the picture is the other one.
    for ((pixel, alpha), expected) in image.pixels().iter().zip(image.alpha().unwrap()).zip(opaque.pixels()) {
        for (c, expected) in pixel.iter().zip(expected) {
            assert!((c + 1.0 - alpha - expected).abs() < 1e-6, "{pixel:?} {alpha} instead of {expected}");
        }
    }
}

/// Straight on, a sheet of glass of two sides lets (1 − r) / (1 + r) through, r = 0.04, and reflects the rest; a mirror
/// reflects all, which is no hole.
#[test]
fn the_background_shows_through_glass_and_not_in_mirrors() {
    let glass = MaterialDesc::Dielectric(Dielectric::default());
    let mut desc = scene(WHITE, glass, parallel());
    let (lo, hi) = ([-9.0, -9.0, -0.5], [9.0, 9.0, 0.5]);
    desc.shape.mesh.push(box_mesh(lo, hi));
    render_every_way(&desc, &transparent(settings(4, 4096, 50)), |way, film| {
        let image = film.develop();
        for (alpha, pixel) in image.alpha().unwrap().iter().zip(image.pixels()) {
            let expected = 1.0 - 0.96 / 1.04;
            assert!((alpha - expected).abs() < 0.02, "{way}: {alpha} instead of {expected}");
            assert!((pixel[0] - alpha).abs() < 1e-5, "{way}: what it reflects is white");
        }
    });
    desc.material
        .insert("it".to_owned(), MaterialDesc::Metal(Metal { albedo: Rgb::grey(0.8).into(), roughness: 0.0.into() }));
    let image = render(&desc, transparent(settings(4, 4, 50))).develop();
    assert!(
        image.alpha().unwrap().iter().all(|a| *a == 1.0) && image.pixels().iter().all(|p| (p[0] - 0.8).abs() < 1e-6)
    );
}

/// Noise that is clamped is missing in the picture, and known.
#[test]
fn what_clamping_takes_is_what_is_missing() {
    let mut desc = ball();
    desc.environment = DARK;
    desc.material.insert("lamp".to_owned(), lamp(40.0));
    desc.shape.sphere.push(sphere([2.0, 2.0, 2.0], 0.3));
    desc.shape.sphere[1].material = Some("lamp".to_owned());
    let mean = |clamp: f32| {
        let film = FilmOptions { clamp, ..FilmOptions::default() };
        let film = render(&desc, Settings { film, ..settings_of(64) });
        let image = film.develop();
        let sum: f64 = image.pixels().iter().map(|&rgb| f64::from(Rgb(rgb).luminance())).sum();
        (sum / image.pixels().len() as f64, film.clamped())
    };
    let ((whole, nothing), (clamped, lost)) = (mean(0.0), mean(2.0));
    assert_eq!(nothing, 0.0);
    assert!(lost > 0.1 * whole && ((clamped + lost) / whole - 1.0).abs() < 1e-5, "{clamped} + {lost}, {whole}");
}

/// The variance of a channel is that of its means over pictures of other noise.
#[test]
fn variance_is_that_of_the_mean() {
    let mut desc = ball();
    desc.shape.sphere[0].material = None;
    desc.environment = eyebeam_core::light::EnvironmentDesc::default();
    let film = FilmOptions { variance: true, ..FilmOptions::default() };
    let with = |seed| render(&desc, Settings { seed, film, width: 8, height: 8, ..settings_of(64) });
    let films: Vec<_> = (0..100).map(with).collect();
    let images: Vec<_> = films.iter().map(|f| f.develop()).collect();
    let (mut own, mut true_one) = ([0.0; 3], [0.0; 3]);
    for i in 0..64 {
        for c in 0..3 {
            let values: Vec<_> = images.iter().map(|image| f64::from(image.pixels()[i][c])).collect();
            let mean = values.iter().sum::<f64>() / 100.0;
            true_one[c] += values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / 99.0;
            own[c] += films.iter().map(|f| f64::from(f.variance()[i][c])).sum::<f64>() / 100.0;
        }
    }
    // 64 estimates from 100 values each are off by 1.8 % together.
    for c in 0..3 {
        assert!((own[c] / true_one[c] - 1.0).abs() < 0.06, "{own:?} {true_one:?}");
    }
}
