//! Meshes of PLY files.

use std::time::{Duration, Instant};

use eyebeam_core::shape::MeshData;
use eyebeam_io::At;
use eyebeam_io::scene::ply::{read_ply, read_ply_bytes};
use proptest::prelude::*;

use crate::corpus::corpus;
use crate::flaw;

fn read(text: &str) -> MeshData {
    read_ply_bytes("a.ply", text.as_bytes()).unwrap_or_else(|e| panic!("{e}")).0
}

/// What is told of, each after its line.
fn said(text: &str) -> Vec<String> {
    let (_, warnings) = read_ply_bytes("a.ply", text.as_bytes()).unwrap();
    let said = warnings.into_iter().map(|warning| {
        let place = warning.place.unwrap();
        assert_eq!(place.file, "a.ply");
        let At::Line(line) = place.at else { panic!("{:?}", place.at) };
        format!("{line}: {}", warning.message)
    });
    said.collect()
}

fn try_ply(bytes: &[u8]) -> Option<MeshData> {
    let start = Instant::now();
    let read = read_ply_bytes("a.ply", bytes).map_err(|error| flaw(error, bytes));
    assert!(start.elapsed() < Duration::from_secs(5), "{:?}", start.elapsed());
    let mesh = read.ok()?.0;
    let vertices = mesh.vertices.len();
    assert!(mesh.vertices.iter().flatten().all(|c| c.is_finite()));
    assert!(mesh.triangles.iter().flatten().all(|&i| (i as usize) < vertices));
    assert!(mesh.normals.is_empty() || mesh.normals.len() == vertices);
    assert!(mesh.uvs.is_empty() || mesh.uvs.len() == vertices);
    Some(mesh)
}

/// A square and a triangle, with things to skip before, between and after.
const TEXT: &str = "ply\nformat ascii 1.0\ncomment by hand\n\
    element camera 1\nproperty list uchar float view\nproperty int id\n\
    element vertex 5\nproperty float ny\nproperty double z\nproperty short x\nproperty float nz\nproperty list uint8 char tag\n\
    property float y\nproperty float nx\nproperty float t\nproperty float s\n\
    element face 3\nproperty uchar red\nproperty list uchar uint vertex_indices\nproperty list uchar float texcoord\n\
    element edge 1\nproperty int a\nend_header\n\
    3 0.5 1 2 7\n\
    1 0.5 0 0 0 0 0 0.25 0.75\n1 0 1 0 1 9 0 nan 0 0\n1 0 1 0 2 9 9 1 0 0 0\n1 0 0 0 0 1 0 0 0\n1 2 0 0 0 1e-3 0 0 0\n\
    255 4 0 1 2 3 2 0 0\n1 2 0 1 0\n0 3\n3 2 4 0\n1\n";

#[test]
fn any_order_and_anything_else() {
    let mesh = read(TEXT);
    let up = [0.0, 1.0, 0.0];
    assert_eq!(mesh.vertices[0], [0.0, 0.0, 0.5]);
    assert_eq!(mesh.vertices[2], [1.0, 1.0, 0.0]);
    assert_eq!(mesh.vertices[4], [0.0, 1e-3, 2.0]);
    assert_eq!(mesh.normals, [up, [0.0; 3], up, up, up]);
    assert_eq!(mesh.uvs[0], [0.75, 0.25]);
    assert_eq!(mesh.triangles, [[0, 1, 2], [0, 2, 3], [3, 2, 4]]);
    for ends in ["\r\n", "\r"] {
        assert_eq!(read(&TEXT.replace('\n', ends)), mesh);
    }
    assert_eq!(read(TEXT.trim_end()), mesh);
}

#[test]
fn colours_of_vertices() {
    let text = |kind: &str, names: [&str; 3], rows: [&str; 3]| {
        let properties = names.map(|name| format!("property {kind} {name}\n")).concat();
        let rows = rows.map(|row| format!("0 0 0 {row}\n")).concat();
        format!(
            "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n{properties}\
             element face 1\nproperty list uchar int vertex_indices\nend_header\n{rows}3 0 1 2\n"
        )
    };
    // Bytes are as screens show them, other numbers are light.
    let bytes = read(&text("uchar", ["red", "green", "blue"], ["255 0 188", "0 0 0", "1 2 3"])).colors;
    assert!(bytes.len() == 3 && bytes[0][..2] == [1.0, 0.0] && (bytes[0][2] - 0.5).abs() < 0.005, "{bytes:?}");
    let floats = read(&text("float", ["r", "g", "b"], ["0.5 2 0.25", "-1 nan 0", "inf 1 1"])).colors;
    assert_eq!(floats, [[0.5, 2.0, 0.25], [0.0; 3], [0.0, 1.0, 1.0]]);
    assert!(read(&text("uchar", ["red", "green", "alpha"], ["1 2 3"; 3])).colors.is_empty());
    // Of other whole numbers the largest tells up to what they count.
    let bytes = read(&text("uchar", ["red", "green", "blue"], ["255 0 188", "0 0 0", "1 2 3"])).colors;
    for kind in ["char", "short", "int", "uint"] {
        assert_eq!(
            read(&text(kind, ["red", "green", "blue"], ["255 0 188", "0 0 0", "1 2 3"])).colors,
            bytes,
            "{kind}"
        );
    }
    let words = read(&text("int", ["red", "green", "blue"], ["65535 0 48316", "0 -1 nan", "257 514 771"])).colors;
    assert_eq!((words[0], words[1][..2].to_vec(), words[2]), (bytes[0], vec![0.0; 2], bytes[2]));
    let longs = read(&text("uint", ["red", "green", "blue"], ["4000000000 0 0"; 3])).colors;
    assert_eq!(longs[0], [1.0, 0.0, 0.0]);
}

#[test]
fn what_is_not_read_is_told_of() {
    let expected = [
        "4: the elements `camera`, `edge` are not read",
        "7: the property `tag` of the element `vertex` is not read",
        "17: the properties `red`, `texcoord` of the element `face` are not read",
        "17: a face of fewer than three corners is dropped",
    ];
    assert_eq!(said(TEXT), expected);
    // Nothing of what is plain.
    let face = "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
    let plain = format!("{HEAD}{face}{FOUR}3 0 1 2\n \r\n");
    assert_eq!(said(&plain), [""; 0]);
    assert_eq!(said(&format!("{plain}3 0 1 2\n")), ["16: 7 bytes after the last element are not read"]);
    let picture =
        plain.replacen("1.0\n", "1.0\ncomment TextureFile my wood.png\ncomment TextureFiles\ncomment TextureFile\n", 1);
    assert_eq!(said(&picture), ["3: the picture `my wood.png` is not read"]);
    let many: String = (0..50).map(|i| format!("property float p{i}\n")).collect();
    let many = HEAD.replace("property float x", &format!("{many}property float x"));
    let many = format!("{many}{face}{}3 0 1 2", FOUR.replace('\n', &format!("{}\n", " 0".repeat(50))));
    assert!(said(&many)[0].ends_with("`p7` and 42 more of the element `vertex` are not read"), "{:?}", said(&many));
}

/// An arrow whose corner 3 lies inwards: its triangles lie on it alone, wherever the list begins, and whatever comes first.
#[test]
fn concave_polygons() {
    let places = [[0, 0], [2, 1], [0, 2], [1, 1]];
    let vertices: String = places.iter().map(|[x, y]| format!("{x} {y} 0\n")).collect();
    let list = "element face 1\nproperty list uchar int vertex_indices\n";
    let head = HEAD.strip_prefix("ply\nformat ascii 1.0\n").unwrap();
    for turn in 0..4 {
        let corners: String = (0..4).map(|i| format!(" {}", (i + turn) % 4)).collect();
        let late = format!("{HEAD}{list}end_header\n{vertices}4{corners}\n");
        let early = format!("ply\nformat ascii 1.0\n{list}{head}end_header\n4{corners}\n{vertices}");
        for text in [late, early] {
            let mesh = read(&text);
            assert!(
                mesh.triangles.len() == 2 && mesh.triangles.iter().all(|t| t.contains(&1) && t.contains(&3)),
                "{mesh:?}"
            );
        }
    }
}

/// One polygon that turns this way and that, at every corner of the file.
#[test]
fn polygons_of_many_corners_end() {
    for (count, told) in [(1_u32 << 18, 0), ((1 << 18) + 1, 1)] {
        let mut bytes = format!(
            "ply\nformat binary_little_endian 1.0\nelement vertex {count}\nproperty float x\nproperty float y\n\
             property float z\nelement face 1\nproperty list uint uint vertex_indices\nend_header\n"
        )
        .into_bytes();
        for i in 0..count {
            let place = [(i.wrapping_mul(2_654_435_761) >> 8) as f32, (i.wrapping_mul(40_503) % 65_536) as f32, 0.0];
            place.iter().for_each(|c| bytes.extend(c.to_le_bytes()));
        }
        std::iter::once(count).chain(0..count).for_each(|i| bytes.extend(i.to_le_bytes()));
        let start = Instant::now();
        let (mesh, warnings) = read_ply_bytes("a.ply", &bytes).unwrap();
        println!("{:?}", start.elapsed());
        assert_eq!((mesh.triangles.len() as u32, warnings.len()), (count - 2, told), "{warnings:?}");
        assert!(start.elapsed() < Duration::from_secs(5), "{:?}", start.elapsed());
    }
}

/// The same in binary.
fn binary(big_endian: bool) -> Vec<u8> {
    let format = if big_endian { "binary_big_endian" } else { "binary_little_endian" };
    let end = TEXT.find("end_header\n").unwrap() + "end_header\n".len();
    let mut bytes = TEXT[..end].replace("ascii", format).into_bytes();
    let mut put = |value: &str, kind: &str| {
        let number: f64 = value.parse().unwrap();
        let mut raw = match kind {
            "uchar" => vec![number as u8],
            "char" => vec![number as i8 as u8],
            "short" => (number as i16).to_le_bytes().to_vec(),
            "int" => (number as i32).to_le_bytes().to_vec(),
            "uint" => (number as u32).to_le_bytes().to_vec(),
            "float" => (number as f32).to_le_bytes().to_vec(),
            _ => number.to_le_bytes().to_vec(),
        };
        if big_endian {
            raw.reverse();
        }
        bytes.extend(raw);
    };
    let mut words = TEXT[end..].split_ascii_whitespace();
    let mut row = |kinds: &[&str]| {
        for kind in kinds {
            let word = words.next().unwrap();
            match kind.strip_prefix("list ") {
                None => put(word, kind),
                Some(item) => {
                    put(word, "uchar");
                    (0..word.parse().unwrap()).for_each(|_| put(words.next().unwrap(), item));
                }
            }
        }
    };
    row(&["list float", "int"]);
    (0..5).for_each(|_| row(&["float", "double", "short", "float", "list char", "float", "float", "float", "float"]));
    (0..3).for_each(|_| row(&["uchar", "list uint", "list float"]));
    row(&["int"]);
    bytes
}

#[test]
fn binary_is_the_same() {
    for big_endian in [false, true] {
        let (mesh, warnings) = read_ply_bytes("a.ply", &binary(big_endian)).unwrap_or_else(|e| panic!("{e}"));
        assert_eq!(warnings.len(), 4, "{warnings:?}");
        assert_eq!(mesh.triangles, read(TEXT).triangles);
        assert_eq!(mesh.vertices, read(TEXT).vertices);
        assert_eq!(mesh.normals, read(TEXT).normals);
        assert_eq!(mesh.uvs, read(TEXT).uvs);
    }
}

const HEAD: &str = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n";
const FOUR: &str = "0 0 0\n1 0 0\n0 1 0\n1 1 0\n";

#[test]
fn strips() {
    let strips = "element tristrips 1\nproperty list int int vertex_indices\nend_header\n";
    let mesh = read(&format!("{HEAD}{strips}{FOUR}11 0 1 2 3 -1 3 2 1 -1 0 0\n"));
    assert_eq!(mesh.triangles, [[0, 1, 2], [2, 1, 3], [3, 2, 1]]);
}

#[test]
fn faces_may_come_first() {
    let text = "ply\nformat ascii 1.0\nelement face 1\nproperty list int int vertex_index\nelement vertex 3\n\
        property float x\nproperty float y\nproperty float z\nend_header\n3 0 1 2\n0 0 0\n1 0 0\n0 1 0\n";
    assert_eq!(read(text).triangles, [[0, 1, 2]]);
}

#[test]
fn mistakes_have_their_place() {
    let face = "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
    for (text, said, at) in [
        (String::new(), "no PLY file", At::Line(1)),
        ("solid\n".to_owned(), "no PLY file", At::Line(1)),
        (HEAD.to_owned(), "no `end_header`", At::File),
        (HEAD.replace("ascii", "text"), "unknown format `text`", At::Line(2)),
        (HEAD.replace("vertex 4", "vertex -4"), "`-4` is no number", At::Line(3)),
        (HEAD.replace("float y", "real y"), "unknown type `real`", At::Line(5)),
        (HEAD.replace("element", "elephant"), "`elephant`", At::Line(3)),
        (format!("{HEAD}end_header\n{FOUR}"), "no faces", At::File),
        (format!("{HEAD}element vertex 1\n{face}"), "two elements are named `vertex`", At::Line(7)),
        (format!("{HEAD}{face}{FOUR}").replace("float y", "float w"), "no numbers `x`, `y` and `z`", At::Line(3)),
        (format!("{HEAD}{face}{FOUR}3 0 1 2").replace("indices", "numbers"), "no list `vertex_indices`", At::Line(7)),
        (format!("{HEAD}{face}{FOUR}3 0 1 4"), "there is no vertex 4", At::Line(14)),
        (format!("{HEAD}{face}{FOUR}3 0 1\n-1"), "there is no vertex -1", At::Line(15)),
        (format!("{HEAD}{face}{FOUR}3 0 1 0.5"), "there is no vertex 0.5", At::Line(14)),
        (format!("{HEAD}{face}{FOUR}-3 0 1 2"), "cannot have -3 items", At::Line(14)),
        (format!("{HEAD}{face}{FOUR}3 0 1"), "cut off", At::Line(14)),
        (format!("{HEAD}{face}{FOUR}").replace("1 1 0", "1 x 0"), "`x` is no number", At::Line(13)),
        (format!("{HEAD}{face}{FOUR}").replace("1 1 0", "1 1e99 0"), "not finite", At::Line(13)),
        (format!("{HEAD}{face}{FOUR}").replace("vertex 4", "vertex 4000000000"), "too short", At::Line(10)),
        (format!("{HEAD}{face}{FOUR}").replace("vertex 4", "vertex 99999999999999"), "too many", At::File),
    ] {
        let found = flaw(read_ply_bytes("a.ply", text.as_bytes()).expect_err(&text), text.as_bytes());
        assert!(found.message.contains(said) && found.at == at, "{found}\n{text}");
    }
}

#[test]
fn truncated() {
    // What follows the faces is not read.
    let unread = |bytes: &[u8]| bytes.len() - 4;
    for big_endian in [false, true] {
        let bytes = binary(big_endian);
        for end in 0..unread(&bytes) {
            assert!(try_ply(&bytes[..end]).is_none(), "cut at {end} of {}", bytes.len());
        }
    }
    for end in 0..TEXT.len() - 5 {
        assert!(try_ply(&TEXT.as_bytes()[..end]).is_none(), "cut at {end}");
    }
}

#[test]
fn promises_are_not_believed() {
    for elements in ["vertex 4294967295", "face 4294967295", "camera 18446744073709551615", "tristrips 9999999999"] {
        let name = elements.split_once(' ').unwrap().0;
        for bytes in [binary(false), binary(true), TEXT.as_bytes().to_vec()] {
            let text = String::from_utf8_lossy(&bytes[..600]).into_owned();
            let Some(start) = text.find(&format!("element {name} ")) else { continue };
            let end = start + text[start..].find('\n').unwrap();
            let lying = [&bytes[..start], b"element ", elements.as_bytes(), &bytes[end..]].concat();
            assert!(try_ply(&lying).is_none(), "{elements}");
        }
    }
    // Elements without properties take no bytes, and no time.
    let nothing = TEXT.replace("element vertex", "element nothing 18446744073709551615\nelement vertex");
    assert_eq!(read(&nothing), read(TEXT));
}

#[test]
fn a_million_triangles_are_read_soon() {
    let (vertices, faces) = (650_000_u32, 1_300_000_u32);
    let mut bytes = format!(
        "ply\nformat binary_little_endian 1.0\nelement vertex {vertices}\nproperty float x\nproperty float y\n\
         property float z\nelement face {faces}\nproperty list uchar int vertex_indices\nend_header\n"
    )
    .into_bytes();
    (0..vertices * 3).for_each(|i| bytes.extend((i as f32).to_le_bytes()));
    for i in 0..faces {
        bytes.push(3);
        [0, 1, 2].iter().for_each(|k| bytes.extend(((i + k) % vertices).to_le_bytes()));
    }
    let start = Instant::now();
    let (mesh, _) = read_ply_bytes("a.ply", &bytes).unwrap();
    println!("{:?}", start.elapsed());
    assert_eq!(mesh.vertices[649_999], [1_949_997.0, 1_949_998.0, 1_949_999.0]);
    assert_eq!(mesh.triangles[1_299_999], [649_999, 0, 1]);
    assert!(start.elapsed() < Duration::from_secs(5), "{:?}", start.elapsed());
}

#[test]
fn good_ones() {
    let mut read = 0;
    for path in ["meshes", "mitsuba", "pbrt"].into_iter().flat_map(|folder| corpus(folder, &["ply"])) {
        match read_ply(&path) {
            Ok((mesh, _)) => assert!(!mesh.triangles.is_empty() && !mesh.vertices.is_empty(), "{}", path.display()),
            Err(error) => assert!(path.ends_with("points.ply"), "{error}"),
        }
        read += 1;
    }
    println!("{read} files");
}

#[test]
fn bad_ones() {
    for path in corpus("bad", &["ply"]) {
        let error = try_ply(&std::fs::read(&path).unwrap());
        assert!(error.is_none(), "{}", path.display());
    }
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 2000,
        failure_persistence: None,
        rng_seed: prop::test_runner::RngSeed::Fixed(1),
        ..ProptestConfig::default()
    })]

    #[test]
    fn with_some_bytes_changed(
        kind in 0..3_usize,
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..4),
    ) {
        let [little, big, text] = [binary(false), binary(true), TEXT.as_bytes().to_vec()];
        let mut bytes = match kind { 0 => little, 1 => big, _ => text };
        for (at, byte) in changes {
            let at = at.index(bytes.len());
            bytes[at] = byte;
        }
        try_ply(&bytes);
    }
}
