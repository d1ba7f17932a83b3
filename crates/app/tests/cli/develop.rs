//! Linear light to pictures for screens.

use exr::prelude::FlatSamples;
use serde_json::{Value, json};

use crate::aov::read_exr;
use crate::{Place, read_png};

/// Small, with more than one exposure can hold.
const RENDER: &str = "render scene.toml -q -r 45x21 --spp 5 -D environment.constant.radiance=3";

/// What a PNG says of its look.
fn look(bytes: &[u8]) -> Value {
    let reader = png::Decoder::new(std::io::Cursor::new(bytes)).read_info().unwrap();
    let text = reader.info().utf8_text.iter().find(|t| t.keyword == "eyebeam.look").unwrap().get_text().unwrap();
    serde_json::from_str(&text).unwrap()
}

#[test]
fn a_developed_film_is_the_rendered_picture() {
    let place = Place::new();
    for transparent in ["", "--transparent"] {
        place.run(&format!("{RENDER} {transparent} -o film.exr")).ends_with(0);
        for options in [
            "",
            "--view agx --exposure auto --dither",
            "--view filmic --exposure -1.5 --white-balance 3200",
            "--view aces --contrast 1.2 --saturation 0.5 --bits 16",
            "--view standard --exposure=2",
            "--bloom 0.1 --vignette 60 --exposure auto",
        ] {
            place.run(&format!("{RENDER} {transparent} -o rendered.png {options}")).ends_with(0);
            let run = place.run(&format!("develop film.exr -o developed.png {options}")).ends_with(0);
            assert_eq!((run.text(), run.stderr.as_str()), ("", "developed.png: 45 x 21\n"));
            assert!(place.read("developed.png") == place.read("rendered.png"), "{transparent} {options}");
        }
        place.run(&format!("{RENDER} {transparent} -o rendered.jpg --quality 70")).ends_with(0);
        place.run("develop film.exr -q -o developed.jpg --quality 70").ends_with(0);
        assert!(place.read("developed.jpg") == place.read("rendered.jpg"));
    }
}

#[test]
fn options_do_what_they_say() {
    let place = Place::new();
    place.run(&format!("{RENDER} -o film.exr")).ends_with(0);
    let pixels = |options: &str| {
        let run = place.run(&format!("develop film.exr -q -o - {options}")).ends_with(0);
        read_png(&run.stdout).2
    };
    let mean = |pixels: &[u8], channel: usize| {
        let of = pixels.iter().skip(channel).step_by(3);
        of.map(|&p| f64::from(p)).sum::<f64>() / (pixels.len() / 3) as f64
    };
    let plain = pixels("--view standard");
    assert_eq!(plain[..3], [255; 3], "the background is brighter than white");
    let looks = ["agx", "aces", "filmic"].map(|view| pixels(&format!("--view {view}")));
    assert!(looks.iter().all(|look| *look != plain && look[..3] != [255; 3]));
    assert!(mean(&pixels("--exposure -2"), 1) < mean(&pixels(""), 1) - 20.0);
    let auto = mean(&pixels("--exposure auto"), 1);
    assert!((90.0..150.0).contains(&auto), "{auto}");
    let darker = pixels("--exposure -3");
    assert!(pixels("--exposure -3 --bloom 0 --vignette 0") == darker);
    assert!(pixels("--exposure -3 --bloom 0.5") != darker);
    let corners = pixels("--exposure -3 --vignette 90");
    assert!(corners[0] < darker[0] && mean(&corners, 1) < mean(&darker, 1));
    let warmth = |pixels: &[u8]| mean(pixels, 0) - mean(pixels, 2);
    assert!(warmth(&pixels("--exposure -3 --white-balance 3000")) < warmth(&darker) - 20.0);
    assert!(pixels("--exposure -3 --saturation 0").chunks(3).all(|p| p[0] == p[1] && p[1] == p[2]));
    assert!(pixels("--exposure -3 --dither").iter().zip(&darker).all(|(a, b)| a.abs_diff(*b) <= 1));
}

#[test]
fn pictures_say_how_they_were_developed() {
    let place = Place::new();
    place.run(&format!("{RENDER} -o film.exr")).ends_with(0);
    place.run("develop film.exr -q -o a.png --view agx --exposure auto --contrast 1.5 --dither").ends_with(0);
    let mut told = look(&place.read("a.png"));
    let ev = told.as_object_mut().unwrap().remove("ev").unwrap().as_f64().unwrap();
    assert!((-6.0..0.0).contains(&ev), "{ev}");
    let expected = json!({
        "view": "agx", "bloom": 0.0, "vignette": 0.0, "exposure": "auto", "white_balance": 6500.0, "contrast": 1.5,
        "saturation": 1.0, "dither": true
    });
    assert_eq!(told, expected);
    let (.., provenance) = read_png(&place.read("a.png"));
    assert_eq!((&provenance["scene"], &provenance["settings"]["spp"]), (&json!("scene.toml"), &json!(5)));
    place.run("develop film.exr -q -o b.exr").ends_with(0);
    assert!(place.read("b.exr") == place.read("film.exr"));
}

#[test]
fn linear_formats_stay_linear() {
    let place = Place::new();
    for format in ["exr", "hdr"] {
        place.run(&format!("{RENDER} -o plain.{format}")).ends_with(0);
        place.run(&format!("{RENDER} -o looked.{format} --view agx --exposure 3 --dither --stats a.json")).ends_with(0);
        assert!(place.read(&format!("plain.{format}")) == place.read(&format!("looked.{format}")));
        assert_eq!(place.json("a.json")["look"], Value::Null);
    }
    let run = place.run("develop plain.hdr -q -o a.png").ends_with(0);
    assert_eq!(run.stderr, "");
    let (width, height, _, provenance) = read_png(&place.read("a.png"));
    assert_eq!((width, height, &provenance["picture"]), (45, 21, &json!("plain.hdr")));
}

#[test]
fn half_is_for_colours() {
    let place = Place::new();
    place.run(&format!("{RENDER} -o a.exr --half --aov depth,id")).ends_with(0);
    for channel in read_exr(&place.read("a.exr")).layer_data.channel_data.list {
        let name = channel.name.to_string();
        let right = match channel.sample_data {
            FlatSamples::F16(_) => name.len() == 1 && name != "Z",
            FlatSamples::F32(_) => name == "Z",
            FlatSamples::U32(_) => name.starts_with("id."),
        };
        assert!(right, "{name}");
    }
}

#[test]
fn a_film_from_standard_input() {
    let place = Place::new();
    place.run(&format!("{RENDER} -o film.hdr")).ends_with(0);
    let film = std::fs::File::open(place.path("film.hdr")).unwrap();
    let run = crate::Run::from(place.command("develop - -o -").stdin(film).output().unwrap()).ends_with(0);
    assert_eq!((read_png(&run.stdout).0, run.stderr.as_str()), (45, "-: 45 x 21\n"));
    let run = place.run_with_input("develop - -o a.png", "").ends_with(3);
    assert_eq!(run.stderr, "error: the picture is empty\n  --> -\n");
}

#[test]
fn what_cannot_be_developed() {
    let place = Place::new();
    place.run(&format!("{RENDER} -o a.png")).ends_with(0);
    place.run(&format!("{RENDER} -o film.exr --transparent")).ends_with(0);
    let whole = place.read("film.exr");
    std::fs::write(place.path("cut.exr"), &whole[..whole.len() / 2]).unwrap();
    let before = place.files();
    for (args, code, said) in [
        ("develop missing.exr -o b.png", 4, "error: cannot read `missing.exr`: "),
        ("develop . -o b.png", 4, "error: cannot read `.`: "),
        ("develop film.exr -o missing/b.png", 4, "error: cannot write `missing/b.png`: "),
        ("develop a.png -o b.png", 3, "error: this is no picture of linear light\n  --> a.png\nhint: "),
        ("develop cut.exr -o b.png", 3, "error: cannot decode the OpenEXR picture: "),
        ("develop film.exr -o b.hdr", 2, "error: a transparent picture needs alpha, which `b.hdr` cannot hold\nhint: "),
    ] {
        let run = place.run(args).ends_with(code);
        assert!(run.stdout.is_empty() && run.stderr.starts_with(said), "{args}: {}", run.stderr);
    }
    assert!(place.files() == before, "something was written");
}
