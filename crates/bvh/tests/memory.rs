//! A walk through all of the unsafe code in little time, for tools that watch every access to memory: `make memcheck`
//! (valgrind), and processors that are emulated (`make test-arm`).

use eyebeam_bvh::{Bvh, Isa, MovingTriangle, Primitive, Quad, Quality, Ray, Sphere, Triangle};
use glam::Vec3;

/// Tools are 30 (valgrind) to 1000 (Miri) times slower than the processor.
const SHAPES: usize = 3000;
const RAYS: usize = 1500;

/// Points that fill the cube from -1 to 1 evenly (multiples of irrational numbers).
fn point(i: usize) -> Vec3 {
    let coordinate = |share: f64| (2.0 * (i as f64 * share).fract() - 1.0) as f32;
    Vec3::new(coordinate(0.819_172_513), coordinate(0.671_043_607), coordinate(0.549_700_478))
}

fn shape(i: usize) -> Primitive {
    let (at, u, v) = (point(i), 0.1 * point(i + 7), 0.1 * point(i + 13));
    match i % 4 {
        0 => Primitive::Sphere(Sphere { center: at, radius: 0.1 * u.length() + 1e-3 }),
        1 => Primitive::Quad(Quad { corner: at, u, v }),
        2 => Primitive::Triangle(Triangle { a: at, b: at + u, c: at + v }),
        _ => {
            let triangle = |a: Vec3| Triangle { a, b: a + u, c: a + v };
            Primitive::MovingTriangle(MovingTriangle { at: [triangle(at), triangle(at + v)], time: [0.0, 1.0] })
        }
    }
}

/// Every third straight at a shape, every third with a zero in its direction.
fn ray(i: usize, shapes: &[Primitive]) -> Ray {
    let o = 2.0 * point(5 * i + 1);
    let d = match (i % 3, shapes.get(i)) {
        (0, Some(shape)) => shape.bounds(&[]).lo.midpoint(shape.bounds(&[]).hi) - o,
        (1, _) => point(i) * Vec3::new(1.0, 0.0, 1.0),
        _ => point(i),
    };
    let t_max = if i.is_multiple_of(4) { 1.5 } else { f32::INFINITY };
    Ray { t_max, time: (i % 5) as f32 / 4.0, ..Ray::new(o, d) }
}

/// Traces the rays in every way that there is.
fn trace(bvh: &Bvh, rays: &[Ray]) -> Vec<Option<(u32, u32)>> {
    let (mut hits, mut occluded) = (vec![None; rays.len()], vec![false; rays.len()]);
    let flying = bvh.clone().with_rays_in_flight(true);
    flying.intersect_batch(rays, &mut hits);
    flying.occluded_batch(rays, &mut occluded);
    let single: Vec<_> = rays.iter().map(|ray| bvh.intersect(ray)).collect();
    assert_eq!(single, hits);
    assert!(rays.iter().zip(&hits).all(|(ray, hit)| bvh.occluded(ray) == hit.is_some()));
    assert!(hits.iter().zip(&occluded).all(|(hit, &occluded)| hit.is_some() == occluded));
    hits.iter().map(|hit| hit.map(|h| (h.t.to_bits(), h.prim))).collect()
}

#[test]
fn every_path_over_every_shape() {
    for count in [0, 1, 5, SHAPES] {
        let shapes: Vec<_> = (0..count).map(shape).collect();
        let rays: Vec<_> = (0..RAYS).map(|i| ray(i, &shapes)).collect();
        let list = trace(&Bvh::list(&shapes).unwrap(), &rays[..rays.len().min(200)]);
        for quality in Quality::ALL {
            let bvh = Bvh::build(&shapes, quality).unwrap();
            let scalar = trace(&bvh.clone().with_isa(Isa::Scalar), &rays);
            assert_eq!(scalar[..list.len()], list);
            assert_eq!(trace(&bvh.with_isa(Isa::detect()), &rays), scalar);
        }
        assert!(count < SHAPES || list.iter().flatten().count() > list.len() / 5);
    }
    println!("walked with {:?} and {:?}", Isa::Scalar, Isa::detect());
}

/// The stack is deepest where boxes lie within boxes, and every child is met.
#[test]
fn a_deep_stack() {
    const STEPS: i32 = 60;
    let ball = |k: i32, i: i32, center: Vec3| {
        let radius = 0.5_f32.powi(k) * (1.0 + 0.1 * i as f32);
        Primitive::Sphere(Sphere { center: center * radius, radius })
    };
    let sides = [Vec3::X, Vec3::NEG_Y, Vec3::Z, Vec3::ONE];
    let balls = (0..STEPS).flat_map(|k| sides.into_iter().flat_map(move |side| (0..9).map(move |i| ball(k, i, side))));
    let balls: Vec<_> = balls.collect();
    let rays: Vec<_> = (0..RAYS.div_ceil(10)).map(|i| Ray::new(0.1 * point(i), point(i + 3))).collect();
    for quality in Quality::ALL {
        let bvh = Bvh::build(&balls, quality).unwrap();
        assert_eq!(trace(&bvh.clone().with_isa(Isa::Scalar), &rays), trace(&bvh, &rays));
    }
}

/// What is not a number must end, and within the tree.
#[test]
fn rays_that_are_not_finite() {
    let odd = [0.0, -0.0, f32::NAN, f32::INFINITY, f32::NEG_INFINITY, f32::MAX, 1e-45];
    let any = |i: usize| Vec3::new(odd[i % 7], odd[i / 7 % 7], odd[i / 49 % 7]);
    let shapes: Vec<_> = (0..300).map(shape).collect();
    let bvh = Bvh::build(&shapes, Quality::Balanced).unwrap();
    for bvh in [bvh.clone().with_isa(Isa::Scalar), bvh] {
        for i in 0..343 {
            for (o, d) in [(any(i), point(i)), (point(i), any(i)), (any(i), any(i + 11))] {
                let ray = Ray { t_max: odd[i % 5], ..Ray::new(o, d) };
                for ray in [ray, Ray::new(o, d)] {
                    assert!(bvh.intersect(&ray).is_none_or(|hit| hit.t.is_finite()));
                    bvh.occluded(&ray);
                }
            }
        }
    }
}
