//! What a picture tells besides light, and pictures without a background.

use std::io::Cursor;

use exr::prelude::{AnyChannels, AttributeValue, FlatSamples, Image, Layer, ReadChannels, ReadLayers, Text};
use serde_json::{Value, json};

use crate::{Place, read_png};

/// A ball before nothing, of 33 x 33 pixels.
const BALL: &str = "-r 33x33 -D camera.look_from=[0,0,5] -D camera.look_at=[0,0,0] -D environment.constant.radiance=1";

pub(crate) type File = Image<Layer<AnyChannels<FlatSamples>>>;

pub(crate) fn read_exr(bytes: &[u8]) -> File {
    let reader = exr::prelude::read().no_deep_data().largest_resolution_level().all_channels().first_valid_layer();
    reader.all_attributes().from_buffered(Cursor::new(bytes)).unwrap()
}

pub(crate) fn names(file: &File) -> Vec<String> {
    file.layer_data.channel_data.list.iter().map(|c| c.name.to_string()).collect()
}

fn json_of(file: &File, attribute: &str) -> Value {
    let AttributeValue::Text(text) = &file.layer_data.attributes.other[&Text::from(attribute)] else { panic!() };
    serde_json::from_str(&text.to_string()).unwrap()
}

/// The number of a channel in the middle of the picture and in its corner.
fn middle_and_corner(file: &File, name: &str) -> [f32; 2] {
    let channel = file.layer_data.channel_data.list.iter().find(|c| c.name.to_string() == name).unwrap();
    [33 * 16 + 16, 0].map(|i| match &channel.sample_data {
        FlatSamples::F32(values) => values[i],
        FlatSamples::U32(values) => {
            assert!(name.starts_with("id."), "{name}");
            values[i] as f32
        }
        FlatSamples::F16(_) => panic!("{name}"),
    })
}

#[test]
fn all_channels() {
    let place = Place::new();
    place.run(&format!("render scene.toml -q -o a.exr --spp 20 --aov all --stats a.json {BALL}")).ends_with(0);
    let file = read_exr(&place.read("a.exr"));
    let expected = [
        "A",
        "B",
        "G",
        "N.X",
        "N.Y",
        "N.Z",
        "Ng.X",
        "Ng.Y",
        "Ng.Z",
        "P.X",
        "P.Y",
        "P.Z",
        "R",
        "Z",
        "albedo.B",
        "albedo.G",
        "albedo.R",
        "distance.Z",
        "id.instance",
        "id.material",
        "id.object",
        "spp.Y",
        "uv.U",
        "uv.V",
        "variance.B",
        "variance.G",
        "variance.R",
    ];
    assert_eq!(names(&file), expected);
    for (name, middle, corner) in [
        ("A", 1.0, 1.0),
        ("albedo.R", 0.8, 0.0),
        ("N.Z", 1.0, 0.0),
        ("Ng.X", 0.0, 0.0),
        ("Z", 4.0, f32::INFINITY),
        ("distance.Z", 4.0, f32::INFINITY),
        ("P.Z", 1.0, 0.0),
        ("uv.U", 0.25, 0.0),
        ("uv.V", 0.5, 0.0),
        ("id.object", 1.0, 0.0),
        ("id.material", 2.0, 0.0),
        ("id.instance", 0.0, 0.0),
        ("spp.Y", 20.0, 20.0),
        ("variance.G", 0.0, 0.0),
    ] {
        for (value, expected) in middle_and_corner(&file, name).into_iter().zip([middle, corner]) {
            assert!(value == expected || (value - expected).abs() < 0.02, "{name}: {value}, not {expected}");
        }
    }
    assert_eq!(json_of(&file, "id.names"), json!({"object": ["", "sphere.0"], "material": ["", "default", "gold"]}));
    let about = json!({"names": [
        "albedo", "normal", "geometric-normal", "depth", "distance", "position", "uv", "id", "variance", "spp"
    ], "through": false, "spp": 20});
    assert_eq!(json_of(&file, "eyebeam")["aov"], about);
    assert_eq!(place.json("a.json")["aov"], about);
    assert!(place.json("a.json")["seconds"]["aov"].as_f64().unwrap() > 0.0);
}

/// They come in any order, once, and leave the picture as it is.
#[test]
fn channels_that_are_asked_for() {
    let place = Place::new();
    let render = |args: &str| {
        place.run(&format!("render scene.toml -q -o a.exr --spp 20 {BALL} {args}")).ends_with(0);
        place.read("a.exr")
    };
    let depth = render("--aov depth,albedo --aov depth");
    assert_eq!(names(&read_exr(&depth)), ["A", "B", "G", "R", "Z", "albedo.B", "albedo.G", "albedo.R"]);
    for args in ["--threads 1", "--threads 7", "--progress json"] {
        assert!(render(&format!("--aov albedo,depth {args}")) == depth, "{args}");
    }
    let (plain, spp) = (read_exr(&render("")), read_exr(&render("--aov spp")));
    let picture = |file: &File| {
        let list = &file.layer_data.channel_data.list;
        ["R", "G", "B"].map(|name| list.iter().find(|c| c.name.to_string() == name).unwrap().sample_data.clone())
    };
    assert!(picture(&plain) == picture(&read_exr(&depth)) && picture(&plain) == picture(&spp));
    assert_eq!((names(&plain).len(), names(&spp).len()), (4, 5));

    // A mirror shows the background, which is nothing.
    let mirror = "-D material.gold.metal.roughness=0 --aov albedo,depth";
    assert!((middle_and_corner(&read_exr(&render(mirror)), "albedo.R")[0] - 0.8).abs() < 1e-6);
    let through = read_exr(&render(&format!("{mirror} --aov-through")));
    assert_eq!(middle_and_corner(&through, "albedo.R")[0], 0.0);
    assert_eq!(middle_and_corner(&through, "Z")[0], middle_and_corner(&read_exr(&depth), "Z")[0]);
    assert_eq!(json_of(&through, "eyebeam")["aov"], json!({"names": ["albedo", "depth"], "through": true, "spp": 20}));
}

#[test]
fn channels_need_a_file_for_them() {
    let place = Place::new();
    let before = place.files();
    for (args, said) in [
        ("--aov depth", "error: --aov needs a file of many channels, which `scene.png` is not\nhint: "),
        ("--aov id -o a.hdr", "error: --aov needs a file of many channels, which `a.hdr` is not\nhint: "),
        ("--aov all -o -", "error: --aov needs a file of many channels, which `-` is not\nhint: "),
        ("--aov dept -o a.exr", "error: invalid value 'dept' for '--aov <NAMES>'"),
        ("--aov depth, -o a.exr", "error: "),
        ("--aov-through -o a.exr", "error: the following required arguments were not provided"),
        ("--transparent -o a.hdr", "error: a transparent picture needs alpha, which `a.hdr` cannot hold\nhint: "),
        ("-D render.transparent=true -o a.hdr", "error: a transparent picture needs alpha"),
        ("--clamp -1", "error: "),
        ("--clamp nan", "error: invalid value 'nan' for '--clamp <L>': use a number from 0"),
    ] {
        let run = place.run(&format!("render scene.toml {args}")).ends_with(2);
        assert!(run.stderr.starts_with(said), "{args}: {}", run.stderr);
    }
    assert!(place.run("render scene.toml --aov dept -o a.exr").stderr.contains("a similar value exists: 'depth'"));
    place.run("render scene.toml -D render.clamp=-1").ends_with(3);
    place.run("render scene.toml --aov all -o a.exr -r 1000x1000 --memory 200M").ends_with(5);
    assert!(place.files() == before, "something was written");
}

#[test]
fn transparent_pictures() {
    let place = Place::new();
    place.run(&format!("render scene.toml -q -o a.png --spp 20 --transparent {BALL}")).ends_with(0);
    let (width, height, png, provenance) = read_png(&place.read("a.png"));
    assert_eq!((width, height, png.len()), (33, 33, 33 * 33 * 4));
    let in_png = |x: usize, y: usize| &png[4 * (33 * y + x)..][..4];
    assert_eq!(in_png(0, 0), [0; 4]);
    assert!(in_png(16, 16)[3] == 255 && in_png(16, 16)[0] > 200);
    // At the edge, colours are those of the ball.
    let edge = (0..33).map(|x| in_png(x, 16)).find(|p| (50..200).contains(&p[3])).unwrap();
    assert!(edge[0] > 150, "{edge:?}");
    assert_eq!(provenance["settings"]["transparent"], true);

    place.run(&format!("render scene.toml -q -o a.exr --spp 20 -D render.transparent=true {BALL}")).ends_with(0);
    let file = read_exr(&place.read("a.exr"));
    assert_eq!((middle_and_corner(&file, "A"), middle_and_corner(&file, "R")[1]), ([1.0, 0.0], 0.0));
}

#[test]
fn clamped_light_is_told() {
    let place = Place::new();
    let stats = |args: &str| {
        place.run(&format!("render scene.toml -q --spp 20 -r 32x18 --stats a.json {args}")).ends_with(0);
        place.json("a.json")
    };
    assert_eq!(stats("")["clamped_energy"], 0.0);
    let clamped = stats("--clamp 0.25");
    assert!(clamped["clamped_energy"].as_f64().unwrap() > 0.1);
    assert_eq!(clamped["settings"]["clamp"], 0.25);
    assert_eq!(read_png(&place.read("scene.png")).3["settings"]["clamp"], 0.25);
    assert_eq!(stats("--clamp 0 -D render.clamp=0.25")["clamped_energy"], 0.0, "the option wins");
}
