//! Surfaces that shine: spheres, quads and triangles of emissive materials, sampled by the solid angle that they fill.

use std::f32::consts::PI;

use eyebeam_bvh::Primitive;
use glam::{Vec2, Vec3};

use crate::color::{Rgb, Spectrum};
use crate::light::select::LightBounds;
use crate::light::{LightSample, Target};
use crate::sampling::solid_angle::{SphereCone, SphericalRectangle, SphericalTriangle};
use crate::sampling::{uniform_sphere, uniform_triangle};

/// A primitive that shines, with the same radiance everywhere and into all directions.
#[derive(Clone, Copy, Debug)]
pub(crate) struct AreaLight {
    shape: Shape,
    radiance: Spectrum,
    two_sided: bool,
}

#[derive(Clone, Copy, Debug)]
enum Shape {
    Sphere {
        center: Vec3,
        radius: f32,
    },
    /// The points corner + x edges[0] + y edges[1]: for x, y in 0..1, or in the triangle x + y <= 1.
    Flat {
        kind: Flat,
        corner: Vec3,
        edges: [Vec3; 2],
        n: Vec3,
        area: f32,
    },
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Flat {
    Rectangle,
    /// A parallelogram without right angles.
    Slanted,
    Triangle,
}

/// How a flat light is sampled from a point.
enum FlatSampling {
    Rectangle(SphericalRectangle),
    Triangle(SphericalTriangle),
    /// Too small, too close or too slanted for its solid angle: by area.
    Area,
}

impl AreaLight {
    /// None for a primitive that cannot shine.
    pub(crate) fn new(primitive: &Primitive, radiance: Spectrum, two_sided: bool) -> Option<Self> {
        let flat = |kind: Flat, corner: Vec3, edges: [Vec3; 2], share: f32| {
            let normal = edges[0].as_dvec3().cross(edges[1].as_dvec3());
            let (n, area) = (normal.normalize_or_zero().as_vec3(), share * normal.length() as f32);
            Shape::Flat { kind, corner, edges, n, area }
        };
        let shape = match primitive {
            Primitive::Sphere(s) => Shape::Sphere { center: s.center, radius: s.radius },
            Primitive::Quad(q) => {
                let slant = q.u.normalize_or_zero().dot(q.v.normalize_or_zero());
                let kind = if slant.abs() < 1e-5 { Flat::Rectangle } else { Flat::Slanted };
                flat(kind, q.corner, [q.u, q.v], 1.0)
            }
            Primitive::Triangle(t) => flat(Flat::Triangle, t.a, [t.b - t.a, t.c - t.a], 0.5),
            Primitive::MovingTriangle(_) | Primitive::Instance(_) => return None,
        };
        Some(Self { shape, radiance, two_sided })
    }

    /// Where it is and how much it shines.
    pub(crate) fn bounds(&self) -> LightBounds {
        let sides = if self.two_sided { 2.0 } else { 1.0 };
        let power = |area: f32| Rgb(self.radiance.to_rgb()).luminance() * PI * area * sides;
        match self.shape {
            Shape::Sphere { center, radius } => {
                LightBounds::all_around(center - radius, center + radius, power(4.0 * PI * radius * radius))
            }
            Shape::Flat { kind, corner, edges: [u, v], n, area } => {
                let far = if kind == Flat::Triangle { corner + u } else { corner + u + v };
                let points = [corner, corner + u, corner + v, far];
                let lo = points.into_iter().fold(corner, Vec3::min);
                let hi = points.into_iter().fold(corner, Vec3::max);
                LightBounds::flat(lo, hi, n, power(area), self.two_sided)
            }
        }
    }

    /// Draws a point that shines on `p`, with the density of its direction per solid angle.
    #[inline]
    pub(super) fn sample(&self, p: Vec3, u: Vec2) -> Option<LightSample> {
        match self.shape {
            Shape::Sphere { center, radius } => self.sample_sphere(center, radius, p, u),
            Shape::Flat { kind, corner, edges, n, area } => {
                let side = (p - corner).dot(n);
                if side == 0.0 || (side < 0.0 && !self.two_sided) {
                    return None;
                }
                let (point, pdf) = match Self::flat_sampling(kind, corner, edges, p) {
                    FlatSampling::Rectangle(r) => (r.sample(u).1, Some(1.0 / r.solid_angle())),
                    FlatSampling::Triangle(t) => {
                        let b = t.sample(u)?.1;
                        (corner + edges[0] * b.y + edges[1] * b.z, Some(1.0 / t.solid_angle()))
                    }
                    FlatSampling::Area if kind == Flat::Triangle => {
                        let b = uniform_triangle(u);
                        (corner + edges[0] * b.y + edges[1] * b.z, None)
                    }
                    FlatSampling::Area => (corner + edges[0] * u.x + edges[1] * u.y, None),
                };
                let to = point - p;
                let wi = to.try_normalize()?;
                let pdf = pdf.unwrap_or_else(|| to.length_squared() / (area * wi.dot(n).abs()));
                let reach = corner.abs() + edges[0].abs() + edges[1].abs();
                let n = n * side.signum();
                (pdf > 0.0 && pdf.is_finite()).then(|| LightSample {
                    wi,
                    target: Target::On(offset(point, reach, n)),
                    l: self.radiance,
                    pdf,
                    delta: false,
                })
            }
        }
    }

    fn sample_sphere(&self, center: Vec3, radius: f32, p: Vec3, u: Vec2) -> Option<LightSample> {
        let reach = center.abs() + radius;
        let sample = |wi: Vec3, point: Vec3, n: Vec3, pdf: f32| LightSample {
            wi,
            target: Target::On(offset(point, reach, n)),
            l: self.radiance,
            pdf,
            delta: false,
        };
        if let Some(cone) = cone(center, radius, p) {
            let (wi, distance) = cone.sample(u);
            let n = (p + wi * distance - center).try_normalize()?;
            return Some(sample(wi, center + n * radius, n, cone.pdf()));
        }
        if !self.two_sided {
            return None;
        }
        let n = uniform_sphere(u);
        let point = center + n * radius;
        let to = point - p;
        let wi = to.try_normalize()?;
        let cos = -wi.dot(n);
        let pdf = to.length_squared() / (4.0 * PI * radius * radius * cos.abs());
        (pdf > 0.0 && pdf.is_finite()).then(|| sample(wi, point, n * cos.signum(), pdf))
    }

    /// The density with which [`sample`](Self::sample) draws from `p` the direction to `point` of the light.
    #[inline]
    pub(super) fn pdf(&self, p: Vec3, point: Vec3) -> f32 {
        let to = point - p;
        let by_area = |area: f32, n: Vec3| to.length_squared() * to.length() / (area * to.dot(n).abs());
        match self.shape {
            Shape::Sphere { center, radius } => match cone(center, radius, p) {
                Some(cone) => cone.pdf(),
                None if self.two_sided => by_area(4.0 * PI * radius * radius, (point - center).normalize_or_zero()),
                None => 0.0,
            },
            Shape::Flat { kind, corner, edges, n, area } => match Self::flat_sampling(kind, corner, edges, p) {
                FlatSampling::Rectangle(r) => 1.0 / r.solid_angle(),
                FlatSampling::Triangle(t) => 1.0 / t.solid_angle(),
                FlatSampling::Area => by_area(area, n),
            },
        }
    }

    #[inline]
    fn flat_sampling(kind: Flat, corner: Vec3, [u, v]: [Vec3; 2], p: Vec3) -> FlatSampling {
        let by_angle = match kind {
            Flat::Rectangle => SphericalRectangle::new(corner, u, v, p).map(FlatSampling::Rectangle),
            Flat::Triangle => SphericalTriangle::new([corner, corner + u, corner + v], p).map(FlatSampling::Triangle),
            Flat::Slanted => None,
        };
        by_angle.unwrap_or(FlatSampling::Area)
    }
}

/// The cone that a sphere fills as seen from `p`; none from within, and from so near that rounding decides.
#[inline]
fn cone(center: Vec3, radius: f32, p: Vec3) -> Option<SphereCone> {
    let margin = 1e-5 * radius + 4.0 * f32::EPSILON * (p.abs().max(center.abs())).max_element();
    (p.distance(center) > radius + margin).then(|| SphereCone::new(center, radius, p))?
}

/// The point, moved off its surface by more than it may be off.
#[inline]
fn offset(point: Vec3, reach: Vec3, n: Vec3) -> Vec3 {
    point + n * (8.0 * f32::EPSILON * n.abs().dot(reach))
}
