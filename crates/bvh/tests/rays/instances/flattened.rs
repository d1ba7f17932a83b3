//! Instances against the same shapes without instances, whose corners are transformed in double precision.

use eyebeam_bvh::{Bvh, Hit, Isa, Quality, Ray, Surface};
use glam::DMat3;

use crate::instances::scene::{Scene, Seen, rays};
use crate::random::Random;

/// A hit of a flat shape by Möller and Trumbore, and how far it is inside the nearest edge. None if the ray is so nearly in the
/// plane that little can be said.
struct FlatHit {
    t: f64,
    uv: [f64; 2],
    inside: f64,
}

fn flat_hit(seen: &Seen, ray: &Ray) -> Option<FlatHit> {
    let (corner, [u, v], is_triangle) = seen.flat(ray.time)?;
    let (o, d) = (ray.o.as_dvec3(), ray.d.as_dvec3());
    let p = d.cross(v);
    let det = p.dot(u);
    if det.abs() <= 1e-3 * d.length() * u.length() * v.length() {
        return None;
    }
    let to_o = o - corner;
    let q = to_o.cross(u);
    let [x, y] = [p.dot(to_o) / det, q.dot(d) / det];
    let far = if is_triangle { 1.0 - x - y } else { (1.0 - x).min(1.0 - y) };
    Some(FlatHit { t: q.dot(v) / det, uv: [x, y], inside: x.min(y).min(far) })
}

/// What single precision loses of the answer.
const ROUNDING: f64 = 1e-7;

/// What double precision may lose in the transforms and their inverses, of the lengths involved, seen on the slant.
fn error(seen: &Seen) -> f64 {
    let largest = |m: DMat3| m.to_cols_array().into_iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    let m = seen.to_world.matrix3;
    1e-12 * largest(m) * largest(m.inverse())
}

/// The lengths that go into a hit.
fn reach(seen: &Seen, ray: &Ray, t: f64) -> f64 {
    let edges = seen.flat(ray.time).map_or(0.0, |(_, [u, v], _)| u.length() + v.length());
    ray.o.as_dvec3().length() + t * ray.d.as_dvec3().length() + seen.to_world.translation.length() + edges
}

fn assert_hit_is_right(bvh: &Bvh, hit: &Hit, seen: &[Seen], ray: &Ray) {
    let found = seen.iter().find(|seen| seen.prim == hit.prim && seen.instances == hit.instances).unwrap();
    let d = ray.d.as_dvec3();
    let along = d * f64::from(hit.t);
    let p = ray.o.as_dvec3() + along;
    let error = error(found) * reach(found, ray, hit.t.into());
    let to_world = bvh.to_world(hit, ray.time);
    match bvh.surface(hit, ray.time) {
        Surface::Flat { corner, edges } => {
            let Some(expected) = flat_hit(found, ray) else { return };
            let on_surface = corner + edges[0] * f64::from(hit.u) + edges[1] * f64::from(hit.v);
            let at = to_world.transform_point3(on_surface);
            let lengths = edges.map(|edge| to_world.transform_vector3(edge).length());
            let rounding = ROUNDING * (along.length() + lengths[0] + lengths[1]);
            assert!(at.distance(p) <= rounding + error, "{at} is not {p}: {ray:?} {hit:?}");
            let is_near =
                |a: f32, b: f64, error: f64| (f64::from(a) - b).abs() <= ROUNDING * b.abs().max(1e-30) + error;
            assert!(is_near(hit.t, expected.t, error / d.length()), "{hit:?} instead of {}: {ray:?}", expected.t);
            for (i, x) in [hit.u, hit.v].into_iter().enumerate() {
                assert!(
                    is_near(x, expected.uv[i], error / lengths[i]),
                    "{hit:?} instead of {:?}: {ray:?}",
                    expected.uv
                );
            }
        }
        Surface::Sphere(sphere) => {
            let to_object = to_world.inverse();
            let from_center = to_object.transform_point3(p).distance(sphere.center.as_dvec3());
            let m = to_object.matrix3;
            let scale = m.x_axis.length() + m.y_axis.length() + m.z_axis.length();
            let off = (from_center - f64::from(sphere.radius)).abs();
            assert!(off <= scale * (ROUNDING * along.length() + error), "off by {off}: {ray:?} {hit:?}");
        }
    }
}

/// Nothing that is certainly met lies before what was found.
fn assert_nothing_is_nearer(hit: Option<Hit>, seen: &[Seen], ray: &Ray) {
    let farthest = f64::from(hit.map_or(ray.t_max, |hit| hit.t));
    for other in seen {
        let Some(expected) = flat_hit(other, ray) else { continue };
        let error = error(other);
        if expected.inside > 1e-6 && error < 1e-4 {
            let t_error = error * reach(other, ray, expected.t.abs()) / ray.d.as_dvec3().length();
            let is_between = expected.t > t_error && expected.t < farthest * (1.0 - ROUNDING) - t_error;
            assert!(!is_between, "{hit:?} instead of {} at {}: {ray:?}", other.prim, expected.t);
        }
    }
}

/// So deep within each other, at these times.
pub(crate) fn compare(depth: usize, times: &[f32], r: &mut Random) {
    let scene = Scene::random(depth, times.len() > 1, r);
    let bvh = scene.tree(Quality::Balanced, Isa::detect());
    let seen: Vec<_> = times.iter().map(|&time| scene.seen(time)).collect();
    let mut hits = 0;
    for ray in rays(&scene, times, 300, r) {
        let seen = &seen[times.iter().position(|&time| time == ray.time).unwrap()];
        let hit = bvh.intersect(&ray);
        if let Some(hit) = &hit {
            assert_hit_is_right(&bvh, hit, seen, &ray);
            hits += 1;
        }
        assert_nothing_is_nearer(hit, seen, &ray);
    }
    assert!(hits > 20);
}

#[test]
fn instances_look_like_what_they_show() {
    let mut r = Random::new(50);
    for depth in [1, 1, 1, 2, 2, 3].into_iter().cycle().take(120) {
        compare(depth, &[0.0], &mut r);
    }
}
