//! Slow and independent intersections: other formulas than the crate's, in twice its precision.
//!
//! Each answer comes with what double precision may make of it: a few times 1e-16 of the lengths that go into it.

mod double;

use eyebeam_bvh::{Hit, Primitive, Quad, Ray, Sphere, Triangle};

use double::{Double, Double3};

/// What double precision may lose and the crate's shapes are wider by, relative to the lengths involved.
const EPSILON: f64 = 64.0 * f64::EPSILON;

/// A hit that is right.
#[derive(Debug)]
pub(crate) struct Allowed {
    t: f64,
    uv: [f64; 2],
    t_error: f64,
    uv_error: f64,
}

/// Every answer that is right; more than one where rounding decides.
#[derive(Debug)]
pub(crate) struct Expected {
    hits: Vec<Allowed>,
    may_miss: bool,
    /// So near the plane of the shape that double precision cannot tell.
    in_plane: bool,
}

impl Expected {
    const MISS: Self = Self { hits: Vec::new(), may_miss: true, in_plane: false };

    pub(crate) fn new(shape: &Primitive, ray: &Ray) -> Self {
        match shape {
            Primitive::Sphere(s) => sphere(s, ray),
            Primitive::Quad(q) => quad(q, ray),
            Primitive::Triangle(t) => triangle(t, ray),
            _ => panic!("no reference for {shape:?}"),
        }
    }

    /// Whether rounding has no say in it.
    pub(crate) fn is_clear(&self) -> bool {
        !self.in_plane && self.hits.len() + usize::from(self.may_miss) == 1
    }

    pub(crate) fn allows(&self, hit: Option<Hit>) -> bool {
        let Some(hit) = hit else {
            return self.may_miss || self.in_plane;
        };
        let near = |a: f32, b: f64, error: f64| (f64::from(a) - b).abs() <= error + 6.0e-8 * b.abs() + 1e-45;
        self.in_plane
            || self.hits.iter().any(|h| {
                near(hit.t, h.t, h.t_error) && near(hit.u, h.uv[0], h.uv_error) && near(hit.v, h.uv[1], h.uv_error)
            })
    }
}

/// Pythagoras at the foot of the perpendicular from the centre; the crate solves a quadratic.
fn sphere(sphere: &Sphere, ray: &Ray) -> Expected {
    let (o, d) = (Double3::from(ray.o), Double3::from(ray.d));
    let to_center = Double3::from(sphere.center) - o;
    let r = f64::from(sphere.radius);
    let d_sq = d.dot(d);
    let off_axis = to_center.cross(d);
    let half_chord_sq = Double::from(r) * Double::from(r) - off_axis.dot(off_axis) / d_sq;
    let error = EPSILON * (to_center.length() + r);
    let distance = off_axis.length() / d.length();
    if distance > r + error {
        return Expected::MISS;
    }
    let foot = to_center.dot(d) / d_sq;
    if (distance - r).abs() <= error {
        // It grazes: anywhere within the chord that a displacement by `error` opens.
        let t_error = 2.0 * (error * r).sqrt() + error;
        let hits = vec![Allowed { t: foot.to_f64(), uv: [0.0; 2], t_error: t_error / d.length(), uv_error: 0.0 }];
        return Expected { hits, may_miss: true, in_plane: false };
    }
    let half_chord = half_chord_sq.sqrt();
    let t_error = error * (r / half_chord.to_f64()).max(1.0) / d.length();
    let half_chord = half_chord / d_sq.sqrt();
    let mut expected = Expected::MISS;
    for t in [foot - half_chord, foot + half_chord].map(Double::to_f64) {
        if t >= -t_error {
            expected.hits.push(Allowed { t, uv: [0.0; 2], t_error, uv_error: 0.0 });
        }
        if t > t_error {
            expected.may_miss = false;
            break;
        }
    }
    expected
}

/// What the plane of two edges from `corner` has to say, or none if the ray is parallel to it.
struct PlaneHit {
    t: f64,
    t_error: f64,
    /// Coordinates along the edges, and how far off they may be.
    uv: [f64; 2],
    uv_error: [f64; 2],
}

/// Plane first, then the point's coordinates by areas; the crate works with triple products of the ray.
fn plane(corner: Double3, edges: [Double3; 2], ray: &Ray) -> Option<PlaneHit> {
    let (o, d) = (Double3::from(ray.o), Double3::from(ray.d));
    let n = edges[0].cross(edges[1]);
    let cos = d.dot(n);
    let lengths = edges.map(Double3::length);
    let largest_cos = d.length() * lengths[0] * lengths[1];
    if cos.to_f64().abs() <= 1e3 * EPSILON * largest_cos {
        return None;
    }
    let to_corner = corner - o;
    let t = to_corner.dot(n) / cos;
    let in_plane = d * t - to_corner;
    let n_sq = n.dot(n);
    let uv = [in_plane.cross(edges[1]), edges[0].cross(in_plane)].map(|area| (area.dot(n) / n_sq).to_f64());
    // The ray passes an edge at a distance that is off by `error`; seen along the other edge, on the slant, that is more.
    // The other vertices of a quad are the corner and the edges, added up in double precision.
    let reach = to_corner.length() + lengths[0] + lengths[1] + corner.length();
    let error = EPSILON * reach * d.length() / cos.to_f64().abs();
    let t_error = error * lengths[0] * lengths[1] / d.length();
    Some(PlaneHit { t: t.to_f64(), t_error, uv, uv_error: [error * lengths[1], error * lengths[0]] })
}

/// `inside` is how far the point lies inside the nearest edge, in coordinates along the edges.
fn flat(hit: Option<PlaneHit>, inside: impl Fn([f64; 2]) -> f64) -> Expected {
    let Some(PlaneHit { t, t_error, uv, uv_error }) = hit else {
        return Expected { hits: Vec::new(), may_miss: true, in_plane: true };
    };
    let uv_error = uv_error[0] + uv_error[1];
    let inside = inside(uv);
    if t < -t_error || inside < -uv_error {
        return Expected::MISS;
    }
    let hits = vec![Allowed { t, uv, t_error, uv_error }];
    Expected { hits, may_miss: t <= t_error || inside <= uv_error, in_plane: false }
}

fn quad(quad: &Quad, ray: &Ray) -> Expected {
    let edges = [quad.u, quad.v].map(Double3::from);
    flat(plane(Double3::from(quad.corner), edges, ray), |[u, v]| u.min(1.0 - u).min(v).min(1.0 - v))
}

fn triangle(triangle: &Triangle, ray: &Ray) -> Expected {
    let [a, b, c] = [triangle.a, triangle.b, triangle.c].map(Double3::from);
    flat(plane(a, [b - a, c - a], ray), |[u, v]| u.min(v).min(1.0 - u - v))
}
