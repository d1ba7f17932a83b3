//! Any text as a scene file.

#![no_main]

use eyebeam_fuzz::{NAME, check};
use eyebeam_io::scene::read_str;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    check(read_str(NAME, text, &[]));
});
