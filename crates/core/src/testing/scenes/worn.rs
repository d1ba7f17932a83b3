//! Surfaces that are there in part, and shapes that are filled.

use super::KnownScene;
use super::build::*;
use super::glass::reflectance;
use crate::color::Rgb;
use crate::desc::SceneDesc;
use crate::light::{DirectionalLight, EnvironmentDesc, Gradient};
use crate::material::{Dielectric, Mask, MaterialDesc, Mix, Null, Principled};
use crate::names::Name;

pub(super) fn scenes() -> Vec<KnownScene> {
    let holes = [
        hole(),
        hollow(),
        shadow(),
        nothing(),
        half_and_half(),
        one_sided("white furnace, outside of a one-sided ball", 3.0, 0.0),
        one_sided("white furnace, within a one-sided ball", 0.5, 1.0),
    ];
    let filled = [0.0, 45.0, 75.0].map(plate).into_iter().chain([overlap(), wet_glass(), principled()]);
    holes.into_iter().chain(filled).collect()
}

/// A black thing of which a share is there.
fn veil(desc: &mut SceneDesc, opacity: f32) -> MaterialDesc {
    desc.material.insert("black".to_owned(), matte(0.0));
    MaterialDesc::Mask(Mask::new(Name::new("black"), opacity.into()))
}

/// A sheet with holes in front of a white sky.
fn hole() -> KnownScene {
    let mut desc = empty(WHITE, stare([0.3, 2.0, 0.1], [0.3, 0.0, 0.1]));
    let material = veil(&mut desc, 0.3);
    add_quad(&mut desc, floor(0.0), "veil", material);
    KnownScene::new("white furnace, sheet with holes", desc, 2, 0.7)
}

/// Through a ball with holes one looks twice.
fn hollow() -> KnownScene {
    let mut desc = empty(WHITE, stare([0.0, 0.0, 3.0], [0.2, 0.3, 0.0]));
    let material = veil(&mut desc, 0.4);
    add_sphere(&mut desc, [0.0; 3], 1.0, "veil", material);
    KnownScene::new("white furnace, ball with holes", desc, 2, 0.36)
}

/// A floor in the sun under a sheet with holes.
fn shadow() -> KnownScene {
    let mut desc = lit_floor(DARK);
    let sun = DirectionalLight { direction: [0.0, 1.0, 0.0], irradiance: Rgb::grey(3.0), angle: 0.0 };
    desc.light.directional.push(sun);
    let material = veil(&mut desc, 0.25);
    add_quad(&mut desc, floor(2.0), "veil", material);
    KnownScene::new("floor below a sheet with holes", desc, 2, floor_at(3.0 * 0.75)).hidden()
}

/// A black ball that has an outside only, seen from a place on the z axis.
fn one_sided(name: &str, z: f32, expected: f64) -> KnownScene {
    let mut desc = empty(WHITE, stare([0.0, 0.0, z], [0.1, 0.2, 0.0]));
    desc.material.insert("black".to_owned(), matte(0.0));
    add_sphere(&mut desc, [0.0; 3], 1.0, "front", MaterialDesc::Mask(Mask::one_sided(Name::new("black"))));
    KnownScene::new(name, desc, 2, expected)
}

/// What is not there is not seen, and casts no shadow.
fn nothing() -> KnownScene {
    let mut desc = lit_floor(WHITE);
    add_sphere(&mut desc, [0.0; 3], 1.0, "nothing", MaterialDesc::Null(Null {}));
    KnownScene::new("floor within nothing", desc, 2, floor_at(std::f64::consts::PI))
}

/// A floor of which a quarter is white.
fn half_and_half() -> KnownScene {
    let mut desc = empty(WHITE, stare([3.0, 0.4, 0.0], [0.0; 3]));
    desc.material.insert("dark".to_owned(), matte(0.2));
    desc.material.insert("white".to_owned(), matte(1.0));
    let mix = Mix { a: Name::new("dark"), b: Name::new("white"), share: 0.25.into() };
    add_quad(&mut desc, floor(0.0), "both", MaterialDesc::Mix(mix));
    KnownScene::new("floor of two materials", desc, 2, 0.4)
}

/// Two horizontal surfaces of a filling, from one height to a lower one.
fn add_layer(desc: &mut SceneDesc, [top, bottom]: [f32; 2], name: &str, material: MaterialDesc) {
    let [[x, y, z], u, v] = floor(bottom);
    add_quad(desc, floor(top), name, material.clone());
    add_quad(desc, [[x, y, -z], u, v.map(|x| -x)], name, material);
}

/// A plate of grey glass between a sky and darker ground, all reflections within it added up.
fn plate(degrees: f64) -> KnownScene {
    let (sin, cos) = degrees.to_radians().sin_cos();
    let sky = Gradient { bottom: Rgb::grey(0.0), top: Rgb::grey(1.0) };
    let from = [0.3 + 2.0 * sin as f32, 2.0 * cos as f32, 0.1];
    let mut desc = empty(EnvironmentDesc::Gradient(sky), stare(from, [0.3, 0.0, 0.1]));
    let glass =
        Dielectric { transmittance: Some(Rgb::grey(0.5)), transmittance_distance: 0.3, ..Dielectric::default() };
    add_layer(&mut desc, [0.0, -0.2], "glass", MaterialDesc::Dielectric(glass));
    let cos_t = (1.0 - (sin / 1.5).powi(2)).sqrt();
    let (r, a) = (reflectance(cos, 1.5), 0.5_f64.powf(0.2 / 0.3 / cos_t));
    let inside = (1.0 - r).powi(2) * a / (1.0 - (r * a).powi(2));
    let [above, below] = [0.5 * (1.0 + cos), 0.5 * (1.0 - cos)];
    let expected = (r + inside * r * a) * above + inside * below;
    KnownScene::new(format!("plate of grey glass at {degrees} degrees"), desc, 200, expected)
}

/// Two fillings without surfaces of their own, one of which reaches into the other.
fn overlap() -> KnownScene {
    let mut desc = empty(WHITE, stare([0.3, 2.0, 0.1], [0.3, 0.0, 0.1]));
    let air = |absorption, priority| {
        let absorption = Some(Rgb::grey(absorption));
        MaterialDesc::Dielectric(Dielectric { eta: 1.0, absorption, priority, ..Dielectric::default() })
    };
    add_layer(&mut desc, [0.0, -0.2], "thin", air(1.0, 1));
    add_layer(&mut desc, [-0.1, -0.3], "thick", air(3.0, 2));
    KnownScene::new("smoke within smoke", desc, 20, (-0.1 * 1.0 - 0.2 * 3.0_f64).exp())
}

/// A layer that is all clear and bends nothing, and colours light on its way.
fn principled() -> KnownScene {
    let mut desc = empty(WHITE, stare([0.3, 2.0, 0.1], [0.3, 0.0, 0.1]));
    let clear = Principled {
        transmission_weight: 1.0.into(),
        transmission_color: Rgb::grey(0.5).into(),
        transmission_depth: 0.3,
        specular_ior: 1.0,
        specular_roughness: 0.0.into(),
        ..Principled::default()
    };
    add_layer(&mut desc, [0.0, -0.2], "clear", MaterialDesc::Principled(Box::new(clear)));
    KnownScene::new("principled layer", desc, 20, 0.5_f64.powf(0.2 / 0.3))
}

/// Water on glass that reaches into it: three surfaces, the one in the middle between water and glass. Reflections at right
/// angles, with the layers between them clear, add up as shares.
fn wet_glass() -> KnownScene {
    let mut desc = empty(DARK, stare([0.3, 2.0, 0.1], [0.3, 0.0, 0.1]));
    let clear = |eta, priority| MaterialDesc::Dielectric(Dielectric { eta, priority, ..Dielectric::default() });
    // What absorbs nothing but is of a priority.
    add_layer(&mut desc, [0.0, -0.2], "water", clear(1.33, 1));
    add_layer(&mut desc, [-0.1, -0.3], "glass", clear(1.5, 2));
    add_quad(&mut desc, floor(-5.0), "lamp", lamp(1.0));
    let passed = |eta: f64| 1.0 - ((eta - 1.0) / (eta + 1.0)).powi(2);
    // (1 - T) / T of a stack of layers is the sum of those of its surfaces.
    let resistance = [1.33, 1.5 / 1.33, 1.5].map(|eta| (1.0 - passed(eta)) / passed(eta)).into_iter().sum::<f64>();
    KnownScene::new("water on glass", desc, 1000, 1.0 / (1.0 + resistance))
}
