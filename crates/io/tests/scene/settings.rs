//! `-D key=value`.

use eyebeam_core::material::MaterialDesc;
use eyebeam_io::scene::read_str;

use crate::{places, problems, setting};

const SCENE: &str = "
[material.gold.metal]
roughness = 0.25
[environment.none]
[[shape.sphere]]
radius = 1
[[shape.sphere]]
radius = 2
";

fn read(settings: &[&str]) -> Result<eyebeam_core::desc::SceneDesc, eyebeam_io::Error> {
    read_str("a.toml", SCENE, &settings.iter().map(|s| setting(s)).collect::<Vec<_>>()).map(|file| file.desc)
}

#[test]
fn are_stronger_than_the_file() {
    let desc = read(&[
        "camera.vfov=20",
        "camera.vfov=25",
        "camera.look_at=[0, 2, 0]",
        "shape.sphere.1.radius=7",
        "shape.sphere.0.material=gold",
        "shape.sphere.0.center.1=0.5",
    ]);
    // A list that the file does not have cannot be changed in part.
    assert!(desc.is_err());
    let desc = read(&["camera.vfov=20", "camera.vfov=25", "camera.look_at=[0, 2, 0]", "camera.look_at.1=3"]).unwrap();
    assert_eq!((desc.camera.vfov, desc.camera.look_at), (Some(25.0), [0.0, 3.0, 0.0]));
    let desc = read(&["shape.sphere.1.radius=7", "shape.sphere.0.material=gold"]).unwrap();
    assert_eq!((desc.shape.sphere[0].radius, desc.shape.sphere[1].radius), (1.0, 7.0));
    assert_eq!(desc.shape.sphere[0].material.as_deref(), Some("gold"));
}

#[test]
fn another_kind_replaces() {
    let desc = read(&["material.gold.lambertian.albedo=0.25", "environment.constant.radiance=2"]).unwrap();
    assert!(matches!(desc.material["gold"], MaterialDesc::Lambertian(_)));
    assert!(matches!(desc.environment, eyebeam_core::light::EnvironmentDesc::Constant(_)));
    let desc = read(&["material.gold.metal.albedo=0.5"]).unwrap();
    let MaterialDesc::Metal(metal) = &desc.material["gold"] else { panic!() };
    assert_eq!(metal.roughness, 0.25.into(), "the same kind keeps the rest");
}

#[test]
fn mistakes_have_their_place() {
    let mut report = String::new();
    for (text, column) in [
        ("camera.vfow=30", 8),
        ("camera.vfov=wide", 13),
        ("camera.vfov=", 13),
        ("camera.vfov=-1", 13),
        ("camera.look_at=[0, \"x\", 0]", 20),
        ("camera={vfow = 3}", 9),
        ("camera=3", 8),
        ("cam.vfov=3", 1),
        ("=3", 1),
        (".=3", 1),
        ("camera..vfov=3", 8),
        ("camera.vfov.x=3", 8),
        ("material.gold.roughness=0.5", 15),
        ("shape.sphere.2.radius=1", 1),
        ("shape.sphere.x.radius=1", 1),
        ("shape.sphere.0.material=é", 25),
        ("include=[\"a.toml\"]", 1),
    ] {
        let error = read(&[text]).expect_err(text);
        report += &format!("-D {text}\n{error}\n\n");
        let found = problems(error);
        assert_eq!(places(&found)[0].1, column, "{text}");
        assert_eq!(found[0].place.as_ref().unwrap().file, "-D", "{text}");
    }
    insta::assert_snapshot!(report);
}

#[test]
fn deep_keys_are_refused() {
    for key in [vec!["a"; 60_000].join("."), ".".repeat(100_000)] {
        assert!(read(&[&format!("{key}=1")]).is_err());
    }
}
