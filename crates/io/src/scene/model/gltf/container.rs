//! GLB or JSON, and the bytes that it names: in the file, in a data URI, or in files beside it.
//!
//! A GLB is a header of twelve bytes and chunks: first the JSON, then at most one of bytes. Khronos, glTF 2.0 Specification, 2021, §4.

use std::borrow::Cow;
use std::path::Path;

use base64::Engine;
use base64::alphabet;
use base64::engine::{DecodePaddingMode, GeneralPurpose, GeneralPurposeConfig};

use crate::error::{At, FileError};
use crate::scene::model::files::Files;

/// The JSON text and the bytes behind it in a file.
pub(super) struct Container<'a> {
    pub(super) json: &'a [u8],
    pub(super) bytes: Option<&'a [u8]>,
}

impl<'a> Container<'a> {
    pub(super) fn open(bytes: &'a [u8]) -> Result<Self, FileError> {
        if !bytes.starts_with(b"glTF") {
            const MARK: &[u8] = b"\xef\xbb\xbf";
            return Ok(Self { json: bytes.strip_prefix(MARK).unwrap_or(bytes), bytes: None });
        }
        let word = |at: usize| -> Result<usize, FileError> {
            let word = bytes.get(at..at + 4).and_then(|b| b.try_into().ok()).map(u32::from_le_bytes);
            Ok(word.ok_or_else(|| FileError::new("the file ends too early").at(At::Byte(bytes.len())))? as usize)
        };
        if word(4)? != 2 {
            let message = format!("this is version {} of GLB", word(4)?);
            return Err(FileError::new(message).at(At::Byte(4)).hint("export it as glTF 2.0"));
        }
        let mut chunks = Vec::new();
        let mut at = 12;
        while at < bytes.len() && chunks.len() < 2 {
            let (length, kind) = (word(at)?, word(at + 4)?);
            let chunk = bytes.get(at + 8..).and_then(|rest| rest.get(..length)).ok_or_else(|| {
                FileError::new(format!("a chunk of {length} bytes reaches beyond the end of the file")).at(At::Byte(at))
            })?;
            chunks.push((kind, chunk));
            at += 8 + length;
        }
        const JSON: usize = 0x4e4f_534a;
        const BIN: usize = 0x004e_4942;
        match chunks[..] {
            [(JSON, json)] => Ok(Self { json, bytes: None }),
            [(JSON, json), (kind, bytes)] => Ok(Self { json, bytes: (kind == BIN).then_some(bytes) }),
            _ => Err(FileError::new("the first chunk is no JSON").at(At::Byte(12))),
        }
    }
}

/// With padding or without.
const BASE64: GeneralPurpose = GeneralPurpose::new(
    &alphabet::STANDARD,
    GeneralPurposeConfig::new().with_decode_padding_mode(DecodePaddingMode::Indifferent),
);

/// The bytes that a URI names, in it or in a file.
pub(super) fn resolve(uri: &str, files: Files<'_>) -> Result<Vec<u8>, FileError> {
    if let Some(data) = uri.strip_prefix("data:") {
        let Some((_, data)) = data.split_once(";base64,") else {
            return Err(FileError::new("a data URI is not in base64"));
        };
        return BASE64.decode(data.trim_end()).map_err(|e| FileError::new(format!("a data URI is damaged: {e}")));
    }
    let path = files.find(Path::new(&*decode(uri)));
    let bytes = path.and_then(|path| Ok(files.read(&path)?));
    bytes.map_err(|e| FileError { message: format!("`{uri}` is not read: {}", e.message), ..e })
}

/// Without `%20` and the like; what is none stays.
fn decode(uri: &str) -> Cow<'_, str> {
    if !uri.contains('%') {
        return Cow::Borrowed(uri);
    }
    let bytes = uri.as_bytes();
    let (mut out, mut i) = (Vec::with_capacity(bytes.len()), 0);
    while let Some(&byte) = bytes.get(i) {
        let hex = bytes.get(i + 1..i + 3).and_then(|h| std::str::from_utf8(h).ok());
        match hex.and_then(|h| u8::from_str_radix(h, 16).ok()).filter(|_| byte == b'%') {
            Some(decoded) => {
                out.push(decoded);
                i += 3;
            }
            None => {
                out.push(byte);
                i += 1;
            }
        }
    }
    Cow::Owned(String::from_utf8_lossy(&out).into_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn uris_are_decoded() {
        assert_eq!(decode("a%20b%2Fc%zz%4"), "a b/c%zz%4");
        assert_eq!(resolve("data:application/octet-stream;base64,AQID", Files::None).unwrap(), [1, 2, 3]);
        assert!(resolve("data:text/plain,abc", Files::None).is_err());
        // The name is looked at after that.
        let error = resolve("..%2Fa.bin", Files::In(Path::new("."))).unwrap_err();
        assert_eq!(error.message, "`..%2Fa.bin` is not read: its name leads out of the folder of the model");
    }
}
