//! Sets and rays that are made to go wrong: they must end without a panic.

use eyebeam_bvh::{BuildError, Bvh, Primitive, Quad, Quality, Ray, Sphere, Triangle};
use glam::Vec3;

use crate::random::Random;

fn ball(center: Vec3, radius: f32) -> Primitive {
    Primitive::Sphere(Sphere { center, radius })
}

#[test]
fn trees_can_be_shared_between_threads() {
    fn is_shared<T: Send + Sync + 'static>() {}
    is_shared::<Bvh>();
}

/// Sets that the surface area heuristic would split off one by one, deeper than the stack; and every ball is found.
#[test]
fn geometric_series() {
    for step in [2.0_f32, 0.5, 1.5, 0.97] {
        for (axis, dir) in Vec3::AXES.into_iter().enumerate() {
            let position = |k: i32| dir * step.powi(k);
            let shapes: Vec<_> = (0..120).map(|k| ball(position(k), 1e-3 * step.powi(k))).collect();
            for quality in Quality::ALL {
                let bvh = Bvh::build(&shapes, quality).unwrap();
                assert_eq!(bvh.validate(), Ok(()));
                let side = Vec3::AXES[(axis + 1) % 3];
                for k in 0..120 {
                    let ray = Ray::new(position(k) + side * step.powi(k), -side);
                    assert_eq!(bvh.intersect(&ray).map(|h| h.prim), Some(k as u32), "{step}^{k}");
                }
                let along = Ray::new(Vec3::ZERO, dir);
                let hit = |bvh: &Bvh| bvh.intersect(&along).map(|h| (h.t, h.prim));
                assert_eq!(hit(&bvh), hit(&Bvh::list(&shapes).unwrap()));
            }
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
    let list = Bvh::list(&shapes).unwrap();
    let trees = Quality::ALL.map(|quality| Bvh::build(&shapes, quality).unwrap());
    trees.iter().for_each(|tree| assert_eq!(tree.validate(), Ok(())));
    let mut r = Random::new(20);
    for _ in 0..2000 {
        let ray = Ray::new(r.in_cube() * 2.0, r.direction());
        let answer = |bvh: &Bvh| bvh.intersect(&ray).map(|h| (h.t, h.prim));
        trees.iter().for_each(|tree| assert_eq!(answer(tree), answer(&list), "{ray:?}"));
    }
}

#[test]
fn a_hundred_thousand_copies() {
    for shape in [ball(Vec3::ONE, 0.5), ball(Vec3::ZERO, 1e-30)] {
        for quality in Quality::ALL {
            let bvh = Bvh::build(&vec![shape; 100_000], quality).unwrap();
            assert_eq!(bvh.validate(), Ok(()));
            let d = Vec3::new(0.3, -0.2, -1.0);
            let center = bvh.bounds().lo.midpoint(bvh.bounds().hi);
            assert_eq!(bvh.intersect(&Ray::new(center - d, d)).map(|h| h.prim), Some(0));
        }
    }
}

const ODD: [f32; 8] = [0.0, -0.0, f32::NAN, f32::INFINITY, f32::NEG_INFINITY, f32::MAX, 1e-45, 1.0];

fn any(r: &mut Random, from: &[f32]) -> Vec3 {
    Vec3::from_array([0; 3].map(|_| r.pick(from)))
}

fn any_shape(r: &mut Random, from: &[f32]) -> Primitive {
    let [a, b, c] = [0; 3].map(|_| any(r, from));
    match r.below(3) {
        0 => ball(a, r.pick(from)),
        1 => Primitive::Quad(Quad { corner: a, u: b, v: c }),
        _ => Primitive::Triangle(Triangle { a, b, c }),
    }
}

/// Rays of any numbers, against usual shapes and against the largest and smallest there are.
#[test]
fn numbers_that_are_not_finite() {
    let mut r = Random::new(21);
    let shapes: Vec<_> = (0..200).map(|_| r.in_cube()).collect();
    let mut shapes: Vec<_> = shapes.into_iter().map(|center| r.shape(center, 0.3)).collect();
    for is_huge in [false, true] {
        if is_huge {
            let finite = [0.0, -0.0, f32::MAX, -f32::MAX, f32::MAX / 3.0, 1e38, 1e30, 1e19, 1e-45, 1.0];
            shapes.iter_mut().skip(1).step_by(2).for_each(|shape| *shape = any_shape(&mut r, &finite));
        }
        for quality in Quality::ALL {
            let bvh = Bvh::build(&shapes, quality).unwrap();
            assert_eq!(bvh.validate(), Ok(()));
            assert!(bvh.stats().sah_cost.is_finite());
            for _ in 0..20_000 {
                let o = if r.below(2) == 0 { r.in_cube() } else { any(&mut r, &ODD) };
                let hit = bvh.intersect(&Ray { t_max: r.pick(&ODD), ..Ray::new(o, any(&mut r, &ODD)) });
                assert!(hit.is_none_or(|h| h.t.is_finite()));
            }
        }
    }
}

#[test]
fn the_first_primitive_that_is_not_finite_is_named() {
    let mut r = Random::new(22);
    for count in [1, 100, 100_000] {
        let mut shapes: Vec<_> = (0..count).map(|_| r.shape(Vec3::ZERO, 1.0)).collect();
        let index = r.below(count);
        for (at, shape) in shapes.iter_mut().enumerate().skip(index) {
            if at == index || r.below(100) == 0 {
                *shape = loop {
                    let shape = any_shape(&mut r, &ODD);
                    if format!("{shape:?}").contains("NaN") || format!("{shape:?}").contains("inf") {
                        break shape;
                    }
                };
            }
        }
        for quality in Quality::ALL {
            assert_eq!(Bvh::build(&shapes, quality).err(), Some(BuildError::NotFinite { index }));
        }
    }
}
