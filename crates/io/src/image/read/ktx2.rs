//! KTX2 with Basis Universal pictures: bytes, of the largest level. Those of other formats are refused, by name.
//!
//! Khronos, KTX File Format 2.0, 2021, and Khronos Data Format Specification 1.3, 2019, §5.6. The decoder believes what the header
//! says, so nothing reaches it that was not checked here: what lies where in the file, and how large things become.

use basisu::{DecodeFlags, TargetFormat, Transcoder};
use eyebeam_core::texture::{Pixels, Samples};

use crate::error::{At, FileError};
use crate::image::read::pixels::{compact, pixels};
use crate::image::read::{check_length, check_size};

/// What each file begins with.
pub(super) const MAGIC: [u8; 12] = *b"\xabKTX 20\xbb\r\n\x1a\n";

/// Bytes of the decoded pixel, and of what is made on the way.
const BYTES_PER_PIXEL: u64 = 6;
/// Runs of equal blocks of 16 pixels, compressed once more.
const PIXELS_IN_BYTE: u64 = 1 << 14;
/// The decoder's limit, too.
const MOST_LEVELS: u32 = 16;

/// What a header says, and what of it matters.
struct Header {
    size: [u32; 2],
    /// Red is in all colours, and green in alpha.
    is_red_green: bool,
}

/// Refused if the picture, and so many bytes more for each pixel, are more than is allowed.
pub(super) fn decode(bytes: &[u8], more: u64) -> Result<Pixels, FileError> {
    let header = open(bytes, more)?;
    let level = Transcoder::new(bytes).and_then(|t| t.transcode(0, TargetFormat::Rgba32, DecodeFlags::NONE));
    let mut signals = level.map_err(|_| FileError::new("cannot decode the KTX2: its pixels are damaged"))?;
    if header.is_red_green {
        signals.as_chunks_mut().0.iter_mut().for_each(|p: &mut [u8; 4]| *p = [p[0], p[3], 0, u8::MAX]);
    }
    let (channels, signals) = compact(4, signals, u8::MAX);
    pixels(header.size, channels, Samples::Byte(signals))
}

/// The memory that pixels take, by the header alone, and so many bytes more for each.
pub(super) fn size(bytes: &[u8], more: u64) -> Result<u64, FileError> {
    let [width, height] = open(bytes, more)?.size;
    check_size(width.into(), height.into(), 4 + more)
}

fn open(bytes: &[u8], more: u64) -> Result<Header, FileError> {
    const ETC1S: u32 = 163;
    const UASTC: u32 = 166;
    const NONE: u32 = 0;
    const BASIS_LZ: u32 = 1;
    const ZSTANDARD: u32 = 2;
    let file = Words(bytes);
    let format = file.word(12)?;
    if format != 0 {
        let message = format!("the KTX2 holds pixels of the Vulkan format {format}");
        return Err(FileError::new(message).hint("of KTX2 only Basis Universal is read: ETC1S or UASTC"));
    }
    let [width, height, depth, layers, faces, levels] = file.words(20)?;
    if depth > 0 || layers > 1 || faces != 1 || !(1..=MOST_LEVELS).contains(&levels) {
        return Err(FileError::new("the KTX2 is no flat picture"));
    }
    check_size(width.into(), height.into(), BYTES_PER_PIXEL + more)?;
    check_length(bytes, width.into(), height.into(), PIXELS_IN_BYTE)?;
    let [compression, descriptor, length] = file.words(44)?;
    file.within(descriptor.into(), length.into())?;
    // Pairs of keys and values end where words do; the decoder would run past the end of others.
    let [pairs, of_pairs] = file.words(56)?;
    file.within(pairs.into(), of_pairs.into())?;
    if !pairs.is_multiple_of(4) || !of_pairs.is_multiple_of(4) {
        return Err(FileError::new("the keys and values of the KTX2 end within a word").at(At::Byte(56)));
    }
    // What the decoder reads of a description of one or two kinds of samples.
    let two = match length {
        44 => false,
        60 => true,
        _ => return Err(FileError::new("the KTX2 describes its pixels as Basis Universal does not").at(At::Byte(48))),
    };
    let channel = |sample: usize| Ok::<_, FileError>((file.word(descriptor as usize + 28 + sample * 16)? >> 24) & 15);
    let model = file.word(descriptor as usize + 12)? & 255;
    let blocks = u64::from(width.div_ceil(4)) * u64::from(height.div_ceil(4));
    let [start, length, inflated] = [file.long(80)?, file.long(88)?, file.long(96)?];
    file.within(start, length)?;
    let is_red_green = match (model, compression) {
        (ETC1S, BASIS_LZ) => {
            file.within(file.long(64)?, file.long(72)?)?;
            two && channel(1)? == 4
        }
        (UASTC, NONE) => channel(0)? == 5,
        (UASTC, ZSTANDARD) if inflated == blocks * 16 => channel(0)? == 5,
        (UASTC, ZSTANDARD) => return Err(FileError::new("the KTX2 has another size than it says").at(At::Byte(96))),
        (ETC1S | UASTC, _) => {
            return Err(FileError::new(format!("the KTX2 is compressed by the unknown scheme {compression}")));
        }
        _ => {
            let message = format!("the KTX2 holds pixels of the colour model {model}");
            return Err(FileError::new(message).hint("of KTX2 only Basis Universal is read: ETC1S or UASTC"));
        }
    };
    Ok(Header { size: [width, height], is_red_green })
}

/// A file of little-endian numbers.
struct Words<'a>(&'a [u8]);

impl Words<'_> {
    fn word(&self, at: usize) -> Result<u32, FileError> {
        self.words(at).map(|[word]| word)
    }

    fn words<const N: usize>(&self, at: usize) -> Result<[u32; N], FileError> {
        let bytes = self.0.get(at..).and_then(|rest| rest.as_chunks().0.get(..N));
        let words: Option<[[u8; 4]; N]> = bytes.and_then(|words| words.try_into().ok());
        Ok(words.ok_or_else(|| self.short())?.map(u32::from_le_bytes))
    }

    fn long(&self, at: usize) -> Result<u64, FileError> {
        self.words(at).map(|[low, high]| u64::from(low) | u64::from(high) << 32)
    }

    /// That there are so many bytes.
    fn within(&self, at: u64, length: u64) -> Result<(), FileError> {
        let end = at.checked_add(length).filter(|&end| end <= self.0.len() as u64);
        end.map(drop).ok_or_else(|| self.short())
    }

    fn short(&self) -> FileError {
        FileError::new("the KTX2 ends too early").at(At::Byte(self.0.len()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A picture of 5 x 3 pixels in two blocks of UASTC, each of one colour.
    fn uastc(colors: [[u8; 4]; 2], channel: u8) -> Vec<u8> {
        let words = |words: &[u32]| words.iter().flat_map(|w| w.to_le_bytes()).collect::<Vec<u8>>();
        let header = words(&[0, 1, 5, 3, 0, 0, 1, 1, 0, 104, 44, 0, 0, 0, 0, 0, 0]);
        let level = words(&[148, 0, 32, 0, 32, 0]);
        let mut description =
            words(&[44, 0, 2 | 40 << 16, 166 | 1 << 8 | 2 << 16, 3 | 3 << 8, 16, 0, 127 << 16, 0, 0, 0]);
        description[31] = channel;
        // Mode 8, five bits, and then a colour.
        let block = |color: [u8; 4]| (0x17 | u128::from(u32::from_le_bytes(color)) << 5).to_le_bytes();
        [&MAGIC[..], &header, &level, &description, colors.map(block).as_flattened()].concat()
    }

    const COLORS: [[u8; 4]; 2] = [[200, 100, 50, 255], [10, 20, 30, 255]];

    fn set(bytes: &[u8], at: usize, word: u32) -> Vec<u8> {
        let mut bytes = bytes.to_vec();
        bytes[at..at + 4].copy_from_slice(&word.to_le_bytes());
        bytes
    }

    #[test]
    fn blocks_are_cut_at_the_edge() {
        let row = [[200, 100, 50]; 4].into_iter().chain([[10, 20, 30]]);
        let expected: Vec<u8> = row.cycle().take(15).flatten().collect();
        let pixels = decode(&uastc(COLORS, 0), 0).unwrap();
        assert!(pixels.channels() == 3 && *pixels.samples() == Samples::Byte(expected));
        assert_eq!(size(&uastc(COLORS, 0), 0), Ok(60));
        let alpha = decode(&uastc([[200, 100, 50, 9], [10, 20, 30, 255]], 3), 0).unwrap();
        assert_eq!(alpha.channels(), 4);
        let two = decode(&uastc([[200, 200, 200, 9], [10, 10, 10, 90]], 5), 0).unwrap();
        let Samples::Byte(two) = two.samples() else { panic!() };
        assert_eq!(two[9..15], [200, 9, 0, 10, 90, 0]);
    }

    /// A frame of Zstandard whose one block is not compressed.
    #[test]
    fn levels_are_inflated() {
        let plain = uastc(COLORS, 0);
        let frame = [&[0x28, 0xb5, 0x2f, 0xfd, 0x20, 32, 1, 1, 0][..], &plain[148..]].concat();
        let whole = [&set(&set(&plain, 44, 2), 88, frame.len() as u32)[..148], &frame].concat();
        assert!(decode(&whole, 0).unwrap() == decode(&plain, 0).unwrap());
        assert!(decode(&set(&whole, 96, 1 << 30), 0).unwrap_err().message.contains("another size than it says"));
        assert!(decode(&set(&whole, 152, 0), 0).unwrap_err().message.contains("its pixels are damaged"));
    }

    #[test]
    fn what_is_not_read_is_refused_by_its_header() {
        let whole = uastc(COLORS, 0);
        for (at, word, said) in [
            (12, 37, "pixels of the Vulkan format 37"),
            (20, 1 << 31, "a picture of 2147483648 x 3 pixels is too large"),
            (20, 0, "the picture has no pixels"),
            (20, 100, "its pixels are damaged"),
            (28, 2, "is no flat picture"),
            (36, 6, "is no flat picture"),
            (40, 99, "is no flat picture"),
            (44, 3, "by the unknown scheme 3"),
            (48, u32::MAX, "ends too early"),
            (52, 43, "describes its pixels as Basis Universal does not"),
            (80, 1 << 20, "ends too early"),
            (84, u32::MAX, "ends too early"),
            (116, 160, "pixels of the colour model 160"),
            (116, 163, "by the unknown scheme 0"),
        ] {
            let error = decode(&set(&whole, at, word), 0).unwrap_err();
            assert!(error.message.contains(said), "{at}: {}", error.message);
        }
        (12..whole.len()).for_each(|end| drop(decode(&whole[..end], 0).unwrap_err()));
    }
}
