//! Scenes with a solution in closed form, within their noise.

use std::f64::consts::PI;

use eyebeam_core::color::Rgb;
use eyebeam_core::integrator::IntegratorKind;
use eyebeam_core::material::{MaterialDesc, Metal};
use eyebeam_core::sampler::SamplerKind;
use eyebeam_core::shape::QuadDesc;
use eyebeam_core::testing::{scenes, z_test};
use eyebeam_core::texture::NoTextures;
use glam::Vec3;

use crate::setup::*;

/// So narrow that every pixel looks at the same point.
const NARROW: f32 = 0.01;

/// Every scene that is known beforehand, by every integrator that can see its light, with every sampler.
#[test]
fn known_scenes() {
    const SPP: u32 = 128;
    for scene in scenes::all() {
        for (integrator, kind) in IntegratorKind::NAMES {
            if !scene.by_chance && *kind == IntegratorKind::Weekend {
                continue;
            }
            for (sampler, numbers) in SamplerKind::NAMES {
                let result = scene.check(|| kind.build(scene.max_depth), *numbers, SPP);
                result.unwrap_or_else(|e| panic!("{}, {integrator}, {sampler}: {e}", scene.name));
            }
        }
    }
}

/// A pixel is the square around its centre: the border of a lamp through the middle of the picture halves the middle pixels.
#[test]
fn pixels_are_where_they_should_be() {
    const SPP: u32 = 4096;
    let mut desc = scene(DARK, lamp(1.0), look([0.0, 0.0, 3.0], [0.0; 3], 20.0));
    let halves = [[[10.0, 0.0, 0.0], [0.0, 20.0, 0.0]], [[20.0, 0.0, 0.0], [0.0, 10.0, 0.0]]];
    for (axis, corner) in [(0, [0.0, -10.0, 0.0]), (1, [-10.0, 0.0, 0.0])] {
        let [u, v] = halves[axis];
        desc.shape.quad = vec![QuadDesc { corner, u, v, material: Some("it".to_owned()), ..QuadDesc::default() }];
        let image = render(&desc, settings(5, SPP, 1)).develop();
        // The lamp is on the right, and then above.
        let expected = |x: u32, y: u32| [0.0, 0.0, 0.5, 1.0, 1.0][[x, 4 - y][axis] as usize];
        let error = |x: u32, y: u32| (expected(x, y) * (1.0 - expected(x, y)) / f64::from(SPP)).sqrt();
        z_test(&image, expected, error, 1).unwrap();
    }
}

/// One edge shows only what shines; a lamp shines on the side of its normal, whatever the depth.
#[test]
fn lamps_shine_forwards() {
    let mut desc = scene(DARK, lamp(2.5), look([0.0, 3.0, 0.0], [0.0; 3], 20.0));
    desc.shape.quad.push(floor(0.0, 10.0));
    for depth in [1, 50] {
        assert_everywhere(&render(&desc, settings(8, 4, depth)), 2.5, 0.0, "from above");
    }
    desc.camera = look([0.0, -3.0, 0.0], [0.0; 3], 20.0);
    assert_everywhere(&render(&desc, settings(8, 4, 50)), 0.0, 0.0, "from below");
}

#[test]
fn one_edge_shows_only_what_shines() {
    let mut desc = scene(WHITE, matte(1.0), look([0.0, 3.0, 0.0], [0.0; 3], 20.0));
    assert_everywhere(&render(&desc, settings(8, 4, 1)), 1.0, 0.0, "sky");
    assert_everywhere(&render(&desc, settings(8, 4, 0)), 0.0, 0.0, "no edge");
    desc.shape.quad.push(floor(0.0, 10.0));
    assert_everywhere(&render(&desc, settings(8, 4, 1)), 0.0, 0.0, "floor");
}

/// Share of the ball of radius r around a point at height c above the plane that is not below it.
fn share_above(c: f64, r: f64) -> f64 {
    let cap = (r - c).max(0.0);
    1.0 - cap * cap * (3.0 * r - cap) / (4.0 * r.powi(3))
}

/// The integral of the lobe over all directions, by midpoints.
fn integral(metal: &MaterialDesc, wo: Vec3) -> f64 {
    const N: i32 = 1000;
    let mut sum = 0.0;
    for i in 0..N {
        let z = 2.0 * (f64::from(i) + 0.5) / f64::from(N) - 1.0;
        for j in 0..N {
            let (sin, cos) = (2.0 * PI * (f64::from(j) + 0.5) / f64::from(N)).sin_cos();
            let r = (1.0 - z * z).sqrt();
            let wi = Vec3::new((r * cos) as f32, (r * sin) as f32, z as f32);
            sum += f64::from(metal.bsdf(&NoTextures).eval(wo, wi).to_rgb()[0]);
        }
    }
    sum * 4.0 * PI / f64::from(N * N)
}

/// Rough metal in the furnace loses what falls below the surface and nothing else.
#[test]
fn rough_metal_loses_what_falls_below() {
    for roughness in [0.3_f32, 0.7, 1.0] {
        for height in [0.05_f32, 0.3, 1.0, 4.0] {
            let metal = MaterialDesc::Metal(Metal { albedo: Rgb::grey(1.0).into(), roughness: roughness.into() });
            let mut desc = scene(WHITE, metal.clone(), look([1.0, height, 0.0], [0.0; 3], NARROW));
            desc.shape.quad.push(floor(0.0, 100.0));
            let wo = Vec3::new(1.0, 0.0, height).normalize();
            let expected = share_above(f64::from(wo.z), f64::from(roughness));
            let integral = integral(&metal, wo);
            assert!(
                (integral - expected).abs() < 2e-3,
                "roughness {roughness}, height {height}: {integral}, {expected}"
            );
            // Pixels may have lost nothing by chance, so the error is not the film's but that of counting.
            let (image, samples) = (render(&desc, settings(8, 1000, 2)).develop(), 1000.0);
            let error = (expected * (1.0 - expected) / samples).sqrt();
            z_test(&image, |_, _| expected, |_, _| error, image.width()).unwrap();
        }
    }
}
