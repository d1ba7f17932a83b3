//! Any bytes as a photometric file of a luminaire.

#![no_main]

use eyebeam_fuzz::{NAME, check};
use eyebeam_io::ies::read_ies_bytes;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    check(read_ies_bytes(NAME, bytes));
});
