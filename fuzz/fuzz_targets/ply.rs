//! Any bytes as a PLY file: a mesh whose triangles have vertices, or an error.

#![no_main]

use eyebeam_fuzz::{NAME, check};
use eyebeam_io::scene::ply::read_ply_bytes;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    if let Some((mesh, _)) = check(read_ply_bytes(NAME, bytes)) {
        assert!(mesh.triangles.iter().flatten().all(|&i| (i as usize) < mesh.vertices.len()));
        assert!(mesh.vertices.iter().flatten().all(|c| c.is_finite()));
    }
});
