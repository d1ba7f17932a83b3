use glam::{UVec2, Vec2, Vec3};

use super::*;
use crate::material::Bsdf;
use crate::sampler::Independent;
use crate::testing::{Reciprocal, check_lobe};
use crate::texture::NoTextures;

fn rgb(r: f32, g: f32, b: f32) -> Color {
    Rgb([r, g, b]).into()
}

fn white() -> Principled {
    Principled { base_color: Rgb::grey(1.0).into(), ..Principled::default() }
}

fn metal(roughness: f32) -> Principled {
    Principled { base_metalness: 1.0.into(), specular_roughness: roughness.into(), ..white() }
}

fn glass(roughness: f32) -> Principled {
    Principled { transmission_weight: 1.0.into(), specular_roughness: roughness.into(), ..Principled::default() }
}

fn lobe(material: &Principled) -> Bsdf {
    Bsdf::Principled(material.bsdf(&NoTextures))
}

fn direction(cos: f32) -> Vec3 {
    Vec3::new(0.6 * (1.0 - cos * cos).sqrt(), 0.8 * (1.0 - cos * cos).sqrt(), cos)
}

/// The share of light from a direction of this cosine that is scattered, and its standard error; by strata.
fn share(material: &Principled, cos: f32) -> [(f64, f64); 3] {
    const SIDE: u32 = 24;
    const N: u32 = SIDE * SIDE * SIDE;
    let lobe = lobe(material);
    let (mut sum, mut squares) = ([0.0; 3], [0.0; 3]);
    for i in 0..N {
        let mut numbers = Independent::new(21, UVec2::ZERO, i);
        let place = |k: u32, u: f32| (((k % SIDE) as f32 + u) / SIDE as f32).min(1.0 - f32::EPSILON);
        let (uc, u) = (numbers.get_1d(), numbers.get_2d());
        let u = Vec2::new(place(i, u.x), place(i / SIDE, u.y));
        if let Some(s) = lobe.sample(direction(cos), place(i / SIDE / SIDE, uc), u) {
            for (c, weight) in s.weight.to_rgb().into_iter().enumerate() {
                let energy = f64::from(weight * s.eta * s.eta);
                sum[c] += energy / f64::from(N);
                squares[c] += energy * energy / f64::from(N);
            }
        }
    }
    std::array::from_fn(|c| (sum[c], ((squares[c] - sum[c] * sum[c]).max(0.0) / f64::from(N)).sqrt()))
}

#[test]
fn reciprocal_without_layers_above() {
    let plastic = Principled { base_color: rgb(0.9, 0.4, 0.1), ..Principled::default() };
    let mixed = Principled {
        base_metalness: 0.5.into(),
        base_diffuse_roughness: 0.7.into(),
        specular_roughness: 0.5.into(),
        specular_color: rgb(0.9, 0.7, 0.5),
        ..plastic.clone()
    };
    let brushed = Principled { specular_roughness_anisotropy: 0.7.into(), ..metal(0.4) };
    let smooth = Principled { specular_roughness: 0.0.into(), ..plastic.clone() };
    let frosted = Principled { transmission_weight: 0.5.into(), specular_roughness: 0.5.into(), ..plastic.clone() };
    let sheet = Principled { geometry_thin_walled: true, ..frosted.clone() };
    let pane = Principled { geometry_thin_walled: true, ..glass(0.0) };
    for material in [plastic, mixed, brushed, smooth, frosted, sheet, pane, metal(1.0), glass(0.4), glass(0.0)] {
        check_lobe(&lobe(&material), Reciprocal::Yes).unwrap();
    }
}

#[test]
fn bends_one_color() {
    let mut lobe = lobe(&Principled { coat_weight: 0.5.into(), ..glass(0.4) });
    lobe.disperse(1.04, Spectrum::from_rgb([0.1, 0.95, 0.45]));
    check_lobe(&lobe, Reciprocal::No).unwrap();
}

#[test]
fn layers() {
    let base = Principled { base_color: rgb(0.9, 0.4, 0.1), ..Principled::default() };
    let coated = Principled { coat_weight: 1.0.into(), coat_color: rgb(0.9, 0.8, 0.6), ..base.clone() };
    let rough_coat = Principled {
        coat_roughness: 0.4.into(),
        coat_weight: 0.7.into(),
        base_metalness: 0.5.into(),
        ..coated.clone()
    };
    let fuzzy = Principled { fuzz_weight: 0.8.into(), fuzz_color: rgb(0.8, 0.9, 1.0), ..base.clone() };
    let film =
        Principled { thin_film_weight: 1.0.into(), base_metalness: 0.5.into(), specular_roughness: 0.5.into(), ..base };
    let all = Principled {
        transmission_weight: 0.5.into(),
        thin_film_weight: 0.5.into(),
        fuzz_weight: 0.5.into(),
        ..rough_coat.clone()
    };
    for material in [coated, rough_coat, fuzzy, film, all] {
        check_lobe(&lobe(&material), Reciprocal::No).unwrap();
    }
}

/// A coat whose normals are not those of the surface, as steep as can be and hardly.
#[test]
fn tilted_coats() {
    for (normal, roughness) in [([0.6, 0.45, 0.95], 0.4_f32), ([0.6, 0.45, 0.95], 0.0), ([0.95, 0.5, 0.55], 0.3)] {
        let coated = Principled {
            coat_weight: 1.0.into(),
            coat_roughness: roughness.into(),
            geometry_coat_normal: Some(Rgb(normal).into()),
            specular_roughness: 0.5.into(),
            specular_roughness_anisotropy: 0.5.into(),
            specular_rotation: 20.0,
            ..white()
        };
        check_lobe(&lobe(&coated), Reciprocal::No).unwrap();
        for cos in [1.0, 0.6, 0.2] {
            assert!(share(&coated, cos).into_iter().all(|(share, error)| share < 1.01 + 3.0 * error));
        }
    }
    let smooth = Principled { coat_weight: 1.0.into(), ..white() };
    let same = Principled { geometry_coat_normal: Some(rgb(0.5, 0.5, 1.0)), ..smooth.clone() };
    let (wo, wi) = (direction(0.7), direction(0.4));
    assert_eq!(lobe(&same).eval(wo, wi).to_rgb(), lobe(&smooth).eval(wo, wi).to_rgb());
}

/// Long highlights are turned by degrees, by a texture, and by both.
#[test]
fn long_highlights_are_turned() {
    let brushed = Principled { specular_roughness_anisotropy: 0.8.into(), ..metal(0.4) };
    let (wo, wi) = (direction(0.7), direction(0.4));
    let turned = |w: Vec3, degrees: f32| Vec2::from_angle(degrees.to_radians()).rotate(w.truncate()).extend(w.z);
    let eval = |material: &Principled, by: f32| lobe(material).eval(turned(wo, by), turned(wi, by)).to_rgb()[0];
    let quarter = Some(rgb(0.5, 1.0, 0.5));
    for (specular_rotation, geometry_tangent, by) in
        [(30.0, None, 30.0), (-400.0, None, -40.0), (0.0, quarter.clone(), 90.0), (30.0, quarter, 120.0)]
    {
        let turned = Principled { specular_rotation, geometry_tangent, ..brushed.clone() };
        let (expected, found) = (eval(&brushed, 0.0), eval(&turned, by));
        assert!((found - expected).abs() < 1e-3 * expected, "{found}, not {expected}, turned by {by}");
        assert!((eval(&turned, 0.0) - expected).abs() > 0.05 * expected);
    }
}

/// A white furnace: white layers keep all light, whatever their roughness, and whatever lies above them.
#[test]
fn white_keeps_all_light() {
    let coat = |coat_roughness: f32, base: Principled| Principled {
        coat_weight: 1.0.into(),
        coat_roughness: coat_roughness.into(),
        ..base
    };
    let mut materials = vec![];
    for roughness in [0.0_f32, 0.1, 0.3, 0.6, 1.0] {
        let matte = Principled { specular_roughness: roughness.into(), ..white() };
        let fuzzy = Principled { fuzz_weight: 1.0.into(), ..matte.clone() };
        let mixed = Principled { base_metalness: 0.5.into(), specular_weight: 0.5.into(), ..matte.clone() };
        materials.extend([coat(roughness, matte.clone()), coat(0.0, metal(roughness)), coat(0.5, metal(roughness))]);
        materials.extend([matte, metal(roughness), fuzzy, mixed]);
    }
    for material in materials {
        for cos in [1.0, 0.7, 0.4, 0.15, 0.03] {
            for (share, error) in share(&material, cos) {
                let metal_loses = material.specular_weight != 1.0.into();
                let most = 1.0 + 0.01 + 3.0 * error;
                let least = if metal_loses { 0.7 } else { 0.99 - 3.0 * error };
                assert!(
                    (least..=most).contains(&share) && error < 0.01,
                    "{share} ± {error} at cosine {cos}: {material:?}"
                );
            }
        }
    }
}

/// Walls of grooves that send light to where facets let it out would make light.
#[test]
fn rough_white_makes_no_light() {
    for (diffuse, specular, ior) in
        [(1.0_f32, 0.0_f32, 1.5), (1.0, 0.3, 1.5), (1.0, 1.0, 1.5), (0.4, 0.2, 1.5), (1.0, 0.1, 3.0)]
    {
        let material = Principled {
            base_diffuse_roughness: diffuse.into(),
            specular_roughness: specular.into(),
            specular_ior: ior,
            ..white()
        };
        for cos in [1.0, 0.8, 0.6, 0.4, 0.2, 0.1] {
            let [(share, error), ..] = share(&material, cos);
            let range = 0.96 - 3.0 * error..=1.0 + 3.0 * error;
            assert!(range.contains(&share), "{share} ± {error} at {cos}, {diffuse}, {specular}, {ior}");
        }
    }
}

/// Smooth glass is smooth glass, from either side; and film keeps what does not go through.
#[test]
fn clear_glass_keeps_all_light() {
    let film = Principled { thin_film_weight: 1.0.into(), ..glass(0.0) };
    let pane = Principled { geometry_thin_walled: true, ..film.clone() };
    for material in [glass(0.0), film, pane] {
        for cos in [1.0_f32, 0.7, 0.3, 0.05, -0.9, -0.5, -0.1] {
            for (share, error) in share(&material, cos) {
                assert!((share - 1.0).abs() < 1e-3 + 3.0 * error, "{share} ± {error} at {cos}");
            }
        }
    }
}

/// A pane reflects as two boundaries, and what goes through is not bent.
#[test]
fn panes_bend_nothing() {
    let pane = Principled { geometry_thin_walled: true, ..glass(0.0) };
    for side in [1.0, -1.0] {
        let wo = Vec3::new(0.6, 0.0, 0.8 * side);
        let samples = [0.0, 1.0 - f32::EPSILON].map(|uc| lobe(&pane).sample(wo, uc, Vec2::ZERO).unwrap());
        let r = Boundary::new(0.0, 1.5).fresnel(0.8);
        let share = |s: crate::material::BsdfSample| s.weight.to_rgb()[0] * s.pdf;
        assert!(
            (share(samples[0]) - 2.0 * r / (1.0 + r)).abs() < 1e-5
                && (share(samples[0]) + share(samples[1]) - 1.0).abs() < 1e-5
        );
        assert!((samples[1].wi + wo).length() < 1e-6 && samples[1].eta == 1.0 && samples[1].delta);
    }
}

/// Schlick's form, its dip and its mean.
#[test]
fn metal_is_tinted_at_82_degrees() {
    let gold = Principled { base_color: rgb(1.0, 0.7, 0.3), specular_color: rgb(1.0, 0.9, 0.5), ..metal(0.0) };
    let at = |cos: f32| {
        let s = lobe(&gold).sample(direction(cos), 0.5, Vec2::ZERO).unwrap();
        assert!(s.delta);
        s.weight.to_rgb()
    };
    let close = |a: [f32; 3], b: [f32; 3]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-3);
    assert!(close(at(1.0), [1.0, 0.7, 0.3]) && close(at(1e-4), [1.0; 3]));
    let schlick = |f0: f32| f0 + (1.0 - f0) * (6.0_f32 / 7.0).powi(5);
    assert!(close(at(1.0 / 7.0), [1.0, 0.9 * schlick(0.7), 0.5 * schlick(0.3)]), "{:?}", at(1.0 / 7.0));
}

/// Straight on the factor is one on what is reflected; a coat darkens what is not white.
#[test]
fn weights() {
    let reflected = |specular_weight: f32| {
        let material =
            Principled { base_color: rgb(0.0, 0.0, 0.0), specular_weight: specular_weight.into(), ..white() };
        lobe(&material).albedo().to_rgb()[0]
    };
    assert!((reflected(1.0) - 0.04).abs() < 1e-3 && (reflected(0.5) - 0.02).abs() < 1e-3 && reflected(0.0) == 0.0);
    let grey = Principled { base_color: rgb(0.5, 0.5, 0.5), coat_weight: 1.0.into(), coat_ior: 1.5, ..white() };
    let undarkened = Principled { coat_darkening: 0.0, ..grey.clone() };
    let [dark, light] = [grey, undarkened].map(|m| lobe(&m).albedo().to_rgb()[0]);
    assert!(dark < 0.75 * light, "{dark} {light}");
}

/// 203 cd / m² are one W / (m² sr) of light that is even over the visible.
#[test]
fn shines() {
    let lamp = Principled { emission_luminance: 406.0, emission_color: rgb(1.0, 0.5, 0.0), ..white() };
    let le = lamp.emission().unwrap().le(Vec3::Z, &NoTextures).to_rgb();
    assert!(le.iter().zip([2.0, 1.0, 0.0]).all(|(a, b)| (a - b).abs() < 3e-3), "{le:?}");
    assert!(lamp.emission().unwrap().le(-Vec3::Z, &NoTextures).is_black() && white().emission().is_none());
}

#[test]
fn grazing_light_is_finite() {
    let coat = Principled {
        coat_weight: 1.0.into(),
        fuzz_weight: 1.0.into(),
        thin_film_weight: 1.0.into(),
        transmission_weight: 0.5.into(),
        base_metalness: 0.3.into(),
        ..white()
    };
    let nothing = Principled { base_weight: 0.0.into(), specular_weight: 0.0.into(), ..white() };
    let flat = Principled { specular_ior: 1.0, ..glass(0.7) };
    for material in [coat, nothing, flat, metal(0.0), metal(0.03), metal(1.0), glass(0.0), glass(0.03), glass(1.0)] {
        let lobe = lobe(&material);
        for z in [0.0_f32, -0.0, 1e-42, 1e-30, -1e-20, 1e-10, -1e-5, 0.3, 1.0] {
            let wo = Vec3::new((1.0 - z * z).sqrt(), 0.0, z);
            for i in 0..200 {
                let mut numbers = Independent::new(22, UVec2::ZERO, i);
                if let Some(s) = lobe.sample(wo, numbers.get_1d(), numbers.get_2d()) {
                    assert!(s.weight.to_rgb().iter().all(|w| (0.0..100.0).contains(w)), "{s:?} at {z}: {material:?}");
                    assert!(s.pdf > 0.0 && s.wi.is_finite());
                }
            }
            for wi in [Vec3::new(-1.0, 0.0, z), wo, -wo, Vec3::Z, Vec3::X, Vec3::new(-1.0, 0.0, 1e-25)] {
                let (eval, pdf) = lobe.eval_pdf(wo, wi);
                assert!(eval.to_rgb().iter().all(|e| e.is_finite() && *e >= 0.0) && pdf.is_finite() && pdf >= 0.0);
            }
        }
    }
}

/// The table of docs/theory/microfacets.md: the share of the light, in percent, that white layers scatter.
#[test]
fn documented_shares() {
    let mut table = String::from("| layers of roughness | 0° | 30° | 60° | 80° |\n|---|---|---|---|---|\n");
    for roughness in [0.2_f32, 0.6, 1.0] {
        let matte = Principled { specular_roughness: roughness.into(), ..white() };
        let coated = Principled { coat_weight: 1.0.into(), coat_roughness: roughness.into(), ..metal(roughness) };
        for (name, material) in [("matte", matte), ("metal", metal(roughness)), ("coated metal", coated)] {
            let shares = [0.0_f32, 30.0, 60.0, 80.0].map(|degrees| {
                let [(share, _), ..] = share(&material, degrees.to_radians().cos());
                format!("{:.0}", 100.0 * share)
            });
            table += &format!("| {name}, {roughness:.1} | {} |\n", shares.join(" | "));
        }
    }
    let page = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/theory/microfacets.md");
    let text = std::fs::read_to_string(page).unwrap();
    assert!(text.contains(&table), "the table of {page} should be\n\n{table}");
}
