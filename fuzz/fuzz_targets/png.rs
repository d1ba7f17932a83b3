//! Any bytes as a picture in PNG.

#![no_main]

use eyebeam_fuzz::read_picture;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    // Others are of other targets.
    if bytes.starts_with(b"\x89PNG") {
        read_picture(bytes);
    }
});
