//! Any bytes as an STL file, text or binary.

#![no_main]

use eyebeam_fuzz::read_model;
use eyebeam_io::scene::{Files, ReadOptions};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| read_model("fuzzed.stl", bytes, Files::None, &ReadOptions::default()));
