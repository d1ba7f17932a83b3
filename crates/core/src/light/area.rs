//! Surfaces that shine: spheres, quads and triangles of emissive materials, sampled by the solid angle that they fill.

use std::f32::consts::PI;

use eyebeam_bvh::Primitive;
use glam::{Vec2, Vec3};

use crate::color::{Rgb, Spectrum};
use crate::light::select::LightBounds;
use crate::light::{LightSample, Target};
use crate::math::offset_ray_origin;
use crate::sampling::{
    SphereCone, SphereSample, SphericalRectangle, SphericalTriangle, pdf_from_area, uniform_sphere, uniform_triangle,
};
use crate::shape::SurfacePoint;

/// A primitive that shines, with the same radiance everywhere and into all directions.
#[derive(Clone, Copy, Debug)]
pub(crate) struct AreaLight {
    shape: Shape,
    radiance: Spectrum,
    two_sided: bool,
}

#[derive(Clone, Copy, Debug)]
enum Shape {
    Sphere { center: Vec3, radius: f32 },
    Flat(Flat),
}

/// The points corner + x edges[0] + y edges[1], for x and y in 0..1, or with x + y <= 1 in a triangle.
#[derive(Clone, Copy, Debug)]
struct Flat {
    kind: Kind,
    corner: Vec3,
    edges: [Vec3; 2],
    n: Vec3,
    area: f32,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Kind {
    Rectangle,
    /// A parallelogram without right angles.
    Slanted,
    Triangle,
}

/// How a flat light is sampled from a point.
enum FlatSampling {
    Rectangle(SphericalRectangle),
    Triangle(SphericalTriangle),
    /// Too small, too large or too slanted for its solid angle: by area.
    Area,
}

impl AreaLight {
    /// None for a primitive that cannot shine.
    pub(crate) fn new(primitive: &Primitive, radiance: Spectrum, two_sided: bool) -> Option<Self> {
        let shape = match primitive {
            Primitive::Sphere(s) => Shape::Sphere { center: s.center, radius: s.radius },
            Primitive::Quad(q) => {
                let slant = q.u.normalize_or_zero().dot(q.v.normalize_or_zero());
                let kind = if slant.abs() < 1e-5 { Kind::Rectangle } else { Kind::Slanted };
                Shape::Flat(Flat::new(kind, q.corner, [q.u, q.v]))
            }
            Primitive::Triangle(t) => Shape::Flat(Flat::new(Kind::Triangle, t.a, [t.b - t.a, t.c - t.a])),
            Primitive::MovingTriangle(_) | Primitive::Instance(_) => return None,
        };
        Some(Self { shape, radiance, two_sided })
    }

    /// Where it is and how much it shines.
    pub(crate) fn bounds(&self) -> LightBounds {
        let sides = if self.two_sided { 2.0 } else { 1.0 };
        let power = |area: f32| Rgb(self.radiance.to_rgb()).luminance() * PI * area * sides;
        match self.shape {
            Shape::Sphere { center, radius } => LightBounds::sphere(center, radius, power(sphere_area(radius))),
            Shape::Flat(Flat { kind, corner, edges: [u, v], n, area }) => {
                let far = if kind == Kind::Triangle { corner + u } else { corner + u + v };
                let points = [corner + u, corner + v, far];
                let [lo, hi] = [Vec3::min, Vec3::max].map(|f| points.into_iter().fold(corner, f));
                LightBounds { two_sided: self.two_sided, ..LightBounds::flat(lo, hi, n, power(area)) }
            }
        }
    }

    /// Draws a point that shines on `p`, with the density of its direction per solid angle.
    #[inline]
    pub(super) fn sample(&self, p: Vec3, u: Vec2) -> Option<LightSample> {
        let (point, wi, pdf) = match self.shape {
            Shape::Sphere { center, radius } => self.sample_sphere(center, radius, p, u),
            Shape::Flat(flat) => self.sample_flat(&flat, p, u),
        }?;
        let target = Target::On(offset_ray_origin(point.p, point.p_error, point.n, -wi));
        (pdf > 0.0).then_some(LightSample { wi, target, l: self.radiance, pdf, delta: false })
    }

    fn sample_flat(&self, flat: &Flat, p: Vec3, u: Vec2) -> Option<(SurfacePoint, Vec3, f32)> {
        let height = (p - flat.corner).dot(flat.n);
        if height == 0.0 || (height < 0.0 && !self.two_sided) {
            return None;
        }
        let (uv, by_angle) = match flat.sampling(p) {
            FlatSampling::Rectangle(r) => (r.sample(u).uv, Some(r.pdf())),
            FlatSampling::Triangle(t) => (t.sample(u).uv, Some(t.pdf())),
            FlatSampling::Area if flat.kind == Kind::Triangle => (uniform_triangle(u), None),
            FlatSampling::Area => (u, None),
        };
        let point = SurfacePoint::on_plane(flat.corner.as_dvec3(), flat.edges.map(|e| e.as_dvec3()), uv);
        let to = point.p - p;
        let wi = to.try_normalize()?;
        let pdf = by_angle.unwrap_or_else(|| pdf_from_area(1.0 / flat.area, to.length_squared(), wi.dot(flat.n)));
        Some((point, wi, pdf))
    }

    fn sample_sphere(&self, center: Vec3, radius: f32, p: Vec3, u: Vec2) -> Option<(SurfacePoint, Vec3, f32)> {
        if let Some(cone) = cone(center, radius, p) {
            let SphereSample { wi, distance } = cone.sample(u);
            let n = (p + wi * distance - center).try_normalize()?;
            return Some((SurfacePoint::on_sphere(center.as_dvec3(), radius.into(), n.as_dvec3()), wi, cone.pdf()));
        }
        if !self.two_sided {
            return None;
        }
        let point = SurfacePoint::on_sphere(center.as_dvec3(), radius.into(), uniform_sphere(u).as_dvec3());
        let to = point.p - p;
        let wi = to.try_normalize()?;
        Some((point, wi, pdf_from_area(1.0 / sphere_area(radius), to.length_squared(), wi.dot(point.n))))
    }

    /// The density with which [`sample`](Self::sample) draws from `p` the direction to `point` of the light.
    #[inline]
    pub(super) fn pdf(&self, p: Vec3, point: Vec3) -> f32 {
        let by_area = |area: f32, n: Vec3| {
            let to = point - p;
            pdf_from_area(1.0 / area, to.length_squared(), to.normalize_or_zero().dot(n))
        };
        match self.shape {
            Shape::Sphere { center, radius } => match cone(center, radius, p) {
                Some(cone) => cone.pdf(),
                None if self.two_sided => by_area(sphere_area(radius), (point - center).normalize_or_zero()),
                None => 0.0,
            },
            Shape::Flat(flat) => match flat.sampling(p) {
                FlatSampling::Rectangle(r) => r.pdf(),
                FlatSampling::Triangle(t) => t.pdf(),
                FlatSampling::Area => by_area(flat.area, flat.n),
            },
        }
    }
}

impl Flat {
    fn new(kind: Kind, corner: Vec3, edges: [Vec3; 2]) -> Self {
        let normal = edges[0].as_dvec3().cross(edges[1].as_dvec3());
        let share = if kind == Kind::Triangle { 0.5 } else { 1.0 };
        Self { kind, corner, edges, n: normal.normalize_or_zero().as_vec3(), area: share * normal.length() as f32 }
    }

    #[inline]
    fn sampling(&self, p: Vec3) -> FlatSampling {
        let (corner, [u, v]) = (self.corner, self.edges);
        let by_angle = match self.kind {
            Kind::Rectangle => SphericalRectangle::new(corner, u, v, p).map(FlatSampling::Rectangle),
            Kind::Triangle => SphericalTriangle::new([corner, corner + u, corner + v], p).map(FlatSampling::Triangle),
            Kind::Slanted => None,
        };
        by_angle.unwrap_or(FlatSampling::Area)
    }
}

fn sphere_area(radius: f32) -> f32 {
    4.0 * PI * radius * radius
}

/// The cone that a sphere fills as seen from `p`; none from within, and from so near that rounding decides.
#[inline]
fn cone(center: Vec3, radius: f32, p: Vec3) -> Option<SphereCone> {
    let margin = 1e-5 * radius + 4.0 * f32::EPSILON * (p.abs().max(center.abs())).max_element();
    (p.distance(center) > radius + margin).then(|| SphereCone::new(center, radius, p))?
}
