//! Value noise and its fractal sum, for displaced surfaces.

use glam::{IVec3, Vec3};

/// A random number in [-1, 1] for each point of the integer lattice.
fn lattice(p: IVec3) -> f32 {
    let [x, y, z] = p.to_array().map(|i| i as u32);
    let mut h = x.wrapping_mul(0x8da6_b343) ^ y.wrapping_mul(0xd816_3841) ^ z.wrapping_mul(0xcb1a_b31f);
    h ^= h >> 15;
    h = h.wrapping_mul(0x2c1b_3c6d);
    h ^= h >> 12;
    h = h.wrapping_mul(0x297a_2d39);
    h ^= h >> 15;
    h as f32 / 4_294_967_295.0 * 2.0 - 1.0
}

/// The lattice's numbers, smoothly interpolated.
pub(super) fn value_noise(p: Vec3) -> f32 {
    let floor = p.floor();
    let cell = floor.as_ivec3();
    let t = p - floor;
    let w = t * t * (3.0 - 2.0 * t);
    let lerp = |a: f32, b: f32, t: f32| a + (b - a) * t;
    let edge = |y, z| lerp(lattice(cell + IVec3::new(0, y, z)), lattice(cell + IVec3::new(1, y, z)), w.x);
    let face = |z| lerp(edge(0, z), edge(1, z), w.y);
    lerp(face(0), face(1), w.z)
}

/// Octaves of noise, each of half the height and about twice the frequency of the one before.
pub(super) fn fractal_noise(mut p: Vec3, octaves: u32) -> f32 {
    let (mut amplitude, mut sum) = (1.0, 0.0);
    for _ in 0..octaves {
        sum += amplitude * value_noise(p);
        p *= 2.03;
        amplitude *= 0.5;
    }
    sum
}
