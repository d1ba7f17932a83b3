//! The lines of a text that is too long to be read at once.
//!
//! A line ends at a line feed, with or without a carriage return. Bytes that are no UTF-8 become replacement characters; a text that
//! begins with the byte order mark of UTF-16 is read as that.

use std::io::{self, BufRead, BufReader, Read};
use std::path::Path;

use crate::error::{At, Error, FileError};

/// Longer lines are refused, bytes; those that go on in the next count as one.
const LONGEST: usize = 1 << 20;

/// Reads line by line.
pub(super) struct Lines<'a> {
    name: &'a str,
    source: Box<dyn BufRead + 'a>,
    bytes: Vec<u8>,
    text: String,
    /// Of lines that were read.
    count: usize,
    /// Whether a backslash at its end joins a line with the next, unless it stands in a comment.
    joins: bool,
}

impl<'a> Lines<'a> {
    /// From the beginning of a file, whose name stands in errors.
    ///
    /// # Errors
    /// If it cannot be read.
    pub(super) fn new(mut file: Box<dyn BufRead + 'a>, name: &'a str, joins: bool) -> Result<Self, Error> {
        let start = file.fill_buf().map_err(|e| Error::read(Path::new(name), e))?;
        let is_big = start.starts_with(&[0xfe, 0xff]);
        let mark = if is_big || start.starts_with(&[0xff, 0xfe]) {
            2
        } else if start.starts_with(&[0xef, 0xbb, 0xbf]) {
            3
        } else {
            0
        };
        file.consume(mark);
        let source: Box<dyn BufRead + 'a> =
            if mark == 2 { Box::new(BufReader::new(Utf16 { source: file, is_big })) } else { file };
        Ok(Self { name, source, bytes: Vec::new(), text: String::new(), count: 0, joins })
    }

    /// The next line without its end, and its number, from 1.
    ///
    /// # Errors
    /// If it cannot be read or is too long.
    pub(super) fn next(&mut self) -> Result<Option<(usize, &str)>, Error> {
        self.bytes.clear();
        let number = self.count + 1;
        loop {
            let start = self.bytes.len();
            let left = (LONGEST + 1).saturating_sub(self.bytes.len()) as u64;
            let read = self.source.by_ref().take(left).read_until(b'\n', &mut self.bytes);
            if self.bytes.len() > LONGEST {
                let error = FileError::new(format!("the line is longer than {LONGEST} bytes")).at(At::Line(number));
                return Err(error.of(self.name));
            }
            if read.map_err(|e| Error::read(Path::new(self.name), e))? == 0 {
                if self.count < number {
                    return Ok(None);
                }
                break;
            }
            self.count += 1;
            for end in [b'\n', b'\r'] {
                self.bytes.pop_if(|last| *last == end);
            }
            if !self.joins || self.bytes.get(start..).is_some_and(ends_in_comment) {
                break;
            }
            if self.bytes.pop_if(|last| *last == b'\\').is_none() {
                break;
            }
            self.bytes.push(b' ');
        }
        self.text.clear();
        self.text.push_str(&String::from_utf8_lossy(&self.bytes));
        Ok(Some((number, &self.text)))
    }
}

/// Whether a word of the line, and with it a comment, begins with `#`.
fn ends_in_comment(line: &[u8]) -> bool {
    line.ends_with(b"\\") && line.split(u8::is_ascii_whitespace).any(|word| word.starts_with(b"#"))
}

/// UTF-16 as UTF-8.
struct Utf16<R> {
    source: R,
    is_big: bool,
}

impl<R: Read> Utf16<R> {
    /// A unit; none at the end.
    fn unit(&mut self) -> io::Result<Option<u16>> {
        let mut bytes = [0; 2];
        match self.source.read_exact(&mut bytes) {
            Ok(()) => Ok(Some(if self.is_big { u16::from_be_bytes(bytes) } else { u16::from_le_bytes(bytes) })),
            Err(e) if e.kind() == io::ErrorKind::UnexpectedEof => Ok(None),
            Err(e) => Err(e),
        }
    }
}

impl<R: Read> Read for Utf16<R> {
    /// Units beyond the first plane become replacement characters: they stand in names and comments alone.
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let mut length = 0;
        while let Some(rest) = buffer.get_mut(length..).filter(|rest| rest.len() >= 3) {
            let Some(unit) = self.unit()? else { break };
            let c = char::from_u32(unit.into()).unwrap_or(char::REPLACEMENT_CHARACTER);
            length += c.encode_utf8(rest).len();
        }
        Ok(length)
    }
}
