//! The tree finds what the list finds, bit for bit, with whatever instructions it is walked.

use eyebeam_bvh::{Bvh, Isa, Primitive, Quad, Quality, Ray, Sphere, Surface, Triangle};
use glam::Vec3;

use crate::random::Random;

/// Asks tree and list the same questions; most must have an answer, unless there is nothing to hit.
fn compare(name: &str, shapes: Vec<Primitive>, extent: f32, rays: usize, r: &mut Random) {
    let list = Bvh::list(&shapes).unwrap();
    let trees = Quality::ALL.map(|quality| Bvh::build(&shapes, quality).unwrap());
    for tree in &trees {
        assert_eq!(tree.bounds(), list.bounds());
        assert_eq!(tree.validate(), Ok(()));
    }
    let [fast, balanced, best] = trees;
    let plain = balanced.clone().with_isa(Isa::Scalar);
    let trees = [("balanced", balanced), ("plain instructions", plain), ("fast", fast), ("best", best)];
    let mut hits = 0;
    for _ in 0..rays {
        let ray = r.ray(&shapes, extent);
        let answer = |bvh: &Bvh| {
            let hit = bvh.intersect(&ray);
            if let Some(h) = hit {
                assert!(h.t <= ray.t_max && h.t > 0.0, "{name}: {ray:?} {h:?}");
                assert_eq!(bvh.surface(&h, 0.0), surface(&shapes[h.prim as usize]));
            }
            hit.map(|h| (h.t.to_bits(), h.prim, h.u.to_bits(), h.v.to_bits()))
        };
        let expected = answer(&list);
        for (tree_name, tree) in &trees {
            assert_eq!(answer(tree), expected, "{name}, {} shapes, {tree_name}: {ray:?}", shapes.len());
        }
        hits += usize::from(expected.is_some());
    }
    assert!(shapes.is_empty() || hits > rays / 20, "{name}: only {hits} of {rays} rays hit");
}

/// A shape as a hit shows it.
fn surface(shape: &Primitive) -> Surface {
    match *shape {
        Primitive::Triangle(t) => {
            let [a, b, c] = [t.a, t.b, t.c].map(|p| p.as_dvec3());
            Surface::Flat { corner: a, edges: [b - a, c - a] }
        }
        Primitive::Quad(q) => Surface::Flat { corner: q.corner.as_dvec3(), edges: [q.u.as_dvec3(), q.v.as_dvec3()] },
        Primitive::Sphere(s) => Surface::Sphere(s),
        _ => panic!("{shape:?} has no surface of its own"),
    }
}

#[test]
fn soups_of_every_size() {
    let mut r = Random::new(10);
    for n in [0, 1, 2, 3, 4, 5, 6, 17, 100, 5000] {
        for spread in [0.0, 0.3, 1.0] {
            let size = if n > 1000 { 0.05 } else { 0.4 };
            let shapes = (0..n).map(|_| r.in_cube() * spread).collect::<Vec<_>>();
            let shapes = shapes.into_iter().map(|center| r.shape(center, size)).collect();
            compare("soup", shapes, 1.0, if n > 1000 { 2000 } else { 5000 }, &mut r);
        }
    }
}

#[test]
fn sizes_and_distances_of_every_scale() {
    let mut r = Random::new(11);
    for _ in 0..200 {
        let scales = [1e-6, 1e-3, 1.0, 1e3, 1e6];
        let shape = |_| {
            let center = r.in_cube() * r.pick(&scales);
            let size = r.pick(&scales);
            r.shape(center, size)
        };
        let shapes = (0..60).map(shape).collect();
        let extent = r.pick(&scales);
        compare("scales", shapes, extent, 2000, &mut r);
    }
}

/// Every shape twice or more: the lowest index wins.
#[test]
fn duplicates() {
    let mut r = Random::new(12);
    for copies in [2, 3, 50] {
        let few: Vec<_> = (0..8).map(|_| r.shape(Vec3::ZERO, 1.0)).collect();
        let shapes = (0..copies * few.len()).map(|i| few[i % few.len()]).collect();
        compare("duplicates", shapes, 2.0, 5000, &mut r);
    }
}

/// Quads and triangles on top of each other in one plane, and stacks that are closer than single precision tells apart.
#[test]
fn coplanar_stacks() {
    let mut r = Random::new(13);
    for gap in [0.0, 1e-9, 1e-7, 1e-3] {
        for axis in 0..3 {
            let [u, v, n] = [0, 1, 2].map(|i| Vec3::AXES[(axis + i) % 3]);
            let shape = |i: usize| {
                let corner = n * (gap * i as f32) + (u + v) * 0.1 * (i % 7) as f32;
                if i.is_multiple_of(2) {
                    Primitive::Quad(Quad { corner, u, v })
                } else {
                    Primitive::Triangle(Triangle { a: corner, b: corner + u, c: corner + v })
                }
            };
            compare("stack", (0..64).map(shape).collect(), 1.5, 5000, &mut r);
        }
    }
}

/// Long thin triangles and quads through one another, most seen on the slant.
#[test]
fn slivers() {
    let mut r = Random::new(14);
    for thickness in [1e-2, 1e-4, 1e-6, 1e-8] {
        for _ in 0..20 {
            let sliver = |_| {
                let (a, along) = (r.in_cube(), r.in_cube());
                let across = r.in_cube() * thickness;
                if r.below(2) == 0 {
                    Primitive::Quad(Quad { corner: a, u: along, v: across })
                } else {
                    Primitive::Triangle(Triangle { a, b: a + along, c: a + along * r.unit() + across })
                }
            };
            compare("slivers", (0..100).map(sliver).collect(), 1.0, 2000, &mut r);
        }
    }
}

/// Rays in the plane of slivers, whose normals are all rounding.
#[test]
fn slivers_seen_edge_on() {
    let mut r = Random::new(15);
    for _ in 0..300 {
        let (corner, along, across) = (r.in_cube(), r.in_cube(), r.in_cube());
        let sliver = |_| {
            let a = corner + along * r.unit() + across * r.unit();
            let (u, v) = (along * r.unit(), along * r.unit() + across * r.unit() * r.pick(&[1.0, 1e-4, 1e-7]));
            if r.below(2) == 0 {
                Primitive::Quad(Quad { corner: a, u, v })
            } else {
                Primitive::Triangle(Triangle { a, b: a + u, c: a + v })
            }
        };
        compare("edge-on", (0..50).map(sliver).collect(), 1.0, 1000, &mut r);
    }
}

/// A grid of squares and triangles, looked at along its plane.
#[test]
fn grids_seen_edge_on() {
    let mut r = Random::new(16);
    for n in [1, 2, 16] {
        let shape = |i: usize| {
            let cell = 1.0 / n as f32;
            let corner = Vec3::new((i % n) as f32 * cell, 0.0, (i / n) as f32 * cell);
            let (u, v) = (Vec3::X * cell, Vec3::Z * cell);
            if i.is_multiple_of(3) {
                Primitive::Quad(Quad { corner, u, v })
            } else {
                Primitive::Triangle(Triangle { a: corner, b: corner + u, c: corner + v })
            }
        };
        let shapes: Vec<_> = (0..n * n).map(shape).collect();
        let list = Bvh::list(&shapes).unwrap();
        let trees = Quality::ALL.map(|quality| Bvh::build(&shapes, quality).unwrap());
        for _ in 0..20_000 {
            let height = r.pick(&[0.0, 1e-45, 1e-30, 1e-9]);
            let o = Vec3::new(r.unit() * 3.0 - 1.0, height, r.unit() * 3.0 - 1.0);
            let d = r.direction() * Vec3::new(1.0, r.pick(&[0.0, -0.0, 1e-30, -1e-9, -1e-4]), 1.0);
            let ray = Ray::new(o, d);
            let expected = list.intersect(&ray).map(|h| (h.t, h.prim));
            for (tree, quality) in trees.iter().zip(Quality::ALL) {
                assert_eq!(tree.intersect(&ray).map(|h| (h.t, h.prim)), expected, "{quality}: {ray:?}");
            }
        }
    }
}

#[test]
fn centres_that_coincide() {
    let mut r = Random::new(17);
    let onion = (0..100).map(|i| Sphere { center: Vec3::ONE, radius: 0.01 * (100 - i) as f32 });
    compare("onion", onion.map(Primitive::Sphere).collect(), 2.0, 5000, &mut r);
    let fan = (0..100).map(|_| r.in_cube()).collect::<Vec<_>>();
    let fan = fan.windows(2).map(|e| Primitive::Quad(Quad { corner: -(e[0] + e[1]) / 2.0, u: e[0], v: e[1] }));
    compare("fan", fan.collect(), 2.0, 5000, &mut r);
}

/// Long thin quads and triangles hinged on one short edge and nearly in one plane, seen in that plane from beyond the hinge:
/// their distances are all the same but for errors larger than single precision's.
#[test]
fn fans_seen_edge_on() {
    let mut r = Random::new(18);
    for _ in 0..400 {
        let size = r.pick(&[1.0, 1e3, 1e6]);
        let thin = r.pick(&[1.0, 1e-3, 1e-4, 1e-5]) * size;
        let (corner, hinge, wing) = (r.in_cube() * r.pick(&[0.0, size]), r.in_cube() * thin, r.in_cube() * size);
        let jitter = r.pick(&[1e-8, 1e-7, 1e-6, 1e-4]) * size;
        let blade = |_| {
            let (u, v) = (hinge, wing * (r.unit() + 0.1) + r.in_cube() * jitter);
            if r.below(2) == 0 {
                Primitive::Quad(Quad { corner, u, v })
            } else {
                Primitive::Triangle(Triangle { a: corner, b: corner + u, c: corner + v })
            }
        };
        let shapes: Vec<_> = (0..40).map(blade).collect();
        let list = Bvh::list(&shapes).unwrap();
        let trees = Quality::ALL.map(|quality| Bvh::build(&shapes, quality).unwrap());
        for _ in 0..1000 {
            let on_hinge = corner + hinge * r.unit();
            let o = on_hinge - (wing + hinge * (r.unit() - 0.5)) * r.pick(&[1e-6, 1e-3, 1.0]);
            let ray = Ray::new(o, on_hinge + wing * r.pick(&[0.0, 1e-7, 1e-5]) - o);
            let answer = |bvh: &Bvh| bvh.intersect(&ray).map(|h| (h.t.to_bits(), h.prim));
            for (tree, quality) in trees.iter().zip(Quality::ALL) {
                assert_eq!(answer(tree), answer(&list), "{quality}: {ray:?}");
            }
        }
    }
}
