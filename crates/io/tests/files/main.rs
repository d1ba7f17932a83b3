//! Files that scenes refer to, above all damaged ones.

#[path = "../shared/corpus.rs"]
mod corpus;
mod ies;
mod images;
#[path = "../shared/pictures.rs"]
mod pictures;
mod ply;

use eyebeam_io::{At, Error, FileError};

/// What is wrong with the file; it has a message, and a place that is in the file.
fn flaw(error: Error, bytes: &[u8]) -> FileError {
    let Error::File(flaw) = error else { panic!("{error}") };
    assert!(!flaw.message.is_empty());
    match flaw.at {
        At::File => {}
        At::Line(line) => assert!((1..=bytes.len() + 1).contains(&line), "{flaw}"),
        At::Byte(byte) => assert!(byte <= bytes.len(), "{flaw}"),
        At::Character { .. } | At::Part(_) => panic!("{flaw}"),
    }
    flaw
}
