//! What builds promise besides hits: what is left out, and trees that follow what they show.

use eyebeam_bvh::{BuildError, Bvh, Primitive, Quad, Quality, Sphere, Triangle};
use glam::Vec3;

use crate::random::Random;

fn degenerate(r: &mut Random) -> Primitive {
    let (a, u) = (r.in_cube(), r.in_cube());
    match r.below(4) {
        0 => Primitive::Sphere(Sphere { center: a, radius: r.pick(&[0.0, -0.0, -0.3]) }),
        1 => Primitive::Quad(Quad { corner: a, u, v: u * 2.0 }),
        2 => Primitive::Triangle(Triangle { a, b: a, c: u }),
        _ => Primitive::Triangle(Triangle { a: Vec3::ZERO, b: u, c: u * -0.5 }),
    }
}

#[test]
fn degenerate_primitives_are_left_out_and_counted() {
    let mut r = Random::new(30);
    for count in [0, 1, 9, 300, 40_000] {
        let shapes: Vec<_> = (0..count).map(|_| degenerate(&mut r)).collect();
        for quality in Quality::ALL {
            let bvh = Bvh::build(&shapes, quality).unwrap();
            let stats = bvh.stats();
            assert_eq!((stats.primitives, stats.degenerate, stats.leaves), (0, count, 0));
            assert_eq!(bvh.intersect(&r.ray(&shapes, 1.0)), None);
            let is_odd = |i: &usize| i % 2 == 1;
            let mixed: Vec<_> =
                (0..count).map(|i| if is_odd(&i) { shapes[i] } else { r.shape(Vec3::ZERO, 1.0) }).collect();
            let bvh = Bvh::build(&mixed, quality).unwrap();
            assert_eq!(bvh.stats().degenerate, (0..count).filter(is_odd).count());
            assert_eq!(bvh.validate(), Ok(()));
        }
    }
}

fn moved(shape: Primitive, by: &mut impl FnMut() -> Vec3) -> Primitive {
    match shape {
        Primitive::Sphere(s) => Primitive::Sphere(Sphere { center: s.center + by(), ..s }),
        Primitive::Quad(q) => Primitive::Quad(Quad { corner: q.corner + by(), u: q.u + by(), v: q.v + by() }),
        Primitive::Triangle(t) => Primitive::Triangle(Triangle { a: t.a + by(), b: t.b + by(), c: t.c + by() }),
        other => other,
    }
}

fn assert_same_hits(refitted: &Bvh, shapes: &Vec<Primitive>, r: &mut Random) {
    let list = Bvh::list(shapes).unwrap();
    assert_eq!(refitted.validate(), Ok(()));
    assert_eq!(refitted.bounds(), list.bounds());
    for _ in 0..2000 {
        let ray = r.ray(shapes, 1.0);
        let [a, b] = [refitted, &list].map(|bvh| bvh.intersect(&ray).map(|h| (h.t.to_bits(), h.prim)));
        assert_eq!(a, b, "{ray:?}");
    }
}

#[test]
fn refitted_trees_hit_what_new_ones_hit() {
    let mut r = Random::new(31);
    for (count, quality) in [0, 1, 8, 300, 3000].into_iter().flat_map(|n| Quality::ALL.map(|q| (n, q))) {
        let centers: Vec<_> = (0..count).map(|_| r.in_cube()).collect();
        let shape =
            |i: usize, center: Vec3, r: &mut Random| if i % 50 == 7 { degenerate(r) } else { r.shape(center, 0.2) };
        let mut shapes: Vec<_> = centers.iter().enumerate().map(|(i, &center)| shape(i, center, &mut r)).collect();
        let mut bvh = Bvh::build(&shapes, quality).unwrap();
        for distance in [0.0, 0.1, 2.0] {
            for (i, shape) in shapes.iter_mut().enumerate().filter(|(i, _)| i % 50 != 7) {
                *shape = moved(*shape, &mut || if i % 3 == 0 { Vec3::ZERO } else { distance * r.in_cube() });
            }
            bvh.refit(&shapes).unwrap();
            assert_same_hits(&bvh, &shapes, &mut r);
        }
    }
}

#[test]
fn what_refitting_cannot_do_is_built_anew() {
    let mut r = Random::new(32);
    let shapes: Vec<_> = (0..500).map(|_| r.in_cube()).collect();
    let shapes: Vec<_> = shapes.into_iter().map(|center| r.shape(center, 0.2)).collect();
    let mut bvh = Bvh::build(&shapes, Quality::Best).unwrap();
    let mut fewer = shapes.clone();
    fewer.truncate(300);
    let mut others = shapes.clone();
    others.swap(0, 1);
    others.rotate_left(7);
    let mut flat = shapes.clone();
    flat[20] = degenerate(&mut r);
    for changed in [&fewer, &shapes, &others, &flat, &shapes] {
        bvh.refit(changed).unwrap();
        assert_same_hits(&bvh, changed, &mut r);
    }
    flat[3] = Primitive::Sphere(Sphere { center: Vec3::NAN, radius: 1.0 });
    assert_eq!(bvh.refit(&flat), Err(BuildError::NotFinite { index: 3 }));
    assert_same_hits(&bvh, &shapes, &mut r);
}
