//! Triangles and instances that move: the same as the list, the same as at rest where they are then, in time only, and closed.

use eyebeam_bvh::{Affine, Bvh, Instance, MovingTriangle, Primitive, Quality, Ray, Triangle};
use glam::Vec3;

use crate::instances::{Scene, assert_same_as_list, bits, compare_with_flattened, instance, rays};
use crate::random::Random;
use crate::watertight::icosphere;

#[test]
fn trees_of_what_moves_find_what_lists_find() {
    let mut r = Random::new(60);
    for depth in [0, 0, 0, 1, 1, 2, 3].into_iter().cycle().take(35) {
        let scene = Scene::random(depth, true, &mut r);
        let times: Vec<_> = [0.0, 0.25, 0.5, 1.0].into_iter().chain((0..20).map(|_| r.unit())).collect();
        let rays = rays(&scene, &times, 400, &mut r);
        let hits = assert_same_as_list("moving", &scene, &rays);
        assert!(hits > rays.len() / 20, "{depth}: {hits} hits");
    }
}

#[test]
fn what_moves_looks_like_what_is_there() {
    let mut r = Random::new(61);
    for depth in [0, 0, 1, 1, 2, 3].into_iter().cycle().take(60) {
        let times = [0.0, 0.3, 0.5, 0.71, 1.0, r.unit()];
        compare_with_flattened(depth, &times, &mut r);
    }
}

/// The triangle in the plane z = 0 about a point.
fn at(x: f32, y: f32) -> Triangle {
    let [a, b, c] = [[-1.0, -1.0], [1.0, -1.0], [0.0, 1.0]].map(|[dx, dy]| Vec3::new(x + dx, y + dy, 0.0));
    Triangle { a, b, c }
}

fn down(x: f32, y: f32, time: f32) -> Ray {
    Ray { time, ..Ray::new(Vec3::new(x, y, 2.0), Vec3::NEG_Z) }
}

#[test]
fn outside_of_its_time_nothing_is_there() {
    let [start, end] = [0.25_f32, 0.75];
    let moving = Primitive::MovingTriangle(MovingTriangle { at: [at(0.0, 0.0); 2], time: [start, end] });
    let shown = Instance { time: [start, end], ..Instance::new(0, Affine::IDENTITY) };
    let still = Scene::of(vec![Primitive::Triangle(at(0.0, 0.0))]);
    let scenes = [Scene::of(vec![moving]), Scene { shapes: vec![Primitive::Instance(shown)], objects: vec![still] }];
    for scene in &scenes {
        for (name, tree) in scene.trees() {
            for time in [start, 0.5, end] {
                assert!(tree.intersect(&down(0.0, 0.0, time)).is_some_and(|hit| hit.t == 2.0), "{name}, {time}");
            }
            for time in [-1.0, 0.0, start.next_down(), end.next_up(), 1.0, 2.0, -f32::MAX, f32::MAX] {
                assert_eq!(tree.intersect(&down(0.0, 0.0, time)), None, "{name}, {time}");
                assert!(!tree.occluded(&down(0.0, 0.0, time)), "{name}, {time}");
            }
        }
    }
}

/// Four keys: to the right, up, and back to where it began.
#[test]
fn several_keys_are_several_primitives() {
    let places = [[0.0, 0.0], [10.0, 0.0], [10.0, 10.0], [0.0, 0.0]];
    let times = [0.0, 0.3, 0.7, 1.0];
    let triangles = (0..3).map(|i| {
        let [from, to] = [i, i + 1].map(|key: usize| at(places[key][0], places[key][1]));
        Primitive::MovingTriangle(MovingTriangle { at: [from, to], time: [times[i], times[i + 1]] })
    });
    let instances = (0..3).map(|i| {
        let at = [i, i + 1].map(|key: usize| Affine::from_translation(Vec3::new(places[key][0], places[key][1], 0.0)));
        Primitive::Instance(Instance { object: 0, at, time: [times[i], times[i + 1]] })
    });
    let still = Scene::of(vec![Primitive::Triangle(at(0.0, 0.0))]);
    let scenes = [Scene::of(triangles.collect()), Scene { shapes: instances.collect(), objects: vec![still] }];
    for (scene, is_instance) in scenes.iter().zip([false, true]) {
        let interval = |hit: eyebeam_bvh::Hit| if is_instance { hit.instances[0] } else { hit.prim };
        for (name, tree) in scene.trees() {
            // At a key, the two that meet there are in the same place: the first counts.
            for (key, first) in [0, 0, 1, 2].into_iter().enumerate() {
                let [x, y] = places[key];
                let hit = tree.intersect(&down(x, y, times[key])).unwrap();
                assert_eq!((hit.t, interval(hit)), (2.0, first), "{name}, key {key}");
            }
            for step in 0..=1000_u16 {
                let time = f32::from(step) / 1000.0;
                let i = if time <= times[1] {
                    0
                } else if time <= times[2] {
                    1
                } else {
                    2
                };
                let share = (time - times[i]) / (times[i + 1] - times[i]);
                let [x, y] = [0, 1].map(|axis| places[i][axis] * (1.0 - share) + places[i + 1][axis] * share);
                assert_eq!(tree.intersect(&down(x, y, time)).map(interval), Some(i as u32), "{name}, {time}");
                assert_eq!(tree.intersect(&down(x + 2.0, y + 2.0, time)), None, "{name}, {time}");
            }
        }
    }
}

#[test]
fn times_that_are_not_finite_end() {
    let mut r = Random::new(62);
    let odd = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, f32::MAX, -f32::MAX, 1e-45];
    for depth in 0..3 {
        let scene = Scene::random(depth, true, &mut r);
        for (_, tree) in scene.trees() {
            for ray in rays(&scene, &[0.5], 500, &mut r) {
                let ray = Ray { time: r.pick(&odd), ..ray };
                if let Some(hit) = tree.intersect(&ray) {
                    assert!(hit.t.is_finite());
                    tree.surface(&hit, ray.time);
                    tree.to_world(&hit, ray.time);
                }
                tree.occluded(&ray);
            }
        }
    }
}

/// Where a point of the sphere is at the beginning and at the end; between 0.6 and 1.4 from the centre.
fn wobble(p: Vec3) -> [Vec3; 2] {
    let height = |phase: f32| 1.0 + 0.2 * (7.0 * p.x + phase).sin() + 0.2 * (9.0 * p.y - phase).cos() * p.z;
    [p * height(0.0), p * height(2.5)]
}

/// At any time, alone and in an instance that moves, too.
#[test]
fn closed_surfaces_stay_closed_as_they_move() {
    let mut r = Random::new(63);
    let outline = icosphere(4, Vec3::ONE);
    let moving = outline.iter().map(|corners| {
        let at = [0, 1].map(|end| {
            let [a, b, c] = corners.map(|p| wobble(p)[end]);
            Triangle { a, b, c }
        });
        Primitive::MovingTriangle(MovingTriangle { at, time: [0.0, 1.0] })
    });
    let alone = Scene::of(moving.collect());
    let from = Affine { axes: [Vec3::new(-1.0, 0.1, 0.0), Vec3::new(0.4, 1.0, 0.0), Vec3::Z], offset: Vec3::ZERO };
    let to = Affine { axes: [Vec3::new(-2.0, 0.0, 0.3), Vec3::new(0.0, 0.5, 0.2), Vec3::Z], offset: 40.0 * Vec3::ONE };
    let shown = Instance { object: 0, at: [from, to], time: [0.0, 1.0] };
    let within = Scene { shapes: vec![Primitive::Instance(shown)], objects: vec![alone.clone()] };
    for scene in [alone, within] {
        let trees = scene.trees();
        for i in 0..30_000 {
            let [any, along] = [0; 2].map(|_| r.unit());
            let time = r.pick(&[0.0, 1.0, 0.5, any, any]);
            let to_world = if scene.objects.is_empty() { None } else { shown.to_world(time) };
            let world = |p: Vec3| to_world.map_or(p, |at| at.transform_point3(p.as_dvec3()).as_vec3());
            let (triangle, edge) = (outline[r.below(outline.len())], r.below(3));
            let [p, q] = [edge, (edge + 1) % 3].map(|i| {
                let [from, to] = wobble(triangle[i]);
                from.lerp(to, time)
            });
            let on_edge = world(p.lerp(q, r.pick(&[0.0, 0.5, along])));
            let inside = world(0.3 * r.in_cube());
            let (name, tree) = &trees[i % trees.len()];
            let ray = if i / trees.len() % 2 == 0 {
                Ray { time, ..Ray::new(inside, on_edge - inside) }
            } else {
                let outside = inside + (on_edge - inside) * r.pick(&[10.0, 1000.0]);
                Ray { time, t_max: 1.0, ..Ray::new(outside, inside - outside) }
            };
            assert!(tree.intersect(&ray).is_some() && tree.occluded(&ray), "{name}: {ray:?}");
        }
    }
}

#[test]
fn refitted_motion_is_hit_where_it_is_now() {
    let mut r = Random::new(64);
    for quality in Quality::ALL {
        let mut shapes = Scene::random(0, true, &mut r).shapes;
        let mut bvh = Bvh::build(&shapes, quality).unwrap();
        for shape in &mut shapes {
            if let Primitive::MovingTriangle(t) = shape {
                t.at[1].a += 5.0 * r.in_cube();
                t.time = [0.0, 1.0];
            }
        }
        bvh.refit(&shapes).unwrap();
        assert_eq!(bvh.validate(), Ok(()));
        let list = Bvh::list(&shapes).unwrap();
        for ray in rays(&Scene::of(shapes), &[0.0, 0.3, 1.0], 1000, &mut r) {
            assert_eq!(bits(bvh.intersect(&ray)), bits(list.intersect(&ray)), "{quality}: {ray:?}");
        }
    }
}

/// What does not move and what moves not at all are hit alike.
#[test]
fn at_rest_nothing_changes() {
    let mut r = Random::new(65);
    let still: Vec<_> = (0..50).map(|_| Triangle { a: r.in_cube(), b: r.in_cube(), c: r.in_cube() }).collect();
    let moving = |t: &Triangle| Primitive::MovingTriangle(MovingTriangle { at: [*t; 2], time: [0.0, 1.0] });
    let [still, moving] =
        [still.iter().copied().map(Primitive::Triangle).collect::<Vec<_>>(), still.iter().map(moving).collect()];
    let shown = Scene { shapes: vec![instance(0, Affine::IDENTITY)], objects: vec![Scene::of(still.clone())] };
    let shown = shown.list();
    let [a, b] = [&still, &moving].map(|shapes| Bvh::build(shapes, Quality::Balanced).unwrap());
    for ray in rays(&Scene::of(still.clone()), &[0.0, 0.4], 5000, &mut r) {
        let expected = bits(a.intersect(&ray));
        assert_eq!(bits(b.intersect(&ray)), expected, "{ray:?}");
        assert_eq!(bits(shown.intersect(&ray)).map(|hit| hit.0), expected.map(|hit| hit.0), "{ray:?}");
    }
}
