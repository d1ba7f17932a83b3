//! Hits that the caller rejects: as if what was hit were not there.

use std::collections::HashMap;

use eyebeam_bvh::{Bvh, Hit, Primitive, Ray};
use glam::Vec3;

use crate::instances::{Scene, assert_same_as_list, bits, instance, rays};
use crate::random::Random;

/// The scene without some of its shapes, and for each list, outermost first, the indices of those that are left.
fn without(shapes: &[Primitive], is_rejected: impl Fn(u32) -> bool) -> (Vec<Primitive>, Vec<u32>) {
    (0..).zip(shapes).filter(|(i, _)| !is_rejected(*i)).map(|(i, shape)| (*shape, i)).unzip()
}

/// Tree and list with a callback find what a list of the rest finds, under the names of `rename`. How many rays find something
/// else than without the callback, among those that find something.
fn compare(
    scene: &Scene,
    rest: &Scene,
    rays: &[Ray],
    accept: impl Fn(&Hit) -> bool,
    rename: impl Fn(&mut Hit),
) -> usize {
    let rest = rest.list();
    let mut trees = scene.trees();
    trees.push(("list".to_owned(), scene.list()));
    let mut others = 0;
    for ray in rays {
        let mut hit = rest.intersect(ray);
        hit.as_mut().map(&rename);
        let expected = bits(hit);
        for (name, tree) in &trees {
            assert_eq!(bits(tree.intersect_where(ray, &accept)), expected, "{name}: {ray:?}");
            assert_eq!(tree.occluded_where(ray, &accept), expected.is_some(), "{name}: {ray:?}");
        }
        others += usize::from(expected.is_some() && bits(trees[0].1.intersect(ray)) != expected);
    }
    others
}

#[test]
fn rejected_primitives_are_not_there() {
    let mut r = Random::new(70);
    let mut others = 0;
    for _ in 0..30 {
        let mut scene = Scene::random(0, false, &mut r);
        scene.shapes.extend(Scene::random(0, true, &mut r).shapes);
        let (shapes, names) = without(&scene.shapes, is_rejected);
        let rays = rays(&scene, &[0.0, 0.3], 300, &mut r);
        let rename = |hit: &mut Hit| hit.prim = names[hit.prim as usize];
        others += compare(&scene, &Scene::of(shapes), &rays, |hit| !is_rejected(hit.prim), rename);
    }
    assert!(others > 500, "{others}");
}

fn is_rejected(index: u32) -> bool {
    index % 3 == 1
}

/// Parts of what an instance shows.
#[test]
fn rejection_reaches_into_instances() {
    let mut r = Random::new(71);
    let mut others = 0;
    for _ in 0..30 {
        let object = Scene::random(0, false, &mut r);
        let (parts, names) = without(&object.shapes, is_rejected);
        let shapes = Scene::random(1, false, &mut r).shapes;
        let [scene, rest] =
            [object, Scene::of(parts)].map(|object| Scene { shapes: shapes.clone(), objects: vec![object; 2] });
        let is_within = |hit: &Hit| hit.instances[0] != Hit::NO_INSTANCE;
        let rename = |hit: &mut Hit| {
            if is_within(hit) {
                hit.prim = names[hit.prim as usize];
            }
        };
        let rays = rays(&scene, &[0.0], 300, &mut r);
        others += compare(&scene, &rest, &rays, |hit| !(is_within(hit) && is_rejected(hit.prim)), rename);
    }
    assert!(others > 100, "{others}");
}

/// The index in the outermost list.
fn outermost(hit: &mut Hit) -> &mut u32 {
    if hit.instances[0] == Hit::NO_INSTANCE { &mut hit.prim } else { &mut hit.instances[0] }
}

/// Whole instances and plain shapes.
#[test]
fn instances_can_be_rejected() {
    let mut r = Random::new(75);
    let mut others = 0;
    for _ in 0..30 {
        let scene = Scene::random(1, false, &mut r);
        let (shapes, names) = without(&scene.shapes, is_rejected);
        let rename = |hit: &mut Hit| {
            let index = outermost(hit);
            *index = names[*index as usize];
        };
        let accept = |hit: &Hit| !is_rejected(*outermost(&mut { *hit }));
        let rest = Scene { shapes, objects: scene.objects.clone() };
        others += compare(&scene, &rest, &rays(&scene, &[0.0], 300, &mut r), accept, rename);
    }
    assert!(others > 100, "{others}");
}

/// Every other square of the surface's parameters is a hole.
fn is_solid(hit: &Hit) -> bool {
    ((hit.u * 8.0) as u32 + (hit.v * 8.0) as u32).is_multiple_of(2)
}

/// Each shape by itself, then the nearest of the hits that count.
#[test]
fn checkered_shapes_have_holes() {
    let mut r = Random::new(72);
    let mut rejected = 0;
    for n in [1, 5, 40, 300] {
        let shapes: Vec<_> = (0..n).map(|_| r.in_cube()).collect();
        let shapes: Vec<_> = shapes.into_iter().map(|center| r.shape(center, 0.5)).collect();
        let scene = Scene::of(shapes);
        let single: Vec<_> = scene.shapes.iter().map(|shape| Bvh::list(&vec![*shape]).unwrap()).collect();
        let trees = scene.trees();
        for ray in rays(&scene, &[0.0], 1000, &mut r) {
            let hits = (0..).zip(&single).filter_map(|(prim, bvh)| {
                let mut hit = bvh.intersect(&ray)?;
                hit.prim = prim;
                Some(hit)
            });
            let solid = hits.filter(is_solid).min_by(|a, b| a.t.total_cmp(&b.t).then(a.prim.cmp(&b.prim)));
            for (name, tree) in &trees {
                assert_eq!(bits(tree.intersect_where(&ray, is_solid)), bits(solid), "{name}: {ray:?}");
                assert_eq!(tree.occluded_where(&ray, is_solid), solid.is_some(), "{name}: {ray:?}");
            }
            rejected += usize::from(bits(trees[0].1.intersect(&ray)) != bits(solid));
        }
    }
    assert!(rejected > 200, "{rejected}");
}

#[test]
fn to_accept_or_reject_everything() {
    let mut r = Random::new(73);
    for depth in [0, 1, 2, 3].into_iter().cycle().take(20) {
        let scene = Scene::random(depth, depth % 2 == 1, &mut r);
        let rays = rays(&scene, &[0.0, 0.6], 200, &mut r);
        assert!(assert_same_as_list("accepted", &scene, &rays) > 10);
        for (name, tree) in scene.trees() {
            for ray in &rays {
                let hit = tree.intersect(ray);
                assert_eq!(bits(tree.intersect_where(ray, |_| true)), bits(hit), "{name}: {ray:?}");
                assert_eq!(tree.occluded_where(ray, |_| true), hit.is_some(), "{name}: {ray:?}");
                assert_eq!(tree.intersect_where(ray, |_| false), None, "{name}: {ray:?}");
                assert!(!tree.occluded_where(ray, |_| false), "{name}: {ray:?}");
            }
        }
    }
}

/// The caller is shown hits as they would be returned.
#[test]
fn the_caller_is_asked_about_hits_as_they_are() {
    let mut r = Random::new(74);
    let object = Scene::random(0, false, &mut r);
    let shapes = (0..10).map(|i| instance(0, eyebeam_bvh::Affine::from_translation(Vec3::X * i as f32))).collect();
    let scene = Scene { shapes, objects: vec![object] };
    let (name, tree) = &scene.trees()[1];
    for ray in rays(&scene, &[0.0], 500, &mut r) {
        let asked = std::cell::RefCell::new(HashMap::new());
        let note = |hit: &Hit| asked.borrow_mut().insert((hit.instances, hit.prim), *hit).is_none_or(|_| true);
        if let Some(hit) = tree.intersect_where(&ray, note) {
            let asked = asked.borrow();
            assert_eq!(asked.get(&(hit.instances, hit.prim)), Some(&hit), "{name}");
            assert!(asked.values().all(|hit| hit.t > 0.0 && hit.t <= ray.t_max), "{name}");
        }
    }
}
