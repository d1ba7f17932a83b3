//! Closed rooms, furnaces and mirrors.

use super::KnownScene;
use super::build::*;
use crate::color::Rgb;
use crate::material::{Emissive, MaterialDesc};

pub(super) fn scenes() -> Vec<KnownScene> {
    let depths = [0, 1, 2, 3, 10, 40].map(glowing_ball);
    let balls = [("matte", matte(1.0)), ("mirror", metal(1.0, 0.0))].map(|(name, it)| white_ball(name, it));
    let metals = [(0.3, 0.05), (0.7, 0.3), (1.0, 4.0)].map(|(roughness, height)| rough_metal(roughness, height));
    [depths.to_vec(), balls.to_vec(), metals.to_vec(), vec![grey_ball(), mirror_corner(), first_edge()]].concat()
}

/// Inside of a ball that glows and scatters, every path brings e (1 + a + a² + …), one term an edge.
fn glowing_ball(depth: u32) -> KnownScene {
    let (e, a) = (3.0, 0.6);
    let emissive = Emissive { radiance: Rgb::grey(e).into(), albedo: Rgb::grey(a).into(), two_sided: true };
    let mut desc = empty(DARK, stare([0.1, 0.2, 0.3], [1.0, 0.0, 0.0]));
    add_sphere(&mut desc, [0.0; 3], 1.0, "shell", MaterialDesc::Emissive(emissive));
    let (e, a) = (f64::from(e), f64::from(a));
    KnownScene::new(format!("glowing ball, {depth} edges"), desc, depth, e * (1.0 - a.powi(depth as i32)) / (1.0 - a))
}

/// In the white furnace what loses no light cannot be told from the background.
fn white_ball(name: &str, material: MaterialDesc) -> KnownScene {
    let mut desc = empty(WHITE, stare([0.3, 0.0, 3.0], [0.3, 0.4, 0.0]));
    add_sphere(&mut desc, [0.0; 3], 1.0, "ball", material);
    KnownScene::new(format!("white furnace, {name}"), desc, 50, 1.0)
}

/// Under an even sky a convex matte thing has its albedo.
fn grey_ball() -> KnownScene {
    let mut desc = empty(WHITE, stare([0.0, 0.0, 3.0], [0.3, 0.4, 0.0]));
    add_sphere(&mut desc, [0.0; 3], 1.0, "ball", matte(0.35));
    KnownScene::new("matte ball under an even sky", desc, 2, f64::from(0.35_f32))
}

/// Three mirrors at right angles send a ray back after three reflections.
fn mirror_corner() -> KnownScene {
    let mut desc = empty(WHITE, stare([2.0, 2.2, 2.5], [0.5, 0.4, 0.0]));
    for axis in 0..3 {
        let edge = |axis: usize| std::array::from_fn(|i| if i == axis % 3 { 10.0 } else { 0.0 });
        add_quad(&mut desc, [[0.0; 3], edge(axis + 1), edge(axis + 2)], "mirror", metal(0.7, 0.0));
    }
    KnownScene::new("corner of three mirrors", desc, 4, f64::from(0.7_f32).powi(3))
}

/// One edge shows only what shines.
fn first_edge() -> KnownScene {
    KnownScene::new("floor with one edge", lit_floor(WHITE), 1, 0.0)
}

/// Metal of roughness r loses the part of the ball of radius r around the tip of the mirror direction that is below the
/// surface.
fn rough_metal(roughness: f32, height: f32) -> KnownScene {
    let mut desc = empty(WHITE, stare([1.0, height, 0.0], [0.0; 3]));
    add_quad(&mut desc, floor(0.0), "metal", metal(1.0, roughness));
    let (r, cos) = (f64::from(roughness), f64::from(height) / f64::from(height).hypot(1.0));
    let cap = (r - cos).max(0.0);
    let expected = 1.0 - cap * cap * (3.0 * r - cap) / (4.0 * r.powi(3));
    KnownScene::new(format!("metal of roughness {roughness}"), desc, 2, expected)
}
