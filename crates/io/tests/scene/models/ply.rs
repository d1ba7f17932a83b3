//! PLY files as models.

use std::fs;

use eyebeam_core::material::MaterialDesc;
use eyebeam_core::texture::{Scalar, TextureDesc};
use eyebeam_io::At;
use eyebeam_io::scene::read;
use tempfile::TempDir;

use crate::models::{TRIANGLE, model};

#[test]
fn what_is_not_read_is_told_of() {
    let text = TRIANGLE.replace("property uchar red", "property uchar quality").replacen(
        "1.0\n",
        "1.0\ncomment TextureFile a.png\n",
        1,
    );
    let warnings = model("t.ply", &text, None).warnings;
    let said: Vec<_> = warnings.iter().map(|w| w.message.as_str()).collect();
    assert_eq!(
        said,
        [
            "the picture `a.png` is not read",
            "the properties `quality`, `green`, `blue` of the element `vertex` are not read"
        ]
    );
    let place = warnings[1].place.as_ref().unwrap();
    assert!(place.file.ends_with("t.ply") && place.at == At::Line(4), "{place:?}");
    // In scene files, too.
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("t.ply"), &text).unwrap();
    fs::write(folder.path().join("s.toml"), "[[shape.mesh]]\nfile = \"t.ply\"\n[[shape.mesh]]\nfile = \"t.ply\"\n")
        .unwrap();
    let warnings = read(&folder.path().join("s.toml"), &[]).unwrap().warnings;
    assert!(warnings.len() == 2 && warnings[0].message == "`t.ply`: the picture `a.png` is not read", "{warnings:?}");
}

/// The triangle with such alphas.
fn alphas(alphas: [&str; 3]) -> String {
    let mut text = TRIANGLE.replace("blue\n", "blue\nproperty uchar alpha\n");
    for (corner, alpha) in ["0 0 0 255 0 0", "1 0 0 255 0 0", "0 0 2 255 0 0"].into_iter().zip(alphas) {
        text = text.replace(corner, &format!("{corner} {alpha}"));
    }
    text
}

#[test]
fn alphas_make_holes() {
    let file = model("t.ply", &alphas(["255", "0", "51"]), None);
    assert_eq!(file.desc.shape.mesh[0].data.as_ref().unwrap().alphas, [1.0, 0.0, 0.2]);
    let name = file.desc.shape.mesh[0].material.as_ref().unwrap();
    let MaterialDesc::Mask(mask) = &file.desc.material[name] else { panic!("{name}") };
    let Scalar::Texture(opacity) = &mask.opacity else { panic!() };
    assert!(matches!(&file.desc.texture[opacity.name()], TextureDesc::VertexColor(colors) if colors.alpha));
    assert!(
        matches!(&file.desc.material[mask.of.name()], MaterialDesc::Lambertian(matte) if matte.albedo.rgb().is_none())
    );
    assert_eq!(file.warnings, []);
    // Those that are full make none; and neither do those of programs that do not know them.
    for (given, told) in [(["255"; 3], 0), (["0"; 3], 1)] {
        let file = model("t.ply", &alphas(given), None);
        assert_eq!((file.desc.material.len(), file.warnings.len()), (1, told), "{given:?}");
    }
}
