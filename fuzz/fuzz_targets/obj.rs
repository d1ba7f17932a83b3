//! Any bytes as an OBJ file; what stands before the first `newmtl` in them is the model, the rest its library of materials.

#![no_main]

use std::collections::BTreeMap;

use eyebeam_fuzz::read_model;
use eyebeam_io::scene::{Files, ReadOptions};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let library = bytes.windows(6).position(|word| word == b"newmtl").unwrap_or(bytes.len());
    let (model, library) = bytes.split_at(library);
    let files = BTreeMap::from([("a.mtl".to_owned(), library.to_vec())]);
    read_model("fuzzed.obj", model, Files::Given(&files), &ReadOptions::default());
});
