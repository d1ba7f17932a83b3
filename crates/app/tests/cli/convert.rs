//! `eyebeam convert`: the scene that comes of a model makes the same picture.

use crate::made::{png, write_gltf};
use crate::{Place, read_png};

const RENDER: &str = "-r 48x40 --spp 4 -q";

/// A square of two triangles with a picture, and a bare one.
const OBJ: &str = "mtllib a.mtl
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
v 2 0 0
v 2 1 -1
vt 0 0
vt 1 0
vt 1 1
vt 0 1
usemtl has picture
f 1/1 2/2 3/3 4/4
usemtl bare
f 2 5 6 3
";

const MTL: &str = "newmtl has picture
Kd 0.8 0.8 0.8
map_Kd color.png
Ns 50
Ks 0.3 0.3 0.3
newmtl bare
Kd 0.1 0.5 0.2
";

/// Pixels of a picture of the model, and of one of the scene that it was converted to.
fn both(place: &Place, model: &str, args: &str) -> [Vec<u8>; 2] {
    place.run(&format!("render {model} -o a.png {RENDER} {args}")).ends_with(0);
    place.run(&format!("convert {model} b.toml -r 48x40 --force -q {args}")).ends_with(0);
    // In the studio, where models have no other light.
    let view = if model.ends_with(".toml") { "" } else { "--view neutral" };
    place.run(&format!("render b.toml -o b.png {RENDER} {view}")).ends_with(0);
    ["a.png", "b.png"].map(|name| read_png(&place.read(name)).2)
}

#[test]
fn models_become_scenes_of_the_same_picture() {
    let place = Place::new();
    write_gltf(&place);
    place.write("a.obj", OBJ);
    place.write("a.mtl", MTL);
    std::fs::write(place.path("color.png"), png(|x, y| [40 * x as u8, 200, 50 * y as u8])).unwrap();
    let mut pictures = Vec::new();
    for (model, args) in [
        ("model.gltf", ""),
        ("model.gltf", "--camera auto"),
        ("model.gltf", "--camera 1 --no-ground --animation lift --at 0.2"),
        ("a.obj", ""),
        ("a.obj", "--up +Z"),
        ("scene.toml", ""),
    ] {
        let [a, b] = both(&place, model, args);
        assert!(a == b, "{model} {args}");
        assert!(!pictures.contains(&a), "{model} {args} is like another");
        pictures.push(a);
        place.run("check b.toml --strict").ends_with(0);
    }
    let files = std::fs::read_dir(place.path("b-assets")).unwrap().count();
    assert!(files >= 4, "{files}");
}

#[test]
fn nothing_is_lost_by_mistake() {
    let place = Place::new();
    write_gltf(&place);
    let run = place.run("convert model.gltf b.toml").ends_with(0);
    let said = "made up: a studio, a ground\nb.toml · 4 files in b-assets\n\
                render it with `--view neutral`, as the model would be\n";
    assert!(run.stderr.ends_with(said) && run.stdout.is_empty(), "{}", run.stderr);
    let before = place.files();
    let run = place.run("convert model.gltf b.toml").ends_with(4);
    assert!(run.stderr.contains("`--force` replaces it"), "{}", run.stderr);
    place.run("convert missing.glb c.toml").ends_with(4);
    place.run("convert model.gltf c.toml --strict").ends_with(3);
    place.run("convert model.gltf c.glb").ends_with(2);
    place.run("convert model.gltf -").ends_with(2);
    place.run("convert model.gltf no/c.toml").ends_with(4);
    assert!(place.files() == before, "something was written");
    place.run("convert model.gltf b.toml --force -q").ends_with(0);
    let run = place.run("convert model.gltf d.toml --env none").ends_with(0);
    assert!(run.stderr.contains("`--exposure auto`"), "{}", run.stderr);
}
