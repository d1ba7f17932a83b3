//! MTL: what is read in one way or another, and what is told of.

use eyebeam_core::material::{Mask, MaterialDesc};
use eyebeam_core::texture::{Encoding, Scalar, TextureDesc};
use eyebeam_io::scene::SceneFile;

use crate::models::obj::{image, library, png, png_of, principled, said};

/// What is told of a library of one material.
fn told(lines: &str) -> Vec<String> {
    said(&library(&format!("newmtl a\n{lines}\n"), &[("b.png", &png()), ("c.png", &png())]))
}

fn material<'a>(file: &'a SceneFile, name: &str) -> &'a MaterialDesc {
    &file.desc.material[name]
}

/// Blender writes normals as `map_Bump`.
#[test]
fn normals_that_are_called_heights() {
    let normals = png_of(&[120, 130, 250]);
    let file = library(
        "newmtl a\nmap_Bump -bm 0.5 n.png\nnewmtl b\nbump -imfchan b n.png\nnewmtl c\nbump b.png\nnewmtl d\nbump -bm 1e9 n.png\n\
         newmtl e\nnorm -bm 2 n.png\nbump n.png\n",
        &[("n.png", &normals), ("b.png", &png())],
    );
    let strength = |name: &str| match material(&file, name) {
        MaterialDesc::NormalMap(map) => map.strength,
        other => panic!("{other:?}"),
    };
    assert_eq!(
        (strength("a"), strength("d"), strength("e"), image(&file, "a bump").encoding),
        (0.5, 100.0, 2.0, Encoding::Linear)
    );
    for name in ["b", "c"] {
        assert!(matches!(material(&file, name), MaterialDesc::Bump(_)), "{name}");
    }
    assert_eq!(said(&file), [""; 0]);
    assert_eq!(told("norm b.png\nbump c.png"), ["material `a`: its `bump` is not used beside its `norm`"]);
}

#[test]
fn opacity_comes_before_clarity() {
    for (lines, opacity, expected) in [
        ("d 0.25\nTr 0.75", 0.25, None),
        ("Tr 0.75\nd 0.25", 0.25, None),
        ("d 0.25\nTr 0.25", 0.25, Some("3: `Tr` is not 1 - `d`, and not used")),
        ("Tr 0.25\nd 0.25", 0.25, Some("2: `Tr` is not 1 - `d`, and not used")),
        ("Tr 0.25", 0.75, None),
    ] {
        let file = library(&format!("newmtl a\n{lines}\n"), &[]);
        let MaterialDesc::Mask(mask) = material(&file, "a") else { panic!("{lines}") };
        assert_eq!(
            (mask.opacity.number(), said(&file).first().map(String::as_str)),
            (Some(opacity), expected),
            "{lines}"
        );
    }
}

#[test]
fn opacity_times_its_picture() {
    let file = library(
        "newmtl a\nd 0.5\nmap_d b.png\nnewmtl b\nd 1\nmap_d b.png\nnewmtl c\nd 0\nmap_d b.png\n",
        &[("b.png", &png())],
    );
    let picture = |name: &str| match material(&file, name) {
        MaterialDesc::Mask(Mask { opacity: Scalar::Texture(name), .. }) => name.name().to_owned(),
        other => panic!("{other:?}"),
    };
    let TextureDesc::Multiply(product) = &file.desc.texture[&picture("a")] else { panic!() };
    assert_eq!(product.b.rgb().unwrap().0, [0.5; 3]);
    assert_eq!((picture("b"), picture("c"), said(&file)), ("b d".to_owned(), "c d".to_owned(), vec![]));
}

/// What shines has relief and holes like anything else.
#[test]
fn lamps_keep_their_layers() {
    let file = library("newmtl a\nKe 1 2 4\nd 0.5\nbump b.png\nnewmtl b\nKe 1 1 1\nnorm b.png\n", &[("b.png", &png())]);
    let MaterialDesc::Mask(mask) = material(&file, "a") else { panic!() };
    let MaterialDesc::Bump(bump) = material(&file, mask.of.name()) else { panic!() };
    assert!(principled(&file, bump.of.name()).emission_luminance > 0.0);
    let MaterialDesc::NormalMap(map) = material(&file, "b") else { panic!() };
    assert!(principled(&file, map.of.name()).emission_luminance > 0.0);
    assert_eq!(said(&file), [""; 0]);
}

/// Without gloss a picture of it makes none.
#[test]
fn gloss_is_of_its_illumination() {
    for (illum, weight) in [("0", 0.0), ("1", 0.0), ("2", 1.0)] {
        let file = library(&format!("newmtl a\nKs 1 1 1\nmap_Ks b.png\nillum {illum}\n"), &[("b.png", &png())]);
        assert_eq!(principled(&file, "a").specular_weight.number(), Some(weight), "{illum}");
    }
}

#[test]
fn what_is_not_used_is_told_of() {
    for (lines, expected) in [
        ("Pr 0.5\nKs 0.3 0.2 0.1", "3: `Ks` is not used beside `Pr`, `Pm`, `Ps` or `Pc`"),
        ("Pm 0.5\nmap_Ks b.png", "3: `map_Ks` is not used beside `Pr`, `Pm`, `Ps` or `Pc`"),
        ("Tf 0.5 1 1", "material `a`: its `Tf` is not used: it is not clear"),
        ("Kd 1 2 3", "2: `Kd` outside of 0..1 is clamped"),
        ("Ks -1 0 0", "2: `Ks` outside of 0..1 is clamped"),
        ("Pm 2", "2: `Pm` outside of 0..1 is clamped"),
        ("Ni 5", "2: `Ni` above 3 is taken as 3"),
        ("Ni 0.75", "2: `Ni` below 1 is not used"),
        ("map_Kd -bm 2 b.png", "2: the option `-bm` is not read"),
        ("Kd 1 0 0\nnewmtl a\nKd 0 1 0", "3: a second `newmtl a` is not used"),
    ] {
        assert_eq!(told(lines), [expected], "{lines}");
    }
    let usual = "Kd 1 1.0000001 1\nKs 0.5 0.5 0.5\nKe 9 9 9\nTf 1 1 1\nNi 1.45\nPr 0.5\nPs 0\nd 1\nTr 0\nillum 2";
    for silent in
        [usual, "Tf 0 0 0\nNi 0", "Tf 0.5 1 1\nillum 7\nKd 0 0 0", "Kd 1 0 0\nnewmtl a\nKd 1 0 0", "map_Kd -bm 1 b.png"]
    {
        assert_eq!(told(silent), [""; 0], "{silent}");
    }
}
