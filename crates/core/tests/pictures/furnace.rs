//! Light is the same everywhere: what loses none cannot be told from the background.

use eyebeam_core::color::Rgb;
use eyebeam_core::material::{Dielectric, DiffuseTransmission, Emissive, MaterialDesc, Metal, ThinDielectric};

use crate::setup::*;

fn mirror() -> MaterialDesc {
    MaterialDesc::Metal(Metal { albedo: Rgb::grey(1.0).into(), roughness: 0.0.into() })
}

#[test]
fn white_balls_vanish() {
    for (name, material) in [("matte", matte(1.0)), ("mirror", mirror())] {
        let mut desc = scene(WHITE, material, look([0.0, 0.0, 3.0], [0.0; 3], 60.0));
        desc.shape.sphere.push(sphere([0.0; 3], 1.0));
        assert_every_way(&desc, &settings(64, 64, 50), 1.0, 0.0, name);
    }
}

/// So does a hollow one of what light comes through, however often it goes to and fro inside.
#[test]
fn thin_balls_vanish() {
    let half = Rgb::grey(0.5);
    let sheet =
        MaterialDesc::DiffuseTransmission(DiffuseTransmission { reflectance: half.into(), transmittance: half.into() });
    for (name, material) in [("sheet", sheet), ("pane", MaterialDesc::ThinDielectric(ThinDielectric::default()))] {
        let mut desc = scene(WHITE, material, look([0.0, 0.0, 3.0], [0.0; 3], 60.0));
        desc.shape.sphere.push(sphere([0.0; 3], 1.0));
        assert_every_way(&desc, &settings(32, 64, 10_000), 1.0, 0.0, name);
    }
}

/// Refraction changes radiance by eta² on the way in and back on the way out.
#[test]
fn glass_vanishes() {
    for eta in [1.0, 1.33, 1.5, 2.42, 0.8] {
        let glass = MaterialDesc::Dielectric(Dielectric { eta, ..Dielectric::default() });
        let mut desc = scene(WHITE, glass, look([0.0, 0.0, 3.0], [0.0; 3], 50.0));
        desc.shape.sphere.push(sphere([0.0; 3], 1.0));
        assert_every_way(&desc, &settings(32, 64, 10_000), 1.0, 1e-6, "ball");
        let inside = MaterialDesc::Dielectric(Dielectric { eta: 1.0 / eta, ..Dielectric::default() });
        desc.material.insert("inside".to_owned(), inside);
        let mut bubble = sphere([0.0; 3], 0.9);
        bubble.material = Some("inside".to_owned());
        desc.shape.sphere.push(bubble);
        assert_every_way(&desc, &settings(32, 64, 10_000), 1.0, 2e-6, "hollow ball");
    }
}

/// Under water the sky is brighter by eta²: the same light comes from a smaller solid angle.
#[test]
fn glass_is_brighter_inside() {
    for eta in [1.33_f32, 1.5, 2.42] {
        let glass = MaterialDesc::Dielectric(Dielectric { eta, ..Dielectric::default() });
        let mut desc = scene(WHITE, glass, look([0.1, 0.0, 0.0], [0.0, 0.0, -1.0], 90.0));
        desc.shape.sphere.push(sphere([0.0; 3], 1.0));
        assert_every_way(&desc, &settings(16, 16, 1000), eta * eta, 1e-6, "inside");
    }
}

/// Inside a glowing ball every path brings e (1 + a + a² + ...), one term an edge; the eye is in it too.
#[test]
fn paths_have_as_many_edges_as_allowed() {
    let (e, a) = (3.0_f32, 0.6_f32);
    let emissive = Emissive { radiance: Rgb::grey(e).into(), albedo: Rgb::grey(a).into(), two_sided: true };
    let mut desc = scene(WHITE, MaterialDesc::Emissive(emissive), look([0.1, 0.2, 0.3], [1.0, 0.0, 0.0], 90.0));
    desc.shape.sphere.push(sphere([0.0; 3], 1.0));
    for depth in [0, 1, 2, 3, 10] {
        let expected = e * (1.0 - a.powi(depth)) / (1.0 - a);
        assert_every_way(&desc, &settings(16, 16, depth as u32), expected, 1e-6, &format!("depth {depth}"));
    }
}

/// The same in a box of quads and in one of triangles.
#[test]
fn boxes_keep_their_light() {
    let emissive = Emissive { radiance: Rgb::grey(1.0).into(), albedo: Rgb::grey(0.5).into(), two_sided: true };
    let mut desc = scene(DARK, MaterialDesc::Emissive(emissive), look([0.1, 0.2, 0.3], [1.0, 0.0, 0.0], 100.0));
    let (lo, hi) = ([-0.25, -0.75, -0.25], [0.75, 0.5, 1.0]);
    desc.shape.quad = box_quads(lo, hi);
    assert_every_way(&desc, &settings(64, 64, 20), 2.0, 1e-5, "quads");
    desc.shape.quad.clear();
    desc.shape.mesh.push(box_mesh(lo, hi));
    assert_every_way(&desc, &settings(64, 64, 20), 2.0, 1e-5, "triangles");
}

/// A camera has no body: a mirror that faces it shows what is behind.
#[test]
fn cameras_are_not_seen() {
    let mut desc = scene(WHITE, mirror(), look([0.0, 1.0, 0.0], [0.0; 3], 40.0));
    desc.camera.aperture = Some(0.5);
    desc.shape.quad.push(floor(0.0, 10.0));
    assert_every_way(&desc, &settings(16, 16, 2), 1.0, 0.0, "mirror");
}
