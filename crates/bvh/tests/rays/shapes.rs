//! Each shape against the reference, and exact answers at the edge of what is defined.

use eyebeam_bvh::{Bvh, Primitive, Quad, Quality, Ray, Sphere, Triangle};
use glam::Vec3;

use crate::random::Random;
use crate::reference::Expected;

fn hit(shape: Primitive, o: [f32; 3], d: [f32; 3]) -> Option<f32> {
    Bvh::list(&vec![shape]).unwrap().intersect(&Ray::new(o.into(), d.into())).map(|hit| hit.t)
}

/// Sizes and distances from far below to far above a metre; rays to corners and edges, along axes, from surfaces.
#[test]
fn shapes_agree_with_the_reference() {
    let mut r = Random::new(1);
    let (mut clear, mut hits) = (0, 0);
    const RAYS: usize = 400_000;
    for _ in 0..RAYS {
        let size = r.pick(&[1e-6, 1e-3, 1.0, 1e3, 1e5]);
        let center = r.in_cube() * r.pick(&[0.0, 1e-3, 1.0, 1e3]);
        let shape = r.shape(center, size);
        let extent = size * r.pick(&[1.0, 3.0, 1e3, 1e6]);
        let ray = Ray { t_max: f32::INFINITY, ..r.ray(&[shape], extent) };
        let expected = Expected::new(&shape, &ray);
        let hit = Bvh::list(&vec![shape]).unwrap().intersect(&ray);
        assert!(expected.allows(hit), "{shape:?}\n{ray:?}\n{hit:?}\n{expected:?}");
        clear += usize::from(expected.is_clear());
        hits += usize::from(hit.is_some());
    }
    assert!(clear > RAYS * 3 / 4 && hits > RAYS / 4, "the test decides something: {clear} clear, {hits} hits");
}

/// Just above the ground at every height of a usual scene, looking down, up and along.
#[test]
fn large_spheres_are_exact_at_the_ground() {
    let mut r = Random::new(2);
    for _ in 0..100_000 {
        let radius = r.pick(&[1e3, 1e4, 1e5]);
        let ground = Primitive::Sphere(Sphere { center: Vec3::new(0.0, -radius, 0.0), radius });
        let o = r.in_cube() * Vec3::new(10.0, 0.0, 10.0) + Vec3::Y * r.pick(&[0.0, 1e-6, 1e-3, 1.0]);
        let ray = Ray::new(o, r.in_cube() * Vec3::new(1.0, r.pick(&[1.0, 1e-3, 1e-6]), 1.0));
        let (expected, hit) = (Expected::new(&ground, &ray), Bvh::list(&vec![ground]).unwrap().intersect(&ray));
        assert!(expected.allows(hit), "{ground:?}\n{ray:?}\n{hit:?}\n{expected:?}");
    }
}

#[test]
fn sphere_from_all_sides() {
    let unit = Primitive::Sphere(Sphere { center: Vec3::ZERO, radius: 1.0 });
    assert_eq!(hit(unit, [0.0, 0.0, 3.0], [0.0, 0.0, -2.0]), Some(1.0), "t counts directions");
    assert_eq!(hit(unit, [0.0, 0.0, 0.0], [0.0, 1.0, 0.0]), Some(1.0), "from the centre");
    assert_eq!(hit(unit, [0.0, 0.0, 0.5], [0.0, 0.0, -1.0]), Some(1.5), "from inside");
    assert_eq!(hit(unit, [0.0, 0.0, 1.0], [0.0, 0.0, 1.0]), None, "from the surface, outwards");
    assert_eq!(hit(unit, [0.0, 0.0, 1.0], [0.0, 0.0, -1.0]), Some(2.0), "from the surface, inwards");
    assert_eq!(hit(unit, [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]), None, "from the surface, along it");
    assert_eq!(hit(unit, [1.0, 0.0, 5.0], [0.0, 0.0, -1.0]), Some(5.0), "tangent");
    assert_eq!(hit(unit, [1.0_f32.next_up(), 0.0, 5.0], [0.0, 0.0, -1.0]), None, "just past the tangent");
    assert_eq!(hit(unit, [0.0, 0.0, -3.0], [0.0, 0.0, -1.0]), None, "behind");
    assert_eq!(hit(unit, [0.0, 0.0, 3.0], [0.0, 0.0, 0.0]), None, "no direction");
}

/// Points that single precision has exactly: on the way out there is nothing, on the way in the far side.
#[test]
fn spheres_are_exact_on_the_surface() {
    let mut r = Random::new(3);
    for (p, radius) in
        [([3.0, 4.0, 0.0], 5.0), ([2.0, -3.0, 6.0], 7.0), ([-1.0, 4.0, 8.0], 9.0), ([6.0, 7.0, -6.0], 11.0)]
    {
        let (p, sphere) = (Vec3::from(p), Primitive::Sphere(Sphere { center: Vec3::ZERO, radius }));
        for _ in 0..10_000 {
            let d = r.in_cube();
            let (cos, hit) = (p.dot(d), hit(sphere, p.into(), d.into()));
            if cos > 1e-3 {
                assert_eq!(hit, None, "from {p} along {d}");
            } else if cos < -1e-3 {
                let far = -2.0 * cos / d.length_squared();
                assert!(hit.is_some_and(|t| (t - far).abs() < 1e-4 * far), "from {p} along {d}: {hit:?}");
            }
        }
    }
}

#[test]
fn directions_may_have_any_length() {
    let unit = Primitive::Sphere(Sphere { center: Vec3::ZERO, radius: 1.0 });
    let floor = Primitive::Quad(Quad { corner: Vec3::NEG_Y, u: Vec3::X, v: Vec3::Z });
    for length in [1e-18_f32, 1e-9, 1.0, 1e9, 1e18] {
        for (shape, o) in [(unit, [0.0, 4.0, 0.0]), (floor, [0.0, 2.0, 0.0]), (floor, [1.0, 2.0, 1.0])] {
            for zero in [0.0, -0.0] {
                let t = hit(shape, o, [zero, -length, zero]).unwrap();
                assert!((t * length - 3.0).abs() < 1e-6, "{length}: {t}");
            }
        }
    }
    let ground = Primitive::Quad(Quad { corner: Vec3::new(-1.0, 0.0, -1.0), u: Vec3::X * 2.0, v: Vec3::Z * 2.0 });
    assert_eq!(hit(ground, [0.0, 1e-30, 0.0], [0.0, -1e30, 0.0]), None, "nearer than a distance can say");
}

/// Along an edge, in the plane of the shape, beside it: all that is left of the products is rounding.
#[test]
fn rays_in_the_plane_beside_a_shape_miss() {
    let mut r = Random::new(4);
    for _ in 0..100_000 {
        let (u, v) = (r.in_cube(), r.in_cube());
        let shape = if r.below(2) == 0 {
            Primitive::Quad(Quad { corner: Vec3::ZERO, u, v })
        } else {
            Primitive::Triangle(Triangle { a: Vec3::ZERO, b: u, c: v })
        };
        let (o, d) = if r.below(2) == 0 { (2.0 * v, u) } else { (2.0 * u, v) };
        let d = d * r.pick(&[1.0, -1.0]);
        assert_eq!(hit(shape, o.into(), d.into()), None, "{shape:?} from {o} along {d}");
    }
}

#[test]
fn quad_edges_belong_to_it() {
    let floor = Primitive::Quad(Quad { corner: Vec3::ZERO, u: Vec3::X, v: Vec3::Z });
    for (x, z) in [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0), (0.25, 1.0), (0.0, 0.75)] {
        assert_eq!(hit(floor, [x, 2.0, z], [0.0, -1.0, 0.0]), Some(2.0), "from above at {x}, {z}");
        assert_eq!(hit(floor, [x, -2.0, z], [0.0, 1.0, 0.0]), Some(2.0), "from below at {x}, {z}");
    }
    assert_eq!(hit(floor, [1.0_f32.next_up(), 1.0, 0.5], [0.0, -1.0, 0.0]), None);
    assert_eq!(hit(floor, [-1.0, 0.0, 0.5], [1.0, 0.0, 0.0]), None, "in its plane");
    assert_eq!(hit(floor, [0.5, 0.0, 0.5], [0.3, 1.0, 0.1]), None, "from its surface");
}

#[test]
fn triangle_edges_belong_to_it() {
    let half = Primitive::Triangle(Triangle { a: Vec3::ZERO, b: Vec3::X, c: Vec3::Y });
    for (x, y) in [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (0.5, 0.5), (0.0, 0.25), (0.25, 0.25)] {
        assert_eq!(hit(half, [x, y, 2.0], [0.0, 0.0, -1.0]), Some(2.0), "from the front at {x}, {y}");
        assert_eq!(hit(half, [x, y, -2.0], [0.0, 0.0, 1.0]), Some(2.0), "from the back at {x}, {y}");
    }
    assert_eq!(hit(half, [0.5, 0.5_f32.next_up(), 1.0], [0.0, 0.0, -1.0]), None);
    assert_eq!(hit(half, [-1.0, 0.25, 0.0], [1.0, 0.0, 0.0]), None, "in its plane");
    assert_eq!(hit(half, [0.25, 0.25, 0.0], [0.3, 0.1, 1.0]), None, "from its surface");
    let flat = Primitive::Triangle(Triangle { a: Vec3::ZERO, b: Vec3::X, c: Vec3::X });
    assert_eq!(hit(flat, [0.5, 0.0, 2.0], [0.0, 0.0, -1.0]), None, "no area");
}

#[test]
fn parameters_say_where() {
    let quad = Quad { corner: Vec3::new(1.0, 2.0, 3.0), u: Vec3::new(2.0, 0.0, 0.0), v: Vec3::new(1.0, 4.0, 0.0) };
    let bvh = Bvh::build(&vec![Primitive::Quad(quad)], Quality::Balanced).unwrap();
    let hit = bvh.intersect(&Ray::new(quad.corner + 0.25 * quad.u + 0.5 * quad.v + Vec3::Z, Vec3::NEG_Z)).unwrap();
    assert_eq!((hit.t, hit.u, hit.v), (1.0, 0.25, 0.5));
    let triangle = Triangle { a: quad.corner, b: quad.corner + quad.u, c: quad.corner + quad.v };
    let bvh = Bvh::build(&vec![Primitive::Triangle(triangle)], Quality::Balanced).unwrap();
    let hit = bvh.intersect(&Ray::new(quad.corner + 0.25 * quad.u + 0.5 * quad.v + Vec3::Z, Vec3::NEG_Z)).unwrap();
    assert_eq!((hit.t, hit.u, hit.v), (1.0, 0.25, 0.5));
}
