//! What materials cost: a floor of each that fills the picture, under a lamp and an even sky.

use std::error::Error;

use eyebeam_core::desc::SceneDesc;
use eyebeam_core::scene::Scene;
use eyebeam_io::scene::read_str;

use crate::measure::nanoseconds_a_sample;

/// What a floor is made of, by its name: `[material.floor…]` and what that needs.
const MATERIALS: &[(&str, &str)] = &[
    ("lambertian", "floor.lambertian.albedo = 0.5"),
    ("oren-nayar", "floor.oren-nayar = { albedo = 0.5, roughness = 0.7 }"),
    ("diffuse-transmission", "floor.diffuse-transmission = {}"),
    ("sheen", "floor.sheen = {}"),
    ("metal", "floor.metal.roughness = 0.3"),
    ("conductor, a mirror", "floor.conductor.metal = \"gold\""),
    ("conductor, rough", "floor.conductor = { metal = \"gold\", roughness = 0.4 }"),
    ("conductor, single scattering", "floor.conductor = { metal = \"gold\", roughness = 0.4, compensation = false }"),
    ("conductor, brushed", "floor.conductor = { metal = \"gold\", roughness = 0.4, anisotropy = 0.8 }"),
    ("dielectric, smooth", "floor.dielectric = {}"),
    ("dielectric, rough", "floor.dielectric.roughness = 0.4"),
    ("dielectric, absorbing", "floor.dielectric.absorption = 1"),
    ("thin-dielectric", "floor.thin-dielectric = {}"),
    ("plastic, smooth", "floor.plastic = {}"),
    ("plastic, rough", "floor.plastic.roughness = 0.3"),
    ("principled, matte", "floor.principled = {}"),
    ("principled, metal", "floor.principled.base_metalness = 1"),
    ("principled, coated", "floor.principled.coat_weight = 1"),
    ("principled, coat and fuzz", "floor.principled = { coat_weight = 1, fuzz_weight = 0.5 }"),
    ("emissive", "floor.emissive.albedo = 0.5"),
    ("null, over a matte floor", "floor.null = {}"),
    ("mix of two matte", "floor.mix = { a = \"matte\", b = \"matte\" }"),
    ("mask of a matte, opaque", "floor.mask = { of = \"matte\", opacity = 1 }"),
    ("normal map of a matte", "floor.normal-map = { of = \"matte\", map = [0.6, 0.5, 0.9] }"),
    ("bump of a matte, by noise", "floor.bump = { of = \"matte\", height = \"noise\" }"),
];

/// All but the material.
const SCENE: &str = r#"
[render]
width = 128
height = 128
spp = 16
max_depth = 2

[camera]
look_from = [0.1, 5, 0.1]
look_at = [0, 0, 0]

[environment.constant]

[texture.noise.noise]

[[shape.quad]]
corner = [-200, 0, 200]
u = [400, 0, 0]
v = [0, 0, -400]
material = "floor"

[[shape.quad]]
corner = [-200, -1, 200]
u = [400, 0, 0]
v = [0, 0, -400]
material = "matte"

[[shape.quad]]
corner = [-3, 8, -3]
u = [2, 0, 0]
v = [0, 0, 2]
material = "lamp"

[material]
lamp.emissive.radiance = 5
matte.lambertian.albedo = 0.5
"#;

/// Prints a table.
///
/// # Errors
/// If a scene cannot be read or built.
pub fn run(rounds: usize) -> Result<(), Box<dyn Error>> {
    let scenes = MATERIALS.iter().map(|(_, material)| scene(material)).collect::<Result<Vec<_>, _>>()?;
    let times = nanoseconds_a_sample(&scenes, rounds);
    println!("| material | ns a sample | times lambertian |");
    println!("|---|---|---|");
    for ((name, _), time) in MATERIALS.iter().zip(&times) {
        println!("| {name} | {time:.0} | {:.2} |", time / times[0]);
    }
    Ok(())
}

fn scene(material: &str) -> Result<(Scene, SceneDesc), Box<dyn Error>> {
    let desc = read_str("floor.toml", &format!("{SCENE}{material}\n"), &[])?.desc;
    let scene = Scene::build(&desc).map_err(|problems| format!("{problems:?}"))?;
    Ok((scene, desc))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_material_is_one() {
        for (name, material) in MATERIALS {
            assert!(scene(material).is_ok(), "{name}");
        }
    }
}
