//! Other people's files, which are no part of the repository.

use std::fs;
use std::io::{Write, stderr};
use std::path::{Path, PathBuf};

/// Every file in a folder of the corpus or below whose name has one of these endings, or any if there are none. Without the folder there are
/// none, and the output of the test says so.
pub(crate) fn corpus(folder: &str, endings: &[&str]) -> Vec<PathBuf> {
    let beside = || Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/scenes");
    let root = std::env::var_os("EYEBEAM_CORPUS").map_or_else(beside, PathBuf::from).join(folder);
    if !root.is_dir() {
        // Not by `println`, which nobody sees of a test that passes.
        let _ = writeln!(stderr(), "not tested: there is no {folder}; EYEBEAM_CORPUS tells where it is");
    }
    let is_wanted = |path: &Path| {
        let is = |ending: &&str| path.extension().is_some_and(|e| e.eq_ignore_ascii_case(ending));
        endings.is_empty() || endings.iter().any(is)
    };
    let (mut found, mut folders) = (Vec::new(), vec![root]);
    while let Some(folder) = folders.pop() {
        for path in fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path()) {
            match path.is_dir() {
                true => folders.push(path),
                false if is_wanted(&path) => found.push(path),
                false => {}
            }
        }
    }
    found.sort();
    found
}
