//! Spheres: rays per second on the rays that the renderer makes, against the textbook's list and the textbook's tree.

use std::hint::black_box;
use std::io::Write;

use eyebeam_bvh::{Bvh, Primitive, Quality, Ray, Sphere};
use eyebeam_core::desc::SceneDesc;
use eyebeam_core::sampler::{Independent, Sampler};
use eyebeam_core::scene::Scene;
use glam::{UVec2, Vec3};

use super::table::{header, mega, row};
use super::tracer::is_close;
use super::{Outcome, Plan};
use crate::measure::{median, read_scene, shrink, thread_time};
use crate::textbook::{Queries, Ray as TextbookRay};

/// The ground and five balls of the book's three materials, under a sky.
const SIX_SPHERES: &str = r#"
    [render]
    width = 400
    height = 225
    [camera]
    look_from = [0, 1.2, 6]
    look_at = [0, 0.5, 0]
    vfov = 35
    [material]
    ground.lambertian.albedo = 0.5
    red.lambertian.albedo = [0.7, 0.3, 0.2]
    gold.metal = {albedo = [0.9, 0.7, 0.3], roughness = 0.2}
    mirror.metal = {albedo = 0.9, roughness = 0}
    glass.dielectric.eta = 1.5
    [shape]
    sphere = [
        {center = [0, -1000, 0], radius = 1000, material = "ground"},
        {center = [-1.6, 0.6, -0.4], radius = 0.6, material = "red"},
        {center = [0, 0.6, 0], radius = 0.6, material = "glass"},
        {center = [1.6, 0.6, -0.4], radius = 0.6, material = "gold"},
        {center = [-0.8, 0.3, 1.2], radius = 0.3, material = "mirror"},
        {center = [0.8, 0.3, 1.2], radius = 0.3, material = "red"},
    ]
"#;

/// Six spheres, and the cover scene of the book. All take turns.
pub(super) fn run(plan: Plan, out: &mut dyn Write) -> Outcome {
    writeln!(out, "\n### Spheres: rays of the renderer, one thread\n")?;
    let columns = [
        "rays",
        "Eyebeam, Mrays/s",
        "list",
        "textbook tree",
        "over list",
        "over tree",
        "differing from list, ours",
        "tree",
    ];
    header(out, "spheres", columns.map(str::to_owned).into_iter())?;
    for desc in [eyebeam_io::scene::read_str("six spheres", SIX_SPHERES, &[])?.desc, read_scene("weekend")?] {
        let rays = record(&desc, plan.resolution)?;
        let spheres = desc.shape.sphere.iter().map(|s| Sphere { center: Vec3::from(s.center), radius: s.radius });
        let primitives: Vec<_> = spheres.map(Primitive::Sphere).collect();
        let bvh = Bvh::build(&primitives, Quality::Balanced)?;
        let measured = measure(&rays, &bvh, &Queries::new(&desc)?, plan.rounds);
        row(out, &primitives.len().to_string(), measured.cells(rays.len()).into_iter())?;
    }
    Ok(())
}

/// The rays of one sample of each pixel of a picture, from the camera on, in the order in which the renderer traces them.
pub(crate) fn record(desc: &SceneDesc, width: u32) -> Result<Vec<Ray>, String> {
    let mut desc = desc.clone();
    shrink(&mut desc, width, 1);
    let scene = Scene::build(&desc).map_err(|problems| format!("{problems:?}"))?;
    let (width, height) = (desc.render.width, desc.render.height);
    let camera = scene.camera(width, height);
    let mut rays = Vec::new();
    for pixel in (0..height).flat_map(|y| (0..width).map(move |x| UVec2::new(x, y))) {
        let mut sampler = Sampler::Independent(Independent::new(0, pixel, 0));
        let film = pixel.as_vec2() + sampler.get_2d();
        let mut next = camera.ray(film, &mut sampler);
        for _ in 0..desc.render.max_depth {
            let Some(ray) = next else { break };
            rays.push(ray);
            next = scene
                .intersect(&ray)
                .and_then(|si| si.scatter(&si.bsdf(), &mut sampler))
                .map(|(_, scattered)| scattered);
        }
    }
    Ok(rays)
}

/// Seconds of each round, and distances: ours, the list's, the tree's.
struct Measured {
    seconds: [Vec<f64>; 3],
    distances: [Vec<f32>; 3],
}

fn measure(rays: &[Ray], bvh: &Bvh, textbook: &Queries, rounds: usize) -> Measured {
    let theirs: Vec<_> = rays.iter().map(TextbookRay::from).collect();
    let mut seconds = [const { Vec::new() }; 3];
    let mut distances = [(); 3].map(|()| vec![0.0_f32; rays.len()]);
    let narrow = |t: Option<f64>| t.map_or(f32::INFINITY, |t| t as f32);
    for _ in 0..rounds {
        let [ours, list, tree] = &mut distances;
        let our = |ray: &Ray| black_box(bvh.intersect(ray)).map_or(f32::INFINITY, |hit| hit.t);
        seconds[0].push(time(rays, ours, our));
        seconds[1].push(time(&theirs, list, |ray| narrow(textbook.by_list(ray))));
        seconds[2].push(time(&theirs, tree, |ray| narrow(textbook.by_tree(ray))));
    }
    Measured { seconds, distances }
}

/// Processor time of all rays, in seconds.
fn time<R>(rays: &[R], distances: &mut [f32], query: impl Fn(&R) -> f32) -> f64 {
    let work = || {
        for (ray, distance) in rays.iter().zip(distances) {
            *distance = query(ray);
        }
    };
    thread_time(work).as_secs_f64()
}

impl Measured {
    fn cells(&self, rays: usize) -> [String; 8] {
        let [ours, list, tree] = &self.seconds;
        let rate = |seconds: &Vec<f64>| format!("{:.2}", mega(rays, median(seconds.clone())));
        let ratio = |theirs: &Vec<f64>| format!("{:.2}", median(theirs.iter().zip(ours).map(|(a, b)| a / b).collect()));
        let [our_t, list_t, tree_t] = &self.distances;
        let differing = |t: &Vec<f32>| t.iter().zip(list_t).filter(|&(&a, &b)| !is_close(a, b)).count().to_string();
        [
            rays.to_string(),
            rate(ours),
            rate(list),
            rate(tree),
            ratio(list),
            ratio(tree),
            differing(our_t),
            differing(tree_t),
        ]
    }
}
