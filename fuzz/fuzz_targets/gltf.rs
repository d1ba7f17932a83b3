//! Any bytes as glTF or GLB: a scene that can be rendered, or an error.

#![no_main]

use eyebeam_fuzz::read_model;
use eyebeam_io::scene::{Files, ReadOptions};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    for animation in [None, Some("0")] {
        read_model("fuzzed.glb", bytes, Files::None, &ReadOptions { animation, at: 0.5, ..ReadOptions::default() });
    }
});
