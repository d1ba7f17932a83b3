//! Pictures of textures: shared, as small as in their files, and refused before they can do harm.

use std::fs;
use std::sync::Arc;
use std::time::{Duration, Instant};

use eyebeam_core::desc::SceneDesc;
use eyebeam_core::film::Image;
use eyebeam_core::texture::{Pixels, TextureDesc};
use eyebeam_io::Error;
use eyebeam_io::image::{Encoding, ImageFormat};
use eyebeam_io::scene::{SceneFile, read};
use tempfile::TempDir;

use crate::{places, problems, unmark};

/// A folder with a picture in every format.
fn folder() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    let mut image = Image::new(8, 4);
    (0..8).for_each(|x| image.set_pixel(x, 1, [1.0, 0.5, 0.1 * x as f32]));
    for ending in ["png", "jpg", "exr", "hdr"] {
        let path = folder.path().join("a").with_extension(ending);
        let format = ImageFormat::from_path(&path).unwrap();
        let encoding = Encoding { half: true, ..Encoding::default() };
        fs::write(path, format.encode(&image, "{}", &encoding).unwrap()).unwrap();
    }
    folder
}

fn read_in(folder: &TempDir, text: &str) -> Result<SceneFile, Error> {
    let path = folder.path().join("a.toml");
    fs::write(&path, text).unwrap();
    read(&path, &[])
}

fn pixels<'d>(desc: &'d SceneDesc, name: &str) -> &'d Arc<Pixels> {
    let TextureDesc::Image(texture) = &desc.texture[name] else { panic!("{name} is no image") };
    texture.pixels.as_ref().unwrap()
}

#[test]
fn as_small_as_in_the_file_and_there_once() {
    let folder = folder();
    let text = "
[texture.png.image]\nfile = \"a.png\"
[texture.same.image]\nfile = \"./a.png\"\nencoding = \"linear\"\nfilter = \"nearest\"
[texture.jpg.image]\nfile = \"a.jpg\"
[texture.exr.image]\nfile = \"a.exr\"
[texture.hdr.image]\nfile = \"a.hdr\"
";
    let SceneFile { desc, warnings, .. } = read_in(&folder, text).unwrap();
    assert_eq!(warnings, []);
    for (name, bytes_per_pixel) in [("png", 3), ("jpg", 3), ("exr", 6), ("hdr", 12)] {
        let pixels = pixels(&desc, name);
        assert_eq!((pixels.width(), pixels.height(), pixels.bytes()), (8, 4, 32 * bytes_per_pixel), "{name}");
    }
    assert!(Arc::ptr_eq(pixels(&desc, "png"), pixels(&desc, "same")));
}

/// Whatever was wrong with a file is said at each place that names it, and nothing else.
#[test]
fn what_cannot_be_had() {
    let folder = folder();
    let whole = fs::read(folder.path().join("a.png")).unwrap();
    fs::write(folder.path().join("cut.png"), &whole[..whole.len() / 2]).unwrap();
    fs::write(folder.path().join("not.png"), "GIF89a").unwrap();
    fs::write(folder.path().join("empty.png"), "").unwrap();
    let marked = "
[texture.a.image]\nfile = ▸\"nothing.png\"
[texture.b.image]\nfile = ▸\"cut.png\"
[texture.c.image]\nfile = ▸\"cut.png\"
[texture.d.image]\nfile = ▸\"not.png\"
[texture.e.image]\nfile = ▸\"empty.png\"
[texture.f.image]\nfile = ▸\".\"
[texture.g.image]\nfile = \"a.exr\"\nencoding = ▸\"srgb\"
[texture.h.image]\nfile = \"a.png\"\nencoding = ▸\"gamma\"
[texture.i.image]\nfile = \"a.png\"\ntriplanar = ▸true\nmapping.space = \"uv\"
";
    let (text, expected) = unmark(marked);
    let error = read_in(&folder, &text).unwrap_err();
    let said = error.to_string().replace(folder.path().to_str().unwrap(), "FOLDER");
    assert_eq!(places(&problems(error)), expected, "{said}");
    insta::assert_snapshot!(said);
}

/// Pictures that say that they are 100 000 pixels wide and high are refused by their headers.
#[test]
fn sizes_that_are_too_large_are_refused_before_decoding() {
    let folder = folder();
    let side = 100_000_u32.to_be_bytes();
    let mut png = fs::read(folder.path().join("a.png")).unwrap();
    png[16..20].copy_from_slice(&side);
    png[20..24].copy_from_slice(&side);
    // The header's checksum, so that nothing but its size is wrong.
    let crc = crc32(&png[12..29]).to_be_bytes();
    png[29..33].copy_from_slice(&crc);
    let mut jpg = fs::read(folder.path().join("a.jpg")).unwrap();
    let frame = jpg.windows(2).position(|w| w == [0xff, 0xc0]).unwrap() + 5;
    jpg[frame..frame + 4].fill(0xff);
    let mut exr = fs::read(folder.path().join("a.exr")).unwrap();
    let window = exr.windows(11).position(|w| w == b"dataWindow\0").unwrap() + "dataWindow\0box2i\0".len() + 4;
    exr[window + 8..window + 12].copy_from_slice(&99_999_u32.to_le_bytes());
    exr[window + 12..window + 16].copy_from_slice(&99_999_u32.to_le_bytes());
    let hdr = b"#?RADIANCE\n\n-Y 100000 +X 100000\n".to_vec();
    let too_large = |size: &str| {
        let hint = "hint: up to 268435456 pixels and 4 GiB of memory are allowed";
        (format!("a picture of {size} pixels is too large"), hint)
    };
    // One that says how many lines are stored together contradicts itself.
    let contradictory = "cannot decode the OpenEXR picture: invalid: chunk count not matching data size".to_owned();
    for (name, bytes, (message, hint)) in [
        ("b.png", png, too_large("100000 x 100000")),
        ("b.jpg", jpg, too_large("65535 x 65535")),
        ("b.exr", exr, (contradictory, "")),
        ("b.hdr", hdr, too_large("100000 x 100000")),
    ] {
        fs::write(folder.path().join(name), bytes).unwrap();
        let start = Instant::now();
        let error = read_in(&folder, &format!("[texture.a.image]\nfile = \"{name}\"")).unwrap_err().to_string();
        assert!(start.elapsed() < Duration::from_secs(1), "{name}: {:?}", start.elapsed());
        let said = format!("error: `{name}` is wrong: {message}, in texture \"a\"\n");
        assert!(error.starts_with(&said) && error.ends_with(hint), "{error}");
    }
}

fn crc32(bytes: &[u8]) -> u32 {
    let step = |crc: u32| if crc & 1 == 1 { crc >> 1 ^ 0xedb8_8320 } else { crc >> 1 };
    !bytes.iter().fold(!0, |crc, &byte| (0..8).fold(crc ^ u32::from(byte), |crc, _| step(crc)))
}
