//! `path` is `weekend` in the mean: block by block, at every depth, where light sampling helps, where it is of no use, and
//! where it cannot work.

use std::f32::consts::TAU;
use std::sync::Arc;

use eyebeam_core::color::Rgb;
use eyebeam_core::desc::SceneDesc;
use eyebeam_core::film::Image;
use eyebeam_core::integrator::IntegratorKind;
use eyebeam_core::light::{DirectionalLight, EnvironmentDesc, ImageEnvironment};
use eyebeam_core::material::{
    Bump, Conductor, Dielectric, DiffuseTransmission, Emissive, Mask, MaterialDesc, Metal, Mix, NamedMetal, NormalMap,
    OrenNayar, Plastic, Principled, Sheen, ThinDielectric, ThinFilm,
};
use eyebeam_core::names::Name;
use eyebeam_core::render::Settings;
use eyebeam_core::shape::{MeshDesc, QuadDesc};
use eyebeam_core::testing::z_test_films;
use eyebeam_core::texture::{Checker, Color, Mapping, Noise, Scalar, Space, TextureDesc};

use crate::setup::*;

fn quad(corner: [f32; 3], u: [f32; 3], v: [f32; 3], material: &str) -> QuadDesc {
    QuadDesc { corner, u, v, material: Some(material.to_owned()), ..QuadDesc::default() }
}

fn with(desc: &mut SceneDesc, name: &str, material: MaterialDesc) {
    desc.material.insert(name.to_owned(), material);
}

fn metal(roughness: f32) -> MaterialDesc {
    MaterialDesc::Metal(Metal { albedo: Rgb([0.9, 0.7, 0.4]).into(), roughness: roughness.into() })
}

fn glass() -> MaterialDesc {
    MaterialDesc::Dielectric(Dielectric::default())
}

/// A ball on a floor.
fn still_life(environment: EnvironmentDesc) -> SceneDesc {
    let mut desc = scene(environment, matte(0.7), look([0.0, 1.2, 4.0], [0.0, 0.5, 0.0], 45.0));
    desc.shape.quad.push(floor(0.0, 8.0));
    desc.shape.sphere.push(sphere([0.0, 0.5, 0.0], 0.5));
    desc
}

/// A matte room with a lamp below the ceiling: light sampling finds what chance seldom does.
fn room() -> SceneDesc {
    let mut desc = scene(DARK, matte(0.6), look([0.0, 0.0, 3.5], [0.0; 3], 45.0));
    with(&mut desc, "lamp", lamp(5.0));
    desc.shape.quad = box_quads([-1.0; 3], [1.0; 3]);
    desc.shape.quad.remove(5);
    desc.shape.quad.push(quad([-0.5, 0.99, -0.5], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0], "lamp"));
    desc.shape.sphere.push(sphere([0.3, -0.6, 0.2], 0.4));
    desc
}

/// An even sky, which is not sampled.
fn outside() -> SceneDesc {
    let mut desc = still_life(EnvironmentDesc::default());
    with(&mut desc, "rough", metal(0.4));
    desc.shape.sphere.push(sphere([1.1, 0.5, 0.0], 0.5));
    desc.shape.sphere[1].material = Some("rough".to_owned());
    desc
}

/// A lamp inside a ball of glass, and one seen in a mirror: shadow rays never reach them.
fn behind_glass() -> SceneDesc {
    let mut desc = still_life(DARK);
    for (name, material) in [("lamp", lamp(8.0)), ("glass", glass()), ("mirror", metal(0.0))] {
        with(&mut desc, name, material);
    }
    for (center, radius, name) in
        [([1.2, 0.9, 0.4], 0.85, "glass"), ([1.2, 0.9, 0.4], 0.6, "lamp"), ([-1.3, 0.6, 0.0], 0.6, "mirror")]
    {
        desc.shape.sphere.push(sphere(center, radius));
        desc.shape.sphere.last_mut().unwrap().material = Some(name.to_owned());
    }
    desc
}

/// Rough metal under large and small lamps of every shape, one of which shines on both sides.
fn lamps() -> SceneDesc {
    let mut desc = still_life(DARK);
    for (name, material) in [("it", metal(0.5)), ("lamp", lamp(4.0)), ("dim", lamp(1.5))] {
        with(&mut desc, name, material);
    }
    let both = Emissive { radiance: Rgb([1.0, 2.0, 3.0]).into(), albedo: Rgb::grey(0.5).into(), two_sided: true };
    with(&mut desc, "both", MaterialDesc::Emissive(both));
    desc.shape.sphere.push(sphere([-1.5, 1.5, -0.5], 0.6));
    desc.shape.sphere[1].material = Some("lamp".to_owned());
    desc.shape.quad.push(quad([1.0, 0.3, -1.0], [0.5, 1.0, 0.0], [0.0, 0.6, 1.5], "both"));
    desc.shape.quad.push(quad([-1.0, 3.0, -1.0], [2.0, 0.0, 0.0], [0.0, 0.0, 2.0], "dim"));
    desc.shape.mesh.push(MeshDesc {
        vertices: vec![[0.5, 2.0, 1.0], [2.0, 2.2, 1.0], [1.0, 1.5, -1.5], [-1.0, 2.5, -2.0]],
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        material: Some("lamp".to_owned()),
        ..MeshDesc::default()
    });
    desc
}

/// Materials made of others, lamps that shine in patterns, and lamps within what absorbs light.
fn worn() -> SceneDesc {
    let mut desc = still_life(EnvironmentDesc::default());
    let named = |name: &str| Name::new(name);
    let squares = |even: [f32; 3], odd: [f32; 3]| {
        let mapping = Mapping { space: Some(Space::Uv), scale: [6.0; 3], ..Mapping::default() };
        TextureDesc::Checker(Checker { even: Rgb(even).into(), odd: Rgb(odd).into(), mapping })
    };
    desc.texture.insert("panes".to_owned(), squares([6.0, 5.0, 4.0], [0.5, 1.0, 2.0]));
    desc.texture.insert("squares".to_owned(), squares([1.0; 3], [0.2; 3]));
    desc.texture.insert("slopes".to_owned(), squares([0.3, 0.5, 0.9], [0.6, 0.7, 0.9]));
    desc.texture.insert("dents".to_owned(), TextureDesc::Noise(Noise::default()));
    let texture = |name: &str| Scalar::Texture(named(name));
    let absorbing = |eta, roughness: f32| {
        let absorption = Some(Rgb([0.5, 2.0, 4.0]));
        MaterialDesc::Dielectric(Dielectric { eta, roughness: roughness.into(), absorption, ..Dielectric::default() })
    };
    let panes = Emissive { radiance: Color::Texture(named("panes")), two_sided: true, ..Emissive::default() };
    for (name, material) in [
        ("panes", MaterialDesc::Emissive(panes)),
        ("window", MaterialDesc::Mask(Mask::new(named("panes"), texture("squares")))),
        ("rough", metal(0.4)),
        ("floor", MaterialDesc::Mix(Mix { a: named("rough"), b: named("default"), share: texture("squares") })),
        ("net", MaterialDesc::Mask(Mask::new(named("floor"), texture("squares")))),
        ("dented", MaterialDesc::Bump(Bump { of: named("rough"), height: texture("dents"), scale: 0.3 })),
        (
            "tiled",
            MaterialDesc::NormalMap(NormalMap {
                of: named("dented"),
                map: Color::Texture(named("slopes")),
                strength: 1.0,
            }),
        ),
        ("smoke", absorbing(1.0, 0.0)),
        ("frosted", absorbing(1.5, 0.7)),
        ("lamp", lamp(5.0)),
    ] {
        with(&mut desc, name, material);
    }
    desc.shape.quad[0].material = Some("floor".to_owned());
    desc.shape.sphere[0].material = Some("net".to_owned());
    desc.shape.quad.push(quad([-1.0, 2.5, -1.0], [2.0, 0.0, 0.0], [0.0, 0.0, 2.0], "window"));
    for (center, radius, name) in [
        ([1.2, 0.6, 0.2], 0.6, "tiled"),
        ([-1.2, 0.6, 0.2], 0.6, "smoke"),
        ([-1.2, 0.7, 0.2], 0.25, "lamp"),
        ([-1.1, 0.2, 0.4], 0.15, "default"),
        ([0.1, 0.4, 1.2], 0.4, "frosted"),
        ([0.1, 0.3, 1.2], 0.15, "floor"),
    ] {
        desc.shape.sphere.push(sphere(center, radius));
        desc.shape.sphere.last_mut().unwrap().material = Some(name.to_owned());
    }
    desc
}

/// Frosted glass and facets of metal: lobes that both ways find.
fn frosted() -> SceneDesc {
    let mut desc = still_life(EnvironmentDesc::default());
    let frosted =
        |roughness: f32| MaterialDesc::Dielectric(Dielectric { roughness: roughness.into(), ..Dielectric::default() });
    let copper =
        Conductor { reflectance: Some(Rgb([0.9, 0.6, 0.4]).into()), roughness: 0.6.into(), ..Conductor::default() };
    let gold =
        Conductor { metal: Some(NamedMetal::Gold), roughness: 0.5.into(), anisotropy: 0.6, ..Conductor::default() };
    for (name, material) in [
        ("lamp", lamp(4.0)),
        ("frosted", frosted(0.6)),
        ("copper", MaterialDesc::Conductor(copper)),
        ("gold", MaterialDesc::Conductor(gold)),
    ] {
        with(&mut desc, name, material);
    }
    desc.shape.quad.push(quad([-1.0, 3.0, -1.0], [2.0, 0.0, 0.0], [0.0, 0.0, 2.0], "lamp"));
    for (center, name) in [([1.2, 0.6, 0.2], "frosted"), ([-1.2, 0.6, 0.2], "copper"), ([0.0, 0.4, 1.2], "gold")] {
        desc.shape.sphere.push(sphere(center, center[1]));
        desc.shape.sphere.last_mut().unwrap().material = Some(name.to_owned());
    }
    desc
}

/// Frosted and layered glass that bends colours differently, one within the other, and a lamp that shines through it.
fn dispersive() -> SceneDesc {
    let mut desc = still_life(EnvironmentDesc::default());
    let flint = |roughness: f32, priority| {
        let roughness = roughness.into();
        MaterialDesc::Dielectric(Dielectric {
            eta: 1.7,
            abbe_number: Some(5.0),
            roughness,
            priority,
            ..Dielectric::default()
        })
    };
    let layers = Principled {
        transmission_weight: 1.0.into(),
        specular_roughness: 0.6.into(),
        specular_ior: 2.0,
        transmission_dispersion_scale: 1.0,
        transmission_dispersion_abbe_number: 4.0,
        coat_weight: 0.5.into(),
        ..Principled::default()
    };
    for (name, material) in [
        ("lamp", lamp(4.0)),
        ("frosted", flint(0.6, 2)),
        ("smooth", flint(0.0, 1)),
        ("layers", MaterialDesc::Principled(layers.into())),
    ] {
        with(&mut desc, name, material);
    }
    desc.shape.quad.push(quad([-1.0, 3.0, -1.0], [2.0, 0.0, 0.0], [0.0, 0.0, 2.0], "lamp"));
    for (center, radius, name) in [
        ([1.2, 0.6, 0.2], 0.6, "frosted"),
        ([1.2, 0.6, 1.0], 0.5, "smooth"),
        ([-1.2, 0.6, 0.2], 0.6, "layers"),
        ([0.0, 0.4, 1.2], 0.4, "frosted"),
    ] {
        desc.shape.sphere.push(sphere(center, radius));
        desc.shape.sphere.last_mut().unwrap().material = Some(name.to_owned());
    }
    desc
}

/// Plaster, velvet, and a lamp in front of and behind a pane and a sheet of paper.
fn matte_and_thin() -> SceneDesc {
    let mut desc = still_life(EnvironmentDesc::default());
    let plaster = OrenNayar { albedo: Rgb([0.9, 0.6, 0.4]).into(), roughness: 1.0.into() };
    let velvet =
        Sheen { color: Rgb([0.9, 0.5, 0.2]).into(), roughness: 0.4.into(), albedo: Rgb([0.2, 0.3, 0.6]).into() };
    let paper =
        DiffuseTransmission { reflectance: Rgb([0.3, 0.5, 0.2]).into(), transmittance: Rgb([0.6, 0.3, 0.5]).into() };
    let pane = ThinDielectric { eta: 1.5, color: Rgb([0.5, 0.9, 0.7]).into() };
    for (name, material) in [
        ("lamp", lamp(4.0)),
        ("plaster", MaterialDesc::OrenNayar(plaster)),
        ("velvet", MaterialDesc::Sheen(velvet)),
        ("paper", MaterialDesc::DiffuseTransmission(paper)),
        ("pane", MaterialDesc::ThinDielectric(pane)),
    ] {
        with(&mut desc, name, material);
    }
    desc.shape.quad.push(quad([-1.0, 3.0, -1.0], [2.0, 0.0, 0.0], [0.0, 0.0, 2.0], "lamp"));
    desc.shape.quad.push(quad([-0.4, 0.2, 1.0], [0.8, 0.1, 0.0], [0.0, 0.5, 0.2], "paper"));
    desc.shape.quad.push(quad([0.6, 0.0, 1.0], [0.8, 0.0, 0.3], [0.0, 1.2, 0.0], "pane"));
    for (x, name) in [(1.2, "plaster"), (-1.2, "velvet")] {
        desc.shape.sphere.push(sphere([x, 0.6, 0.2], 0.6));
        desc.shape.sphere.last_mut().unwrap().material = Some(name.to_owned());
    }
    desc
}

/// Layers and films, mirrors over something matte, and a lamp that is lacquered.
fn layered() -> SceneDesc {
    let mut desc = still_life(EnvironmentDesc::default());
    let ball = Plastic { albedo: Rgb([0.8, 0.3, 0.1]).into(), ..Plastic::default() };
    let oxide = Some(ThinFilm { thickness: 300.0, eta: 2.0 });
    let steel = Conductor { thin_film: oxide, roughness: 0.6.into(), ..Conductor::default() };
    let layers = Principled {
        base_metalness: 0.3.into(),
        transmission_weight: 0.5.into(),
        coat_weight: 0.5.into(),
        fuzz_weight: 0.5.into(),
        specular_roughness: 0.5.into(),
        ..Principled::default()
    };
    let lamp = Principled {
        coat_weight: 1.0.into(),
        emission_luminance: 800.0,
        emission_color: Rgb([1.0, 0.8, 0.6]).into(),
        ..Principled::default()
    };
    for (name, material) in [
        ("lamp", MaterialDesc::Principled(lamp.into())),
        ("ball", MaterialDesc::Plastic(ball)),
        ("steel", MaterialDesc::Conductor(steel)),
        ("layers", MaterialDesc::Principled(layers.into())),
    ] {
        with(&mut desc, name, material);
    }
    desc.shape.quad.push(quad([-1.0, 3.0, -1.0], [2.0, 0.0, 0.0], [0.0, 0.0, 2.0], "lamp"));
    for (center, name) in [([1.2, 0.6, 0.2], "ball"), ([-1.2, 0.6, 0.2], "steel"), ([0.0, 0.4, 1.2], "layers")] {
        desc.shape.sphere.push(sphere(center, center[1]));
        desc.shape.sphere.last_mut().unwrap().material = Some(name.to_owned());
    }
    desc
}

/// Inside of a ball that shines inwards, and a lamp so close to the floor that it fills most of its sky.
fn enclosed() -> SceneDesc {
    let mut desc = still_life(DARK);
    let both = Emissive { radiance: Rgb([0.2, 0.3, 0.4]).into(), albedo: Rgb::grey(0.4).into(), two_sided: true };
    with(&mut desc, "shell", MaterialDesc::Emissive(both));
    with(&mut desc, "lamp", lamp(2.0));
    desc.shape.sphere.push(sphere([0.0; 3], 6.0));
    desc.shape.sphere[1].material = Some("shell".to_owned());
    desc.shape.quad.push(quad([-2.0, 0.02, -1.0], [1.5, 0.0, 0.0], [0.0, 0.0, 2.0], "lamp"));
    desc
}

/// A picture of the sky with bright spots, turned, over matte, metal and glass.
fn panorama() -> SceneDesc {
    let (width, height) = (64, 32);
    let mut image = Image::new(width, height);
    for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
        let near = |cx: f32, cy: f32| (-((x as f32 - cx).powi(2) + (y as f32 - cy).powi(2)) / 8.0).exp();
        let base = 0.2 + 0.1 * (x as f32 / width as f32 * TAU).sin();
        let (a, b) = (near(20.0, 8.0), near(50.0, 14.0));
        image.set_pixel(x, y, [base + 30.0 * a, base + 20.0 * a + 5.0 * b, base + 10.0 * a + 15.0 * b]);
    }
    let file = "sky".to_owned();
    let map = ImageEnvironment { file, rotation: 40.0, scale: 0.7, image: Some(Arc::new(image)) };
    let mut desc = outside();
    desc.environment = EnvironmentDesc::Image(map);
    with(&mut desc, "glass", glass());
    desc.shape.sphere.push(sphere([-1.1, 0.5, 0.2], 0.5));
    desc.shape.sphere[2].material = Some("glass".to_owned());
    desc
}

/// A large sun and a lamp, which share the shadow rays, over a mesh that looks round.
fn sun() -> SceneDesc {
    let mut desc = still_life(EnvironmentDesc::default());
    let direction = [0.6, 0.7, 0.3];
    desc.light.directional.push(DirectionalLight { direction, irradiance: Rgb([3.0, 2.5, 2.0]), angle: 25.0 });
    with(&mut desc, "lamp", lamp(6.0));
    with(&mut desc, "glass", glass());
    desc.shape.sphere.push(sphere([-1.3, 1.0, 0.0], 0.4));
    desc.shape.sphere[1].material = Some("lamp".to_owned());
    for (x, material) in [(1.0, "it"), (-0.6, "glass")] {
        let mut ball = octahedron([x, 0.6, 0.8], 0.5);
        ball.material = Some(material.to_owned());
        desc.shape.mesh.push(ball);
    }
    desc
}

/// Eight triangles with the normals of a ball.
fn octahedron(center: [f32; 3], radius: f32) -> MeshDesc {
    let normals =
        vec![[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, -1.0]];
    let vertex = |n: &[f32; 3]| std::array::from_fn(|i| center[i] + radius * n[i]);
    let corner = |i: u32, axis: u32| 2 * axis + (i >> axis & 1);
    let triangle = |i: u32| {
        let [x, y, z] = [0, 1, 2].map(|axis| corner(i, axis));
        if i.count_ones().is_multiple_of(2) { [x, y, z] } else { [x, z, y] }
    };
    MeshDesc {
        vertices: normals.iter().map(vertex).collect(),
        triangles: (0..8).map(triangle).collect(),
        normals,
        material: Some("it".to_owned()),
        ..MeshDesc::default()
    }
}

fn check(name: &str, desc: &SceneDesc) {
    for (max_depth, spp) in [(1, 16), (2, 512), (3, 512), (50, 512)] {
        let weekend = Settings { height: 24, seed: 3, ..settings(32, spp, max_depth) };
        let path = Settings { integrator: IntegratorKind::Path, seed: 4, ..weekend.clone() };
        let name = format!("{name} at depth {max_depth}");
        let (path, weekend) = (render(desc, path), render(desc, weekend));
        for block in [8, 32] {
            z_test_films(&path, &weekend, block).unwrap_or_else(|e| panic!("{name}, blocks of {block}: {e}"));
        }
    }
}

#[test]
fn where_light_sampling_helps() {
    check("room", &room());
    check("lamps", &lamps());
    check("panorama", &panorama());
    check("sun", &sun());
    check("frosted", &frosted());
    check("dispersive", &dispersive());
    check("matte and thin", &matte_and_thin());
    check("layered", &layered());
    check("worn", &worn());
}

#[test]
fn where_light_sampling_is_useless() {
    check("outside", &outside());
    check("enclosed", &enclosed());
}

#[test]
fn where_light_sampling_is_impossible() {
    check("behind glass", &behind_glass());
}
