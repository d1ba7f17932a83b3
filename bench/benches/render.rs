//! Throughput on one thread: camera rays, whole samples, and the samples of the textbook program.

use std::hint::black_box;
use std::num::NonZeroUsize;
use std::time::Duration;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use eyebeam_bench::measure::{read_scene, render, samples, shrink};
use eyebeam_bench::textbook::Textbook;
use eyebeam_core::sampler::{Independent, Sampler};
use eyebeam_core::scene::Scene;
use glam::UVec2;

/// Why these cannot fail.
const SHIPPED: &str = "the scenes of the repository are read by its tests";

/// Nearest hits of the rays through the middle of all pixels.
fn camera_rays(c: &mut Criterion) {
    let mut group = c.benchmark_group("camera-rays");
    for name in ["spheres", "weekend"] {
        let desc = read_scene(name).expect(SHIPPED);
        let scene = Scene::build(&desc).expect(SHIPPED);
        let (width, height) = (400, 225);
        let camera = scene.camera(width, height);
        let pixels = (0..height).flat_map(|y| (0..width).map(move |x| UVec2::new(x, y)));
        let ray = |pixel: UVec2| {
            let mut sampler = Sampler::Independent(Independent::new(0, pixel, 0));
            camera.ray(pixel.as_vec2() + 0.5, &mut sampler)
        };
        let rays: Vec<_> = pixels.filter_map(ray).collect();
        group.throughput(Throughput::Elements(rays.len() as u64));
        group.bench_function(name, |b| {
            b.iter(|| rays.iter().filter(|ray| scene.intersect(black_box(ray)).is_some()).count());
        });
    }
}

/// Pictures by the renderer, and by the textbook program of the same size, sample count and depth.
fn pictures(c: &mut Criterion) {
    let mut group = c.benchmark_group("samples");
    group.sample_size(10).measurement_time(Duration::from_secs(10));
    for name in ["spheres", "weekend"] {
        let mut desc = read_scene(name).expect(SHIPPED);
        shrink(&mut desc, 320, 4);
        let scene = Scene::build(&desc).expect(SHIPPED);
        group.throughput(Throughput::Elements(samples(&desc)));
        group
            .bench_function(BenchmarkId::new("eyebeam", name), |b| b.iter(|| render(&scene, &desc, NonZeroUsize::MIN)));
        // The book knows no lamps, so it cannot draw all scenes.
        if let Ok(textbook) = Textbook::new(&desc) {
            group.bench_function(BenchmarkId::new("textbook", name), |b| b.iter(|| textbook.render()));
        }
    }
}

criterion_group!(benches, camera_rays, pictures);
criterion_main!(benches);
