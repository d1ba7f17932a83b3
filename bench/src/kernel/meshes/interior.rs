//! A hall with two rows of columns: walls of two triangles, fluted columns, arches, drapes, long thin beams and clutter.

use std::f32::consts::{PI, TAU};

use glam::Vec3;

use super::{Model, View, random_point};
use crate::kernel::random::Random;

const LENGTH: f32 = 30.0;
const HEIGHT: f32 = 10.0;
const WIDTH: f32 = 14.0;
const COLUMNS: usize = 10;

pub(super) fn model() -> Model {
    let lamp = |k: usize| [Vec3::new(2.0 + 6.0 * k as f32, 9.95, 6.0), Vec3::X * 1.5, Vec3::Z * 2.0];
    let mut model = Model {
        view: View { eye: Vec3::new(1.2, 2.2, 6.2), look_at: Vec3::new(20.0, 3.2, 8.0), vfov_deg: 62.0 },
        lights: (0..5).map(lamp).collect(),
        ..Model::default()
    };
    let mut random = Random(7);
    shell(&mut model);
    for (z, wall, gallery) in [(4.0, 0.15, 2.0), (10.0, WIDTH - 0.15, 12.0)] {
        colonnade(&mut model, z, wall);
        model.upright_cuboid(Vec3::new(15.0, 8.05, z), Vec3::new(15.0, 0.05, 0.12));
        model.upright_cuboid(Vec3::new(15.0, 7.15, gallery), Vec3::new(15.0, 0.05, 2.0));
    }
    roof_beams(&mut model);
    drapes(&mut model, &mut random);
    floor_tiles(&mut model, &mut random);
    vases_and_balls(&mut model, &mut random);
    crates_and_rods(&mut model, &mut random);
    chains(&mut model);
    model
}

/// Two triangles for each wall.
fn shell(model: &mut Model) {
    let (x, y, z) = (Vec3::X * LENGTH, Vec3::Y * HEIGHT, Vec3::Z * WIDTH);
    let o = Vec3::ZERO;
    for wall in [[o, x, z], [y, z, x], [o, z, y], [x, y, z], [o, y, x], [z, x, y]] {
        model.patch(wall);
    }
}

fn colonnade(model: &mut Model, z: f32, wall: f32) {
    for c in 0..COLUMNS {
        let x = 1.5 + 3.0 * c as f32;
        column(model, x, z);
        if c + 1 < COLUMNS {
            arches(model, x, z);
        }
        model.upright_cuboid(Vec3::new(x, 5.0, wall), Vec3::new(0.25, 5.0, 0.15));
        balusters(model, x, z);
    }
}

/// A solid of revolution about a vertical axis.
fn turned(
    model: &mut Model,
    [nu, nv]: [u32; 2],
    [x, z]: [f32; 2],
    height: impl Fn(f32) -> f32,
    radius: impl Fn(f32, f32) -> f32,
) {
    model.grid(nu, nv, |u, v| {
        let angle = TAU * u;
        let radius = radius(angle, v);
        Vec3::new(x + radius * angle.cos(), height(v), z + radius * angle.sin())
    });
}

/// Fluted shaft, base, capital and the slab on top.
fn column(model: &mut Model, x: f32, z: f32) {
    let shaft = |angle: f32, v: f32| 0.42 * (1.0 - 0.15 * v) * (1.0 - 0.06 * (angle * 12.0).sin().abs());
    turned(model, [64, 16], [x, z], |v| 0.4 + 4.6 * v, shaft);
    turned(model, [48, 12], [x, z], |v| 0.05 + 0.35 * v, |_, v| 0.45 + 0.18 * (v * PI).sin().max(0.0).sqrt());
    turned(model, [48, 16], [x, z], |v| 5.0 + 0.7 * v, |_, v| 0.36 + 0.3 * v * v + 0.03 * (v * 20.0).sin());
    model.upright_cuboid(Vec3::new(x, 5.75, z), Vec3::new(0.7, 0.06, 0.7));
}

/// Three half tori to the next column.
fn arches(model: &mut Model, x: f32, z: f32) {
    for offset in [-0.25, 0.0, 0.25] {
        model.grid(24, 12, |u, v| {
            let (a, b) = (PI * u, TAU * v);
            let radius = 1.1 + 0.14 * b.cos();
            Vec3::new(x + 1.5 - radius * a.cos(), 5.8 + 1.2 * radius * a.sin(), z + offset + 0.14 * b.sin())
        });
    }
}

fn balusters(model: &mut Model, x: f32, z: f32) {
    for k in 0..14 {
        let x = x - 1.4 + 0.2 * k as f32;
        turned(model, [8, 6], [x, z], |v| 7.2 + 0.8 * v, |_, v| 0.03 + 0.03 * (v * PI * 2.0).sin().abs());
    }
}

/// Long thin triangles along no axis.
fn roof_beams(model: &mut Model) {
    for k in 0..20 {
        for side in [-1.0, 1.0] {
            let along = Vec3::new(0.35 * side, 0.45, 1.0).normalize();
            let across = along.cross(Vec3::Y).normalize();
            let center = Vec3::new(0.7 + 1.5 * k as f32, 8.9, 7.0 + 3.0 * side);
            model.cuboid(center, [along * 3.2, across * 0.07, across.cross(along) * 0.09]);
        }
    }
}

fn drapes(model: &mut Model, random: &mut Random) {
    for k in 0..6 {
        let (x, z) = (3.0 + 4.5 * k as f32, 4.0 + 6.0 * (k % 2) as f32);
        let phase = random.range(0.0, 6.0);
        model.grid(64, 36, |u, v| {
            let fold = 0.14 * (1.0 - 0.6 * v) * (u * 40.0 + phase + 1.5 * (v * 5.0).sin()).sin();
            Vec3::new(x - 0.9 + 1.8 * u, 5.4 - 3.4 * (1.0 - v), z + 0.75 + fold)
        });
    }
}

/// Thin slabs.
fn floor_tiles(model: &mut Model, random: &mut Random) {
    for i in 0..40 {
        for j in 0..8 {
            let half_height = 0.01 + 0.004 * random.unit();
            let center = Vec3::new(0.375 + 0.75 * i as f32, half_height, 4.4 + 0.75 * j as f32);
            model.upright_cuboid(center, Vec3::new(0.36, half_height, 0.36));
        }
    }
}

fn vases_and_balls(model: &mut Model, random: &mut Random) {
    for _ in 0..34 {
        let foot = [random.range(1.0, 29.0), random.range(1.0, 13.0)];
        let (size, waves) = (random.range(0.2, 0.6), random.range(1.0, 4.0));
        let profile = |_, v: f32| size * (0.35 + 0.3 * (v * waves).sin().abs() + 0.1 * (1.0 - v));
        turned(model, [28, 20], foot, |v| 0.02 + 2.2 * size * v, profile);
    }
    for _ in 0..24 {
        let (x, z, radius) = (random.range(1.0, 29.0), random.range(4.5, 9.5), random.range(0.1, 0.35));
        model.grid(24, 12, |u, v| {
            let (a, b) = (TAU * u, PI * v);
            let (dx, dz) = (radius * b.sin() * a.cos(), radius * b.sin() * a.sin());
            Vec3::new(x + dx, radius + 0.02 + radius * b.cos(), z + dz)
        });
    }
}

fn crates_and_rods(model: &mut Model, random: &mut Random) {
    for _ in 0..900 {
        let half = random_point(random, [0.03, 0.3], [0.03, 0.3], [0.03, 0.3]);
        let center = random_point(random, [0.5, 29.5], [0.05, 1.2], [0.8, 13.2]);
        model.random_cuboid(center, half, random);
    }
    for _ in 0..260 {
        let half = Vec3::new(random.range(0.6, 1.6), 0.012, 0.012);
        let center = random_point(random, [1.0, 29.0], [0.3, 6.5], [1.0, 13.0]);
        model.random_cuboid(center, half, random);
    }
}

/// Rings that hang from the roof, each turned against the one before.
fn chains(model: &mut Model) {
    for k in 0..10 {
        for link in 0..9 {
            let (x, y, turn) = (1.5 + 3.0 * k as f32, 9.6 - 0.22 * link as f32, (link % 2) as f32);
            model.grid(16, 8, |u, v| {
                let (a, b) = (TAU * u, TAU * v);
                let radius = 0.1 + 0.025 * b.cos();
                let (wide, thick) = (radius * a.cos(), 0.025 * b.sin());
                let x = x + wide * (1.0 - turn) + thick * turn;
                let z = 7.0 + wide * turn + thick * (1.0 - turn);
                Vec3::new(x, y + radius * a.sin() * 1.3, z)
            });
        }
    }
}
