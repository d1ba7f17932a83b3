//! Pictures: all good ones are read, all damaged ones end in a picture or in an error.

use std::time::{Duration, Instant};

use eyebeam_core::film::Image;
use eyebeam_core::texture::Samples;
use eyebeam_io::image::{
    Encoding, ImageFormat, pixels_size, read_image, read_image_bytes, read_linear_bytes, read_pixels_bytes,
};
use eyebeam_io::{Error, Warning};
use proptest::prelude::*;

use crate::corpus::corpus;
use crate::{flaw, pictures};

/// Whatever the bytes, soon.
fn try_image(bytes: &[u8]) -> Option<Image> {
    let start = Instant::now();
    let read = read_image_bytes("a", bytes).map_err(|error| flaw(error, bytes));
    assert!(start.elapsed() < Duration::from_secs(20), "{:?}", start.elapsed());
    let pixels = read_pixels_bytes("a", bytes).map_err(|error| flaw(error, bytes));
    assert_eq!(read.is_ok(), pixels.is_ok());
    let (image, warnings) = read.ok()?;
    // As it is in the file, it is the same picture.
    if let Ok((pixels, _)) = pixels {
        assert!(pixels.to_image() == image || !warnings.is_empty());
        assert!(pixels_size("a", bytes).unwrap() >= pixels.bytes() as u64);
    }
    assert!(image.pixels().iter().flatten().all(|c| (0.0..f32::INFINITY).contains(c)));
    Some(image)
}

fn mean(image: &Image) -> f64 {
    image.pixels().iter().flatten().map(|&c| f64::from(c)).sum::<f64>() / (3 * image.pixels().len()) as f64
}

fn gradient() -> Image {
    let mut image = Image::new(20, 7);
    for (y, x) in (0..7).flat_map(|y| (0..20).map(move |x| (y, x))) {
        image.set_pixel(x, y, [x as f32 * 0.05, y as f32 * 0.1, (x * y) as f32 * 0.01]);
    }
    image
}

#[test]
fn what_was_written_is_read() {
    let formats =
        [(ImageFormat::Exr, 0.0), (ImageFormat::Hdr, 0.01), (ImageFormat::Png, 0.005), (ImageFormat::Jpeg, 0.1)];
    for (format, error) in formats {
        let (mut image, bytes) = (gradient(), gradient());
        let bytes = format.encode(&bytes, "{}", &Encoding::default()).unwrap();
        let (read, warnings) = read_image_bytes("a", &bytes).unwrap();
        assert_eq!(warnings, []);
        assert_eq!((read.width(), read.height()), (20, 7));
        if format.is_for_screens() {
            // It ends at white.
            let white = |p: [f32; 3]| p.map(|c| c.min(1.0));
            (0..7).for_each(|y| (0..20).for_each(|x| image.set_pixel(x, y, white(image.pixel(x, y)))));
        }
        for (a, b) in image.pixels().iter().flatten().zip(read.pixels().iter().flatten()) {
            assert!((a - b).abs() <= error, "{format:?}: {a}, not {b}");
        }
    }
}

#[test]
fn linear_pictures_keep_their_alpha_and_what_made_them() {
    let alpha: Vec<_> = (0..140).map(|i| i as f32 / 140.0).collect();
    let image = gradient().with_alpha(alpha);
    let provenance = "{\"scene\":\"a.toml\"}";
    let of = |image: &Image, format: ImageFormat, provenance, half| {
        let bytes = format.encode(image, provenance, &Encoding { half, ..Encoding::default() }).unwrap();
        read_linear_bytes("a", &bytes)
    };
    let read = of(&image, ImageFormat::Exr, provenance, false).unwrap();
    assert_eq!((&read.image, read.provenance.as_deref(), read.warnings), (&image, Some(provenance), Vec::new()));
    let half = of(&image, ImageFormat::Exr, "not JSON", true).unwrap();
    assert_eq!(half.provenance, None);
    assert!((half.image.alpha().unwrap()[70] - 0.5).abs() < 1e-3);
    for format in [ImageFormat::Exr, ImageFormat::Hdr] {
        assert_eq!(of(&gradient(), format, "{}", false).unwrap().image.alpha(), None, "{format:?}");
    }
    for format in [ImageFormat::Png, ImageFormat::Jpeg] {
        let error = of(&image, format, "{}", false).unwrap_err().to_string();
        assert!(error.contains("no picture of linear light"), "{error}");
    }
}

#[test]
fn what_is_not_finite_is_told_once() {
    let mut image = gradient();
    image.set_pixel(3, 3, [f32::NAN, f32::INFINITY, -f32::INFINITY]);
    image.set_pixel(4, 3, [-1.0; 3]);
    let bytes = ImageFormat::Exr.encode(&image, "{}", &Encoding::default()).unwrap();
    let (read, warnings) = read_image_bytes("a", &bytes).unwrap();
    assert!(
        matches!(warnings.as_slice(), [Warning { message, .. }] if message.starts_with("1 pixel had")),
        "{warnings:?}"
    );
    assert_eq!(read.pixel(3, 3), [0.0, 19.0 * 6.0 * 0.01, 0.0]);
    assert_eq!(read.pixel(4, 3), [0.0; 3]);
}

#[test]
fn good_ones() {
    for path in corpus("hdri", &["hdr"]) {
        let (image, _) = read_image(&path).unwrap();
        assert_eq!((image.width(), image.height()), (1024, 512), "{}", path.display());
        assert!((0.05..10.0).contains(&mean(&image)), "{}: {}", path.display(), mean(&image));
        let by_other = image::open(&path).unwrap().into_rgb32f();
        for (pixel, expected) in image.pixels().iter().zip(by_other.pixels()) {
            assert_eq!(*pixel, expected.0);
        }
    }
    for path in corpus("rtweekend", &["png", "jpg"]) {
        let (image, warnings) = read_image(&path).unwrap_or_else(|e| panic!("{e}"));
        assert!((0.0..1.0).contains(&mean(&image)) && warnings.is_empty(), "{}", path.display());
    }
}

#[test]
fn all_kinds_of_openexr() {
    let mut means = Vec::new();
    for path in corpus("exr_formats", &["exr"]) {
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let said = match name.as_str() {
            "tiled.exr" => "cannot decode",
            "v1.7.test.tiled.exr" => "there are G, Z",
            "WideFloatRange.exr" => "there are G",
            _ => {
                let (image, _) = read_image(&path).unwrap_or_else(|e| panic!("{e}"));
                assert!(mean(&image) > 0.0, "{name}");
                means.push((name, mean(&image)));
                continue;
            }
        };
        let error = read_image(&path).unwrap_err().to_string();
        assert!(error.contains(said), "{error}");
    }
    // The same picture, compressed with and without losses.
    let of = |wanted: &str| means.iter().find(|(name, _)| name == wanted).map_or(0.0, |(_, mean)| *mean);
    let (lossy, lossless) = (of("comp_dwaa_v2.exr"), of("comp_zip.exr"));
    assert!((lossy - lossless).abs() <= 1e-3 * lossless, "{lossy}, not {lossless}");
}

#[test]
fn webp_with_losses() {
    let (pixels, _) = read_pixels_bytes("a.webp", &pictures::lossy_webp()).unwrap();
    assert_eq!((pixels.width(), pixels.height(), pixels.channels()), (8, 8, 4));
    let Samples::Byte(bytes) = pixels.samples() else { panic!() };
    let off = |i: usize, is: u8| {
        let (x, y) = (i / 4 % 8, i / 4 / 8);
        let was = [30 * x, 200, 20 * y, 255 - 16 * (x + y)][i % 4];
        (is as i32 - was as i32).abs()
    };
    let errors: Vec<_> = bytes.iter().enumerate().map(|(i, &is)| off(i, is)).collect();
    assert!(errors.iter().max().unwrap() <= &60, "{errors:?}");
    assert!(errors.iter().sum::<i32>() <= 8 * 256, "{errors:?}");
    assert!(errors.iter().skip(3).step_by(4).all(|&error| error == 0), "alpha has no losses: {errors:?}");
}

#[test]
fn basis_universal_of_ktx2() {
    let (pixels, _) = read_pixels_bytes("a.ktx2", &pictures::ktx2()).unwrap();
    let Samples::Byte(bytes) = pixels.samples() else { panic!() };
    let (one, other) = ([200, 100, 50], [30, 20, 10]);
    assert_eq!((pixels.width(), pixels.height(), pixels.channels()), (5, 3, 3));
    assert_eq!(bytes.as_chunks::<3>().0, [one, one, one, one, other].repeat(3));
    for path in corpus("gltf", &["ktx2"]) {
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let expected = match name.as_str() {
            "2d_etc1s.ktx2" => (40, 40),
            "test.ktx2" => (256, 256),
            _ => {
                let error = read_image(&path).unwrap_err().to_string();
                assert!(error.contains("the KTX2 holds pixels of the Vulkan format"), "{error}");
                continue;
            }
        };
        let bytes = std::fs::read(&path).unwrap();
        let image = try_image(&bytes).unwrap();
        assert_eq!((image.width(), image.height()), expected);
        assert!((0.02..0.98).contains(&mean(&image)), "{name}: {}", mean(&image));
        // Wrong bytes, most of them where the sizes and tables are.
        let mut state = 1_u64;
        for round in 0..1000 {
            let mut bytes = bytes.clone();
            for _ in 0..1 + round % 4 {
                state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
                let within = if round % 2 == 0 { bytes.len() } else { bytes.len().min(800) };
                bytes[(state >> 33) as usize % within] ^= (state >> 20) as u8;
            }
            let _ = read_pixels_bytes("a", &bytes).map_err(|error| flaw(error, &bytes));
        }
    }
}

#[test]
fn bad_ones() {
    for path in corpus("bad", &[]) {
        let start = Instant::now();
        match read_image(&path) {
            Ok((image, _)) => println!("{} x {}: {}", image.width(), image.height(), path.display()),
            Err(Error::File(_)) => {}
            Err(error) => panic!("{error}"),
        }
        assert!(start.elapsed() < Duration::from_secs(5), "{}: {:?}", path.display(), start.elapsed());
    }
}

#[test]
fn truncated() {
    for format in [ImageFormat::Exr, ImageFormat::Hdr, ImageFormat::Png] {
        let bytes = format.encode(&gradient(), "{}", &Encoding::default()).unwrap();
        for end in 0..bytes.len() {
            let whole = try_image(&bytes[..end]).is_some();
            // PNG ends in a chunk that says so.
            assert!(!whole || (format == ImageFormat::Png && end + 16 > bytes.len()), "{format:?} cut at {end}");
        }
    }
}

#[test]
fn sizes_that_are_too_large_are_refused_at_once() {
    let png = ImageFormat::Png.encode(&gradient(), "{}", &Encoding::default()).unwrap();
    let mut large = png.clone();
    large[16..24].copy_from_slice(&[0x7f, 0xff, 0xff, 0xff, 0x7f, 0xff, 0xff, 0xff]);
    let hdr = b"#?RADIANCE\n\n-Y 100000 +X 100000\n".to_vec();
    // The last column and row of the data window.
    let mut exr = ImageFormat::Exr.encode(&gradient(), "{}", &Encoding::default()).unwrap();
    let window = exr.windows(11).position(|w| w == b"dataWindow\0").unwrap() + "dataWindow\0box2i\0".len() + 4;
    exr[window + 8..window + 16].copy_from_slice(&[0xff, 0xff, 0xff, 0x0f, 0xff, 0xff, 0xff, 0x0f]);
    // Allowed, but not there.
    let mut short = exr.clone();
    short[window + 8..window + 16].copy_from_slice(&[0xff, 0x3f, 0, 0, 0xff, 0x3f, 0, 0]);
    for bytes in [large, hdr, exr, short] {
        let start = Instant::now();
        assert!(try_image(&bytes).is_none());
        assert!(start.elapsed() < Duration::from_secs(1));
    }
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 1000,
        failure_persistence: None,
        rng_seed: prop::test_runner::RngSeed::Fixed(1),
        ..ProptestConfig::default()
    })]

    #[test]
    fn with_some_bytes_changed(
        format in prop::sample::select(vec![ImageFormat::Exr, ImageFormat::Hdr, ImageFormat::Png]),
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..4),
    ) {
        let mut bytes = format.encode(&gradient(), "{}", &Encoding::default()).unwrap();
        for (at, byte) in changes {
            let at = at.index(bytes.len());
            bytes[at] = byte;
        }
        try_image(&bytes);
    }
}
