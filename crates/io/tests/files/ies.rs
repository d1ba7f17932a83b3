//! Photometric profiles of IES files.

use eyebeam_core::light::IesProfile;
use eyebeam_io::At;
use eyebeam_io::ies::read_ies_bytes;
use proptest::prelude::*;

use crate::flaw;

/// A downlight with two planes of symmetry.
const FILE: &str = "IESNA:LM-63-2002\r\n[TEST] 1\r\n[MANUFAC] Nobody\r\n[LUMCAT] TILT=x\r\nTILT=NONE\r\n\
    1 1000 1.5 3 2 1 2 0.1 0.1 0\r\n1.0 1.0 10\r\n0 45,90\r\n0 90\r\n100 50 0\r\n100 25 0\r\n";

fn try_ies(bytes: &[u8]) -> Option<IesProfile> {
    let (profile, _) = read_ies_bytes("a.ies", bytes).map_err(|error| flaw(error, bytes)).ok()?;
    assert!(profile.candela().iter().all(|c| (0.0..=profile.max()).contains(c)));
    Some(profile)
}

#[test]
fn a_file() {
    let (profile, warnings) = read_ies_bytes("a.ies", FILE.as_bytes()).unwrap();
    assert_eq!(warnings, []);
    assert_eq!(profile.vertical(), [0.0, 45.0, 90.0]);
    assert_eq!(profile.horizontal(), [0.0, 90.0]);
    assert_eq!(profile.candela(), [150.0, 75.0, 0.0, 150.0, 37.5, 0.0]);
    assert_eq!(profile.max(), 150.0);
}

#[test]
fn tilt_is_skipped_and_told() {
    let (upright, _) = read_ies_bytes("a.ies", FILE.as_bytes()).unwrap();
    for tilt in ["TILT=INCLUDE\r\n1\r\n3\r\n0 45 90\r\n1 0.9 0.8", "TILT=lamp.tlt"] {
        let (profile, warnings) = read_ies_bytes("a.ies", FILE.replace("TILT=NONE", tilt).as_bytes()).unwrap();
        assert_eq!(profile, upright);
        assert_eq!(warnings.len(), 1);
    }
}

#[test]
fn mistakes_have_their_place() {
    for (from, to, said, at) in [
        ("TILT=NONE", "", "no line `TILT=`", At::File),
        ("3 2 1 2 0.1", "3 2 2 2 0.1", "type is B", At::Line(6)),
        ("3 2 1 2 0.1", "3 2 3 2 0.1", "type is A", At::Line(6)),
        ("3 2 1 2 0.1", "3 2 7 2 0.1", "no photometric type 7", At::Line(6)),
        ("3 2 1 2 0.1", "-3 2 1 2 0.1", "-3 is no number of values", At::Line(6)),
        ("3 2 1 2 0.1", "1001 1000 1 2 0.1", "too many", At::Line(7)),
        ("0 45,90", "0 45,x", "`x` is no number", At::Line(8)),
        ("0 45,90", "0 45,inf", "`inf` is no number", At::Line(8)),
        ("0 45,90", "0 45,45", "must ascend", At::File),
        ("0 90\r\n", "0 80\r\n", "leave out", At::File),
        ("100 25 0", "100 -25 0", "-37.5: it must be finite and not negative", At::File),
        ("1.5", "1e300", "inf: it must be finite", At::File),
        ("100 25 0", "100 25", "cut off", At::Line(12)),
    ] {
        let text = FILE.replacen(from, to, 1);
        let found = flaw(read_ies_bytes("a.ies", text.as_bytes()).expect_err(&text), text.as_bytes());
        assert!(found.message.contains(said) && found.at == at, "{found}\n{text}");
    }
}

#[test]
fn truncated() {
    // Without the last number, or in its midst, nothing remains.
    for end in 0..FILE.len() - 3 {
        assert!(try_ies(&FILE.as_bytes()[..end]).is_none(), "cut at {end}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 3000,
        failure_persistence: None,
        rng_seed: prop::test_runner::RngSeed::Fixed(1),
        ..ProptestConfig::default()
    })]

    #[test]
    fn with_some_bytes_changed(changes in prop::collection::vec((0..FILE.len(), any::<u8>()), 1..5)) {
        let mut bytes = FILE.as_bytes().to_vec();
        for (at, byte) in changes {
            bytes[at] = byte;
        }
        try_ies(&bytes);
    }

    #[test]
    fn garbage(bytes in prop::collection::vec(any::<u8>(), 0..300)) {
        try_ies(&bytes);
        try_ies(&[b"TILT=NONE\n", bytes.as_slice()].concat());
    }
}
