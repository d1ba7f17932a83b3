//! Sets and rays that are made to go wrong: they must end without a panic.

use eyebeam_bvh::{Bvh, Primitive, Quad, Quality, Ray, Sphere, Triangle};
use glam::Vec3;

use crate::random::Random;

fn ball(center: Vec3, radius: f32) -> Primitive {
    Primitive::Sphere(Sphere { center, radius })
}

/// Sets that the surface area heuristic would split off one by one, deeper than the stack; and every ball is found.
#[test]
fn geometric_series() {
    for step in [2.0_f32, 0.5, 1.5, 0.97] {
        for (axis, dir) in Vec3::AXES.into_iter().enumerate() {
            let position = |k: i32| dir * step.powi(k);
            let shapes: Vec<_> = (0..120).map(|k| ball(position(k), 1e-3 * step.powi(k))).collect();
            let bvh = Bvh::build(&shapes, Quality::Balanced).unwrap();
            let side = Vec3::AXES[(axis + 1) % 3];
            for k in 0..120 {
                let ray = Ray::new(position(k) + side * step.powi(k), -side);
                assert_eq!(bvh.intersect(&ray).map(|h| h.prim), Some(k as u32), "{step}^{k}");
            }
            let along = Ray::new(Vec3::ZERO, dir);
            assert_eq!(bvh.intersect(&along), Bvh::build(&shapes, Quality::Balanced).unwrap().intersect(&along));
        }
    }
}

/// Series in all axes at once, with many copies of each, so that every node leaves three behind on the stack.
#[test]
fn deep_trees_stay_within_the_stack() {
    let mut shapes = Vec::new();
    for k in 0..60 {
        let x = 0.5_f32.powi(k);
        for corner in [Vec3::X, Vec3::Y, Vec3::Z, Vec3::NEG_X, Vec3::NEG_Y, Vec3::NEG_Z, Vec3::ONE] {
            shapes.extend((0..20).map(|i| ball(corner * x, x * (1.0 + 0.1 * i as f32))));
        }
    }
    let (tree, list) = (Bvh::build(&shapes, Quality::Balanced).unwrap(), Bvh::list(&shapes).unwrap());
    let mut r = Random::new(20);
    for _ in 0..2000 {
        let ray = Ray::new(r.in_cube() * 2.0, r.direction());
        let [a, b] = [&tree, &list].map(|bvh| bvh.intersect(&ray).map(|h| (h.t, h.prim)));
        assert_eq!(a, b, "{ray:?}");
    }
}

#[test]
fn a_hundred_thousand_copies() {
    for shape in [ball(Vec3::ONE, 0.5), ball(Vec3::ZERO, 1e-30)] {
        let bvh = Bvh::build(&vec![shape; 100_000], Quality::Balanced).unwrap();
        let d = Vec3::new(0.3, -0.2, -1.0);
        let center = bvh.bounds().lo.midpoint(bvh.bounds().hi);
        assert_eq!(bvh.intersect(&Ray::new(center - d, d)).map(|h| h.prim), Some(0));
    }
}

#[test]
fn numbers_that_are_not_finite() {
    let mut r = Random::new(21);
    let shapes: Vec<_> = (0..200).map(|_| r.in_cube()).collect();
    let mut shapes: Vec<_> = shapes.into_iter().map(|center| r.shape(center, 0.3)).collect();
    let odd = [0.0, -0.0, f32::NAN, f32::INFINITY, f32::NEG_INFINITY, f32::MAX, 1e-45, 1.0];
    let any = |r: &mut Random| Vec3::from_array([0; 3].map(|_| r.pick(&odd)));
    for broken in [false, true] {
        if broken {
            for (i, shape) in shapes.iter_mut().enumerate() {
                let [a, b, c] = [0; 3].map(|_| any(&mut r));
                *shape = match i % 4 {
                    0 => Primitive::Sphere(Sphere { center: a, radius: r.pick(&odd) }),
                    1 => Primitive::Quad(Quad { corner: a, u: b, v: c }),
                    2 => Primitive::Triangle(Triangle { a, b, c }),
                    _ => *shape,
                };
            }
        }
        let bvh = Bvh::build(&shapes, Quality::Balanced).unwrap();
        for _ in 0..20_000 {
            let o = if r.below(2) == 0 { r.in_cube() } else { any(&mut r) };
            let hit = bvh.intersect(&Ray { o, d: any(&mut r), t_max: r.pick(&odd), time: 0.0 });
            assert!(hit.is_none_or(|h| h.t.is_finite()));
        }
    }
}
