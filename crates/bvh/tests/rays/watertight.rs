//! From inside a closed surface no ray gets out, least of all where its parts meet.

use eyebeam_bvh::{Bvh, Primitive, Quad, Quality, Ray, Triangle};
use glam::Vec3;

use crate::random::Random;

/// Two triangles for each side of the box from -`half` to `half`.
fn cube(half: Vec3) -> Vec<[Vec3; 3]> {
    quads(half)
        .iter()
        .flat_map(|q| {
            let [a, b, c, d] = [q.corner, q.corner + q.u, q.corner + q.u + q.v, q.corner + q.v];
            [[a, b, c], [a, c, d]]
        })
        .collect()
}

/// The six sides of the box from -`half` to `half`.
fn quads(half: Vec3) -> Vec<Quad> {
    let side = |axis: usize, sign: f32| {
        let [n, u, v] = [0, 1, 2].map(|i| Vec3::AXES[(axis + i) % 3] * half[(axis + i) % 3]);
        Quad { corner: sign * n - u - v, u: 2.0 * u, v: 2.0 * v }
    };
    (0..3).flat_map(|axis| [side(axis, 1.0), side(axis, -1.0)]).collect()
}

/// The octahedron, each triangle cut in four `levels` times, on the unit sphere; then stretched.
fn icosphere(levels: u32, stretch: Vec3) -> Vec<[Vec3; 3]> {
    let mut triangles: Vec<[Vec3; 3]> = Vec::new();
    for signs in 0..8 {
        let sign = |axis: usize| if signs >> axis & 1 == 0 { 1.0 } else { -1.0 };
        triangles.push([Vec3::X * sign(0), Vec3::Y * sign(1), Vec3::Z * sign(2)]);
    }
    for _ in 0..levels {
        let cut = |[a, b, c]: [Vec3; 3]| {
            let [ab, bc, ca] = [a + b, b + c, c + a].map(Vec3::normalize);
            [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
        };
        triangles = triangles.into_iter().flat_map(cut).collect();
    }
    triangles.into_iter().map(|t| t.map(|v| v * stretch)).collect()
}

/// Rays from `inside` to the corners, the middle of the edges and anywhere on the edges of each triangle.
fn assert_closed(name: &str, shapes: Vec<Primitive>, outline: &[[Vec3; 3]], inside: &[Vec3], r: &mut Random) {
    let bvh = Bvh::build(&shapes, Quality::Balanced).unwrap();
    for &o in inside {
        for [a, b, c] in outline {
            for (from, to) in [(a, b), (b, c), (c, a)] {
                for x in [0.0, 0.5, r.unit(), r.unit()] {
                    let d = from.lerp(*to, x) - o;
                    assert!(bvh.intersect(&Ray::new(o, d)).is_some(), "{name}: from {o} along {d}");
                    let unit = Ray::new(o, d.normalize());
                    assert!(bvh.intersect(&unit).is_some(), "{name}: {unit:?}");
                }
            }
        }
    }
}

fn as_shapes(triangles: &[[Vec3; 3]]) -> Vec<Primitive> {
    triangles.iter().map(|&[a, b, c]| Primitive::Triangle(Triangle { a, b, c })).collect()
}

#[test]
fn spheres_of_triangles_are_closed() {
    let mut r = Random::new(30);
    for stretch in [Vec3::ONE, Vec3::splat(1e-4), Vec3::splat(3e4), Vec3::new(1.0, 0.3, 700.0)] {
        for levels in [0, 2, 4] {
            let mesh = icosphere(levels, stretch);
            let mut inside: Vec<_> = (0..20).map(|_| r.in_cube() * 0.3 * stretch).collect();
            inside.push(Vec3::ZERO);
            assert_closed("icosphere", as_shapes(&mesh), &mesh, &inside, &mut r);
        }
    }
}

#[test]
fn boxes_are_closed() {
    let mut r = Random::new(31);
    for half in [Vec3::ONE, Vec3::new(0.3, 0.7, 0.1), Vec3::new(277.5, 0.01, 1e4)] {
        let outline = cube(half);
        let mut inside: Vec<_> = (0..2000).map(|_| r.in_cube() * half).collect();
        inside.extend([Vec3::ZERO, half * 0.5, half * Vec3::new(0.25, 0.5, -0.75)]);
        assert_closed("cube of triangles", as_shapes(&outline), &outline, &inside, &mut r);
        let shapes = quads(half).into_iter().map(Primitive::Quad).collect();
        assert_closed("box of quads", shapes, &outline, &inside, &mut r);
    }
}

/// Away from the origin, where corners have few digits behind the point.
#[test]
fn meshes_far_from_the_origin_are_closed() {
    let mut r = Random::new(32);
    for offset in [Vec3::splat(100.0), Vec3::new(-1e4, 3.0, 1e5)] {
        let mesh: Vec<_> = icosphere(3, Vec3::splat(50.0)).into_iter().map(|t| t.map(|v| v + offset)).collect();
        let inside: Vec<_> = (0..20).map(|_| offset + r.in_cube() * 20.0).collect();
        assert_closed("far", as_shapes(&mesh), &mesh, &inside, &mut r);
    }
}
