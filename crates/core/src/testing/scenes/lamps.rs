//! A floor under lamps.

use std::f64::consts::PI;
use std::sync::Arc;

use glam::DVec3;

use super::KnownScene;
use super::build::*;
use crate::color::Rgb;
use crate::desc::SceneDesc;
use crate::film::Image;
use crate::light::{IesLight, IesProfile, PointLight, ProjectorLight, SpotLight};
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
        over("tilted luminaire", luminaire_tilted).hidden(),
        over("turned luminaire", luminaire_turned).hidden(),
        over("projector", projector).hidden(),
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

const LUMINAIRE: DVec3 = DVec3::new(0.9, 1.1, -0.6);

/// A luminaire, and what its candela towards the origin bring there: over the efficacy of light that is even from 370 to
/// 730 nm, and times cos θ / d².
fn luminaire(desc: &mut SceneDesc, nadir: DVec3, rotation: f32, profile: IesProfile, candela: f64) -> f64 {
    desc.light.ies.push(IesLight {
        file: String::new(),
        position: LUMINAIRE.as_vec3().into(),
        direction: nadir.as_vec3().into(),
        rotation,
        scale: 2.0,
        color: Rgb::grey(1.0),
        profile: Some(Arc::new(profile)),
    });
    2.0 * candela * 360.0 / (683.0 * 106.86) * LUMINAIRE.y / LUMINAIRE.length().powi(3)
}

/// 900 cd · (1 − θ / 120°), which interpolation of two values hits at all angles.
fn luminaire_tilted(desc: &mut SceneDesc) -> f64 {
    let nadir = DVec3::new(0.2, -1.0, 0.7);
    let profile = profile(&[0.0, 120.0], &[0.0], |theta, _| 900.0 * (1.0 - theta / 120.0));
    let theta = nadir.angle_between(-LUMINAIRE).to_degrees();
    luminaire(desc, nadir, 0.0, profile, 900.0 * (1.0 - theta / 120.0))
}

/// (100 + 7 θ) (1 + φ / 60°) cd up to φ = 180°, mirrored beyond. From above the lamp the origin is between −x and +z,
/// 180° + atan(0.6 / 0.9) around it.
fn luminaire_turned(desc: &mut SceneDesc) -> f64 {
    const TURN: f32 = 30.0;
    let candela = |theta: f64, phi: f64| (100.0 + 7.0 * theta) * (1.0 + phi / 60.0);
    let profile = profile(&[0.0, 45.0, 90.0], &[0.0, 90.0, 180.0], candela);
    let theta = DVec3::Y.angle_between(LUMINAIRE).to_degrees();
    let phi = 180.0 + (-LUMINAIRE.z).atan2(LUMINAIRE.x).to_degrees() - f64::from(TURN);
    luminaire(desc, DVec3::NEG_Y, TURN, profile, candela(theta, phi.min(360.0 - phi)))
}

/// A function of two angles as a table. If it is linear in each, the table is the function.
fn profile(vertical: &[f32], horizontal: &[f32], candela: impl Fn(f64, f64) -> f64) -> IesProfile {
    let column = |&phi: &f32| vertical.iter().map(move |&theta| (theta, phi)).collect::<Vec<_>>();
    let places = horizontal.iter().flat_map(column);
    let candela = places.map(|(theta, phi)| candela(theta.into(), phi.into()) as f32).collect();
    IesProfile::new(vertical.to_vec(), horizontal.to_vec(), candela).expect("the angles ascend")
}

/// A picture twice as wide as high, thrown from the side, that is linear between the middles of its pixels.
fn projector(desc: &mut SceneDesc) -> f64 {
    let [position, look_at, up] = [[0.7, 1.4, -0.5], [-0.1, 0.0, 0.08], [0.0, 1.0, 0.0]];
    let mut image = Image::new(4, 2);
    let value = |x: f64, y: f64| 1.0 + 0.5 * x + 2.0 * y;
    for (x, y) in (0..2).flat_map(|y| (0..4).map(move |x| (x, y))) {
        image.set_pixel(x, y, [value(x.into(), y.into()) as f32; 3]);
    }
    let (file, image) = (String::new(), Some(Arc::new(image)));
    desc.light.projector.push(ProjectorLight { file, position, look_at, up, fov: 60.0, scale: 3.0, image });
    let [p, at, up] = [position, look_at, up].map(|v: [f32; 3]| DVec3::from(v.map(f64::from)));
    let forward = (at - p).normalize();
    let right = forward.cross(up).normalize();
    // Where the origin is, in pixels from the middle of the first: half the picture is as wide as the tangent of 30°.
    let along = |axis: DVec3| (-p).dot(axis) / (-p).dot(forward) * 3.0_f64.sqrt();
    let (x, y) = (2.0 + 2.0 * along(right) - 0.5, 1.0 - 2.0 * along(right.cross(forward)) - 0.5);
    debug_assert!((0.0..3.0).contains(&x) && (0.0..1.0).contains(&y), "{x}, {y} is beyond the pixels' middles");
    3.0 * value(x, y) * p.y / p.length().powi(3)
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
