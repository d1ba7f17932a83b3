//! Shading normals: a mesh of flat triangles that looks round.
//!
//! The normals of a triangle's corners are interpolated over it. Where that goes wrong, three things are put right:
//!
//! - **Black edges**: near a silhouette the interpolated normal may point away from the viewer, or mirror the view into the
//!   surface. It is bent until the mirrored direction is above the surface (Keller et al. 2017, "The Iray Light
//!   Transport Simulation and Rendering System", arXiv:1705.01263).
//! - **Leaks**: light that comes from the other side of the surface than the shading normal says does not count (Veach
//!   1997, "Robust Monte Carlo Methods for Light Transport Simulation", §5.3); see
//!   [`SurfaceInteraction`](crate::interaction::SurfaceInteraction).
//! - **Shadow terminator**: flat triangles shade themselves where the light falls in at grazing angles. Rays leave
//!   from the round surface that the normals describe (Hanika 2021, "Hacking the Shadow Terminator", Ray Tracing Gems II,
//!   ch. 4, doi:10.1007/978-1-4842-7185-8_4).

use eyebeam_bvh::Hit;
use glam::{DVec3, Vec2, Vec3};

use crate::math::reflect_at;

/// The normals at the corners of a mesh's triangles.
#[derive(Clone, Debug)]
pub(crate) struct Smooth {
    triangles: Vec<[u32; 3]>,
    normals: Vec<Vec3>,
}

/// How a point of a smooth mesh is shaded.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shading {
    /// Unit shading normal, on the side of the geometric one.
    pub(super) ns: Vec3,
    /// From the point on the triangle to that on the round surface, on the viewer's side.
    pub(super) lift: Vec3,
}

impl Smooth {
    /// One normal a vertex, of any length; triangles with a vertex whose normal has none stay flat.
    pub(crate) fn new(triangles: Vec<[u32; 3]>, normals: &[[f32; 3]]) -> Self {
        Self { triangles, normals: normals.iter().map(|&n| Vec3::from(n).normalize_or_zero()).collect() }
    }

    /// Where the second and third corner of a triangle have these weights, of any length; none where it is flat.
    pub(crate) fn normal(&self, triangle: u32, weights: Vec2) -> Option<Vec3> {
        let normals = self.triangles.get(triangle as usize)?.map(|i| self.normals.get(i as usize).copied());
        let [a, b, c] = [normals[0]?, normals[1]?, normals[2]?];
        let is_flat = [a, b, c].contains(&Vec3::ZERO);
        (!is_flat).then(|| a * (1.0 - weights.x - weights.y) + b * weights.x + c * weights.y)
    }

    /// At a point of a triangle of geometric normal `n` that is seen along a ray of direction `d`.
    #[inline]
    pub(super) fn shading(&self, triangle: u32, [e1, e2]: [DVec3; 2], n: Vec3, d: Vec3, hit: &Hit) -> Shading {
        let flat = Shading { ns: n, lift: Vec3::ZERO };
        let Some(&indices) = self.triangles.get(triangle as usize) else {
            return flat;
        };
        let normals = indices.map(|i| self.normals.get(i as usize).copied().unwrap_or_default());
        let weights = [1.0 - hit.u - hit.v, hit.u, hit.v];
        let interpolated = normals[0] * weights[0] + normals[1] * weights[1] + normals[2] * weights[2];
        let Some(ns) = interpolated.try_normalize().filter(|_| normals.iter().all(|&n| n != Vec3::ZERO)) else {
            return flat;
        };
        // Some files have normals on the wrong side.
        let ns = if ns.dot(n) < 0.0 { -ns } else { ns };
        let side = 1.0_f32.copysign(-d.dot(n));
        let to_point = e1 * f64::from(hit.u) + e2 * f64::from(hit.v);
        let from_corners = [to_point, to_point - e1, to_point - e2].map(|v| v.as_vec3());
        let mut lift = Vec3::ZERO;
        for ((from, normal), weight) in from_corners.into_iter().zip(normals).zip(weights) {
            // On the viewer's side of the triangle, how far the point is below the tangent plane at the corner.
            let normal = normal * side.copysign(normal.dot(n) * side);
            lift -= normal * (weight * from.dot(normal).min(0.0));
        }
        Shading { ns: side * visible(side * ns, side * n, -d), lift }
    }
}

/// Bends a shading normal until the direction in which it mirrors the view is above the surface. All are unit vectors on the
/// viewer's side.
#[inline]
pub(crate) fn visible(ns: Vec3, n: Vec3, wo: Vec3) -> Vec3 {
    /// How far above, at least: the sine of the angle.
    const ABOVE: f32 = 0.01;
    let mirrored = reflect_at(wo, ns);
    let height = mirrored.dot(n);
    let least = ABOVE.min(0.9 * wo.dot(n));
    if height >= least {
        return ns;
    }
    let raised = mirrored + n * (least - height);
    (wo + raised.normalize_or(n)).normalize_or(n)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampler::Independent;
    use crate::sampling::uniform_sphere;
    use eyebeam_bvh::{Bvh, Primitive, Ray, Triangle};
    use glam::UVec2;

    /// Whatever the normals, and from wherever it is seen: the shading normal is a unit vector on the viewer's side, and mirrors
    /// the view to above the surface; where it did so by itself, it is left alone.
    #[test]
    fn the_mirrored_view_is_above_the_surface() {
        for i in 0..20_000 {
            let mut numbers = Independent::new(1, UVec2::ZERO, i);
            let [n, a, b] = [(); 3].map(|()| uniform_sphere(numbers.get_2d()));
            let wo = if a.dot(n) < 0.0 { -a } else { a };
            let ns = (b + 1.2 * n).normalize_or(n);
            let ns = if ns.dot(n) < 0.0 { -ns } else { ns };
            let bent = visible(ns, n, wo);
            assert!((bent.length() - 1.0).abs() < 1e-5 && bent.dot(wo) > 0.0, "{bent} seen from {wo}");
            assert!(reflect_at(wo, bent).dot(n) > -1e-6, "{bent} mirrors {wo} into {n}");
            if reflect_at(wo, ns).dot(n) > 0.01 {
                assert_eq!(bent, ns);
            }
        }
    }

    /// A triangle in a ball of radius 1: seen from outside, points are lifted towards the ball; from inside, where the ball is
    /// hollow, they stay. The surface that corners' tangent planes make of an eighth of a ball is farthest out in the middle
    /// of an edge: half the edge's ends, lifted by a quarter of each, is 3/4 (1, 1, 0).
    #[test]
    fn points_are_lifted_to_the_round_surface() {
        let corners = [Vec3::X, Vec3::Y, Vec3::Z];
        let [a, b, c] = corners;
        let bvh = Bvh::list(&vec![Primitive::Triangle(Triangle { a, b, c })]).unwrap();
        let smooth = Smooth::new(vec![[0, 1, 2]], &corners.map(|v| v.to_array()));
        let n = Vec3::ONE.normalize();
        let farthest = 0.75 * 2.0_f32.sqrt() + 1e-5;
        for side in [1.0, -1.0] {
            for i in 0..500 {
                let u = Independent::new(2, UVec2::ZERO, i).get_2d();
                let weights = crate::sampling::uniform_triangle(u);
                let p = a + (b - a) * weights.x + (c - a) * weights.y;
                let ray = Ray::new(p + side * n, -side * n);
                let hit = bvh.intersect(&ray).unwrap();
                let shading = smooth.shading(0, [(b - a).as_dvec3(), (c - a).as_dvec3()], n, ray.d, &hit);
                // Beyond 45 degrees it would mirror the view into the triangle, and is bent.
                let round = p.normalize();
                assert!(round.dot(n) < 0.72 || shading.ns.dot(round) > 0.9999, "the normal is that of the ball");
                let lifted = p + shading.lift;
                if side > 0.0 {
                    assert!(lifted.length() >= p.length() - 1e-6 && lifted.length() < farthest, "{p} to {lifted}");
                    assert!(p.length() > 0.99 || lifted.length() > p.length());
                } else {
                    assert!(shading.lift.length() < 1e-6);
                }
            }
        }
    }

    #[test]
    fn broken_normals_leave_a_mesh_flat() {
        let smooth = Smooth::new(vec![[0, 1, 2], [0, 1, 9]], &[[0.0; 3], [0.0, 0.0, 1.0], [0.0, 0.0, 1.0]]);
        let [a, b, c] = [Vec3::ZERO, Vec3::X, Vec3::Y];
        let bvh = Bvh::list(&vec![Primitive::Triangle(Triangle { a, b, c })]).unwrap();
        let hit = bvh.intersect(&Ray::new(Vec3::new(0.3, 0.3, 1.0), Vec3::NEG_Z)).unwrap();
        for triangle in [0, 1, 2] {
            let shading = smooth.shading(triangle, [DVec3::X, DVec3::Y], Vec3::Z, Vec3::NEG_Z, &hit);
            assert_eq!((shading.ns, shading.lift), (Vec3::Z, Vec3::ZERO));
        }
    }
}
