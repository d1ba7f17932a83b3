//! The film's own error against the deviation from a picture with far more samples.

use eyebeam_core::color::Rgb;
use eyebeam_core::desc::SceneDesc;
use eyebeam_core::light::EnvironmentDesc;
use eyebeam_core::render::Settings;

use crate::setup::*;

/// A matte ball on a floor under a large lamp: noise that is far from rare events, so that means are normal.
fn still_life() -> SceneDesc {
    let mut desc = scene(EnvironmentDesc::default(), matte(0.7), look([0.0, 1.0, 4.0], [0.0, 0.5, 0.0], 40.0));
    desc.material.insert("lamp".to_owned(), lamp(4.0));
    desc.shape.quad.push(floor(0.0, 20.0));
    desc.shape.sphere.push(sphere([0.0, 0.5, 0.0], 0.5));
    desc.shape.sphere.push(sphere([0.0, 15.0, 0.0], 10.0));
    desc.shape.sphere[1].material = Some("lamp".to_owned());
    desc
}

#[test]
fn the_film_knows_its_error() {
    const SIDE: u32 = 24;
    let desc = still_life();
    let truth = render(&desc, settings(SIDE, 16_384, 5));
    let (image, error) = (truth.develop(), standard_errors(&truth, SIDE));
    let luminance = |pixel| f64::from(Rgb(pixel).luminance());
    let floor = 0.01 * image.pixels().iter().map(|&p| luminance(p)).sum::<f64>() / f64::from(SIDE * SIDE);
    let (mut z_sq, mut relative, mut reported, mut n) = (0.0, 0.0, 0.0, 0.0);
    for seed in 100..108 {
        let film = render(&desc, Settings { seed, ..settings(SIDE, 256, 5) });
        let (own, own_error) = (film.develop(), standard_errors(&film, SIDE));
        for (x, y) in (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| (x, y))) {
            let deviation = luminance(own.pixel(x, y)) - luminance(image.pixel(x, y));
            z_sq += deviation.powi(2) / (own_error(x, y).powi(2) + error(x, y).powi(2) + 1e-12);
            relative += deviation.abs() / (luminance(image.pixel(x, y)) + floor);
            n += 1.0;
        }
        reported += film.error().unwrap().mean / 8.0;
    }
    // The mean of n squares of normal variables is 1 ± √(2/n); of n absolute values √(2/π).
    let (z_sq, actual) = (z_sq / n, relative / n * (std::f64::consts::PI / 2.0).sqrt());
    assert!((z_sq - 1.0).abs() < 5.0 * (2.0_f64 / n).sqrt(), "z² is {z_sq} on average");
    assert!((actual / reported - 1.0).abs() < 0.05, "the film says {reported}, the deviation {actual}");
}
