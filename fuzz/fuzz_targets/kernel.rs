//! Any numbers as shapes and rays: the kernel refuses them, or it traces them without a panic, an endless loop or a hit that
//! is not a number; and where the numbers are in range, the tree finds what the list finds.

#![no_main]

use arbitrary::{Arbitrary, Result, Unstructured};
use eyebeam_bvh::{Bvh, Hit, Isa, Primitive, Quad, Quality, Ray, Sphere, Triangle};
use glam::Vec3;
use libfuzzer_sys::fuzz_target;

/// Mostly numbers that scenes are made of, sometimes any bits.
#[derive(Debug)]
struct Number(f32);

impl<'a> Arbitrary<'a> for Number {
    fn arbitrary(u: &mut Unstructured<'a>) -> Result<Self> {
        const ODD: [f32; 16] = [
            0.0,
            -0.0,
            1.0,
            -1.0,
            1e-6,
            1e6,
            1e-18,
            1e18,
            1e-30,
            1e30,
            f32::NAN,
            f32::INFINITY,
            f32::NEG_INFINITY,
            f32::MAX,
            f32::MIN_POSITIVE,
            1e-45,
        ];
        let kind = u8::arbitrary(u)?;
        Ok(Self(match kind >> 5 {
            0..=3 => f32::from(i8::arbitrary(u)?) / 16.0,
            4 => f32::from(i16::arbitrary(u)?) * 10.0_f32.powi(i32::from(kind % 16) - 8),
            5 | 6 => ODD[usize::from(kind % 4)],
            _ if kind % 2 == 0 => ODD[usize::from(kind / 2 % 16)],
            _ => f32::from_bits(u32::arbitrary(u)?),
        }))
    }
}

#[derive(Arbitrary, Debug)]
struct Point([Number; 3]);

impl From<&Point> for Vec3 {
    fn from(Point([x, y, z]): &Point) -> Self {
        Self::new(x.0, y.0, z.0)
    }
}

#[derive(Arbitrary, Debug)]
enum Shape {
    Sphere(Point, Number),
    Quad(Point, Point, Point),
    Triangle(Point, Point, Point),
    /// As an earlier one.
    Again(u8),
}

#[derive(Arbitrary, Debug)]
struct Aim {
    from: Point,
    to: Point,
    is_direction: bool,
    t_max: Option<Number>,
    time: Number,
}

#[derive(Arbitrary, Debug)]
struct Input {
    shapes: Vec<Shape>,
    aims: Vec<Aim>,
}

impl Input {
    fn shapes(&self) -> Vec<Primitive> {
        let mut shapes: Vec<Primitive> = Vec::new();
        for shape in self.shapes.iter().take(100) {
            shapes.push(match shape {
                Shape::Sphere(center, radius) => {
                    Primitive::Sphere(Sphere { center: center.into(), radius: radius.0.abs() })
                }
                Shape::Quad(corner, u, v) => Primitive::Quad(Quad { corner: corner.into(), u: u.into(), v: v.into() }),
                Shape::Triangle(a, b, c) => Primitive::Triangle(Triangle { a: a.into(), b: b.into(), c: c.into() }),
                Shape::Again(_) if shapes.is_empty() => continue,
                Shape::Again(index) => shapes[usize::from(*index) % shapes.len()],
            });
        }
        shapes
    }

    fn rays(&self) -> Vec<Ray> {
        let ray = |aim: &Aim| {
            let (o, to) = (Vec3::from(&aim.from), Vec3::from(&aim.to));
            let t_max = aim.t_max.as_ref().map_or(f32::INFINITY, |t| t.0);
            Ray { t_max, time: aim.time.0, ..Ray::new(o, if aim.is_direction { to } else { to - o }) }
        };
        self.aims.iter().take(50).map(ray).collect()
    }
}

/// What a scene is made of: zero, or a size that squares and products of single precision hold.
fn in_range(v: Vec3) -> bool {
    v.abs().to_array().into_iter().all(|x| x == 0.0 || (LEAST..=MOST).contains(&x))
}

const LEAST: f32 = 1e-18;
const MOST: f32 = 1e18;

fn is_shape_in_range(shape: &Primitive) -> bool {
    match *shape {
        Primitive::Sphere(Sphere { center, radius }) => in_range(center) && (LEAST..=MOST).contains(&radius),
        Primitive::Quad(Quad { corner, u, v }) => [corner, u, v].into_iter().all(in_range),
        Primitive::Triangle(Triangle { a, b, c }) => [a, b, c].into_iter().all(in_range),
    }
}

fn is_ray_in_range(ray: &Ray) -> bool {
    let length = ray.d.as_dvec3().length();
    in_range(ray.o) && (1e-18..=1e18).contains(&length) && ray.t_max >= 0.0 && (0.0..=1.0).contains(&ray.time)
}

fn bits(hit: Option<Hit>) -> Option<[u32; 4]> {
    hit.map(|h| [h.t.to_bits(), h.prim, h.u.to_bits(), h.v.to_bits()])
}

fuzz_target!(|input: Input| {
    let (shapes, rays) = (input.shapes(), input.rays());
    let Ok(list) = Bvh::list(&shapes) else { return };
    let are_shapes_in_range = shapes.iter().all(is_shape_in_range);
    for quality in Quality::ALL {
        let tree = Bvh::build(&shapes, quality).expect("what one quality builds, all do");
        for tree in [Isa::Scalar, Isa::detect()].map(|isa| tree.clone().with_isa(isa)) {
            let (mut hits, mut occluded) = (vec![None; rays.len()], vec![false; rays.len()]);
            tree.intersect_batch(&rays, &mut hits);
            tree.occluded_batch(&rays, &mut occluded);
            for (i, ray) in rays.iter().enumerate() {
                let (hit, is_occluded) = (tree.intersect(ray), tree.occluded(ray));
                if let Some(hit) = hit {
                    assert!(hit.t.is_finite() && hit.t > 0.0, "{hit:?} of {ray:?}");
                    assert!((hit.prim as usize) < shapes.len());
                    tree.primitive(&hit);
                }
                if are_shapes_in_range && is_ray_in_range(ray) {
                    let expected = bits(list.intersect(ray));
                    assert_eq!(bits(hit), expected, "{quality}: {ray:?} {shapes:?}");
                    assert_eq!(bits(hits[i]), expected, "{quality}, in a batch: {ray:?} {shapes:?}");
                    assert_eq!(is_occluded, expected.is_some(), "{quality}, occluded: {ray:?} {shapes:?}");
                    assert_eq!(occluded[i], expected.is_some(), "{quality}, occluded in a batch: {ray:?} {shapes:?}");
                }
            }
        }
    }
});
