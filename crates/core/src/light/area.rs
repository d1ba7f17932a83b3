//! Surfaces that shine: spheres, quads and triangles of emissive materials, sampled by the solid angle that they fill.

use std::f32::consts::PI;

use eyebeam_bvh::{Primitive, Slot};
use glam::{Vec2, Vec3};

use crate::color::{Rgb, Spectrum};
use crate::light::select::LightBounds;
use crate::light::{LightSample, Target};
use crate::sampling::{
    SphereCone, SphereSample, SphericalRectangle, SphericalTriangle, pdf_from_area, uniform_sphere, uniform_triangle,
};
use crate::shape::SurfacePoint;

/// A primitive that shines into all directions, with the same radiance everywhere or about that in the mean.
#[derive(Clone, Copy, Debug)]
pub(crate) struct AreaLight {
    shape: Shape,
    radiance: Spectrum,
    two_sided: bool,
    /// Where the scene keeps it.
    on: Slot,
    /// Its number among the lights, if its radiance is not the same everywhere.
    varies: Option<u32>,
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
    /// The largest coordinate of the corner and the edges, by size.
    reach: f32,
    /// From this squared distance on, cos θ / distance² is nearly the same everywhere.
    far_sq: f32,
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
    /// By area: from afar, or where the shape is too slanted for its solid angle.
    Area,
}

impl AreaLight {
    /// None for a primitive that cannot shine.
    pub(crate) fn new(
        primitive: &Primitive,
        on: Slot,
        radiance: Spectrum,
        two_sided: bool,
        varies: Option<u32>,
    ) -> Option<Self> {
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
        Some(Self { shape, radiance, two_sided, on, varies })
    }

    /// Where it is and how much it shines.
    pub(crate) fn bounds(&self) -> LightBounds {
        let sides = if self.two_sided { 2.0 } else { 1.0 };
        let power = |area: f32| Rgb(self.radiance.to_rgb()).luminance() * PI * area * sides;
        match self.shape {
            Shape::Sphere { center, radius } => LightBounds::sphere(center, radius, power(sphere_area(radius))),
            Shape::Flat(Flat { kind, corner, edges: [u, v], n, area, .. }) => {
                let far = if kind == Kind::Triangle { corner + u } else { corner + u + v };
                let points = [corner + u, corner + v, far];
                let [lo, hi] = [Vec3::min, Vec3::max].map(|f| points.into_iter().fold(corner, f));
                let bounds = if self.two_sided { LightBounds::flat_two_sided } else { LightBounds::flat };
                bounds(lo, hi, n, power(area))
            }
        }
    }

    /// Draws a point that shines on `p`, with the density of its direction per solid angle.
    #[inline]
    pub(crate) fn sample(&self, p: Vec3, u: Vec2) -> Option<LightSample> {
        let (point, wi, pdf) = match self.shape {
            Shape::Sphere { center, radius } => self.sample_sphere(center, radius, p, u),
            Shape::Flat(flat) => self.sample_flat(&flat, p, u),
        }?;
        let target = Target::On { point: point.ray_origin(-wi, -wi), on: self.on };
        (pdf > 0.0).then_some(LightSample { wi, target, l: self.radiance, pdf, delta: false, varies: self.varies })
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
        let point = flat.point(uv);
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
    pub(crate) fn pdf(&self, p: Vec3, point: Vec3) -> f32 {
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
        let far_sq = Self::FAR * Self::FAR * (edges[0].abs() + edges[1].abs()).length_squared();
        let (n, area) = (normal.normalize_or_zero().as_vec3(), share * normal.length() as f32);
        let reach = corner.abs().max(edges[0].abs()).max(edges[1].abs()).max_element();
        Self { kind, corner, edges, n, area, reach, far_sq }
    }

    #[inline]
    fn point(&self, uv: Vec2) -> SurfacePoint {
        let (corner, uv) = (self.corner.as_dvec3(), uv.as_dvec2());
        let [u, v] = self.edges.map(|e| e.as_dvec3());
        SurfacePoint::rounded(corner + u * uv.x + v * uv.y, self.reach.into(), self.n)
    }

    /// Lengths of the shape away, sampling the area makes as little noise as the solid angle, and costs less.
    const FAR: f32 = 1.5;

    #[inline]
    fn sampling(&self, p: Vec3) -> FlatSampling {
        let (corner, [u, v]) = (self.corner, self.edges);
        if p.distance_squared(corner) > self.far_sq {
            return FlatSampling::Area;
        }
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

#[cfg(test)]
mod tests {
    use eyebeam_bvh::{Quad, Sphere, Triangle};
    use glam::UVec2;

    use super::*;
    use crate::sampler::Independent;

    fn numbers(i: u32) -> Vec2 {
        Independent::new(1, UVec2::ZERO, i).get_2d()
    }

    fn light(primitive: Primitive) -> AreaLight {
        AreaLight::new(&primitive, Slot::NONE, Spectrum::ONE, true, None).unwrap()
    }

    /// Inside a box of lamps the irradiance of a point of a wall is π, whichever wall: what all samples make of it.
    #[test]
    fn walls_around_a_point_send_all_light_there_is() {
        const N: u32 = 100_000;
        let (lo, hi) = (Vec3::new(-0.25, -0.75, -0.25), Vec3::new(0.75, 0.5, 1.0));
        let p = Vec3::new(0.75, 0.2, 0.3);
        let wall = |axis: usize, corner: Vec3| {
            let corner = Vec3::from_array(std::array::from_fn(|i| if i == axis { corner[i] } else { lo[i] }));
            let edge = |axis: usize| Vec3::AXES[axis] * (hi - lo)[axis];
            Quad { corner, u: edge((axis + 1) % 3), v: edge((axis + 2) % 3) }
        };
        let walls = (0..3).flat_map(|axis| [wall(axis, lo), wall(axis, hi)]);
        let halves = |q: Quad| {
            let (a, b, c, d) = (q.corner, q.corner + q.u, q.corner + q.u + q.v, q.corner + q.v);
            [Triangle { a, b, c }, Triangle { a, b: c, c: d }].map(Primitive::Triangle)
        };
        let slanted = |q: Quad| Primitive::Quad(Quad { v: q.v + 1e-4 * q.u, ..q });
        let ways: [Vec<Primitive>; 3] = [
            walls.clone().map(Primitive::Quad).collect(),
            walls.clone().flat_map(halves).collect(),
            walls.map(slanted).collect(),
        ];
        for walls in ways {
            let mut irradiance = 0.0;
            for light in walls.into_iter().map(light) {
                for sample in (0..N).filter_map(|i| light.sample(p, numbers(i))) {
                    irradiance += f64::from(sample.wi.dot(Vec3::NEG_X).max(0.0) / sample.pdf) / f64::from(N);
                }
            }
            assert!((irradiance / std::f64::consts::PI - 1.0).abs() < 3e-3, "{irradiance}");
        }
    }

    /// A sample's density is that of its direction, from near and far, from inside and outside.
    #[test]
    fn samples_know_their_density() {
        let center = Vec3::new(0.3, 0.2, -0.1);
        let lights = [
            Primitive::Sphere(Sphere { center, radius: 0.5 }),
            Primitive::Quad(Quad { corner: center, u: Vec3::X, v: Vec3::new(0.0, 0.5, 0.5) }),
            Primitive::Quad(Quad { corner: center, u: Vec3::X, v: Vec3::new(0.4, 0.5, 0.5) }),
            Primitive::Triangle(Triangle { a: center, b: center + Vec3::X, c: center + Vec3::new(0.2, 0.9, 0.0) }),
        ]
        .map(light);
        for (k, light) in lights.iter().enumerate() {
            for (i, distance) in [0.01, 0.3, 2.0, 50.0, 1e4].into_iter().cycle().take(2000).enumerate() {
                let p = center + distance * uniform_sphere(numbers(i as u32));
                let Some(sample) = light.sample(p, numbers(7 * i as u32 + 1)) else { continue };
                let Target::On { point, .. } = sample.target else { panic!("it is somewhere") };
                let pdf = light.pdf(p, point);
                assert!((pdf / sample.pdf - 1.0).abs() < 0.02, "light {k} from {p}: {pdf}, not {}", sample.pdf);
                assert!((point - p).normalize().dot(sample.wi) > 0.999, "light {k} from {p}");
            }
        }
    }

    /// From behind, nothing; from both sides, if it is said so.
    #[test]
    fn lamps_shine_forwards() {
        let floor = Primitive::Quad(Quad { corner: Vec3::ZERO, u: Vec3::Z, v: Vec3::X });
        for (primitive, outside) in
            [(floor, Vec3::Y), (Primitive::Sphere(Sphere { center: Vec3::ZERO, radius: 0.9 }), Vec3::Y)]
        {
            let inside = Vec3::new(0.3, -0.1, 0.3);
            for two_sided in [false, true] {
                let light = AreaLight::new(&primitive, Slot::NONE, Spectrum::ONE, two_sided, None).unwrap();
                assert!(light.sample(outside, Vec2::splat(0.4)).is_some());
                assert_eq!(light.sample(inside, Vec2::splat(0.4)).is_some(), two_sided);
            }
        }
    }
}
