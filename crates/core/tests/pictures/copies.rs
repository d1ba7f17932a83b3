//! Copies of a mesh look as if each were a mesh of its own.

use eyebeam_core::desc::SceneDesc;
use eyebeam_core::first_hits::FirstHits;
use eyebeam_core::integrator::IntegratorKind;
use eyebeam_core::material::{Lambertian, MaterialDesc};
use eyebeam_core::names::Name;
use eyebeam_core::render::{Monitor, Settings};
use eyebeam_core::sampler::SamplerKind;
use eyebeam_core::scene::Scene;
use eyebeam_core::shape::MeshDesc;
use eyebeam_core::texture::{Checker, Color, Mapping, Space, TextureDesc};
use glam::Vec3;

use crate::setup::*;

/// Moved, turned about y and made larger, mirrored. Evenly: interpolated normals are those of the mesh, not of its copy.
const PLACES: [[f32; 12]; 3] = [
    [1.0, 0.0, 0.0, -1.1, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0],
    [0.96, 0.0, 0.72, -0.9, 0.0, 1.2, 0.0, 0.0, -0.72, 0.0, 0.96, 0.5],
    [-1.0, 0.0, 0.0, 1.0, 0.0, 1.0, 0.0, 0.2, 0.0, 0.0, 1.0, -0.5],
];

fn with(meshes: Vec<MeshDesc>) -> SceneDesc {
    let mut desc = scene(WHITE, matte(0.6), look([0.5, 1.5, 5.0], [0.0, 0.5, 0.0], 45.0));
    let mapping = Mapping { space: Some(Space::Uv), scale: [8.0, 4.0, 1.0], ..Mapping::default() };
    desc.texture.insert("squares".to_owned(), TextureDesc::Checker(Checker { mapping, ..Checker::default() }));
    let checked = Lambertian { albedo: Color::Texture(Name::new("squares")) };
    desc.material.insert("checked".to_owned(), MaterialDesc::Lambertian(checked));
    desc.shape.quad.push(floor(0.0, 8.0));
    desc.shape.mesh = meshes;
    desc
}

/// The tile where a copy of it is.
fn moved(rows: &[f32; 12]) -> MeshDesc {
    let [x, y, z] = [0, 4, 8].map(|i| Vec3::new(rows[i], rows[i + 1], rows[i + 2]));
    let offset = Vec3::new(rows[3], rows[7], rows[11]);
    let mut mesh = tile();
    for v in &mut mesh.vertices {
        let p = Vec3::from(*v);
        *v = (Vec3::new(x.dot(p), y.dot(p), z.dot(p)) + offset).into();
    }
    // The cofactors of the matrix, with the sign of its determinant, turn normals.
    let sign = x.cross(y).dot(z).signum();
    let cofactors = [y.cross(z), z.cross(x), x.cross(y)];
    for n in &mut mesh.normals {
        *n = cofactors.map(|row| sign * row.dot(Vec3::from(*n)));
    }
    // What is mirrored is seen from the same side.
    mesh.triangles.iter_mut().filter(|_| sign < 0.0).for_each(|[_, b, c]| std::mem::swap(b, c));
    mesh
}

fn both() -> [SceneDesc; 2] {
    [with(vec![MeshDesc { instances: PLACES.to_vec(), ..tile() }]), with(PLACES.iter().map(moved).collect())]
}

#[test]
fn copies_look_like_meshes_of_their_own() {
    for integrator in [IntegratorKind::Weekend, IntegratorKind::Path] {
        let settings = Settings { integrator, sampler: SamplerKind::Sobol, height: 48, ..settings(64, 16, 10) };
        let [copies, meshes] = both().map(|desc| render(&desc, settings.clone()).develop());
        let is_same = |(a, b): (&[f32; 3], &[f32; 3])| a.iter().zip(b).all(|(a, b)| (a - b).abs() <= 1e-3 * (1.0 + a));
        let same = copies.pixels().iter().zip(meshes.pixels()).filter(|&pair| is_same(pair)).count();
        assert!(same * 100 > 64 * 48 * 99, "{integrator:?}: {same} pixels are the same");
    }
}

#[test]
fn copies_are_told_apart_and_keep_their_coordinates() {
    let [copies, meshes] = both().map(|desc| {
        let scene = Scene::build(&desc).unwrap();
        let settings = Settings { sampler: SamplerKind::Sobol, height: 48, ..settings(64, 16, 1) };
        let mut hits = FirstHits::new(&scene, settings, false);
        hits.step(&Monitor::default());
        hits.pixels().to_vec()
    });
    let mut seen = [0; 4];
    for (a, b) in copies.iter().zip(&meshes) {
        // The floor is the first object.
        let number = b.ids.object.saturating_sub(1);
        assert_eq!(a.ids.instance, number, "{a:?} {b:?}");
        assert_eq!(a.ids.object, b.ids.object.min(2));
        let is_same = (a.uv - b.uv).length() < 1e-3 && (a.ns - b.ns).length() < 1e-3 && (a.n - b.n).length() < 1e-3;
        assert!(is_same, "{a:?} {b:?}");
        seen[number as usize] += 1;
    }
    assert!(seen.iter().all(|&count| count > 20), "{seen:?}");
}

#[test]
fn copies_cost_one_mesh() {
    let place = |i: u32| [1.0, 0.0, 0.0, 2.0 * i as f32, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0];
    let desc = with(vec![MeshDesc { instances: (0..10_000).map(place).collect(), ..tile() }]);
    // Two triangles, and the floor.
    assert_eq!(Scene::build(&desc).unwrap().primitive_count(), 3);
}

#[test]
fn copies_do_not_move_and_have_places() {
    use eyebeam_core::motion::MotionKey;
    let mut desc = with(vec![MeshDesc { instances: PLACES.to_vec(), motion: vec![MotionKey::default()], ..tile() }]);
    desc.shape.mesh[0].instances[1][4] = f32::NAN;
    let found: Vec<_> = desc.check().into_iter().map(|problem| problem.path.join(".")).collect();
    assert_eq!(found, ["shape.mesh.0.instances.1", "shape.mesh.0.motion"]);
}
