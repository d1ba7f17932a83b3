//! Instances: the same as lists of lists, ties, what is refused or left out, closed surfaces, memory, refitting.

mod flattened;
mod scene;

use eyebeam_bvh::{Affine, BuildError, Bvh, Hit, Instance, Isa, Primitive, Quality, Ray, Sphere, Triangle};
use glam::Vec3;

use crate::random::Random;
use crate::watertight::icosphere;

pub(crate) use flattened::compare as compare_with_flattened;
use scene::transform;
pub(crate) use scene::{Scene, assert_same_as_list, bits, rays};

pub(crate) fn instance(object: u32, at: Affine) -> Primitive {
    Primitive::Instance(Instance::new(object, at))
}

fn ball() -> Primitive {
    Primitive::Sphere(Sphere { center: Vec3::ZERO, radius: 1.0 })
}

pub(crate) fn mesh(triangles: &[[Vec3; 3]]) -> Vec<Primitive> {
    triangles.iter().map(|&[a, b, c]| Primitive::Triangle(Triangle { a, b, c })).collect()
}

#[test]
fn trees_of_instances_find_what_lists_find() {
    let mut r = Random::new(40);
    for depth in [1, 1, 1, 2, 2, 3].into_iter().cycle().take(30) {
        let scene = Scene::random(depth, false, &mut r);
        let rays = rays(&scene, &[0.0], 400, &mut r);
        let hits = assert_same_as_list("random", &scene, &rays);
        assert!(hits > rays.len() / 20, "{depth}: {hits} hits");
    }
}

/// Through one another, at all angles and exactly on top of each other.
#[test]
fn one_object_many_times() {
    let mut r = Random::new(41);
    for spread in [0.0, 1.0, 30.0] {
        let object =
            Scene::of((0..20).map(|_| r.in_cube()).collect::<Vec<_>>().into_iter().map(|c| r.shape(c, 0.3)).collect());
        let mut shapes: Vec<_> = (0..100)
            .map(|_| {
                let at = transform(&mut r);
                instance(0, Affine { offset: at.offset * spread, ..at })
            })
            .collect();
        shapes.extend_from_within(20..60);
        shapes.extend_from_within(0..50);
        let scene = Scene { shapes, objects: vec![object] };
        let rays = rays(&scene, &[0.0], 300, &mut r);
        assert!(assert_same_as_list("copies", &scene, &rays) > 50);
    }
}

/// From a millionth to a million times the size, near and far, one in another; objects of one primitive and of many.
#[test]
fn scales_and_distances_of_every_size() {
    let mut r = Random::new(45);
    let scales = [1e-6, 1e-3, 1.0, 1e3, 1e6];
    let mut hits = 0;
    for n in [1, 2, 40].into_iter().cycle().take(60) {
        let mut show = |count: usize, object: Scene| {
            let shapes = (0..count).map(|_| {
                let (at, scale, far) = (transform(&mut r), r.pick(&scales), r.pick(&[0.0, 1.0, 1e3, 1e6]));
                instance(0, Affine { axes: at.axes.map(|axis| axis.normalize() * scale), offset: r.in_cube() * far })
            });
            Scene { shapes: shapes.collect(), objects: vec![object] }
        };
        let mut plain = Random::new(n as u64);
        let object = Scene::of((0..n).map(|_| plain.shape(Vec3::ZERO, 1.0)).collect());
        let inner = show(3, object);
        let scene = show(8, inner);
        let rays = rays(&scene, &[0.0], 300, &mut r);
        hits += assert_same_as_list("scales", &scene, &rays);
    }
    assert!(hits > 60 * 300 / 10, "{hits}");
}

/// At the same distance, the first path counts, however deep.
#[test]
fn of_the_same_the_first_path_counts() {
    let none = Hit::NO_INSTANCE;
    let inner = Scene::of(vec![ball(), ball()]);
    let middle = Scene {
        shapes: vec![instance(0, Affine::IDENTITY), ball(), instance(0, Affine::IDENTITY)],
        objects: vec![inner],
    };
    let (inside, plain) = (instance(0, Affine::IDENTITY), ball());
    let orders = [
        (vec![inside, inside, plain], ([0, 0, none], 0)),
        (vec![plain, inside, inside], ([none; 3], 0)),
        (vec![instance(0, Affine::from_translation(9.0 * Vec3::X)), inside, plain], ([1, 0, none], 0)),
    ];
    let ray = Ray::new(Vec3::new(0.0, 0.0, 3.0), Vec3::NEG_Z);
    for (shapes, (instances, prim)) in orders {
        let scene = Scene { shapes, objects: vec![middle.clone()] };
        assert_eq!(assert_same_as_list("ties", &scene, &[ray]), 1);
        let hit = scene.tree(Quality::Balanced, Isa::detect()).intersect(&ray).unwrap();
        assert_eq!((hit.t, hit.instances, hit.prim), (2.0, instances, prim));
    }
}

#[test]
fn what_is_nested_too_deep_or_unknown_is_refused() {
    let around = |inner: Scene| Scene { shapes: vec![ball(), instance(0, Affine::IDENTITY)], objects: vec![inner] };
    let three = around(around(around(Scene::of(vec![ball()]))));
    let hit = three.list().intersect(&Ray::new(3.0 * Vec3::Z, Vec3::NEG_Z)).unwrap();
    assert_eq!(hit.instances, [Hit::NO_INSTANCE; 3]);
    let four = around(three);
    assert_eq!(four.try_list().err(), Some(BuildError::TooDeep { index: 1, most: 3 }));
    let unknown = Scene { shapes: vec![ball(), instance(1, Affine::IDENTITY)], objects: vec![Scene::default()] };
    assert_eq!(unknown.try_list().err(), Some(BuildError::NoObject { index: 1, object: 1, count: 1 }));
    // Without a list of objects.
    assert!(matches!(Bvh::list(&unknown.shapes), Err(BuildError::NoObject { count: 0, .. })));
}

#[test]
fn what_cannot_be_seen_is_left_out() {
    let flat = Affine { axes: [Vec3::X, Vec3::Y, Vec3::X + Vec3::Y], offset: Vec3::ZERO };
    let mut stops = Instance::new(1, Affine::IDENTITY);
    stops.time = [1.0, 0.0];
    let mut flattens = Instance::new(1, Affine::IDENTITY);
    (flattens.at[1], flattens.time) = (flat, [0.0, 1.0]);
    let shapes = vec![
        instance(0, Affine::IDENTITY),
        instance(1, flat),
        instance(1, Affine { axes: [Vec3::ZERO; 3], offset: Vec3::ONE }),
        Primitive::Instance(stops),
        Primitive::Instance(flattens),
        instance(1, Affine::IDENTITY),
    ];
    let scene = Scene { shapes, objects: vec![Scene::default(), Scene::of(vec![ball()])] };
    for (name, tree) in scene.trees() {
        let stats = tree.stats();
        assert_eq!((stats.primitives, stats.degenerate), (1, 5), "{name}");
        let hit = tree.intersect(&Ray::new(3.0 * Vec3::Z, Vec3::NEG_Z)).unwrap();
        assert_eq!((hit.t, hit.instances[0]), (2.0, 5));
    }
}

/// Found by proptest: two axes are the same, and the determinant is not 0, for its products are rounded.
#[test]
fn what_is_flat_but_for_roundings_is_left_out() {
    let x = Vec3::new(0.2, 0.2, 0.1);
    let flat = Affine { axes: [x, Vec3::new(-0.079_279_07, -0.1, 0.0), x], offset: Vec3::ZERO };
    let scene = Scene { shapes: vec![instance(0, flat)], objects: vec![Scene::of(vec![ball()])] };
    assert_eq!(scene.list().stats().degenerate, 1);
    // In the middle of its time.
    let [mut from, mut to] = [flat; 2];
    (from.axes[2].x, to.axes[2].x) = (2.0 * x.x, 0.0);
    let moving = Instance { object: 0, at: [from, to], time: [0.0, 1.0] };
    let scene = Scene { shapes: vec![Primitive::Instance(moving)], objects: vec![Scene::of(vec![ball()])] };
    let ray = Ray { time: 0.5, ..Ray::new(3.0 * Vec3::Z, Vec3::NEG_Z) };
    assert_eq!(assert_same_as_list("flat", &scene, &[ray, Ray { time: 0.0, ..ray }]), 1);
}

#[test]
fn transforms_that_are_not_finite_are_refused() {
    for odd in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        for place in 0..14 {
            let mut broken = Instance::new(0, Affine::IDENTITY);
            broken.time = [0.0, 1.0];
            match place {
                0..9 => broken.at[1].axes[place / 3][place % 3] = odd,
                9..12 => broken.at[0].offset[place - 9] = odd,
                _ => {
                    broken.at[1].offset = Vec3::ONE;
                    broken.time[place - 12] = odd;
                }
            }
            let scene =
                Scene { shapes: vec![ball(), Primitive::Instance(broken)], objects: vec![Scene::of(vec![ball()])] };
            assert_eq!(scene.try_list().err(), Some(BuildError::NotFinite { index: 1 }), "{broken:?}");
        }
    }
    let timeless = Instance { time: [f32::NAN; 2], ..Instance::new(0, Affine::IDENTITY) };
    let scene = Scene { shapes: vec![Primitive::Instance(timeless)], objects: vec![Scene::of(vec![ball()])] };
    assert_eq!(scene.try_list().err(), Some(BuildError::NotFinite { index: 0 }));
}

/// Mirrored, sheared and stretched, alone and within another.
#[test]
fn closed_surfaces_stay_closed_in_instances() {
    let mut r = Random::new(42);
    let outline = icosphere(3, Vec3::ONE);
    let mirrored = Affine {
        axes: [Vec3::new(-1.0, 0.3, 0.0), Vec3::new(0.5, 1.0, 0.2), Vec3::new(0.0, -0.7, 1.3)],
        offset: Vec3::new(5.0, -3.0, 1.0),
    };
    let stretched = Affine {
        axes: [Vec3::new(0.01, 0.0, 0.1), Vec3::new(0.0, -30.0, 7.0), Vec3::new(-0.3, 0.0, 1.0)],
        offset: Vec3::new(0.0, 0.1, 200.0),
    };
    let object = Scene::of(mesh(&outline));
    let inner = Scene { shapes: vec![instance(0, mirrored)], objects: vec![object.clone()] };
    let scenes = [
        Scene { shapes: vec![instance(0, mirrored)], objects: vec![object.clone()] },
        Scene { shapes: vec![instance(0, stretched)], objects: vec![object] },
        Scene { shapes: vec![instance(0, stretched)], objects: vec![inner] },
    ];
    for scene in scenes {
        let to_world = scene.seen(0.0)[0].to_world;
        let world = |p: Vec3| to_world.transform_point3(p.as_dvec3()).as_vec3();
        let trees = scene.trees();
        for i in 0..20_000 {
            let (triangle, edge) = (outline[r.below(outline.len())], r.below(3));
            let any = r.unit();
            let on_edge = triangle[edge].lerp(triangle[(edge + 1) % 3], r.pick(&[0.0, 0.5, any]));
            let inside = 0.5 * r.in_cube();
            // From inside out, or from outside past the edge to the inside.
            let ray = if i % 2 == 0 {
                Ray::new(world(inside), world(on_edge) - world(inside))
            } else {
                let outside = inside + (on_edge - inside) * r.pick(&[3.0, 10.0, 1000.0]);
                Ray { t_max: 1.0, ..Ray::new(world(outside), world(inside) - world(outside)) }
            };
            let (name, tree) = &trees[i % trees.len()];
            assert!(tree.intersect(&ray).is_some() && tree.occluded(&ray), "{name}: {ray:?}");
        }
    }
}

/// A forest of a million trees.
#[test]
fn a_million_instances() {
    const SIDE: usize = 1000;
    let object = Scene::of(mesh(&icosphere(2, Vec3::splat(0.4))));
    let at = |i: usize| Affine::from_translation(Vec3::new((i % SIDE) as f32, 0.0, (i / SIDE) as f32));
    let scene = Scene { shapes: (0..SIDE * SIDE).map(|i| instance(0, at(i))).collect(), objects: vec![object] };
    let bvh = scene.tree(Quality::Fast, Isa::detect());
    assert!(bvh.stats().bytes / scene.shapes.len() < 250, "{:?}", bvh.stats());
    let mut r = Random::new(43);
    for _ in 0..1000 {
        let i = r.below(scene.shapes.len());
        let hit = bvh.intersect(&Ray::new(at(i).offset + 10.0 * Vec3::Y, Vec3::NEG_Y)).unwrap();
        assert_eq!(hit.instances[0], i as u32);
    }
}

#[test]
fn refitted_instances_are_hit_where_they_are_now() {
    let mut r = Random::new(44);
    for quality in Quality::ALL {
        let mut scene = Scene::random(2, false, &mut r);
        scene.shapes.extend((0..200).map(|_| instance(r.below(2) as u32, transform(&mut r))));
        let build = |parts: &scene::Parts| Bvh::build(parts, quality);
        let mut bvh = build(&scene.parts(&build).unwrap()).unwrap();
        for _ in 0..3 {
            for shape in &mut scene.shapes {
                if let Primitive::Instance(instance) = shape {
                    *instance = Instance::new(instance.object, transform(&mut r));
                }
            }
            bvh.refit(&scene.parts(&build).unwrap()).unwrap();
            assert_eq!(bvh.validate(), Ok(()));
            let fresh = build(&scene.parts(&build).unwrap()).unwrap();
            assert_eq!(bvh.bounds(), fresh.bounds());
            for ray in rays(&scene, &[0.0], 300, &mut r) {
                assert_eq!(bits(bvh.intersect(&ray)), bits(fresh.intersect(&ray)), "{quality}: {ray:?}");
                assert_eq!(bvh.occluded(&ray), fresh.occluded(&ray), "{quality}: {ray:?}");
            }
        }
    }
}
