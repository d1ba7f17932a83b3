//! What holds for every scene and every ray, on scenes and rays that proptest makes up and cuts down where one fails.
//!
//! `PROPTEST_CASES` says how many scenes (of 64 rays each); the seed is fixed unless `PROPTEST_RNG_SEED` is set.

use std::sync::Arc;

use eyebeam_bvh::{
    Affine, Bvh, Geometry, Hit, Instance, Isa, MovingTriangle, Primitive, Quad, Quality, Ray, Sphere, Triangle,
};
use glam::Vec3;
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

const RAYS: usize = 64;

fn config() -> ProptestConfig {
    let given = ProptestConfig::default();
    let is_set = |name: &str| std::env::var_os(name).is_some();
    ProptestConfig {
        cases: if is_set("PROPTEST_CASES") { given.cases } else { 1000 },
        rng_seed: if is_set("PROPTEST_RNG_SEED") { given.rng_seed } else { RngSeed::Fixed(1) },
        failure_persistence: None,
        ..given
    }
}

fn scale() -> impl Strategy<Value = f32> {
    prop::sample::select(vec![1.0_f32, 1e-6, 1e-3, 1e3, 1e6])
}

/// Half of them on a coarse grid: what lies on one point, line or plane is the rule.
fn coordinate() -> impl Strategy<Value = f32> {
    prop_oneof![(-2_i8..=2).prop_map(f32::from), -1.0_f32..1.0]
}

fn point() -> impl Strategy<Value = Vec3> {
    [coordinate(), coordinate(), coordinate()].prop_map(Vec3::from_array)
}

fn triangle() -> impl Strategy<Value = Triangle> {
    [point(), point(), point()].prop_map(|[a, b, c]| Triangle { a, b, c })
}

/// When what moves exists.
fn times() -> impl Strategy<Value = [f32; 2]> {
    prop::sample::select(vec![[0.0, 1.0], [0.0, 0.5], [0.5, 1.0], [0.25, 0.25]])
}

/// Some flatten.
fn affine() -> impl Strategy<Value = Affine> {
    let factor = || prop::sample::select(vec![1.0_f32, 1.0, -1.0, 0.1, -1e-3, 30.0]);
    let diagonal = [factor(), factor(), factor()].prop_map(|[x, y, z]| [Vec3::X * x, Vec3::Y * y, Vec3::Z * z]);
    let axes = prop_oneof![Just(Vec3::AXES), diagonal, [point(), point(), point()]];
    (axes, point()).prop_map(|(axes, offset)| Affine { axes, offset })
}

/// Half of them move.
fn instance() -> impl Strategy<Value = Primitive> {
    let still = affine().prop_map(|at| Instance::new(0, at));
    let moving = ([affine(), affine()], times()).prop_map(|(at, time)| Instance { object: 0, at, time });
    prop_oneof![still, moving].prop_map(Primitive::Instance)
}

fn shape() -> impl Strategy<Value = Primitive> {
    prop_oneof![
        (point(), 1e-3_f32..2.0).prop_map(|(center, radius)| Primitive::Sphere(Sphere { center, radius })),
        (point(), point(), point()).prop_map(|(corner, u, v)| Primitive::Quad(Quad { corner, u, v })),
        triangle().prop_map(Primitive::Triangle),
        ([triangle(), triangle()], times())
            .prop_map(|(at, time)| { Primitive::MovingTriangle(MovingTriangle { at, time }) }),
        // Without area: a point, a line, a line twice.
        point().prop_map(|a| Primitive::Triangle(Triangle { a, b: a, c: a })),
        (point(), point(), -2_i8..=2).prop_map(|(corner, u, k)| Primitive::Quad(Quad {
            corner,
            u,
            v: u * f32::from(k)
        })),
    ]
}

fn scaled(shape: Primitive, size: f32, scale: f32) -> Primitive {
    let position = |p: Vec3| p * scale;
    // About its first point, by its size.
    let near = |p: Vec3, first: Vec3| (first + (p - first) * size) * scale;
    let triangle = |Triangle { a, b, c }: Triangle| Triangle { a: position(a), b: near(b, a), c: near(c, a) };
    match shape {
        Primitive::Sphere(Sphere { center, radius }) => {
            Primitive::Sphere(Sphere { center: position(center), radius: radius * size * scale })
        }
        Primitive::Quad(Quad { corner, u, v }) => {
            Primitive::Quad(Quad { corner: position(corner), u: u * size * scale, v: v * size * scale })
        }
        Primitive::Triangle(t) => Primitive::Triangle(triangle(t)),
        Primitive::MovingTriangle(t) => Primitive::MovingTriangle(MovingTriangle { at: t.at.map(triangle), ..t }),
        Primitive::Instance(i) => {
            let at = i.at.map(|at| Affine { axes: at.axes.map(|axis| axis * size), offset: position(at.offset) });
            Primitive::Instance(Instance { at, ..i })
        }
    }
}

/// Some shapes of sizes that differ or do not, some of them more than once.
fn shapes(shape: impl Strategy<Value = Primitive>, scale: f32) -> impl Strategy<Value = Vec<Primitive>> {
    let size = prop::sample::select(vec![1.0_f32, 1.0, 0.1, 1e-3, 1e-6]);
    let originals = prop::collection::vec((shape, size), 0..20);
    (originals, prop::collection::vec(any::<prop::sample::Index>(), 0..6)).prop_map(move |(originals, again)| {
        let mut shapes: Vec<_> = originals.into_iter().map(|(shape, size)| scaled(shape, size, scale)).collect();
        if !shapes.is_empty() {
            let copies: Vec<_> = again.iter().map(|index| *index.get(&shapes)).collect();
            shapes.extend(copies);
        }
        shapes
    })
}

/// Shapes, and what all instances among them show.
#[derive(Clone, Debug)]
struct Scene {
    shapes: Vec<Primitive>,
    object: Vec<Primitive>,
}

struct Parts<'a>(&'a [Primitive], [Arc<Bvh>; 1]);

impl Geometry for Parts<'_> {
    fn len(&self) -> usize {
        self.0.len()
    }

    fn primitive(&self, index: usize) -> Primitive {
        self.0[index]
    }

    fn objects(&self) -> &[Arc<Bvh>] {
        &self.1
    }
}

impl Scene {
    /// Without instances in every other.
    fn any(scale: f32) -> impl Strategy<Value = Self> {
        let plain = shapes(shape(), scale).prop_map(|shapes| Self { shapes, object: Vec::new() });
        let with_instances = (shapes(prop_oneof![shape(), instance()], scale), shapes(shape(), scale));
        prop_oneof![plain, with_instances.prop_map(|(shapes, object)| Self { shapes, object })]
    }

    fn list(&self) -> Bvh {
        Bvh::list(&Parts(&self.shapes, [Arc::new(Bvh::list(&self.object).unwrap())])).unwrap()
    }

    /// With each kind of instructions that this processor has.
    fn trees(&self, quality: Quality) -> [Bvh; 2] {
        [Isa::Scalar, Isa::detect()].map(|isa| {
            let object = Bvh::build(&self.object, quality).unwrap().with_isa(isa);
            Bvh::build(&Parts(&self.shapes, [Arc::new(object)]), quality).unwrap().with_isa(isa)
        })
    }

    /// A point of a shape, by two weights.
    fn point(&self, shape: &Primitive, [x, y]: [f32; 2], time: f32) -> Vec3 {
        match shape {
            Primitive::Sphere(s) => s.center + s.radius * Vec3::new(1.0 - 2.0 * x, y, x * y).normalize_or(Vec3::NEG_Z),
            Primitive::Quad(q) => q.corner + q.u * x + q.v * y,
            Primitive::Triangle(t) => t.a.lerp(t.b, x).lerp(t.c, y),
            Primitive::MovingTriangle(t) => {
                let [from, to] = t.at.map(|t| t.a.lerp(t.b, x).lerp(t.c, y));
                from.lerp(to, (time - t.time[0]) / (t.time[1] - t.time[0]).max(0.1))
            }
            Primitive::Instance(i) => match (i.to_world(time), self.object.get((x * 16.0) as usize)) {
                (Some(to_world), Some(shape)) => {
                    to_world.transform_point3(self.point(shape, [y, x], time).as_dvec3()).as_vec3()
                }
                _ => Vec3::ZERO,
            },
        }
    }
}

/// A place: on a shape (a corner, an edge, inside), or anywhere.
#[derive(Clone, Debug)]
enum Place {
    On(prop::sample::Index, f32, f32),
    At(Vec3),
}

impl Place {
    fn any() -> impl Strategy<Value = Self> {
        let weight = || prop_oneof![Just(0.0_f32), Just(1.0), 0.0_f32..1.0];
        prop_oneof![
            (any::<prop::sample::Index>(), weight(), weight()).prop_map(|(shape, x, y)| Self::On(shape, x, y)),
            (point(), prop::sample::select(vec![1.0_f32, 3.0, 1e3])).prop_map(|(p, far)| Self::At(p * far)),
        ]
    }

    fn find(&self, scene: &Scene, scale: f32, time: f32) -> Vec3 {
        match self {
            Self::On(..) if scene.shapes.is_empty() => Vec3::ZERO,
            Self::At(p) => *p * scale,
            Self::On(shape, x, y) => scene.point(shape.get(&scene.shapes), [*x, *y], time),
        }
    }
}

#[derive(Clone, Debug)]
struct Aim {
    from: Place,
    to: Place,
    /// What becomes of the direction: the zeros, by bits, and their sign.
    zeros: u8,
    stretch: f32,
    t_max: f32,
    time: f32,
}

impl Aim {
    fn any() -> impl Strategy<Value = Self> {
        let zeros = prop_oneof![3 => Just(0_u8), 1 => 0_u8..16];
        let stretch = prop::sample::select(vec![1.0_f32, 0.3, 40.0, -1.0]);
        let t_max = prop_oneof![2 => Just(f32::INFINITY), 1 => Just(1.0_f32), 1 => 0.0_f32..2.0];
        let time = prop_oneof![prop::sample::select(vec![0.0_f32, 0.25, 0.5, 1.0]), 0.0_f32..1.0];
        let aim = (Place::any(), Place::any(), zeros, stretch, t_max, time);
        aim.prop_map(|(from, to, zeros, stretch, t_max, time)| Self { from, to, zeros, stretch, t_max, time })
    }

    fn ray(&self, scene: &Scene, scale: f32) -> Ray {
        let (o, to) = (self.from.find(scene, scale, self.time), self.to.find(scene, scale, self.time));
        let mut d = (to - o) * self.stretch;
        for axis in (0..3).filter(|axis| self.zeros >> axis & 1 == 1) {
            d[axis] = if self.zeros >> 3 & 1 == 1 { -0.0 } else { 0.0 };
        }
        // The shortest direction that is allowed is 1e-18.
        let d = if d.abs().max_element() < 1e-15 { Vec3::X } else { d };
        Ray { t_max: self.t_max, time: self.time, ..Ray::new(o, d) }
    }
}

prop_compose! {
    fn scene()(scale in scale())(
        scene in Scene::any(scale),
        aims in prop::collection::vec(Aim::any(), RAYS),
        scale in Just(scale),
    ) -> (Scene, Vec<Ray>) {
        let rays = aims.iter().map(|aim| aim.ray(&scene, scale)).collect();
        (scene, rays)
    }
}

/// All that a hit says, by bits.
type Bits = ([u32; 4], [u32; Hit::MAX_NESTING]);

fn bits(hit: Option<Hit>) -> Option<Bits> {
    hit.map(|h| ([h.t.to_bits(), h.prim, h.u.to_bits(), h.v.to_bits()], h.instances))
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn trees_find_what_the_list_finds((scene, rays) in scene()) {
        let list = scene.list();
        let expected: Vec<_> = rays.iter().map(|ray| list.intersect(ray)).collect();
        for quality in Quality::ALL {
            for tree in scene.trees(quality) {
                let (mut hits, mut occluded) = (vec![None; RAYS], [false; RAYS]);
                let tree = tree.with_rays_in_flight(true);
                tree.intersect_batch(&rays, &mut hits);
                tree.occluded_batch(&rays, &mut occluded);
                for (i, ray) in rays.iter().enumerate() {
                    let hit = tree.intersect(ray);
                    prop_assert_eq!(bits(hit), bits(expected[i]), "{} {:?}", quality, ray);
                    prop_assert_eq!(bits(hits[i]), bits(hit), "in a batch: {} {:?}", quality, ray);
                    prop_assert_eq!(tree.occluded(ray), hit.is_some(), "occluded: {} {:?}", quality, ray);
                    prop_assert_eq!(occluded[i], hit.is_some(), "occluded in a batch: {} {:?}", quality, ray);
                    if let Some(hit) = hit {
                        prop_assert!(hit.t > 0.0 && hit.t <= ray.t_max, "{:?} {:?}", hit, ray);
                        prop_assert_eq!(tree.surface(&hit, ray.time), list.surface(&expected[i].unwrap(), ray.time));
                    }
                }
            }
        }
    }

    #[test]
    fn the_order_of_the_primitives_does_not_matter((scene, rays) in scene(), turn in any::<prop::sample::Index>()) {
        let mut other = scene.clone();
        other.shapes.reverse();
        if !other.shapes.is_empty() {
            other.shapes.rotate_left(turn.index(scene.shapes.len()));
        }
        for quality in Quality::ALL {
            let [[_, a], [_, b]] = [&scene, &other].map(|scene| scene.trees(quality));
            for ray in &rays {
                let [a, b] = [&a, &b].map(|bvh| bvh.intersect(ray).map(|hit| hit.t.to_bits()));
                prop_assert_eq!(a, b, "{} {:?}", quality, ray);
            }
        }
    }

    /// A ray that ends at the hit or just beyond has it, and one that ends just before has not.
    #[test]
    fn hits_end_where_rays_end((scene, rays) in scene()) {
        for tree in Quality::ALL.into_iter().flat_map(|quality| scene.trees(quality)) {
            for ray in &rays {
                let Some(hit) = tree.intersect(ray) else { continue };
                for t_max in [hit.t, hit.t.next_up().min(ray.t_max)] {
                    prop_assert_eq!(bits(tree.intersect(&Ray { t_max, ..*ray })), bits(Some(hit)), "{:?}", ray);
                }
                let before = Ray { t_max: hit.t.next_down(), ..*ray };
                prop_assert_eq!(bits(tree.intersect(&before)), None, "{:?}", before);
                prop_assert!(!tree.occluded(&before), "{:?}", before);
            }
        }
    }
}
