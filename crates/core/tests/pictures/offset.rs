//! Rays that leave a surface do not meet it again at their start. In the furnace, with two edges to a path, a convex white
//! thing vanishes exactly if no ray does.

use eyebeam_core::shape::QuadDesc;

use crate::setup::*;

const SPP: u32 = 64;

/// The usual ground: seen from above, from eye height and along the surface, at its top and far out.
#[test]
fn large_spheres_do_not_shade_themselves() {
    for radius in [1.0_f32, 1e3, 1e4, 1e5, 1e7] {
        for (from, at) in [
            ([0.0, 2.0, 0.0], [0.0, 0.0, 0.0]),
            ([0.0, 1e-3, 0.0], [0.0, 0.0, 0.0]),
            ([0.0, 1.5, 5.0], [0.0, 0.0, 0.0]),
            ([0.0, 0.1, 30.0], [0.0, 0.0, 0.0]),
            ([3.0, 40.0, 200.0], [30.0, 0.0, 100.0]),
        ] {
            let mut desc = scene(WHITE, matte(1.0), look(from, at, 20.0));
            desc.shape.sphere.push(sphere([0.0, -radius, 0.0], radius));
            assert_everywhere(&render(&desc, settings(32, SPP, 2)), 1.0, 0.0, &format!("{radius} from {from:?}"));
        }
    }
}

#[test]
fn spheres_of_every_size_and_place_do_not_shade_themselves() {
    for radius in [1e-6_f32, 1e-3, 1.0, 1e3] {
        for place in [0.0_f32, 1.0, 1e3] {
            if place > 1e4 * radius {
                continue; // Single precision has no room for it there.
            }
            let center = [place, -0.3 * place, 0.7 * place];
            let from = [center[0], center[1] + radius, center[2] + 4.0 * radius];
            let mut desc = scene(WHITE, matte(1.0), look(from, center, 40.0));
            desc.shape.sphere.push(sphere(center, radius));
            let name = format!("radius {radius} at {place}");
            assert_everywhere(&render(&desc, settings(32, SPP, 2)), 1.0, 0.0, &name);
        }
    }
}

#[test]
fn quads_do_not_shade_themselves() {
    for size in [1e-3_f32, 1.0, 1e3, 1e5] {
        for [nx, ny] in [[0.0_f32, 1.0], [0.6, 0.8], [0.28, 0.96], [0.9, 0.1]] {
            // Through the origin, or beside it; across the slope along z.
            for off in [0.0, 0.37 * size] {
                let along = [ny * size, -nx * size, 0.0];
                let corner = [off - along[0], -along[1], size];
                let (u, v) = (along.map(|x| 2.0 * x), [0.0, 0.0, -2.0 * size]);
                let eye = [off + 0.1 * nx * size, 0.1 * ny * size, 0.3 * size];
                let mut desc = scene(WHITE, matte(1.0), look(eye, [off, 0.0, 0.0], 40.0));
                desc.shape.quad.push(QuadDesc { corner, u, v, material: Some("it".to_owned()), ..QuadDesc::default() });
                let name = format!("size {size}, normal {nx}, {ny}, beside {off}");
                assert_everywhere(&render(&desc, settings(32, SPP, 2)), 1.0, 0.0, &name);
            }
        }
    }
}

/// Boxes of triangles near the origin and far from it, flat, thin and round.
#[test]
fn meshes_do_not_shade_themselves() {
    for (lo, hi) in [
        ([-1.0_f32, -1.0, -1.0], [1.0, 1.0, 1.0]),
        ([0.1, 0.2, 0.3], [0.17, 0.23, 0.9]),
        ([-5e4, -1e-3, -5e4], [5e4, 0.0, 5e4]),
        ([1000.0, 2000.0, -500.0], [1000.5, 2000.3, -499.0]),
    ] {
        let middle = [0, 1, 2].map(|i| 0.5 * (lo[i] + hi[i]));
        let size = (hi[0] - lo[0]).min(30.0);
        let eye = [middle[0] + size, hi[1] + 0.5 * size, middle[2] + 2.0 * size];
        let mut desc = scene(WHITE, matte(1.0), look(eye, middle, 40.0));
        desc.shape.mesh.push(box_mesh(lo, hi));
        assert_everywhere(&render(&desc, settings(32, SPP, 2)), 1.0, 0.0, &format!("{lo:?} to {hi:?}"));
    }
}
