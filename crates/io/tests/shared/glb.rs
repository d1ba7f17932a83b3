//! glTF in one file, of a document and numbers.

use serde_json::Value;

/// The numbers that tests' documents speak of: indices of a triangle, its positions (8), coordinates (44), joints (68) and weights (80), 92
/// bytes in all.
pub(crate) fn triangle() -> Vec<u8> {
    let mut bytes: Vec<u8> = [0_u16, 1, 2, 0].iter().flat_map(|i| i.to_le_bytes()).collect();
    let floats = [0.0_f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 1.0, 1.0, 1.0, 0.0, 0.0];
    bytes.extend(floats.iter().flat_map(|f| f.to_le_bytes()));
    bytes.extend([0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0]);
    bytes.extend([255, 0, 0, 0, 255, 0, 0, 0, 255, 0, 0, 0]);
    bytes
}

/// A file with these numbers as its first buffer.
pub(crate) fn glb(document: &Value, numbers: &[u8]) -> Vec<u8> {
    let mut json = document.to_string().into_bytes();
    json.resize(json.len().next_multiple_of(4), b' ');
    let length = 12 + 8 + json.len() + 8 + numbers.len();
    let words = |words: &[u32]| words.iter().flat_map(|w| w.to_le_bytes()).collect::<Vec<u8>>();
    let header = words(&[0x4654_6c67, 2, length as u32, json.len() as u32, 0x4e4f_534a]);
    [header, json, words(&[numbers.len() as u32, 0x004e_4942]), numbers.to_vec()].concat()
}
