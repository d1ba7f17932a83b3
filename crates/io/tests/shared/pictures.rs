//! Small pictures in formats that no crate of the tests writes.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;

/// 8 x 8 pixels [30 x, 200, 20 y] with the alpha 255 − 16 (x + y), with losses.
pub(crate) fn lossy_webp() -> Vec<u8> {
    const CODE: &str = "UklGRnAAAABXRUJQVlA4WAoAAAAQAAAABwAABwAAQUxQSBMAAAABuYzof0AgkPjbZjDAAhETkOUGAFZQOCA2AAAA0AEAnQEqCAAIAAKAQiWo\
AnQA9If7bAAA4j06ugyPov/xiDHv/5qOgNaA0h/z/7NLP+v+6kAA";
    STANDARD.decode(CODE).unwrap()
}

/// 5 x 3 pixels in two blocks of UASTC, each of one colour: 4 pixels of 200, 100 and 50, the rest of 30, 20 and 10.
pub(crate) fn ktx2() -> Vec<u8> {
    let words = |words: &[u32]| words.iter().flat_map(|w| w.to_le_bytes()).collect::<Vec<u8>>();
    let header = words(&[0, 1, 5, 3, 0, 0, 1, 1, 0, 104, 44, 0, 0, 0, 0, 0, 0]);
    let level = words(&[148, 0, 32, 0, 32, 0]);
    let description = words(&[44, 0, 2 | 40 << 16, 166 | 1 << 8 | 2 << 16, 3 | 3 << 8, 16, 0, 127 << 16, 0, 0, 0]);
    // Mode 8, five bits, and then a colour.
    let block = |color: u128| (0x17 | color << 5).to_le_bytes();
    [b"\xabKTX 20\xbb\r\n\x1a\n", &header[..], &level, &description, &block(0xff32_64c8), &block(0xff0a_141e)].concat()
}
