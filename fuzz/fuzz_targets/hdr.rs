//! Any bytes as a picture in Radiance HDR.

#![no_main]

use eyebeam_fuzz::read_picture;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    // Others are of other targets.
    if bytes.starts_with(b"#?") {
        read_picture(bytes);
    }
});
