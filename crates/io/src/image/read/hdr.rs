//! Radiance HDR: three mantissas of eight bits and their exponent, in runs.
//!
//! A colour is (r, g, b) · 2^(e − 136). A line stores runs of each channel (new), or pixels of which (1, 1, 1, n) repeats
//! the last one n times (old). Ward, "Real Pixels", Graphics Gems II, 1991; the Radiance file formats.

use crate::error::{At, FileError};
use crate::image::read::{Decoded, LINEAR, canvas, check_length, check_size};
use crate::warning::Warning;

/// The old way would allow any number; a run of the new one is of 127 pixels in eight bytes.
const PIXELS_IN_BYTE: u64 = 1024;

pub(super) fn decode(bytes: &[u8]) -> Decoded {
    let mut file = Bytes { bytes, at: 0 };
    let warnings = read_header(&mut file)?;
    let layout = read_layout(&mut file)?;
    let (width, height) = layout.size();
    check_length(bytes, width, height, PIXELS_IN_BYTE)?;
    let mut image = canvas(width, height)?;
    let mut line = vec![[0; 4]; layout.minor.length as usize];
    for i in 0..layout.major.length {
        read_line(&mut file, &mut line)?;
        for (j, &rgbe) in (0..).zip(&line) {
            let (x, y) = layout.place(i, j);
            image.set_pixel(x, y, radiance(rgbe));
        }
    }
    Ok((image, warnings))
}

/// The memory that pixels take, by the header alone.
pub(super) fn size(bytes: &[u8]) -> Result<u64, FileError> {
    let mut file = Bytes { bytes, at: 0 };
    read_header(&mut file)?;
    let (width, height) = read_layout(&mut file)?.size();
    let size = check_size(width, height, LINEAR)?;
    check_length(bytes, width, height, PIXELS_IN_BYTE)?;
    Ok(size)
}

fn read_layout(file: &mut Bytes) -> Result<Layout, FileError> {
    Layout::parse(file.line()?).ok_or_else(|| {
        file.error("the size of the Radiance picture is not understood").hint("it is like `-Y 512 +X 1024`")
    })
}

fn radiance([r, g, b, e]: [u8; 4]) -> [f32; 3] {
    if e == 0 {
        return [0.0; 3];
    }
    // 2^(e − 136), put together from its bits.
    let scale = f64::from_bits((u64::from(e) + 1023 - 136) << 52);
    [r, g, b].map(|c| (f64::from(c) * scale) as f32)
}

/// Reads up to the empty line.
fn read_header(file: &mut Bytes) -> Result<Vec<Warning>, FileError> {
    let mut warnings = Vec::new();
    loop {
        let line = file.line()?;
        match line.split_once('=').map(|(key, value)| (key.trim(), value.trim())) {
            _ if line.is_empty() => return Ok(warnings),
            Some(("FORMAT", "32-bit_rle_xyze")) => {
                return Err(file.error("Radiance pictures in XYZ are not read").hint("convert it with `ra_xyze -r`"));
            }
            Some((key @ ("EXPOSURE" | "COLORCORR" | "PRIMARIES"), value)) => {
                warnings.push(Warning::new(format!("the picture's {key} ({value}) is ignored")));
            }
            _ => {}
        }
    }
}

/// One of the two directions that pixels are stored in.
struct Axis {
    is_y: bool,
    /// Towards larger coordinates: up for y, which is towards the first row.
    ascends: bool,
    length: u32,
}

impl Axis {
    fn parse(sign_and_name: &str, length: &str) -> Option<Self> {
        let (is_y, ascends) = match sign_and_name {
            "-Y" => (true, false),
            "+Y" => (true, true),
            "-X" => (false, false),
            "+X" => (false, true),
            _ => return None,
        };
        Some(Self { is_y, ascends, length: length.parse().ok()? })
    }

    /// Column or row of the pixel that is stored at an index.
    fn place(&self, index: u32) -> u32 {
        if self.ascends == self.is_y { self.length - 1 - index } else { index }
    }
}

/// How pixels follow each other: lines along `minor`, one after the other along `major`.
struct Layout {
    major: Axis,
    minor: Axis,
}

impl Layout {
    fn parse(line: &str) -> Option<Self> {
        let words: Vec<_> = line.split_ascii_whitespace().collect();
        let &[major, major_length, minor, minor_length] = words.as_slice() else { return None };
        let layout = Self { major: Axis::parse(major, major_length)?, minor: Axis::parse(minor, minor_length)? };
        (layout.major.is_y != layout.minor.is_y).then_some(layout)
    }

    fn size(&self) -> (u64, u64) {
        let (x, y) = if self.major.is_y { (&self.minor, &self.major) } else { (&self.major, &self.minor) };
        (x.length.into(), y.length.into())
    }

    fn place(&self, i: u32, j: u32) -> (u32, u32) {
        let (major, minor) = (self.major.place(i), self.minor.place(j));
        if self.major.is_y { (minor, major) } else { (major, minor) }
    }
}

/// Lines that are shorter or longer are never stored by channel.
const CHANNEL_LINES: std::ops::Range<usize> = 8..0x8000;

fn read_line(file: &mut Bytes, line: &mut [[u8; 4]]) -> Result<(), FileError> {
    let length = line.len();
    match file.rest() {
        &[2, 2, high, low, ..] if CHANNEL_LINES.contains(&length) && high < 128 => {
            if usize::from(u16::from_be_bytes([high, low])) != length {
                return Err(file.error("a line of the Radiance picture has another length than the picture"));
            }
            file.at += 4;
            (0..4).try_for_each(|channel| read_channel(file, line, channel))
        }
        _ => read_pixels(file, line),
    }
}

/// A byte above 128 is a run of a value, one up to 128 as many values.
fn read_channel(file: &mut Bytes, line: &mut [[u8; 4]], channel: usize) -> Result<(), FileError> {
    let mut x = 0;
    while x < line.len() {
        let code = usize::from(file.byte()?);
        let (count, is_run) = if code > 128 { (code - 128, true) } else { (code, false) };
        if count == 0 || count > line.len() - x {
            return Err(file.error("a run of the Radiance picture does not fit its line"));
        }
        let mut value = if is_run { file.byte()? } else { 0 };
        for pixel in &mut line[x..x + count] {
            if !is_run {
                value = file.byte()?;
            }
            pixel[channel] = value;
        }
        x += count;
    }
    Ok(())
}

fn read_pixels(file: &mut Bytes, line: &mut [[u8; 4]]) -> Result<(), FileError> {
    let (mut x, mut shift) = (0, 0);
    while x < line.len() {
        let pixel = [file.byte()?, file.byte()?, file.byte()?, file.byte()?];
        let &[1, 1, 1, count] = &pixel else {
            line[x] = pixel;
            (x, shift) = (x + 1, 0);
            continue;
        };
        // Repetitions that follow each other are the digits of one count.
        let count = usize::from(count) << shift;
        if x == 0 || shift > 16 || count > line.len() - x {
            return Err(file.error("a run of the Radiance picture does not fit its line"));
        }
        let last = line[x - 1];
        line[x..x + count].fill(last);
        (x, shift) = (x + count, shift + 8);
    }
    Ok(())
}

struct Bytes<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl<'a> Bytes<'a> {
    /// Longer ones are no text.
    const LONGEST_LINE: usize = 4096;

    fn error(&self, message: &str) -> FileError {
        FileError::new(message).at(At::Byte(self.at))
    }

    fn rest(&self) -> &'a [u8] {
        &self.bytes[self.at..]
    }

    fn byte(&mut self) -> Result<u8, FileError> {
        let byte = self.bytes.get(self.at).ok_or_else(|| self.error("the Radiance picture is cut off"))?;
        self.at += 1;
        Ok(*byte)
    }

    /// A line of the header, without its end.
    fn line(&mut self) -> Result<&'a str, FileError> {
        let rest = &self.rest()[..self.rest().len().min(Self::LONGEST_LINE)];
        let end = rest.iter().position(|&b| b == b'\n').ok_or_else(|| {
            self.error("the header of the Radiance picture has no end").hint("is it a Radiance picture at all?")
        })?;
        let line = std::str::from_utf8(&rest[..end]).unwrap_or("?");
        self.at += end + 1;
        Ok(line.trim_end_matches('\r'))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn file(size: &str, pixels: &[u8]) -> Vec<u8> {
        [format!("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n{size}\n").as_bytes(), pixels].concat()
    }

    fn reds(size: &str, pixels: &[u8]) -> Vec<f32> {
        decode(&file(size, pixels)).unwrap().0.pixels().iter().map(|p| p[0]).collect()
    }

    #[test]
    fn values() {
        assert_eq!(radiance([128, 64, 1, 129]), [1.0, 0.5, 1.0 / 128.0]);
        assert_eq!(radiance([255, 255, 255, 0]), [0.0; 3]);
        assert_eq!(radiance([255, 0, 0, 255])[0], 255.0 * 2.0_f32.powi(119));
        assert_eq!(radiance([1, 0, 0, 1])[0], 2.0_f32.powi(-135));
    }

    #[test]
    fn all_orders_of_pixels() {
        let pixels: Vec<_> = (1..=6).flat_map(|i| [i * 10, 0, 0, 136]).collect();
        for (size, expected) in [
            ("-Y 2 +X 3", [1, 2, 3, 4, 5, 6]),
            ("+Y 2 +X 3", [4, 5, 6, 1, 2, 3]),
            ("-Y 2 -X 3", [3, 2, 1, 6, 5, 4]),
            ("+Y 2 -X 3", [6, 5, 4, 3, 2, 1]),
            ("+X 3 -Y 2", [1, 3, 5, 2, 4, 6]),
            ("+X 3 +Y 2", [2, 4, 6, 1, 3, 5]),
            ("-X 3 -Y 2", [5, 3, 1, 6, 4, 2]),
            ("-X 3 +Y 2", [6, 4, 2, 5, 3, 1]),
        ] {
            assert_eq!(reds(size, &pixels), expected.map(|i| i as f32 * 10.0), "{size}");
        }
    }

    #[test]
    fn runs() {
        let new = [&[2, 2, 0, 9][..], &[128 + 5, 7, 4, 1, 2, 3, 4], &[128 + 9, 0], &[128 + 9, 0], &[128 + 9, 136]];
        let expected = [7.0, 7.0, 7.0, 7.0, 7.0, 1.0, 2.0, 3.0, 4.0];
        assert_eq!(reds("-Y 1 +X 9", &new.concat()), expected);
        // 5 and 2 · 256 repetitions.
        let old = [&[7, 0, 0, 136][..], &[1, 1, 1, 5], &[1, 1, 1, 2], &[9, 0, 0, 136]];
        let mut expected = vec![7.0; 1 + 5 + 512];
        expected.push(9.0);
        assert_eq!(reds("-Y 1 +X 519", &old.concat()), expected);
    }

    #[test]
    fn what_does_not_fit() {
        for (size, pixels) in [
            ("-Y 1 +X 9", &[2, 2, 0, 8, 0][..]),
            ("-Y 1 +X 9", &[2, 2, 0, 9, 128 + 10, 0]),
            ("-Y 1 +X 9", &[2, 2, 0, 9, 0]),
            ("-Y 1 +X 3", &[1, 1, 1, 3]),
            ("-Y 1 +X 3", &[5, 5, 5, 5, 1, 1, 1, 3]),
            ("-Y 1 +X 2", &[5, 5, 5, 5, 5, 5, 5]),
            ("-Y 0 +X 2", &[]),
            ("-Y 4000000000 +X 4000000000", &[]),
            ("-Y 2 +Y 2", &[0; 16]),
            ("-Y -1 +X 2", &[0; 16]),
        ] {
            assert!(decode(&file(size, pixels)).is_err(), "{size} {pixels:?}");
        }
    }

    #[test]
    fn what_is_ignored_is_told() {
        let bytes = b"#?RGBE\r\nEXPOSURE= 2.0\r\n\r\n-Y 1 +X 1\n\x01\x02\x03\x88";
        let (image, warnings) = decode(bytes).unwrap();
        assert_eq!(image.pixels(), [[1.0, 2.0, 3.0]]);
        assert_eq!(warnings, [Warning::new("the picture's EXPOSURE (2.0) is ignored")]);
        assert!(decode(b"#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n\x01\x02\x03\x88").is_err());
    }
}
