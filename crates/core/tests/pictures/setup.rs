//! Scenes and renders in few words.

use std::num::NonZeroUsize;

use eyebeam_core::camera::CameraDesc;
use eyebeam_core::desc::{RenderDesc, SceneDesc};
use eyebeam_core::film::{Film, Tile};
use eyebeam_core::integrator::IntegratorKind;
use eyebeam_core::light::EnvironmentDesc;
use eyebeam_core::material::MaterialDesc;
use eyebeam_core::render::{Monitor, Render, Settings};
use eyebeam_core::sampler::SamplerKind;
use eyebeam_core::scene::Scene;
use eyebeam_core::shape::{MeshDesc, QuadDesc, SphereDesc};
use eyebeam_core::testing::z_test;

pub(crate) use eyebeam_core::testing::scenes::build::{DARK, WHITE, lamp, look, matte};

/// A square picture by the plainest means: what theory is about.
pub(crate) fn settings(side: u32, spp: u32, max_depth: u32) -> Settings {
    let plain = RenderDesc { width: side, height: side, spp, max_depth, seed: 1, ..RenderDesc::default() }.plain();
    Settings { threads: NonZeroUsize::new(2).unwrap(), ..Settings::from(&plain) }
}

/// The same picture by every integrator with every sampler.
pub(crate) fn every_way(settings: &Settings) -> Vec<(String, Settings)> {
    let ways = IntegratorKind::NAMES.iter().flat_map(|i| SamplerKind::NAMES.iter().map(move |s| (i, s)));
    let with = |(&(integrator_name, integrator), &(sampler_name, sampler)): (&(&str, _), &(&str, _))| {
        (format!("{integrator_name}, {sampler_name}"), Settings { integrator, sampler, ..settings.clone() })
    };
    ways.map(with).collect()
}

pub(crate) fn finish(mut render: Render) -> Film {
    render.finish(&Monitor::default());
    let film = render.film().clone();
    assert_eq!(film.sample_counts().dropped, 0);
    film
}

pub(crate) fn render(desc: &SceneDesc, settings: Settings) -> Film {
    finish(Render::new(&Scene::build(desc).unwrap(), settings))
}

/// Renders the same picture by every integrator with every sampler.
pub(crate) fn render_every_way(desc: &SceneDesc, settings: &Settings, mut check: impl FnMut(&str, &Film)) {
    let scene = Scene::build(desc).unwrap();
    for (name, settings) in every_way(settings) {
        check(&name, &finish(Render::new(&scene, settings)));
    }
}

/// Standard error of each pixel, row by row.
pub(crate) fn standard_errors(film: &Film, width: u32) -> impl Fn(u32, u32) -> f64 + use<> {
    let mut errors = vec![0.0; film.develop().pixels().len()];
    for (pixel, sum) in film.tiles().iter().flat_map(Tile::pixels) {
        errors[(pixel.y * width + pixel.x) as usize] = sum.standard_error().unwrap();
    }
    move |x, y| errors[(y * width + x) as usize]
}

/// A scene with the one material `it`.
pub(crate) fn scene(environment: EnvironmentDesc, it: MaterialDesc, camera: CameraDesc) -> SceneDesc {
    SceneDesc { environment, camera, material: [("it".to_owned(), it)].into(), ..SceneDesc::default() }
}

pub(crate) fn sphere(center: [f32; 3], radius: f32) -> SphereDesc {
    SphereDesc { center, radius, material: Some("it".to_owned()), ..SphereDesc::default() }
}

/// A horizontal square whose normal is up.
pub(crate) fn floor(y: f32, half: f32) -> QuadDesc {
    let (u, v) = ([2.0 * half, 0.0, 0.0], [0.0, 0.0, -2.0 * half]);
    QuadDesc { corner: [-half, y, half], u, v, material: Some("it".to_owned()), ..QuadDesc::default() }
}

/// The box from `lo` to `hi` as six quads.
pub(crate) fn box_quads(lo: [f32; 3], hi: [f32; 3]) -> Vec<QuadDesc> {
    let edge = |axis: usize| std::array::from_fn(|i| if i == axis { hi[i] - lo[i] } else { 0.0 });
    let side = |axis: usize, corner: [f32; 3]| {
        let corner = std::array::from_fn(|i| if i == axis { corner[i] } else { lo[i] });
        QuadDesc {
            corner,
            u: edge((axis + 1) % 3),
            v: edge((axis + 2) % 3),
            material: Some("it".to_owned()),
            ..QuadDesc::default()
        }
    };
    (0..3).flat_map(|axis| [side(axis, lo), side(axis, hi)]).collect()
}

/// The box from `lo` to `hi`, normals outwards.
pub(crate) fn box_mesh(lo: [f32; 3], hi: [f32; 3]) -> MeshDesc {
    let at = |i: usize, axis: usize| if i >> axis & 1 == 0 { lo[axis] } else { hi[axis] };
    let vertices = (0..8).map(|i| [at(i, 0), at(i, 1), at(i, 2)]).collect();
    let sides = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let triangles = sides.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    MeshDesc { vertices, triangles, material: Some("it".to_owned()), ..MeshDesc::default() }
}

/// That every channel of every pixel is `expected`, with every sampler: by `weekend` but for `error` relative to it, by the
/// others but for the noise that the film reports, and `error` in the mean over blocks.
pub(crate) fn assert_every_way(desc: &SceneDesc, settings: &Settings, expected: f32, error: f32, name: &str) {
    render_every_way(desc, settings, |way, film| {
        let name = format!("{name}, {way}");
        if way.starts_with("weekend") {
            return assert_everywhere(film, expected, error, &name);
        }
        let image = film.develop();
        // That of all pixels together: a pixel of few samples may have seen no rare path, and know of none.
        let errors = standard_errors(film, image.width());
        let pixels = (0..image.height()).flat_map(|y| (0..image.width()).map(move |x| (x, y)));
        let noise = (pixels.map(|(x, y)| errors(x, y).powi(2)).sum::<f64>() / image.pixels().len() as f64).sqrt();
        let floor = f64::from(expected * error);
        for block in [1, 4, image.width()] {
            z_test(&image, |_, _| f64::from(expected), |_, _| noise + floor, block)
                .unwrap_or_else(|e| panic!("{name}, blocks of {block}: {e}"));
        }
    });
}

/// That every channel of every pixel is `expected`, but for `error` relative to it.
pub(crate) fn assert_everywhere(film: &Film, expected: f32, error: f32, name: &str) {
    let image = film.develop();
    for y in 0..image.height() {
        for x in 0..image.width() {
            let pixel = image.pixel(x, y);
            let off = pixel.map(|c| (c - expected).abs()).into_iter().fold(0.0, f32::max);
            assert!(off <= error * expected, "{name}: pixel ({x}, {y}) is {pixel:?}, not {expected}");
        }
    }
}

/// A square with a round look, of the material `checked`.
pub(crate) fn tile() -> MeshDesc {
    MeshDesc {
        vertices: vec![[-0.4, 0.1, 1.0], [0.4, 0.1, 1.0], [0.4, 0.9, 1.0], [-0.4, 0.9, 1.0]],
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        normals: vec![[-1.0, -1.0, 4.0], [1.0, -1.0, 4.0], [1.0, 1.0, 4.0], [-1.0, 1.0, 4.0]],
        uvs: vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]],
        material: Some("checked".to_owned()),
        ..MeshDesc::default()
    }
}
