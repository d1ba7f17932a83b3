//! Random numbers, points and shapes from a seed (SplitMix64).

use eyebeam_bvh::{Primitive, Quad, Ray, Sphere, Triangle};
use glam::Vec3;

pub(crate) struct Random(u64);

impl Random {
    pub(crate) fn new(seed: u64) -> Self {
        Self(seed)
    }

    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// In 0..n.
    pub(crate) fn below(&mut self, n: usize) -> usize {
        (self.next() % n as u64) as usize
    }

    pub(crate) fn pick<T: Copy>(&mut self, from: &[T]) -> T {
        from[self.below(from.len())]
    }

    /// In [0, 1).
    pub(crate) fn unit(&mut self) -> f32 {
        (self.next() >> 40) as f32 / (1 << 24) as f32
    }

    /// In the cube from -1 to 1.
    pub(crate) fn in_cube(&mut self) -> Vec3 {
        Vec3::from_array([0; 3].map(|_| 2.0 * self.unit() - 1.0))
    }

    /// A direction of any length in 1e-3..1e3, every third with one component 0, every third along an axis.
    pub(crate) fn direction(&mut self) -> Vec3 {
        let mut d = self.in_cube() + Vec3::splat(1e-9);
        match self.below(3) {
            0 => d[self.below(3)] = self.pick(&[0.0, -0.0]),
            1 => {
                let axis = self.below(3);
                d = Vec3::AXES[axis] * d[axis];
            }
            _ => {}
        }
        d * self.pick(&[1e-3, 1.0, 1e3])
    }

    /// A shape of about `size`, about `center`.
    pub(crate) fn shape(&mut self, center: Vec3, size: f32) -> Primitive {
        let [a, b, c] = [0; 3].map(|_| self.in_cube() * size);
        match self.below(3) {
            0 => Primitive::Sphere(Sphere { center: center + a, radius: size * (self.unit() + 0.01) }),
            1 => Primitive::Quad(Quad { corner: center + a, u: b, v: c }),
            _ => Primitive::Triangle(Triangle { a: center + a, b: center + b, c: center + c }),
        }
    }

    /// A point on or near the surface: on a sphere; on a corner, an edge or the inside of the others.
    pub(crate) fn point_of(&mut self, shape: &Primitive) -> Vec3 {
        let weight = |r: &mut Self| if r.below(2) == 0 { r.pick(&[0.0, 1.0]) } else { r.unit() };
        let (x, y) = (weight(self), weight(self));
        match shape {
            Primitive::Sphere(s) => s.center + s.radius * self.in_cube().normalize_or(Vec3::Y),
            Primitive::Quad(q) => q.corner + q.u * x + q.v * y,
            Primitive::Triangle(t) => t.a.lerp(t.b, x).lerp(t.c, y),
            _ => self.in_cube(),
        }
    }

    /// From anywhere, or from a shape's surface, to anywhere or to a point of a shape.
    pub(crate) fn ray(&mut self, shapes: &[Primitive], extent: f32) -> Ray {
        let any_shape = |r: &mut Self| shapes.get(r.below(shapes.len().max(1))).copied();
        let point = |r: &mut Self| match any_shape(r).filter(|_| r.below(4) != 0) {
            Some(shape) => r.point_of(&shape),
            None => r.in_cube() * extent,
        };
        let o = if self.below(2) == 0 { self.in_cube() * extent * 2.0 } else { point(self) };
        let d = if self.below(4) == 0 { self.direction() } else { (point(self) - o) * self.pick(&[1.0, 0.3, 40.0]) };
        let t_max = if self.below(3) == 0 { 2.0 * self.unit() } else { f32::INFINITY };
        let d = if d == Vec3::ZERO { Vec3::X } else { d };
        Ray { t_max, ..Ray::new(o, d) }
    }
}
