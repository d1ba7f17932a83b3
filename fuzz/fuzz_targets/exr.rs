//! Any bytes as a picture in OpenEXR.

#![no_main]

use eyebeam_fuzz::read_picture;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    // Others are of other targets.
    if bytes.starts_with(b"\x76\x2f\x31\x01") {
        read_picture(bytes);
    }
});
