//! Good files that are cut off, or in which some bytes are wrong.

use crate::{alone, attempt, random, samples};

#[test]
fn as_they_are_they_can_be_read() {
    let _alone = alone();
    for (name, bytes) in samples::all() {
        assert_eq!(attempt(&name, &bytes), None, "{name}");
    }
}

/// With a folder in `EYEBEAM_SEEDS`, writes them there: that is where fuzzing begins (`make fuzz`).
#[test]
fn fuzzing_begins_with_them() {
    let _alone = alone();
    let Some(folder) = std::env::var_os("EYEBEAM_SEEDS") else { return };
    for (name, bytes) in samples::all() {
        let target = match name.rsplit_once('.').unwrap_or_default().1 {
            "glb" | "gltf" => "gltf",
            "obj" | "mtl" => "obj",
            "toml" => "scene",
            "jpg" => "jpeg",
            other => other,
        };
        let folder = std::path::Path::new(&folder).join(target);
        std::fs::create_dir_all(&folder).unwrap();
        std::fs::write(folder.join(&name), &bytes).unwrap();
    }
}

#[test]
fn cut_off() {
    let _alone = alone();
    for (name, bytes) in samples::all() {
        // All places of short ones.
        let step = if bytes.len() < 1000 { 1 } else { 64 };
        for end in (0..bytes.len()).step_by(step) {
            attempt(&name, &bytes[..end]);
        }
    }
}

#[test]
fn with_wrong_bytes() {
    let _alone = alone();
    let mut state = 1;
    for (name, bytes) in samples::all() {
        for _ in 0..400 {
            let mut bytes = bytes.clone();
            for _ in 0..=random(&mut state) % 4 {
                let at = random(&mut state) as usize % bytes.len();
                bytes[at] ^= 1 << (random(&mut state) % 8);
            }
            attempt(&name, &bytes);
        }
    }
}

/// Numbers are what readers trust most: each is made large.
#[test]
fn with_wrong_numbers() {
    let _alone = alone();
    for (name, bytes) in samples::all() {
        let Ok(text) = String::from_utf8(bytes) else { continue };
        let places = text.match_indices(|c: char| c.is_ascii_digit()).map(|(at, _)| at);
        for at in places.filter(|at| at % 3 == 0) {
            for number in ["99999999999999999999", "4294967295", "-1", "1e39", "nan"] {
                attempt(&name, format!("{}{number}{}", &text[..at], &text[at + 1..]).as_bytes());
            }
        }
    }
}

/// Found by fuzzing: vertices without numbers were none, and triangles had them.
#[test]
fn vertices_without_numbers() {
    let _alone = alone();
    let text = "ply\nformat ascii 1.0\nelement vertex 3\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n3 0 1 2\n";
    let error = attempt("mesh.ply", text.as_bytes()).unwrap();
    assert!(error.contains("vertices have no numbers `x`, `y` and `z`"), "{error}");
}

/// Found by fuzzing: the decoder went past the end of keys and values that are no whole words.
#[test]
fn keys_that_end_within_a_word() {
    let _alone = alone();
    let mut bytes = crate::pictures::ktx2();
    bytes.extend([5, 0, 0, 0, b'a', 0, b'b', b'c', b'd']);
    bytes[56..60].copy_from_slice(&180_u32.to_le_bytes());
    bytes[60..64].copy_from_slice(&9_u32.to_le_bytes());
    let error = attempt("picture.ktx2", &bytes).unwrap();
    assert!(error.contains("the keys and values of the KTX2 end within a word"), "{error}");
}
