//! Triangles and quads, seen along the ray as the exact test sees them (`shape/flat.rs`).

use crate::filter::{FilterRay, each};
use crate::simd::Simd;

/// A point, or a way from one to another, in the space of the ray: across it, and along the axis that is nearest to its
/// direction; all negated. In each lane another.
pub(crate) type Seen<V> = [V; 3];

/// Flat shapes as a ray sees them.
pub(crate) trait Outline<const N: usize, S: Simd<N>> {
    /// One corner.
    fn corner(&self) -> Seen<S::F32>;

    /// The least and the greatest of the areas that the ray spans with the edges: on which side of each it passes.
    fn sides(&self, s: S) -> [S::F32; 2];

    /// The least and the greatest coordinate of a corner along the ray, times a factor.
    fn span(&self, s: S, factor: S::F32) -> [S::F32; 2];

    /// The shape's area, and that times the coordinate of the point where the ray passes.
    fn weigh(&self, s: S) -> [S::F32; 2];
}

/// Triangles.
pub(crate) struct Triangles<V> {
    corners: [Seen<V>; 3],
    /// The area at the edge from each corner to the next.
    sides: [V; 3],
}

/// Parallelograms.
pub(crate) struct Quads<V> {
    corner: Seen<V>,
    u: Seen<V>,
    v: Seen<V>,
    /// The areas at the two edges from the corner; those at the other two are what the whole has more.
    sides: [V; 2],
    area: V,
}

impl<const N: usize, S: Simd<N>> Outline<N, S> for Triangles<S::F32> {
    #[inline(always)]
    fn corner(&self) -> Seen<S::F32> {
        self.corners[0]
    }

    #[inline(always)]
    fn sides(&self, s: S) -> [S::F32; 2] {
        let [ab, bc, ca] = self.sides;
        [s.min(ab, s.min(bc, ca)), s.max(ab, s.max(bc, ca))]
    }

    #[inline(always)]
    fn span(&self, s: S, factor: S::F32) -> [S::F32; 2] {
        let [a, b, c] = each(|i| s.mul(self.corners[i][2], factor));
        [s.min(a, s.min(b, c)), s.max(a, s.max(b, c))]
    }

    #[inline(always)]
    fn weigh(&self, s: S) -> [S::F32; 2] {
        let ([a, b, c], [ab, bc, ca]) = (&self.corners, self.sides);
        let weighed = s.mul_add(bc, a[2], s.mul_add(ca, b[2], s.mul(ab, c[2])));
        [s.add(s.add(ab, bc), ca), weighed]
    }
}

impl<const N: usize, S: Simd<N>> Outline<N, S> for Quads<S::F32> {
    #[inline(always)]
    fn corner(&self) -> Seen<S::F32> {
        self.corner
    }

    #[inline(always)]
    fn sides(&self, s: S) -> [S::F32; 2] {
        let [u, v] = self.sides;
        let (past_u, past_v) = (s.sub(self.area, u), s.sub(self.area, v));
        [s.min(s.min(u, v), s.min(past_u, past_v)), s.max(s.max(u, v), s.max(past_u, past_v))]
    }

    #[inline(always)]
    fn span(&self, s: S, factor: S::F32) -> [S::F32; 2] {
        let (zero, along) = (s.splat(0.0), s.mul(self.corner[2], factor));
        let (u, v) = (s.mul(self.u[2], factor), s.mul(self.v[2], factor));
        let least = s.add(along, s.add(s.min(u, zero), s.min(v, zero)));
        let most = s.add(along, s.add(s.max(u, zero), s.max(v, zero)));
        [least, most]
    }

    #[inline(always)]
    fn weigh(&self, s: S) -> [S::F32; 2] {
        let [u, v] = self.sides;
        let weighed = s.mul_add(u, self.v[2], s.mul_add(v, self.u[2], s.mul(self.area, self.corner[2])));
        [self.area, weighed]
    }
}

/// How a ray sees things.
pub(crate) struct View<const N: usize, S: Simd<N>> {
    s: S,
    order: &'static [usize; 3],
    o: [S::F32; 3],
    shear: [S::F32; 2],
}

impl<const N: usize, S: Simd<N>> View<N, S> {
    #[inline(always)]
    pub(crate) fn new(s: S, ray: &FilterRay) -> Self {
        let shear = [s.splat(ray.shear[0]), s.splat(ray.shear[1])];
        Self { s, order: ray.order, o: each(|axis| s.splat(ray.turned_o[axis])), shear }
    }

    /// Triangles, by their vertices.
    #[inline(always)]
    pub(crate) fn triangles(&self, [a, b, c]: &[[[f32; N]; 3]; 3]) -> Triangles<S::F32> {
        let [a, b, c] = [self.point(a), self.point(b), self.point(c)];
        Triangles { corners: [a, b, c], sides: [self.area(a, b), self.area(b, c), self.area(c, a)] }
    }

    /// Quads, by a corner and two edges.
    #[inline(always)]
    pub(crate) fn quads(&self, [corner, u, v]: &[[[f32; N]; 3]; 3]) -> Quads<S::F32> {
        let (corner, u, v) = (self.point(corner), self.way(u), self.way(v));
        Quads { corner, u, v, sides: [self.area(corner, u), self.area(v, corner)], area: self.area(u, v) }
    }

    /// A point, for each axis the coordinate in each lane.
    #[inline(always)]
    fn point(&self, p: &[[f32; N]; 3]) -> Seen<S::F32> {
        let [x, y, z] = self.load(p);
        self.sheared([self.s.sub(self.o[0], x), self.s.sub(self.o[1], y), self.s.sub(self.o[2], z)])
    }

    /// From one point to another.
    #[inline(always)]
    fn way(&self, to: &[[f32; N]; 3]) -> Seen<S::F32> {
        let ([x, y, z], zero) = (self.load(to), self.s.splat(0.0));
        self.sheared([self.s.sub(zero, x), self.s.sub(zero, y), self.s.sub(zero, z)])
    }

    /// Twice the area of the triangle between the ray and two points, or of that which two ways span.
    #[inline(always)]
    fn area(&self, a: Seen<S::F32>, b: Seen<S::F32>) -> S::F32 {
        self.s.mul_sub(a[0], b[1], self.s.mul(a[1], b[0]))
    }

    #[inline(always)]
    fn load(&self, p: &[[f32; N]; 3]) -> [S::F32; 3] {
        let [x, y, z] = *self.order;
        debug_assert!(x.max(y).max(z) < 3);
        // SAFETY: the order is one of `ORDERS`.
        unsafe { [self.s.load(p.get_unchecked(x)), self.s.load(p.get_unchecked(y)), self.s.load(p.get_unchecked(z))] }
    }

    #[inline(always)]
    fn sheared(&self, [x, y, z]: [S::F32; 3]) -> Seen<S::F32> {
        [self.s.neg_mul_add(self.shear[0], z, x), self.s.neg_mul_add(self.shear[1], z, y), z]
    }
}
