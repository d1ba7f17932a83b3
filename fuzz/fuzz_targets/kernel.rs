//! Any numbers as shapes and rays: the kernel refuses them, or it traces them without a panic, an endless loop or a hit that
//! is not a number; and where the numbers are in range, the tree finds what the list finds.

#![no_main]

use std::sync::Arc;

use arbitrary::{Arbitrary, Result, Unstructured};
use eyebeam_bvh::{
    Affine, Bvh, Geometry, Hit, Instance, Isa, MovingTriangle, Primitive, Quad, Quality, Ray, Sphere, Triangle,
};
use glam::{DVec3, Vec3};
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

/// A transform, mostly one of those that scenes are made of.
#[derive(Arbitrary, Debug)]
enum Transform {
    Translation(Point),
    Scale(Number, Point),
    Any([Point; 4]),
}

impl From<&Transform> for Affine {
    fn from(transform: &Transform) -> Self {
        match transform {
            Transform::Translation(offset) => Self::from_translation(offset.into()),
            Transform::Scale(factor, offset) => {
                Self { axes: Vec3::AXES.map(|axis| axis * factor.0), offset: offset.into() }
            }
            Transform::Any([x, y, z, offset]) => Self { axes: [x, y, z].map(Vec3::from), offset: offset.into() },
        }
    }
}

#[derive(Arbitrary, Debug)]
enum Shape {
    Sphere(Point, Number),
    Quad(Point, Point, Point),
    Triangle(Point, Point, Point),
    /// As an earlier one.
    Again(u8),
    Moving([Point; 3], [Point; 3], Option<[Number; 2]>),
    Instance(u8, Transform, Option<(Transform, [Number; 2])>),
}

impl Shape {
    /// After the shapes before it, where there are so many objects.
    fn to_primitive(&self, shapes: &[Primitive], objects: u32) -> Option<Primitive> {
        let triangle = |[a, b, c]: &[Point; 3]| Triangle { a: a.into(), b: b.into(), c: c.into() };
        Some(match self {
            Self::Sphere(center, radius) => Primitive::Sphere(Sphere { center: center.into(), radius: radius.0.abs() }),
            Self::Quad(corner, u, v) => Primitive::Quad(Quad { corner: corner.into(), u: u.into(), v: v.into() }),
            Self::Triangle(a, b, c) => Primitive::Triangle(Triangle { a: a.into(), b: b.into(), c: c.into() }),
            Self::Again(index) => *shapes.get(usize::from(*index) % shapes.len().max(1))?,
            Self::Moving(from, to, time) => {
                let time = time.as_ref().map_or([0.0, 1.0], |time| time.each_ref().map(|x| x.0));
                Primitive::MovingTriangle(MovingTriangle { at: [triangle(from), triangle(to)], time })
            }
            Self::Instance(object, at, motion) => {
                let object = u32::from(*object).checked_rem(objects)?;
                let instance = Instance::new(object, at.into());
                Primitive::Instance(match motion {
                    None => instance,
                    Some((to, time)) => {
                        let (at, time) = ([at.into(), to.into()], time.each_ref().map(|x| x.0));
                        Instance { at, time, ..instance }
                    }
                })
            }
        })
    }
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
    /// Each may show those before it.
    objects: Vec<Vec<Shape>>,
    shapes: Vec<Shape>,
    aims: Vec<Aim>,
}

/// Shapes, and what the instances among them show.
struct Scene<'a> {
    shapes: &'a [Primitive],
    objects: &'a [Arc<Bvh>],
}

impl Geometry for Scene<'_> {
    fn len(&self) -> usize {
        self.shapes.len()
    }

    fn primitive(&self, index: usize) -> Primitive {
        self.shapes[index]
    }

    fn objects(&self) -> &[Arc<Bvh>] {
        self.objects
    }
}

impl Input {
    /// Those of the objects, each of which may show the ones before it, and at last those that are seen.
    fn shapes(&self) -> Vec<Vec<Primitive>> {
        let lists = self.objects.iter().take(4).chain([&self.shapes]);
        let list = |(objects, list): (usize, &Vec<Shape>)| {
            let mut shapes = Vec::new();
            for shape in list.iter().take(100) {
                shapes.extend(shape.to_primitive(&shapes, objects as u32));
            }
            shapes
        };
        lists.enumerate().map(list).collect()
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

/// Builds all that there is in one way; none if it cannot be.
fn build(lists: &[Vec<Primitive>], build: impl Fn(&Scene) -> Option<Bvh>) -> Option<Bvh> {
    let mut objects: Vec<Arc<Bvh>> = Vec::new();
    for shapes in lists {
        objects.push(Arc::new(build(&Scene { shapes, objects: &objects })?));
    }
    Arc::into_inner(objects.pop()?)
}

const LEAST: f32 = 1e-18;
const MOST: f32 = 1e18;

/// What a scene is made of: zero, or a size that squares and products of single precision hold.
fn in_range(v: Vec3) -> bool {
    v.abs().to_array().into_iter().all(|x| x == 0.0 || (LEAST..=MOST).contains(&x))
}

fn is_shape_in_range(shape: &Primitive) -> bool {
    let is_triangle_in_range = |t: &Triangle| [t.a, t.b, t.c].into_iter().all(in_range);
    match shape {
        Primitive::Sphere(s) => in_range(s.center) && (LEAST..=MOST).contains(&s.radius),
        Primitive::Quad(q) => [q.corner, q.u, q.v].into_iter().all(in_range),
        Primitive::Triangle(t) => is_triangle_in_range(t),
        Primitive::MovingTriangle(t) => t.at.iter().all(is_triangle_in_range),
        Primitive::Instance(i) => i.at.iter().all(|at| in_range(at.offset) && at.axes.into_iter().all(in_range)),
    }
}

/// Whether a ray is in range in the space of `lists`' last list, and in those of all objects in it.
fn is_ray_in_range(lists: &[Vec<Primitive>], o: DVec3, d: DVec3, time: f32) -> bool {
    let Some(shapes) = lists.last() else { return true };
    let range = f64::from(LEAST)..=f64::from(MOST);
    let is_in_range = o.abs().max_element() <= f64::from(MOST) && range.contains(&d.length());
    is_in_range
        && shapes.iter().all(|shape| {
            let Primitive::Instance(instance) = shape else { return true };
            let Some(to_world) = instance.to_world(time) else { return true };
            let to_object = to_world.inverse();
            let (o, d) = (to_object.transform_point3(o), to_object.transform_vector3(d));
            is_ray_in_range(&lists[..=instance.object as usize], o, d, time)
        })
}

type Bits = ([u32; 4], [u32; Hit::MAX_NESTING]);

fn bits(hit: Option<Hit>) -> Option<Bits> {
    hit.map(|h| ([h.t.to_bits(), h.prim, h.u.to_bits(), h.v.to_bits()], h.instances))
}

fuzz_target!(|input: Input| {
    let (lists, rays) = (input.shapes(), input.rays());
    let Some(list) = build(&lists, |scene| Bvh::list(scene).ok()) else { return };
    let are_shapes_in_range = lists.iter().flatten().all(is_shape_in_range);
    let is_in_range = |ray: &Ray| {
        are_shapes_in_range
            && (ray.t_max >= 0.0 && (0.0..=1.0).contains(&ray.time))
            && is_ray_in_range(&lists, ray.o.as_dvec3(), ray.d.as_dvec3(), ray.time)
    };
    let expected: Vec<_> = rays.iter().map(|ray| is_in_range(ray).then(|| bits(list.intersect(ray)))).collect();
    for (quality, isa) in Quality::ALL.into_iter().flat_map(|q| [Isa::Scalar, Isa::detect()].map(|isa| (q, isa))) {
        let tree = build(&lists, |scene| Some(Bvh::build(scene, quality).ok()?.with_isa(isa)));
        let tree = tree.expect("what one quality builds, all do");
        let (mut hits, mut occluded) = (vec![None; rays.len()], vec![false; rays.len()]);
        let tree = tree.with_rays_in_flight(true);
        tree.intersect_batch(&rays, &mut hits);
        tree.occluded_batch(&rays, &mut occluded);
        for (i, ray) in rays.iter().enumerate() {
            let (hit, is_occluded) = (tree.intersect(ray), tree.occluded(ray));
            if let Some(hit) = hit {
                assert!(hit.t.is_finite() && hit.t > 0.0, "{hit:?} of {ray:?}");
                tree.surface(&hit, ray.time);
                tree.to_world(&hit, ray.time);
            }
            if let Some(expected) = expected[i] {
                assert_eq!(bits(hit), expected, "{quality}: {ray:?} {lists:?}");
                assert_eq!(bits(hits[i]), expected, "{quality}, in a batch: {ray:?} {lists:?}");
                assert_eq!(is_occluded, expected.is_some(), "{quality}, occluded: {ray:?} {lists:?}");
                assert_eq!(occluded[i], expected.is_some(), "{quality}, occluded in a batch: {ray:?} {lists:?}");
            }
        }
    }
});
