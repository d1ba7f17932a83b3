//! A floor under lamps.

use std::f64::consts::PI;

use glam::DVec3;

use super::KnownScene;
use super::build::*;
use crate::color::Rgb;
use crate::desc::SceneDesc;
use crate::light::{PointLight, SpotLight};
use crate::shape::MeshDesc;

pub(super) fn scenes() -> Vec<KnownScene> {
    let over = |name: &str, lamp: Lamp| {
        let mut desc = lit_floor(DARK);
        let irradiance = lamp(&mut desc);
        KnownScene::new(format!("{name} over a floor"), desc, 2, floor_at(irradiance))
    };
    vec![
        over("ball", ball),
        over("rectangle", rectangle),
        over("triangle", triangle),
        over("point", point).hidden(),
        over("axis of a spot", spot_axis).hidden(),
        over("rim of a spot", spot_rim).hidden(),
        all_lamps().hidden(),
        behind_a_screen(),
        behind_a_lamp(),
    ]
}

/// Adds a lamp; returns the irradiance that it sends to the floor at the origin.
type Lamp = fn(&mut SceneDesc) -> f64;

const RADIANCE: f32 = 4.0;

/// Right below a ball of radius r at height h it is π L (r / h)².
fn ball(desc: &mut SceneDesc) -> f64 {
    let (r, h) = (0.5, 1.6);
    add_sphere(desc, [0.0, h, 0.0], r, "lamp", lamp(RADIANCE));
    PI * f64::from(RADIANCE) * f64::from(r / h).powi(2)
}

/// The form factor of a parallel rectangle above a point (Howell's catalogue, B-4, four times).
fn rectangle(desc: &mut SceneDesc) -> f64 {
    let (x, y, z) = (0.7, 1.5, 1.2);
    add_quad(desc, [[-x, y, -z], [2.0 * x, 0.0, 0.0], [0.0, 0.0, 2.0 * z]], "lamp", lamp(RADIANCE));
    let [a, b] = [x / y, z / y].map(f64::from);
    let quarter = |a: f64, b: f64| a / a.hypot(1.0) * (b / a.hypot(1.0)).atan();
    f64::from(RADIANCE) * 2.0 * (quarter(a, b) + quarter(b, a))
}

/// A tilted triangle of a mesh.
fn triangle(desc: &mut SceneDesc) -> f64 {
    let vertices = [[-1.2, 1.0, -1.0], [-0.4, 1.9, 1.1], [0.9, 1.4, -0.8]];
    desc.material.insert("lamp".to_owned(), lamp(RADIANCE));
    desc.shape.mesh.push(MeshDesc {
        vertices: vertices.to_vec(),
        triangles: vec![[0, 2, 1]],
        material: Some("lamp".to_owned()),
        ..MeshDesc::default()
    });
    f64::from(RADIANCE) * polygon(&vertices.map(|v| DVec3::from(v.map(f64::from))))
}

/// Irradiance that an even polygon of radiance 1 above the floor sends to the origin: half the sum over its edges of the
/// angle that each fills times the height of the normal of the plane through it and the origin (Lambert 1760).
fn polygon(vertices: &[DVec3]) -> f64 {
    let next = vertices.iter().cycle().skip(1);
    let edge = |(a, b): (&DVec3, &DVec3)| a.angle_between(*b) * a.cross(*b).normalize().y;
    0.5 * vertices.iter().zip(next).map(edge).sum::<f64>().abs()
}

/// I cos θ / d².
fn point(desc: &mut SceneDesc) -> f64 {
    let (position, intensity) = ([0.9, 1.1, -0.6], 3.0);
    desc.light.point.push(PointLight { position, intensity: Rgb::grey(intensity) });
    let p = DVec3::from(position.map(f64::from));
    f64::from(intensity) * p.y / p.length().powi(3)
}

fn spot_axis(desc: &mut SceneDesc) -> f64 {
    spot(desc, [0.0; 3], 1.0)
}

/// In the middle of the rim's cosines there is half of the light.
fn spot_rim(desc: &mut SceneDesc) -> f64 {
    let middle = 0.5 * (20.0_f64.to_radians().cos() + 30.0_f64.to_radians().cos());
    let aside = SPOT_HEIGHT * (1.0 - middle * middle).sqrt() / middle;
    spot(desc, [0.0, 0.0, aside as f32], 0.5)
}

const SPOT_HEIGHT: f64 = 1.2;

/// A spot straight above that looks at a point of the floor, and sends a share of its light to the origin.
fn spot(desc: &mut SceneDesc, look_at: [f32; 3], share: f64) -> f64 {
    let (position, intensity) = ([0.0, SPOT_HEIGHT as f32, 0.0], Rgb::grey(5.0));
    desc.light.spot.push(SpotLight { position, look_at, intensity, inner: Some(20.0), outer: 30.0 });
    share * 5.0 / SPOT_HEIGHT.powi(2)
}

/// Lamps of all kinds at once: whichever is asked, the sum is that of all.
fn all_lamps() -> KnownScene {
    let mut desc = lit_floor(DARK);
    let mut irradiance = [triangle, point, spot_axis].map(|lamp| lamp(&mut desc)).iter().sum::<f64>();
    // Beside the others, and so far to the side that nothing is in front of anything.
    let (center, r) = ([-6.0, 2.0, 1.0], 0.8);
    add_sphere(&mut desc, center, r, "ball", lamp(20.0));
    let to = DVec3::from(center.map(f64::from));
    irradiance += PI * 20.0 * (f64::from(r) / to.length()).powi(2) * to.y / to.length();
    let wall = [[5.0, 0.5, -3.0], [0.0, 0.0, 2.0], [0.0, 1.5, 0.0]];
    add_quad(&mut desc, wall, "wall", lamp(10.0));
    let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let [corner, u, v] = wall.map(|x: [f32; 3]| DVec3::from(x.map(f64::from)));
    irradiance += 10.0 * polygon(&corners.map(|[a, b]| corner + a * u + b * v));
    KnownScene::new("five lamps over a floor", desc, 2, floor_at(irradiance))
}

/// A black screen between lamp and floor.
fn behind_a_screen() -> KnownScene {
    let mut desc = lit_floor(DARK);
    rectangle(&mut desc);
    add_quad(&mut desc, [[-10.0, 1.0, 10.0], [20.0, 0.0, 0.0], [0.0, 0.0, -20.0]], "screen", matte(0.0));
    KnownScene::new("floor behind a screen", desc, 10, 0.0)
}

/// A lamp that shines upwards leaves the floor dark.
fn behind_a_lamp() -> KnownScene {
    let mut desc = lit_floor(DARK);
    add_quad(&mut desc, [[-1.0, 1.0, 1.0], [2.0, 0.0, 0.0], [0.0, 0.0, -2.0]], "lamp", lamp(RADIANCE));
    KnownScene::new("floor behind a lamp", desc, 10, 0.0)
}
