//! Files that are no scenes.

use std::fs::{self, File};
use std::path::Path;
use std::time::{Duration, Instant};

use eyebeam_core::desc::SceneDesc;
use eyebeam_io::scene::read;
use eyebeam_io::{Diagnostic, Error};

use crate::{places, problems};

fn read_bytes(bytes: &[u8]) -> Result<SceneDesc, Error> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.toml");
    fs::write(&path, bytes).unwrap();
    read(&path, &[]).map(|file| file.desc)
}

fn only(error: Error) -> (String, (usize, usize)) {
    match problems(error).as_slice() {
        all @ [Diagnostic { message, .. }] => (message.clone(), places(all)[0]),
        other => panic!("{other:?}"),
    }
}

#[test]
fn empty_ones() {
    for empty in ["", " ", "\r\n\t\n", "\u{feff}", "\u{feff}\n"] {
        let error = read_bytes(empty.as_bytes()).expect_err(empty);
        assert_eq!(only(error), ("the scene file is empty".to_owned(), (1, 1)));
    }
    assert_eq!(read_bytes(b"# only the sky").unwrap(), SceneDesc::default());
}

#[test]
fn the_mark_of_editors_takes_no_column() {
    let error = read_bytes("\u{feff}cam = 1".as_bytes()).unwrap_err();
    assert_eq!(only(error).1, (1, 1));
}

#[test]
fn bytes_that_are_no_text() {
    for (bytes, byte, place) in [
        (&b"\xff"[..], "0xff", (1, 1)),
        (b"# \xc3\xa9\r\n# \xc3\xa9\xc3\xa9 \xa9 x", "0xa9", (2, 6)),
        (b"# cut \xf0\x9d\x84", "0xf0", (1, 7)),
        (b"\xfe\xff\0[\0c", "0xfe", (1, 1)),
    ] {
        assert_eq!(only(read_bytes(bytes).unwrap_err()), (format!("byte {byte} is not UTF-8"), place));
    }
    assert!(matches!(read_bytes(b"\0\0\0\0"), Err(Error::Scene(_))));
}

#[test]
fn those_that_are_not_there() {
    let folder = tempfile::tempdir().unwrap();
    for path in [folder.path(), &folder.path().join("missing.toml"), &folder.path().join("a/b.toml"), Path::new("")] {
        assert!(matches!(read(path, &[]), Err(Error::Io { action: "read", .. })), "{}", path.display());
    }
}

#[test]
fn too_long_ones_are_refused_at_once() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("long.toml");
    File::create(&path).unwrap().set_len(1 << 40).or_else(|_| File::create(&path)?.set_len(1 << 30)).unwrap();
    let start = Instant::now();
    assert_eq!(only(read(&path, &[]).unwrap_err()).0, "the scene file is longer than 64 MiB");
    assert!(start.elapsed() < Duration::from_secs(2), "it was read");
}

#[cfg(target_os = "linux")]
#[test]
fn endless_ones_are_refused() {
    let error = read(Path::new("/dev/zero"), &[]).unwrap_err();
    assert_eq!(only(error).0, "the scene file is longer than 64 MiB");
}
