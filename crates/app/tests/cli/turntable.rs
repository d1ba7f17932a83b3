//! `eyebeam turntable`.

use std::fs;

use crate::made::write_gltf;
use crate::{Place, read_png};

/// A tall box beside the origin, wide along one axis, inside out.
const BAR: &str = "v 2 0 -3
v 3 0 -3
v 3 0 3
v 2 0 3
v 2 1 -3
v 3 1 -3
v 3 1 3
v 2 1 3
f 4 3 2 1
f 5 6 7 8
f 1 2 6 5
f 2 3 7 6
f 3 4 8 7
f 4 1 5 8
";

#[test]
fn the_model_turns_and_stays_in_the_picture() {
    let place = Place::new();
    place.write("bar.obj", BAR);
    let options = "-r 64x48 --spp 4 -q --env none --no-ground --transparent";
    place.run(&format!("turntable bar.obj -n 8 -o frames/{{frame:03}}.png {options} --stats a.json")).ends_with(0);
    assert_eq!(fs::read_dir(place.path("frames")).unwrap().count(), 8);
    let mut widths = Vec::new();
    for frame in 0..8 {
        let (width, height, pixels, said) = read_png(&place.read(&format!("frames/{frame:03}.png")));
        assert_eq!((width, height), (64, 48));
        assert_eq!(said["turntable"], serde_json::json!({ "frame": frame, "of": 8 }));
        let covered = |x: usize, y: usize| pixels[4 * (64 * y + x) + 3] > 0;
        for (x, y) in (0..64).flat_map(|x| (0..48).map(move |y| (x, y))) {
            let is_edge = !(4..60).contains(&x) || !(3..45).contains(&y);
            assert!(!is_edge || !covered(x, y), "frame {frame} reaches ({x}, {y})");
        }
        widths.push((0..64).filter(|&x| (0..48).any(|y| covered(x, y))).count());
    }
    let (least, most) = (widths.iter().min().unwrap(), widths.iter().max().unwrap());
    assert!(*most > 40 && *least + 10 < *most, "{widths:?}");
    let stats = place.json("a.json");
    assert_eq!((&stats["schema"], stats["frames"].as_array().unwrap().len()), (&"eyebeam-turntable-1".into(), 8));
}

#[test]
fn it_begins_with_the_still_picture() {
    let place = Place::new();
    write_gltf(&place);
    let options = "-r 32x24 --spp 2 -q";
    place.run(&format!("render model.gltf -o still.png {options}")).ends_with(0);
    place.run(&format!("turntable model.gltf -n 2 {options}")).ends_with(0);
    let [still, first, second] =
        ["still.png", "model-0000.png", "model-0001.png"].map(|name| read_png(&place.read(name)).2);
    assert!(still == first && first != second);
    // One exposure for all.
    let look = "--env none --exposure auto -v";
    place.run(&format!("turntable model.gltf -n 2 -r 32x24 --spp 2 {look} -o {{frame}}.png --no-ground")).ends_with(0);
    let exposure = |name: &str| {
        let bytes = place.read(name);
        let reader = png::Decoder::new(std::io::Cursor::new(&bytes)).read_info().unwrap();
        let text = reader.info().utf8_text.iter().find(|t| t.keyword == "eyebeam.look").unwrap().get_text().unwrap();
        serde_json::from_str::<serde_json::Value>(&text).unwrap()["ev"].as_f64().unwrap()
    };
    assert_eq!(exposure("0.png"), exposure("1.png"));
}

#[test]
fn names_without_a_number_are_refused() {
    let place = Place::new();
    write_gltf(&place);
    let before = place.files();
    for args in ["-o a.png", "-o {model}.png", "-o {frames}.png", "-n 0", "-o -", "-o {frame}.gif"] {
        let run = place.run(&format!("turntable model.gltf {args}")).ends_with(2);
        assert!(!run.stderr.is_empty(), "{args}");
    }
    let run = place.run("turntable model.gltf -o a.png").ends_with(2);
    assert!(run.stderr.contains("write {frame} or {frame:04}"), "{}", run.stderr);
    place.run("turntable missing.glb -o {frame}.png").ends_with(4);
    assert!(place.files() == before, "something was written");
}
