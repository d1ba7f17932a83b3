//! What the targets of readers have in common.

use std::fmt::Display;

use eyebeam_io::image::{pixels_size, read_image_bytes, read_linear_bytes, read_pixels_bytes};
use eyebeam_io::scene::{Files, ReadOptions, read_bytes};

/// Stands for the file in errors.
pub const NAME: &str = "fuzzed";

/// Whatever was read: an error names the file.
pub fn check<T, E: Display>(read: Result<T, E>) -> Option<T> {
    read.map_err(|error| assert!(error.to_string().contains(NAME), "{error}")).ok()
}

/// Reads a picture in every way that there is.
pub fn read_picture(bytes: &[u8]) {
    let image = check(read_image_bytes(NAME, bytes));
    let pixels = check(read_pixels_bytes(NAME, bytes));
    check(read_linear_bytes(NAME, bytes));
    if let Some((pixels, _)) = &pixels {
        assert!(pixels_size(NAME, bytes).is_ok_and(|size| size >= pixels.bytes() as u64));
    }
    assert_eq!(image.is_some(), pixels.is_some());
    if let Some((image, _)) = image {
        assert!(image.pixels().iter().flatten().all(|c| (0.0..f32::INFINITY).contains(c)));
    }
}

/// Reads a model in little memory: all triangles have vertices.
pub fn read_model(name: &str, bytes: &[u8], files: Files<'_>, options: &ReadOptions<'_>) {
    let options = ReadOptions { memory: Some(256 << 20), ..*options };
    let Some(file) = check(read_bytes(name, bytes, files, &options)) else { return };
    for data in file.desc.shape.mesh.iter().filter_map(|mesh| mesh.data.as_ref()) {
        assert!(data.triangles.iter().flatten().all(|&i| (i as usize) < data.vertices.len()));
    }
}
