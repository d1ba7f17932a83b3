//! STL, as text and binary.

use std::fs;
use std::time::{Duration, Instant};

use eyebeam_core::shape::MeshData;
use eyebeam_io::scene::{ReadOptions, SceneFile, Up, read, read_with};
use eyebeam_io::{At, Error};
use proptest::prelude::Rng as _;
use proptest::test_runner::{RngAlgorithm, TestRng};
use tempfile::TempDir;

use crate::models::corpus::corpus;

const TEXT: &str = "solid a b\nfacet normal 0 0 1\n outer loop\n  vertex 0 0 0\n  vertex 1 0 0\n  vertex 0 0 2e0\n endloop\nendfacet\n\
    facet normal 0 0 1\n outer loop\n  vertex 0 0 0\n  vertex 0 0 2\n  vertex -1 0 0\n endloop\nendfacet\nendsolid a b\n";

fn try_model(bytes: &[u8]) -> Result<SceneFile, Error> {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("m.stl");
    fs::write(&path, bytes).unwrap();
    read_with(&path, &ReadOptions { up: Some(Up::Y), ..ReadOptions::default() })
}

fn data(file: &SceneFile) -> &MeshData {
    file.desc.shape.mesh[0].data.as_deref().unwrap()
}

/// The triangles of [`TEXT`]; the title begins with `solid`, and the second has a colour.
fn binary() -> Vec<u8> {
    let mut bytes = b"solid".to_vec();
    bytes.resize(80, b' ');
    bytes.extend(2_u32.to_le_bytes());
    for (corners, color) in
        [([0.0_f32, 0., 0., 1., 0., 0., 0., 0., 2.], 0_u16), ([0., 0., 0., 0., 0., 2., -1., 0., 0.], 0x8001)]
    {
        bytes.extend([0; 12]);
        bytes.extend(corners.iter().flat_map(|c| c.to_le_bytes()));
        bytes.extend(color.to_le_bytes());
    }
    bytes
}

#[test]
fn text_and_binary_are_the_same_flat_mesh() {
    let (text, binary) = (try_model(TEXT.as_bytes()).unwrap(), try_model(&binary()).unwrap());
    assert_eq!(data(&text), data(&binary));
    assert_eq!(data(&text).vertices, [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 2.0], [-1.0, 0.0, 0.0]]);
    assert_eq!((&data(&text).triangles[..], data(&text).normals.len()), (&[[0, 1, 2], [0, 2, 3]][..], 0));
    assert_eq!(text.warnings, []);
    assert!(
        binary.warnings.len() == 1 && binary.warnings[0].message.ends_with("the colours of 1 triangles are not read")
    );
    assert_eq!(data(&try_model(TEXT.replace('\n', "\r\n").to_uppercase().as_bytes()).unwrap()), data(&text));
}

/// Printers build along +Z.
#[test]
fn z_is_up_if_nothing_is_said() {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("m.stl");
    fs::write(&path, TEXT).unwrap();
    assert_eq!(data(&read(&path, &[]).unwrap()).vertices[2], [0.0, 2.0, 0.0]);
}

#[test]
fn what_is_wrong_has_its_place() {
    let line = |n| At::Line(n);
    let not_finite = [&binary()[..84 + 12], &f32::NAN.to_le_bytes(), &binary()[84 + 16..]].concat();
    for (bytes, message, at) in [
        (TEXT.replacen("1 0 0\n", "1 x 0\n", 1).into_bytes(), "`x` is no number", line(5)),
        (TEXT.replacen("1 0 0\n", "1 nan 0\n", 1).into_bytes(), "not finite", line(7)),
        (TEXT.replacen("  vertex 1 0 0\n", "", 1).into_bytes(), "a facet has 2 vertices", line(6)),
        (TEXT.replacen("1 0 0\n", "1 0\n", 1).into_bytes(), "a vertex has three numbers", line(5)),
        (TEXT.replace(" endloop\n", "").into_bytes(), "more than three vertices", line(10)),
        (TEXT.as_bytes()[..90].to_vec(), "ends within a solid", line(7)),
        (
            binary()[..100].to_vec().split_off(0).into_iter().map(|b| if b == b's' { b'x' } else { b }).collect(),
            "too short for 2 triangles",
            At::Byte(80),
        ),
        (not_finite, "not finite", At::Byte(84)),
        (vec![], "no STL", At::File),
    ] {
        let Error::File(error) = try_model(&bytes).unwrap_err() else { panic!("{message}") };
        assert!(error.message.contains(message) && error.at == at, "{message}: {error}");
    }
}

#[test]
fn damaged_files_end() {
    let survive = |bytes: &[u8]| {
        let start = Instant::now();
        drop(try_model(bytes));
        assert!(start.elapsed() < Duration::from_secs(5), "{:?}", start.elapsed());
    };
    let mut rng = TestRng::from_seed(RngAlgorithm::ChaCha, &[7; 32]);
    for whole in [TEXT.as_bytes().to_vec(), binary()] {
        (0..whole.len()).for_each(|end| survive(&whole[..end]));
        for _ in 0..1000 {
            let mut bytes = whole.clone();
            for _ in 0..1 + rng.next_u32() % 5 {
                let at = rng.next_u32() as usize % bytes.len();
                bytes[at] = rng.next_u32() as u8;
            }
            survive(&bytes);
        }
    }
}

#[test]
fn files_of_other_programs() {
    for path in corpus("meshes", &["stl"]) {
        let file = read(&path, &[]).unwrap_or_else(|e| panic!("{e}"));
        assert!(!data(&file).triangles.is_empty() && data(&file).vertices.len() <= 3 * data(&file).triangles.len());
    }
}
