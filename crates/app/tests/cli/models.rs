//! Models with no options: a picture, and a word about what was made up for it.

use crate::{Place, read_png};

/// A red box of ten metres a side, in the first unit that comes to mind.
const BOX: &str = "ply
format ascii 1.0
element vertex 8
property float x
property float y
property float z
element face 6
property list uchar int vertex_indices
end_header
0 0 0
10 0 0
10 10 0
0 10 0
0 0 10
10 0 10
10 10 10
0 10 10
4 0 3 2 1
4 4 5 6 7
4 0 1 5 4
4 1 2 6 5
4 2 3 7 6
4 3 0 4 7
";

#[test]
fn a_mesh_alone_is_a_picture() {
    let place = Place::new();
    place.write("box.ply", BOX);
    let run = place.run("render box.ply -o box.png -r 64x48 --spp 8 --progress none").ends_with(0);
    assert!(run.stderr.contains("made up: a camera in front, a studio, a ground"), "{}", run.stderr);
    let (_, _, pixels, _) = read_png(&place.read("box.png"));
    let clipped = pixels.iter().filter(|&&byte| byte == 255).count();
    assert!(clipped * 100 < pixels.len(), "{clipped} of {}", pixels.len());
    let mean = pixels.iter().map(|&byte| u32::from(byte)).sum::<u32>() / pixels.len() as u32;
    assert!((60..230).contains(&mean), "{mean}");
    // Without anything around, the alpha is the box.
    let options = "--env none --transparent --no-ground";
    place.run(&format!("render box.ply -q -o alone.png -r 64x48 --spp 8 {options}")).ends_with(0);
    let (_, _, pixels, _) = read_png(&place.read("alone.png"));
    let covered = |i: usize| pixels[4 * i + 3] > 127;
    let rows = (0..48).filter(|y| (0..64).any(|x| covered(y * 64 + x))).count();
    assert!((24..=41).contains(&rows), "{rows} of 48 rows");
}

/// Whatever the unit, the picture is the same but for rounding, and so is one of a file whose z is up.
#[test]
fn units_and_axes_do_not_matter() {
    let place = Place::new();
    let picture = |name: &str, options: &str| {
        place.run(&format!("render {name} -q -o it.png -r 48x36 --spp 16 {options}")).ends_with(0);
        read_png(&place.read("it.png")).2
    };
    let scaled = |by: f64, turn: fn([f64; 3]) -> [f64; 3]| {
        let lines = BOX.lines().map(|line| {
            let numbers: Vec<f64> = line.split(' ').filter_map(|word| word.parse().ok()).collect();
            match numbers[..] {
                [x, y, z] if line.split(' ').count() == 3 => {
                    turn([x, y, z]).map(|c| (c * by).to_string()).join(" ") + "\n"
                }
                _ => format!("{line}\n"),
            }
        });
        lines.collect::<String>()
    };
    place.write("box.ply", BOX);
    let expected = picture("box.ply", "");
    for (by, up) in [(1e-5, "+Y"), (1e5, "+Y"), (1.0, "+Z")] {
        let turn = if up == "+Z" { |[x, y, z]: [f64; 3]| [x, -z, y] } else { |p: [f64; 3]| p };
        place.write("other.ply", &scaled(by, turn));
        let other = picture("other.ply", &format!("--up {up}"));
        let off = |(a, b): (&u8, &u8)| f64::from(a.abs_diff(*b));
        let mean = expected.iter().zip(&other).map(off).sum::<f64>() / expected.len() as f64;
        assert!(mean < 2.0, "{by} {up}: {mean} of 255");
    }
}

#[test]
fn surroundings_and_ground_are_chosen() {
    let place = Place::new();
    place.write("box.ply", BOX);
    place.run("render scene.toml -q -o around.exr -r 8x4 --spp 1").ends_with(0);
    place.run("render scene.toml -q -o around.png -r 8x4 --spp 1").ends_with(0);
    let mut pictures = Vec::new();
    for (options, made_up) in [
        ("", "a camera in front, a studio, a ground"),
        ("--no-ground", "a camera in front, a studio"),
        ("--env sky", "a camera in front, a sky, a ground"),
        ("--env sky --no-ground", "a camera in front, a sky"),
        ("--env around.exr", "a camera in front"),
        ("--env around.png --ground", "a camera in front, a ground"),
    ] {
        let run =
            place.run(&format!("render box.ply -o box.png -r 32x24 --spp 2 --progress none {options}")).ends_with(0);
        assert!(run.stderr.contains(&format!("made up: {made_up}\n")), "{options}: {}", run.stderr);
        pictures.push(read_png(&place.read("box.png")).2);
    }
    let count = pictures.len();
    pictures.sort();
    pictures.dedup();
    assert_eq!(pictures.len(), count, "each is another one");
    place.run("render box.ply --env nowhere.hdr").ends_with(4);
    let run = place.run("render box.ply --env moon").ends_with(2);
    assert!(run.stderr.contains("use studio, sky, none, or the name of a picture"), "{}", run.stderr);
}

#[test]
fn what_takes_more_memory_than_is_allowed_is_refused_by_name() {
    let place = Place::new();
    let count = 200_000;
    let vertices: String = (0..count).map(|i| format!("{i} 0 0\n")).collect();
    let header = format!(
        "ply\nformat ascii 1.0\nelement vertex {count}\nproperty float x\nproperty float y\nproperty float z\n"
    );
    place.write(
        "a.ply",
        &format!("{header}element face 1\nproperty list uchar int vertex_indices\nend_header\n{vertices}3 0 1 2\n"),
    );
    place.write("scene.toml", "[[shape.mesh]]\nfile = \"a.ply\"\n");
    for command in ["check a.ply", "render a.ply -r 4x4 --spp 1"] {
        let run = place.run(&format!("{command} --memory 2M")).ends_with(5);
        assert!(
            run.stderr.contains("it would take 3 MiB of memory, and 2 MiB are allowed\n  --> a.ply"),
            "{}",
            run.stderr
        );
        place.run(&format!("{command} --memory 4M")).ends_with(0);
    }
    // What the picture needs comes on top.
    place.run("render a.ply -r 200x200 --spp 1 --memory 6M").ends_with(5);
    let run = place.run("check scene.toml --memory 2M").ends_with(5);
    assert!(run.stderr.contains("`a.ply` is not read: it would take 3 MiB"), "{}", run.stderr);
}
