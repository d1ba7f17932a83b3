//! Wavefront OBJ and MTL.

use std::collections::BTreeMap;
use std::fs;
use std::time::{Duration, Instant};

use eyebeam_core::desc::SceneDesc;
use eyebeam_core::film::Wrap;
use eyebeam_core::material::{MaterialDesc, Principled};
use eyebeam_core::shape::MeshData;
use eyebeam_core::texture::{Channel, Encoding, ImageTexture, TextureDesc};
use eyebeam_io::scene::{Files, ReadOptions, SceneFile, read, read_bytes};
use eyebeam_io::{At, Error, Warning};
use proptest::prelude::Rng as _;
use proptest::test_runner::{RngAlgorithm, TestRng};
use tempfile::TempDir;

use crate::models::corpus::corpus;

/// A square of four corners.
const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

/// Reads `a/m.obj` with other files in the same folder.
fn try_model(obj: impl AsRef<[u8]>, files: &[(&str, &[u8])]) -> Result<SceneFile, Error> {
    let folder = TempDir::new().unwrap();
    let inner = folder.path().join("a");
    fs::create_dir(&inner).unwrap();
    fs::write(inner.join("m.obj"), obj).unwrap();
    for (name, bytes) in files {
        let path = inner.join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, bytes).unwrap();
    }
    read(&inner.join("m.obj"), &[])
}

fn model(obj: &str) -> SceneFile {
    try_model(obj, &[]).unwrap()
}

fn meshes(desc: &SceneDesc) -> Vec<&MeshData> {
    desc.shape.mesh.iter().map(|mesh| mesh.data.as_deref().unwrap()).collect()
}

/// What is told of, each after its line or its part.
pub(super) fn said(file: &SceneFile) -> Vec<String> {
    let at = |w: &Warning| match &w.place.as_ref().unwrap().at {
        At::Line(line) => format!("{line}: {}", w.message),
        At::Part(part) => format!("{part}: {}", w.message),
        At::File => w.message.clone(),
        other => panic!("{other:?}"),
    };
    file.warnings.iter().map(at).collect()
}

/// The materials of a library of which each is used once.
pub(super) fn library(mtl: &str, files: &[(&str, &[u8])]) -> SceneFile {
    let uses = mtl.lines().filter_map(|line| line.strip_prefix("newmtl "));
    let faces: String = uses.map(|name| format!("usemtl {name}\nf 1 2 3\n")).collect();
    let files = [&[("l.mtl", mtl.as_bytes())], files].concat();
    try_model(format!("mtllib l.mtl\n{SQUARE}{faces}"), &files).unwrap()
}

pub(super) fn principled<'a>(file: &'a SceneFile, name: &str) -> &'a Principled {
    match &file.desc.material[name] {
        MaterialDesc::Principled(p) => p,
        other => panic!("{other:?}"),
    }
}

pub(super) fn image<'a>(file: &'a SceneFile, name: &str) -> &'a ImageTexture {
    match &file.desc.texture[name] {
        TextureDesc::Image(texture) => texture,
        other => panic!("{other:?}"),
    }
}

pub(super) fn png() -> Vec<u8> {
    png_of(&[255, 128, 0])
}

/// A picture of one colour.
pub(super) fn png_of(color: &[u8; 3]) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, 2, 1);
    encoder.set_color(png::ColorType::Rgb);
    encoder.write_header().unwrap().write_image_data(&color.repeat(2)).unwrap();
    bytes
}

#[test]
fn corners_of_all_kinds_share_vertices() {
    let text = format!("{SQUARE}vt 0 0\nvt 1 0 0\nvt 0.5\nvn 0 0 2\nf 1/1/1 2/2/1 3/-1/-1\nf -4/1/1 -2/3/1 -1/1/1\n");
    let file = model(&text);
    assert_eq!(said(&file), [""; 0]);
    let all = meshes(&file.desc);
    assert_eq!(all[0].triangles, [[0, 1, 2], [0, 2, 3]]);
    assert_eq!(all[0].uvs, [[0.0, 0.0], [1.0, 0.0], [0.5, 0.0], [0.0, 0.0]]);
    assert_eq!(all[0].normals, [[0.0, 0.0, 2.0]; 4]);
    for corners in ["f 1 2 3 4", "f 1/ 2/ 3/ 4/", "f 1// 2// 3// 4// # c", "f 1 2\\\n 3 \\\r\n4\r"] {
        let file = model(&format!("{SQUARE}{corners}"));
        assert_eq!((meshes(&file.desc)[0].triangles.len(), meshes(&file.desc)[0].normals.len()), (2, 0), "{corners}");
    }
    let file = model(&format!("{SQUARE}vn 1 0 0\nf 1//1 2//1 3//1"));
    assert_eq!((&meshes(&file.desc)[0].uvs, meshes(&file.desc)[0].normals.len()), (&vec![], 3));
}

fn meshes_of(text: &str) -> Vec<MeshData> {
    meshes(&model(text).desc).into_iter().cloned().collect()
}

#[test]
fn smoothing_groups_have_normals_weighted_by_angle() {
    // Two sides of a box: one is a square, of which two triangles meet at one end of the edge.
    let corners = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\n";
    let sides = "f 1 4 3 2\nf 1 2 6 5\n";
    assert_eq!(meshes_of(&format!("{corners}s off\n{sides}"))[0].normals, [[0.0; 3]; 0]);
    let smooth = &meshes_of(&format!("{corners}s 1\n{sides}"))[0];
    assert_eq!(smooth.vertices.len(), 6);
    for i in [0, 3] {
        let half = -std::f32::consts::FRAC_1_SQRT_2;
        assert!((glam::Vec3::from(smooth.normals[i]) - glam::Vec3::new(0.0, half, half)).length() < 1e-6, "{smooth:?}");
    }
    let apart = &meshes_of(&format!("{corners}s 1\nf 1 4 3 2\ns 2\nf 1 2 6 5\n"))[0];
    assert_eq!((apart.vertices.len(), apart.normals[0]), (8, [0.0, 0.0, -1.0]));
}

#[test]
fn colors_concave_faces_and_meshes_by_material() {
    let file =
        model("v 0 0 0\nv 2 1 0 1 0 0.5\nv 0 2 0\nv 0.5 1 0\ng a b\no c\nf 2 3 4 1\nusemtl x y\nf 1 2 3\nf 1 2 4\n");
    let data = meshes(&file.desc);
    assert_eq!((data.len(), data[0].triangles.len(), data[1].triangles.len()), (2, 2, 2));
    assert!(data[0].colors.contains(&[1.0; 3]) && data[0].colors.iter().any(|c| (c[2] - 0.2140).abs() < 1e-3));
    assert!(data[0].triangles.iter().all(|t| t.contains(&0) && t.contains(&2)), "{:?}", data[0].triangles);
    assert_eq!(said(&file), ["material `x y`: there is no such material: what has it is grey"]);
    assert!(file.desc.shape.mesh.iter().all(|mesh| mesh.material.as_deref() == Some("vertex-color")));
}

/// The colours of a file, all of which count to the same.
#[test]
fn colors_count_to_1_or_255_or_65535() {
    let colors = |more: &str| {
        let file = model(&format!("v 0 0 0 {more}\nv 1 0 0\nv 1 1 0\nf 1 2 3\n"));
        (meshes(&file.desc)[0].colors.first().copied(), said(&file))
    };
    let half = |c: Option<[f32; 3]>| c.is_some_and(|[r, g, b]| r == 1.0 && g == 0.0 && (b - 0.2140).abs() < 2e-3);
    for silent in ["1 0 0.5", "1 0 0.5 1", "255 0 127.5", "255 0 127.5 255", "255 0 127.5 1", "65535 0 32767"] {
        let (color, said) = colors(silent);
        assert!(half(color) && said.is_empty(), "{silent}: {color:?} {said:?}");
    }
    for (more, expected) in [
        ("1 0 0.5 0.9", "1: alphas of vertices are not read"),
        ("255 0 127.5 128", "1: alphas of vertices are not read"),
        ("1.2 -1 0.5", "1: colours of vertices above 1 are clamped"),
    ] {
        let (color, said) = colors(more);
        assert!(half(color) && said == [expected], "{more}: {color:?} {said:?}");
    }
    for more in ["1 2", "1 2 3 4 5"] {
        let expected = "1: what follows `v x y z` is neither a weight nor a colour, and not read";
        assert_eq!(colors(more), (None, vec![expected.to_owned()]));
    }
    // Vertices without a colour are white.
    let file = model("v 0 0 0 255 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n");
    assert_eq!(meshes(&file.desc)[0].colors, [[1.0, 0.0, 0.0], [1.0; 3], [1.0; 3]]);
}

#[test]
fn colors_that_a_material_covers_are_told_of() {
    let obj = |color: &str| format!("mtllib l.mtl\nv 0 0 0 {color}\nv 1 0 0\nv 1 1 0\nusemtl a\nf 1 2 3\n");
    let told = |color: &str| said(&try_model(obj(color), &[("l.mtl", b"newmtl a\nKd 1 0 0\n")]).unwrap());
    assert_eq!(told("1 0 0"), ["colours of vertices are not used where faces have a material"]);
    assert_eq!(told("1 1 1"), [""; 0]);
}

/// A comment ends with its line, whatever its last character is.
#[test]
fn comments_do_not_go_on() {
    let file = model(&format!("\u{feff}{SQUARE}# C:\\models\\\nf 1 2 3 # or so \\\nf 1 3\\\n 4\n"));
    assert_eq!((meshes(&file.desc)[0].triangles.len(), said(&file)), (2, vec![]));
    let file = library("newmtl a\n# by \\\nKd 0 1 0\n", &[]);
    assert_eq!(principled(&file, "a").base_color.rgb().unwrap().0, [0.0, 1.0, 0.0]);
}

/// Names lead to the same files on a disk and in memory.
#[test]
fn names_are_plain_everywhere() {
    let obj = format!("\u{feff}mtllib ./sub\\l.mtl\n{SQUARE}usemtl a\nf 1 2 3\n");
    let (mtl, png) = (b"\xef\xbb\xbfnewmtl a\nmap_Kd ./wood.png\nmap_Ke tex\\.\\wood.png\n", png());
    let files: [(&str, &[u8]); 3] = [("sub/l.mtl", mtl), ("sub/wood.png", &png), ("sub/tex/wood.png", &png)];
    let on_disk = try_model(&obj, &files).unwrap();
    let given: BTreeMap<_, _> = files.map(|(name, bytes)| (name.to_owned(), bytes.to_vec())).into();
    let in_memory = read_bytes("m.obj", obj.as_bytes(), Files::Given(&given), &ReadOptions::default()).unwrap();
    for file in [on_disk, in_memory] {
        assert_eq!(said(&file), [""; 0]);
        assert!(image(&file, "a kd").file.ends_with("sub/wood.png"));
        assert!(image(&file, "a ke").file.ends_with("sub/tex/wood.png"));
    }
}

#[test]
fn what_is_not_read_is_said_once() {
    let mut text = format!("{SQUARE}l 1 2\nl 2 3\np 1\nfoo\nf 1 2\nf\n# \u{e9}\nf 1 2 3\n").into_bytes();
    text.extend(b"o \xff\xfe\ng \xff\n");
    let file = try_model(text, &[]).unwrap();
    let expected = [
        "5: `l` is not read (2 times)",
        "7: `p` is not read",
        "8: `foo` is not read",
        "9: a face of fewer than three corners is dropped (2 times)",
    ];
    assert_eq!(said(&file), expected);
}

#[test]
fn what_is_wrong_has_its_line() {
    for (line, message) in [
        ("f 0 1 2", "there is no vertex 0: there are 4 before this line"),
        ("f 1 2 5", "there is no vertex 5"),
        ("f 1 2 -5", "there is no vertex -5"),
        ("f 1/2 2 3", "there is no vt 2: there are 1 before"),
        ("f 1//0 2 3", "there is no vn 0"),
        ("f 1 2 99999999999999999999", "is no whole number"),
        ("f 1/1/1/1 2 3", "`1/1/1/1` is no corner"),
        ("f 1 2 x", "`x` is no whole number"),
        ("v 1 2", "there are 2 numbers, and not 3"),
        ("v 1 2 nan", "`nan` is no finite number"),
        ("v 1 1e99 0", "`1e99` is no finite number"),
        ("vn inf 0 0", "`inf` is no finite number"),
        ("vt a", "`a` is no finite number"),
        ("vt", "there are 0 numbers, and not 1"),
    ] {
        let text = format!("{SQUARE}vt 0 0\nvn 0 0 1\n{line}\nf 1 2 3\n");
        let error = try_model(text, &[]).unwrap_err();
        let Error::File(error) = error else { panic!("{error}") };
        assert!(error.message.contains(message) && error.at == At::Line(7), "{line}: {error}");
    }
    let file = model(&format!("{SQUARE}f 1/1/1 2/2/2 3/3/3\n"));
    assert_eq!(meshes(&file.desc)[0].normals.len() + meshes(&file.desc)[0].uvs.len(), 0);
    assert!(said(&file)[1].ends_with(": a face with a `vn`, of which there is none, goes without (3 times)"));
    let long = try_model(format!("{SQUARE}# {}\nf 1 2 3", "x".repeat(1 << 20)), &[]).unwrap_err();
    assert!(long.to_string().contains("the line is longer than 1048576 bytes"), "{long}");
    assert!(try_model("", &[]).unwrap_err().to_string().contains("the file has no faces"));
}

#[test]
fn materials_become_layers() {
    let file = library(
        "newmtl matte\nKd 0.1 0.2 0.3\nillum 1\nKs 1 1 1\nfoo 1\n\
         newmtl shiny red\nKd 0.5\nKs 0.25 0.5 0.5\nNs 30\nNi 1.4\nillum 2\nKe 0 0 0\n\
         newmtl mirror\nKd 0 0 0\nKs 0.9 0.8 0.7\nillum 3\n\
         newmtl glass\nd 0.1\nNi 1.6\nTf 0.5 0.9 0.9\nillum 7\n\
         newmtl thin\nTr 0.75\nKd 1 1 1\n\
         newmtl lamp\nKe 2 4 8\nd 0.5\n\
         newmtl pbr\nKd 1 1 1\nKs 0 0 0\nPr 0.2\nPm 0.3\nPs 0.4\nPc 0.5\nPcr 0.6\naniso 0.7\nanisor 0.75\nNs x\n",
        &[],
    );
    let number = |scalar: &eyebeam_core::texture::Scalar| scalar.number().unwrap();
    let matte = principled(&file, "matte");
    assert_eq!((matte.base_color.rgb().unwrap().0, number(&matte.specular_weight)), ([0.1, 0.2, 0.3], 0.0));
    let shiny = principled(&file, "shiny red");
    assert_eq!((shiny.specular_ior, number(&shiny.specular_weight)), (1.4, 0.5));
    assert_eq!(shiny.specular_color.rgb().unwrap().0, [0.5, 1.0, 1.0]);
    // alpha = √(2 / 32) = 1/4
    assert_eq!((number(&shiny.specular_roughness), shiny.emission_luminance), (0.5, 0.0));
    let mirror = principled(&file, "mirror");
    assert_eq!((number(&mirror.base_metalness), number(&mirror.specular_roughness)), (1.0, 0.0));
    let glass = principled(&file, "glass");
    assert_eq!((number(&glass.transmission_weight), glass.specular_ior, glass.geometry_thin_walled), (0.9, 1.6, false));
    assert_eq!(glass.transmission_color.rgb().unwrap().0, [0.5, 0.9, 0.9]);
    let MaterialDesc::Mask(thin) = &file.desc.material["thin"] else { panic!() };
    assert_eq!((number(&thin.opacity), thin.of.name()), (0.25, "thin (layer 0)"));
    let lamp = principled(&file, "lamp (layer 0)");
    assert!((lamp.emission_luminance / 8.0 - 202.7).abs() < 0.1 && !file.given.light);
    assert_eq!(lamp.emission_color.rgb().unwrap().0, [0.25, 0.5, 1.0]);
    let pbr = principled(&file, "pbr");
    let parts = [&pbr.specular_roughness, &pbr.base_metalness, &pbr.fuzz_weight, &pbr.coat_weight, &pbr.coat_roughness];
    assert_eq!(parts.map(number), [0.2, 0.3, 0.4, 0.5, 0.6]);
    assert_eq!((number(&pbr.specular_weight), number(&pbr.specular_roughness_anisotropy)), (1.0, 0.7));
    assert_eq!(pbr.specular_rotation, 0.75 * 360.0);
    assert_eq!(said(&file), ["5: `foo` is not read", "38: `Ns` is not read"]);
}

#[test]
fn pictures_are_loaded_with_their_options() {
    let png = png();
    let file = library(
        "newmtl a\nKd 0.5 0.5 0.5\nmap_Kd -s 2 3 -o 0.5 -clamp on -mm 0 1 my  wood.png\nmap_Bump sub\\b.png -bm 2\n\
         map_d b.png\nmap_Pr b.png\nmap_Ns b.png\n\
         newmtl b\nKd 0 0 0\nmap_Kd my  wood.png\nnorm b.png\nmap_Ke b.png\n\
         newmtl c\nmap_Kd missing.png\nmap_Ks l.mtl\n",
        &[("my  wood.png", &png), ("sub/b.png", &png), ("b.png", &png)],
    );
    let wood = image(&file, "a kd");
    assert!(wood.pixels.is_some() && wood.file.ends_with("my  wood.png"));
    assert_eq!((wood.mapping.scale, wood.mapping.offset, wood.wrap), ([2.0, 3.0, 1.0], [0.5, 0.0, 0.0], Wrap::Clamp));
    assert!(matches!(file.desc.texture["a kd tinted"], TextureDesc::Multiply(_)));
    assert!(!file.desc.texture.contains_key("b kd tinted") && image(&file, "b kd").pixels.is_some());
    assert_eq!((image(&file, "a pr").encoding, wood.encoding), (Encoding::Linear, Encoding::Auto));
    let MaterialDesc::Mask(mask) = &file.desc.material["a"] else { panic!() };
    let MaterialDesc::Bump(bump) = &file.desc.material[mask.of.name()] else { panic!() };
    assert!(
        (bump.scale - 0.02).abs() < 1e-9 && matches!(file.desc.material[bump.of.name()], MaterialDesc::Principled(_))
    );
    let said = said(&file).join("\n");
    for part in [
        "3: the option `-mm` is not read",
        "7: `map_Ns` is not read",
        "the picture `missing.png` is not read",
        "the picture `l.mtl` is not read",
    ] {
        assert!(said.contains(part), "{part}: {said}");
    }
}

/// Of `map_d` the alpha if there is any, and else, or if it is asked for, something of the colour.
#[test]
fn amounts_are_parts_of_pictures() {
    let mut leaf = Vec::new();
    let mut encoder = png::Encoder::new(&mut leaf, 1, 1);
    encoder.set_color(png::ColorType::Rgba);
    encoder.write_header().unwrap().write_image_data(&[9, 99, 9, 128]).unwrap();
    let file = library(
        "newmtl leaf\nmap_Kd leaf.png\nmap_d leaf.png\n\
         newmtl grey\nmap_d grey.png\n\
         newmtl green\nmap_d -imfchan g leaf.png\nmap_Kd -imfchan r leaf.png\n\
         newmtl rough\nmap_Pr -imfchan m leaf.png\nmap_Pm leaf.png\n",
        &[("leaf.png", &leaf), ("grey.png", &png())],
    );
    let takes_alpha = |name: &str| image(&file, name).alpha;
    assert!(takes_alpha("leaf d") && !takes_alpha("leaf kd") && !takes_alpha("grey d") && !takes_alpha("green d"));
    assert!(takes_alpha("rough pr") && !takes_alpha("rough pm"));
    let TextureDesc::Channel(part) = &file.desc.texture["green d channel"] else { panic!() };
    assert_eq!(part.channel, Channel::Green);
    assert_eq!(said(&file), ["8: the option `-imfchan` is not read"]);
}

#[test]
fn ambient_light_is_told_of_if_it_means_something() {
    let file = library(
        "newmtl a\nKa 1 1 1\nnewmtl b\nKa 0.2 0.2 0.2\nnewmtl c\nKa 0 0 0\nnewmtl d\nKa 0.3 0.4 0.5\nKd 0.3 0.4 0.5\n\
         newmtl e\nKa 0.3 0.4 0.5\nKd 1 1 1\n",
        &[],
    );
    assert_eq!(said(&file), ["11: `Ka` is not read"]);
}

#[test]
fn names_that_lead_out_are_refused() {
    let folder = TempDir::new().unwrap();
    let inner = folder.path().join("a");
    fs::create_dir(&inner).unwrap();
    fs::write(folder.path().join("out.png"), png()).unwrap();
    fs::write(folder.path().join("out.mtl"), "newmtl m\nKd 1 0 0\n").unwrap();
    #[cfg(unix)]
    std::os::unix::fs::symlink("../out.png", inner.join("link.png")).unwrap();
    let absolute = folder.path().join("out.png");
    for name in ["../out.png", "..\\out.png", "x/../../out.png", absolute.to_str().unwrap(), "C:\\out.png", "link.png"]
    {
        fs::write(inner.join("m.mtl"), format!("newmtl m\nmap_Kd {name}\n")).unwrap();
        fs::write(inner.join("m.obj"), format!("mtllib m.mtl ../out.mtl\n{SQUARE}usemtl m\nf 1 2 3\n")).unwrap();
        let file = read(&inner.join("m.obj"), &[]).unwrap();
        let said = said(&file).join("\n");
        assert!(file.desc.texture.is_empty() && said.contains(&format!("`{name}` is not read")), "{said}");
        assert!(said.contains("`../out.mtl` is not read: its name leads out of the folder of the model"), "{said}");
    }
}

#[test]
fn libraries_have_spaces_and_neighbours() {
    let files: &[(&str, &[u8])] =
        &[("my lib.mtl", b"newmtl m\nKd 1 0 0"), ("b.mtl", b"\xef\xbb\xbfnewmtl n\nKd 0 1 0")];
    let obj = format!("mtllib my lib.mtl\nmtllib none.mtl b.mtl\n{SQUARE}usemtl m\nf 1 2 3\nusemtl n\nf 1 2 3\n");
    let file = try_model(obj, files).unwrap();
    assert_eq!(principled(&file, "m").base_color.rgb().unwrap().0, [1.0, 0.0, 0.0]);
    assert_eq!(principled(&file, "n").base_color.rgb().unwrap().0, [0.0, 1.0, 0.0]);
    assert!(file.warnings.len() == 1 && file.warnings[0].to_string().contains("`none.mtl`"));
}

const OBJ: &str = "mtllib l.mtl\nv 0 0 0\nv 1 0 0 1 0 0\nv 1 1 0\nv 0 1e0 0\nvt 0 0\nvn 0 0 1\ns 1\nusemtl a\nf 1/1/1 2/1/1 3/1/1\nf -4 \\\n-3 -2 -1\nl 1 2\n";
const MTL: &str =
    "newmtl a\nKd 1 0 0\nKs 0.5 0.5 0.5\nNs 10\nd 0.5\nillum 7\nNi 1.5\nKe 1 1 1\nmap_Kd -s 1 2 -o 1 x.png\nPr 0.5\n";

/// A model or an error, soon.
fn survive(obj: &[u8], mtl: &[u8]) {
    let start = Instant::now();
    drop(try_model(obj, &[("l.mtl", mtl)]));
    assert!(start.elapsed() < Duration::from_secs(5), "{:?}", start.elapsed());
}

#[test]
fn damaged_files_end() {
    try_model(OBJ, &[("l.mtl", MTL.as_bytes())]).unwrap();
    (0..OBJ.len()).for_each(|end| survive(&OBJ.as_bytes()[..end], MTL.as_bytes()));
    (0..MTL.len()).for_each(|end| survive(OBJ.as_bytes(), &MTL.as_bytes()[..end]));
    let mut rng = TestRng::from_seed(RngAlgorithm::ChaCha, &[7; 32]);
    for _ in 0..1500 {
        let mut texts = [OBJ.as_bytes().to_vec(), MTL.as_bytes().to_vec()];
        for text in &mut texts {
            for _ in 0..1 + rng.next_u32() % 5 {
                let at = rng.next_u32() as usize % text.len();
                text[at] = rng.next_u32() as u8;
            }
        }
        survive(&texts[0], &texts[1]);
    }
    // Polygons as long as a line.
    survive(format!("{SQUARE}f {}", "1 3 2 4 ".repeat(120_000)).as_bytes(), b"");
    survive(format!("{SQUARE}f {}", "\\\n".repeat(2_000_000)).as_bytes(), b"");
}

#[test]
fn files_of_other_programs() {
    let mut triangles = BTreeMap::new();
    for path in corpus("meshes", &["obj"]) {
        let file = read(&path, &[]).unwrap_or_else(|e| panic!("{e}"));
        let count: usize = file.desc.shape.mesh.iter().map(|mesh| mesh.triangle_count()).sum();
        assert!(count > 0, "{}", path.display());
        triangles.insert(path.file_name().unwrap().to_str().unwrap().to_owned(), count);
    }
    for (name, expected) in [("stanford-bunny.obj", 69_451), ("spot.obj", 5_856), ("assimp_box_UTF16BE.obj", 12)] {
        assert!(triangles.get(name).is_none_or(|&count| count == expected), "{name}: {triangles:?}");
    }
    corpus("bad", &["obj", "stl", "ply"]).iter().for_each(|path| drop(read(path, &[])));
}
