//! Scenes with instances, built as trees and as lists, and what they look like without instances.

use std::sync::Arc;

use eyebeam_bvh::{
    Affine, BuildError, Bvh, Geometry, Hit, Instance, Isa, MovingTriangle, Primitive, Quality, Ray, Sphere, Triangle,
};
use glam::{DAffine3, DVec3, Mat3, Quat, Vec3};

use crate::random::Random;

/// Shapes, and what the instances among them show.
#[derive(Clone, Debug, Default)]
pub(crate) struct Scene {
    pub(crate) shapes: Vec<Primitive>,
    pub(crate) objects: Vec<Scene>,
}

/// A scene whose objects are built.
pub(crate) struct Parts<'a> {
    pub(crate) shapes: &'a [Primitive],
    pub(crate) objects: Vec<Arc<Bvh>>,
}

impl Geometry for Parts<'_> {
    fn len(&self) -> usize {
        self.shapes.len()
    }

    fn primitive(&self, index: usize) -> Primitive {
        self.shapes[index]
    }

    fn objects(&self) -> &[Arc<Bvh>] {
        &self.objects
    }
}

type Build<'a> = &'a dyn Fn(&Parts) -> Result<Bvh, BuildError>;

impl Scene {
    pub(crate) fn of(shapes: Vec<Primitive>) -> Self {
        Self { shapes, objects: Vec::new() }
    }

    /// The objects built, but not what shows them.
    pub(crate) fn parts(&self, build: Build) -> Result<Parts<'_>, BuildError> {
        let objects = self.objects.iter().map(|object| Ok(Arc::new(build(&object.parts(build)?)?)));
        Ok(Parts { shapes: &self.shapes, objects: objects.collect::<Result<_, _>>()? })
    }

    pub(crate) fn try_list(&self) -> Result<Bvh, BuildError> {
        Bvh::list(&self.parts(&|parts| Bvh::list(parts))?)
    }

    /// Lists of lists: everything is tested.
    pub(crate) fn list(&self) -> Bvh {
        self.try_list().unwrap()
    }

    /// Trees of trees.
    pub(crate) fn tree(&self, quality: Quality, isa: Isa) -> Bvh {
        let build = |parts: &Parts| Ok(Bvh::build(parts, quality)?.with_isa(isa));
        build(&self.parts(&build).unwrap()).unwrap()
    }

    /// All kinds of trees.
    pub(crate) fn trees(&self) -> Vec<(String, Bvh)> {
        let kinds = Quality::ALL.into_iter().flat_map(|q| [Isa::Scalar, Isa::detect()].map(|isa| (q, isa)));
        kinds.map(|(quality, isa)| (format!("{quality}, {isa:?}"), self.tree(quality, isa))).collect()
    }

    /// Shapes about the origin and instances of objects that are made likewise, so deep within each other. If it is to move,
    /// some of both do.
    pub(crate) fn random(depth: usize, is_to_move: bool, r: &mut Random) -> Self {
        let objects: Vec<_> =
            (0..if depth == 0 { 0 } else { 2 }).map(|_| Self::random(depth - 1, is_to_move, r)).collect();
        let mut shapes = Vec::new();
        for _ in 0..if depth < 2 { r.pick(&[3, 12, 30]) } else { r.pick(&[3, 6]) } {
            let shape = if r.below(2) == 0 && depth > 0 {
                let mut instance = Instance::new(r.below(objects.len()) as u32, transform(r));
                if is_to_move && r.below(2) == 0 {
                    let [x, y, z] = instance.at[0].axes.map(|axis| axis + 0.2 * axis.length() * r.in_cube());
                    let offset = instance.at[0].offset + r.in_cube();
                    instance.at[1] = Affine { axes: [x, y, z], offset };
                    instance.time = r.pick(&[[0.0, 1.0], [0.0, 0.5], [0.25, 1.0]]);
                }
                Primitive::Instance(instance)
            } else {
                let center = r.in_cube();
                match r.shape(center, 0.4) {
                    Primitive::Triangle(t) if is_to_move => {
                        let to = Triangle { a: t.a + r.in_cube(), b: t.b + r.in_cube(), c: t.c + r.in_cube() };
                        let time = r.pick(&[[0.0, 1.0], [0.0, 0.5], [0.5, 1.0]]);
                        Primitive::MovingTriangle(MovingTriangle { at: [t, to], time })
                    }
                    shape => shape,
                }
            };
            shapes.push(shape);
        }
        // Some a second time.
        for _ in 0..r.below(3) {
            shapes.push(shapes[r.below(shapes.len())]);
        }
        Self { shapes, objects }
    }

    /// Everything that is there at a time, without instances.
    pub(crate) fn seen(&self, time: f32) -> Vec<Seen> {
        let mut seen = Vec::new();
        self.see(time, &mut Vec::new(), DAffine3::IDENTITY, &mut seen);
        seen
    }

    fn see(&self, time: f32, path: &mut Vec<u32>, to_world: DAffine3, seen: &mut Vec<Seen>) {
        for (index, shape) in (0..).zip(&self.shapes) {
            if let Primitive::Instance(instance) = shape {
                if let Some(inner) = at(&instance.at, instance.time, time) {
                    path.push(index);
                    self.objects[instance.object as usize].see(time, path, to_world * inner, seen);
                    path.pop();
                }
            } else {
                let mut instances = [Hit::NO_INSTANCE; Hit::MAX_NESTING];
                instances[..path.len()].copy_from_slice(path);
                seen.push(Seen { instances, prim: index, shape: *shape, to_world });
            }
        }
    }
}

/// The transform at a time, computed anew.
fn at(keys: &[Affine; 2], [start, end]: [f32; 2], time: f32) -> Option<DAffine3> {
    let columns = keys.map(|a| [a.axes[0], a.axes[1], a.axes[2], a.offset].map(|column| column.as_dvec3()));
    let share = share([start, end], time)?;
    let [x, y, z, w] = [0, 1, 2, 3].map(|i| columns[0][i] * (1.0 - share) + columns[1][i] * share);
    Some(DAffine3::from_cols(x, y, z, w))
}

/// How much of the time is over, if the time is in it.
fn share([start, end]: [f32; 2], time: f32) -> Option<f64> {
    let is_there = start <= time && time <= end;
    let length = f64::from(end) - f64::from(start);
    is_there.then_some(if length.is_finite() { f64::from(time - start) / length } else { 0.0 })
}

/// A shape that is no instance, as it is seen.
pub(crate) struct Seen {
    pub(crate) instances: [u32; Hit::MAX_NESTING],
    pub(crate) prim: u32,
    pub(crate) shape: Primitive,
    pub(crate) to_world: DAffine3,
}

impl Seen {
    /// A corner and two edges, and whether it is a triangle; none of a sphere, or what is not there at this time.
    pub(crate) fn flat(&self, time: f32) -> Option<(DVec3, [DVec3; 2], bool)> {
        let triangle = |t: &Triangle| [t.a, t.b, t.c].map(|p| p.as_dvec3());
        let (points, is_triangle) = match &self.shape {
            Primitive::Triangle(t) => (triangle(t), true),
            Primitive::MovingTriangle(t) => {
                let (share, [from, to]) = (share(t.time, time)?, t.at.each_ref().map(triangle));
                ([0, 1, 2].map(|i| from[i] * (1.0 - share) + to[i] * share), true)
            }
            Primitive::Quad(q) => {
                let [corner, u, v] = [q.corner, q.u, q.v].map(|p| p.as_dvec3());
                ([corner, corner + u, corner + v], false)
            }
            _ => return None,
        };
        let [a, b, c] = points.map(|p| self.to_world.transform_point3(p));
        Some((a, [b - a, c - a], is_triangle))
    }

    /// Something to aim at.
    pub(crate) fn target(&self, time: f32) -> Primitive {
        if let Some((a, [u, v], _)) = self.flat(time) {
            return Primitive::Triangle(Triangle { a: a.as_vec3(), b: (a + u).as_vec3(), c: (a + v).as_vec3() });
        }
        let (center, radius) =
            if let Primitive::Sphere(s) = self.shape { (s.center, s.radius) } else { (Vec3::ZERO, 0.1) };
        let m = self.to_world.matrix3;
        let least = m.x_axis.length().min(m.y_axis.length()).min(m.z_axis.length());
        let center = self.to_world.transform_point3(center.as_dvec3()).as_vec3();
        Primitive::Sphere(Sphere { center, radius: radius * least as f32 })
    }
}

/// Of every kind: shift, rotation, mirror, scale 1e-3 to 1e3, and shear.
pub(crate) fn transform(r: &mut Random) -> Affine {
    let rotation = Mat3::from_quat(Quat::from_scaled_axis(3.0 * r.in_cube()));
    let factor = |r: &mut Random| 10.0_f32.powf(6.0 * r.unit() - 3.0);
    let matrix = match r.below(7) {
        0 => Mat3::IDENTITY,
        1 => rotation,
        2 => rotation * Mat3::from_diagonal(Vec3::new(1.0, -1.0, 1.0)),
        3 => rotation * Mat3::from_diagonal(Vec3::splat(factor(r))),
        4 => Mat3::from_diagonal(Vec3::new(factor(r), factor(r), factor(r))),
        5 => rotation * Mat3::from_cols(Vec3::X, Vec3::new(2.0 * r.unit(), 1.0, 0.0), Vec3::new(r.unit(), 0.5, -1.0)),
        _ => rotation * Mat3::from_diagonal(Vec3::new(factor(r), -factor(r), 1.0)) * rotation,
    };
    let offset = if r.below(4) == 0 { Vec3::ZERO } else { r.in_cube() * r.pick(&[1.0, 3.0, 100.0]) };
    Affine { axes: [matrix.x_axis, matrix.y_axis, matrix.z_axis], offset }
}

/// All that a hit says, by bits.
pub(crate) type Bits = ([u32; 4], [u32; Hit::MAX_NESTING]);

pub(crate) fn bits(hit: Option<Hit>) -> Option<Bits> {
    hit.map(|h| ([h.t.to_bits(), h.prim, h.u.to_bits(), h.v.to_bits()], h.instances))
}

/// Rays about what is seen at their times.
pub(crate) fn rays(scene: &Scene, times: &[f32], count: usize, r: &mut Random) -> Vec<Ray> {
    let targets: Vec<Vec<_>> =
        times.iter().map(|&time| scene.seen(time).iter().map(|seen| seen.target(time)).collect()).collect();
    let ray = |_| {
        let (i, extent) = (r.below(times.len()), r.pick(&[0.5, 2.0, 50.0]));
        Ray { time: times[i], ..r.ray(&targets[i], extent) }
    };
    (0..count).map(ray).collect()
}

/// The trees find what the lists find, one by one and in batches, and any hit where there is a nearest; how many there are.
pub(crate) fn assert_same_as_list(name: &str, scene: &Scene, rays: &[Ray]) -> usize {
    let list = scene.list();
    let expected: Vec<_> = rays.iter().map(|ray| bits(list.intersect(ray))).collect();
    for (tree_name, tree) in scene.trees() {
        assert_eq!(tree.bounds(), list.bounds());
        assert_eq!(tree.validate(), Ok(()));
        let (mut hits, mut occluded) = (vec![None; rays.len()], vec![false; rays.len()]);
        let tree = tree.with_rays_in_flight(true);
        tree.intersect_batch(rays, &mut hits);
        tree.occluded_batch(rays, &mut occluded);
        for (i, ray) in rays.iter().enumerate() {
            let hit = tree.intersect(ray);
            assert_eq!(bits(hit), expected[i], "{name}, {tree_name}: {ray:?}");
            assert_eq!(bits(hits[i]), expected[i], "{name}, {tree_name}, in a batch: {ray:?}");
            assert_eq!(tree.occluded(ray), hit.is_some(), "{name}, {tree_name}, occluded: {ray:?}");
            assert_eq!(occluded[i], hit.is_some(), "{name}, {tree_name}, occluded in a batch: {ray:?}");
            assert_eq!(list.occluded(ray), hit.is_some(), "{name}, occluded in the list: {ray:?}");
        }
    }
    expected.iter().flatten().count()
}
