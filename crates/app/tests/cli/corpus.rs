//! Other people's models with no options: each is a picture, and its model fills that well.

#[path = "../../../io/tests/shared/corpus.rs"]
mod files;

use std::path::Path;
use std::process::Output;

use crate::{Place, read_png};
use files::corpus;

/// Of the pictures, pixels.
const WIDTH: usize = 96;
const HEIGHT: usize = 72;

/// What is no picture, and what is said of it.
const REFUSED: [(&str, &str); 1] = [("points.ply", "it is a cloud of points")];

/// Its triangle has all corners on a line.
const LINE: &str = "assimp_number_formats.obj";

fn models() -> Vec<std::path::PathBuf> {
    let models = corpus("gltf", &["gltf", "glb"]).into_iter().chain(corpus("meshes", &["obj", "ply", "stl"]));
    models.collect()
}

/// A small picture of a model.
fn render(place: &Place, model: &Path, options: &str) -> Result<Vec<u8>, String> {
    let mut command = place.command(&format!("render -q -o it.png -r {WIDTH}x{HEIGHT} {options}"));
    let Output { status, stderr, .. } = command.arg(model).output().unwrap();
    match status.code() {
        Some(0) => Ok(read_png(&place.read("it.png")).2),
        code => Err(format!("{}: {code:?}\n{}", model.display(), String::from_utf8_lossy(&stderr))),
    }
}

#[test]
fn every_model_is_a_picture() {
    let place = Place::new();
    let mut wrong = Vec::new();
    for model in models() {
        let name = model.display();
        match render(&place, &model, "--spp 4") {
            Ok(pixels) => {
                let mean = pixels.iter().map(|&byte| f64::from(byte)).sum::<f64>() / pixels.len() as f64;
                let is_clipped = |pixel: &&[u8]| pixel.iter().all(|&byte| byte == 255);
                let clipped = pixels.chunks_exact(3).filter(is_clipped).count();
                if !(40.0..230.0).contains(&mean) {
                    wrong.push(format!("{name}: the mean is {mean:.0}"));
                }
                if clipped * 100 >= WIDTH * HEIGHT {
                    wrong.push(format!("{name}: {clipped} pixels are clipped"));
                }
            }
            Err(error) if REFUSED.iter().any(|(file, why)| model.ends_with(file) && error.contains(why)) => {}
            Err(error) => wrong.push(error),
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// By the alpha of the model alone, with a camera that is made up even where the file has one.
#[test]
fn every_model_fills_its_picture() {
    let place = Place::new();
    let options = "--camera auto --env none --no-ground --transparent --spp 4 -D render.max_depth=1";
    let mut wrong = Vec::new();
    for model in models().into_iter().filter(|model| !model.ends_with(LINE)) {
        let Ok(pixels) = render(&place, &model, options) else { continue };
        let is_covered = |x: usize, y: usize| pixels[4 * (y * WIDTH + x) + 3] > 0;
        let columns: Vec<_> = (0..WIDTH).filter(|&x| (0..HEIGHT).any(|y| is_covered(x, y))).collect();
        let rows: Vec<_> = (0..HEIGHT).filter(|&y| (0..WIDTH).any(|x| is_covered(x, y))).collect();
        let span = |places: &[usize], all| match places {
            [first, .., last] => (last - first + 1) as f32 / all as f32,
            _ => 0.0,
        };
        let fill = span(&columns, WIDTH).max(span(&rows, HEIGHT));
        if !(0.5..=0.85).contains(&fill) {
            wrong.push(format!("{}: {fill:.2} of the picture", model.display()));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
