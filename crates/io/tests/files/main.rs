//! Files that scenes refer to, above all damaged ones.

mod ies;
mod images;
mod ply;

use std::fs;
use std::path::{Path, PathBuf};

use eyebeam_io::{At, Error, FileError};

/// All files below a folder of scenes beside the checkout; none, and a word about it, if there is no such folder.
fn corpus(folder: &str) -> Vec<PathBuf> {
    let root = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared/scenes")).join(folder);
    if !root.is_dir() {
        println!("skipped: there is no {}", root.display());
    }
    let mut found = Vec::new();
    let mut folders = vec![root];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
            let path = entry.path();
            if path.is_dir() { folders.push(path) } else { found.push(path) }
        }
    }
    found.sort();
    found
}

fn has_ending(path: &Path, ending: &str) -> bool {
    path.extension().is_some_and(|e| e.eq_ignore_ascii_case(ending))
}

/// What is wrong with the file; it has a message, and a place that is in the file.
fn flaw(error: Error, bytes: &[u8]) -> FileError {
    let Error::File(flaw) = error else { panic!("{error}") };
    assert!(!flaw.message.is_empty());
    match flaw.at {
        At::File => {}
        At::Line(line) => assert!((1..=bytes.len() + 1).contains(&line), "{flaw}"),
        At::Byte(byte) => assert!(byte <= bytes.len(), "{flaw}"),
    }
    flaw
}
