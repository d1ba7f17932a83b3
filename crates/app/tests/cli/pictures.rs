//! What is in the files.

use exr::prelude::{AttributeValue, ReadChannels, ReadLayers, Text};
use eyebeam_core::color::srgb_encode;
use serde_json::{Value, json};

use crate::{Place, SCENE, read_png};

type Pixels = Vec<Vec<[f32; 4]>>;

fn read_exr(bytes: &[u8]) -> (Pixels, Value) {
    let file = exr::prelude::read()
        .no_deep_data()
        .largest_resolution_level()
        .rgba_channels(
            |size, _| vec![vec![[0.0; 4]; size.width()]; size.height()],
            |pixels: &mut Pixels, at, (r, g, b, a): (f32, f32, f32, f32)| pixels[at.y()][at.x()] = [r, g, b, a],
        )
        .first_valid_layer()
        .all_attributes()
        .from_buffered(std::io::Cursor::new(bytes))
        .unwrap();
    let AttributeValue::Text(text) = &file.layer_data.attributes.other[&Text::from("eyebeam")] else { panic!() };
    (file.layer_data.channel_data.pixels, serde_json::from_str(&text.to_string()).unwrap())
}

#[test]
fn png_and_exr_show_the_same_and_say_what_made_it() {
    let place = Place::new();
    for format in ["png", "exr"] {
        let options = "-r 45x21 --spp 5 --seed 9 -D camera.vfov=35 --view standard";
        place.run(&format!("render scene.toml -q -o a.{format} {options} --stats {format}.json")).ends_with(0);
    }
    let (width, height, bytes, in_png) = read_png(&place.read("a.png"));
    let (pixels, in_exr) = read_exr(&place.read("a.exr"));
    assert_eq!((width, height, pixels.len(), pixels[0].len()), (45, 21, 21, 45));
    let encoded = pixels.iter().flatten().flat_map(|&[r, g, b, a]| {
        assert_eq!(a, 1.0);
        [r, g, b].map(|c| (srgb_encode(c.clamp(0.0, 1.0)) * 255.0).round() as u8)
    });
    assert!(encoded.eq(bytes), "the PNG is not the EXR in sRGB");

    assert_eq!(in_png, in_exr);
    assert_eq!(in_png["version"], env!("CARGO_PKG_VERSION"));
    assert_eq!(in_png["overrides"], json!(["camera.vfov=35"]));
    assert_eq!((&in_png["settings"]["seed"], &in_png["settings"]["spp"]), (&json!(9), &json!(5)));
    assert_eq!(in_png["spp"], json!({"min": 5, "mean": 5.0, "max": 5}));
    let stats = place.json("png.json");
    for (key, value) in in_png.as_object().unwrap() {
        assert_eq!(stats[key], *value, "{key} differs between picture and statistics");
    }
    assert!(in_png["error"]["mean"].as_f64().unwrap() > 0.0);
}

#[test]
fn the_hash_is_of_the_scene() {
    let place = Place::new();
    let hash = |scene: &str, args: &str| {
        place.write("scene.toml", scene);
        let run = place.run(&format!("render scene.toml -q -r 8x8 --spp 1 -o - {args}")).ends_with(0);
        read_png(&run.stdout).3["scene_hash"].clone()
    };
    let first = hash(SCENE, "");
    for (scene, args) in [
        (SCENE, "--seed 3 --max-depth 5"),
        (SCENE, "-D render.spp=7"),
        (&format!("# words\n{SCENE}\n[render]\nspp = 3"), ""),
    ] {
        assert_eq!(hash(scene, args), first, "{scene} {args}");
    }
    for (scene, args) in
        [(SCENE, "-D camera.vfov=41"), (&SCENE.replace("0.2", "0.3"), ""), (SCENE, "-D environment.none={}")]
    {
        assert_ne!(hash(scene, args), first, "{scene} {args}");
    }
}
