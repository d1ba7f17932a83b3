//! What proptest, fuzzing and long runs have found.

use eyebeam_bvh::{Bvh, Primitive, Quad, Quality, Ray, Sphere, Triangle};
use glam::Vec3;

use crate::reference::Expected;

/// A triangle 0.05 × 0.0005 × 20 seen nearly along its length, from 4000 km: its projection is known to a few per cent of
/// its size. A test that bounds its errors by the largest components takes it to be seen edge-on, and meshes that are
/// stretched by 1e4 have holes from there.
#[test]
fn slivers_seen_from_afar() {
    let triangle = Triangle { a: Vec3::ZERO, b: Vec3::new(0.05, 0.0, -3.0), c: Vec3::new(0.0, 0.0005, 15.0) };
    let shape = Primitive::Triangle(triangle);
    let middle = (triangle.a + triangle.b + triangle.c) / 3.0;
    let o = middle + Vec3::new(2351.0, -16.0, -3_783_213.0);
    let ray = Ray::new(o, middle - o);
    let (expected, hit) = (Expected::new(&shape, &ray), Bvh::list(&vec![shape]).unwrap().intersect(&ray));
    assert!(expected.is_clear() && expected.allows(hit), "{hit:?}\n{expected:?}");
}

/// Found by the fuzzer: a ray straight at the rim of a plate from a thousand million times its size. The box test takes a
/// direction of 0 for one of 1e-12, which is off by 1 mm when it arrives, and the margin of the box is less.
#[test]
fn axis_parallel_rays_from_afar() {
    for far in [1e6, 1e7, 1e9, 1e12] {
        let plate = Primitive::Quad(Quad { corner: Vec3::new(-1.0, -1.0, 0.0), u: 2.0 * Vec3::X, v: 2.0 * Vec3::Y });
        // A second leaf, so that there is a node with boxes.
        let ball = Primitive::Sphere(Sphere { center: Vec3::ZERO, radius: 0.5 });
        let shapes = vec![plate, ball];
        let (tree, list) = (Bvh::build(&shapes, Quality::Balanced).unwrap(), Bvh::list(&shapes).unwrap());
        for x in [1.0, -1.0, 0.9999999, 0.9999] {
            let ray = Ray::new(Vec3::new(x, 0.5, -far), Vec3::Z);
            let [a, b] = [&tree, &list].map(|bvh| bvh.intersect(&ray).map(|hit| (hit.t, hit.prim)));
            assert_eq!(a, b, "{ray:?}");
        }
    }
}
