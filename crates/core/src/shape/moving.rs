//! Where a ray meets a shape that has been moved.
//!
//! What is hit is known in the space of the shape. Points go to the world by the transform M at the time of the ray, in double
//! precision; normals by its transposed inverse.

use eyebeam_bvh::{Hit, Ray, Surface};
use glam::{DAffine3, DVec3, Vec2, Vec3};

use crate::shape::{Plane, Smooth, SurfacePoint};

/// The largest coordinate, by size, that adds up to a point of the world, if those in the shape's space are up to `reach`.
fn reach_in_world(to_world: &DAffine3, reach: f64) -> f64 {
    let m = to_world.matrix3;
    let stretch = m.x_axis.abs() + m.y_axis.abs() + m.z_axis.abs();
    stretch.max_element() * reach + to_world.translation.abs().max_element()
}

impl SurfacePoint {
    /// As [`new`](Self::new), for a surface in the space of a shape that `to_world` moves.
    pub(crate) fn moved(
        surface: &Surface,
        to_world: &DAffine3,
        ray: &Ray,
        hit: &Hit,
        smooth: Option<&Smooth>,
        triangle: u32,
    ) -> Self {
        let to_object = to_world.inverse();
        let normal_to_world = |n: DVec3| (to_object.matrix3.transpose() * n).normalize().as_vec3();
        match surface {
            Surface::Sphere(sphere) => {
                let (center, radius) = (sphere.center.as_dvec3(), f64::from(sphere.radius));
                let on_ray = ray.o.as_dvec3() + ray.d.as_dvec3() * f64::from(hit.t);
                let n = (to_object.transform_point3(on_ray) - center).normalize();
                let reach = reach_in_world(to_world, center.abs().max_element() + radius);
                let p = to_world.transform_point3(center + n * radius);
                Self::rounded(p, reach, normal_to_world(n)).round()
            }
            Surface::Flat { corner, edges } => {
                let reach = corner.abs().max(edges[0].abs()).max(edges[1].abs()).max_element();
                let [u, v] = edges.map(|edge| to_world.transform_vector3(edge));
                let plane = Plane::new(to_world.transform_point3(*corner), [u, v]);
                let (is_mirrored, reach) = (to_world.matrix3.determinant() < 0.0, reach_in_world(to_world, reach));
                let flat = plane.seen_through(is_mirrored, reach).point(Vec2::new(hit.u, hit.v));
                let Some(smooth) = smooth else {
                    return flat;
                };
                let n = edges[0].cross(edges[1]).normalize().as_vec3();
                let d = to_object.transform_vector3(ray.d.as_dvec3()).normalize().as_vec3();
                let shading = smooth.shading(triangle, *edges, n, d, hit);
                let lift: Vec3 = to_world.transform_vector3(shading.lift.as_dvec3()).as_vec3();
                flat.shaded(normal_to_world(shading.ns.as_dvec3()), lift)
            }
        }
    }
}
