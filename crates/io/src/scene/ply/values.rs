//! The values of a PLY file, one after the other. Double precision holds those of all types exactly.

use crate::error::{At, FileError};
use crate::scene::ply::header::{Kind, Scalar};

/// A source of values.
pub(super) trait Values: Clone {
    /// The next one.
    fn next(&mut self, scalar: Scalar) -> Result<f64, FileError>;

    /// Where that is.
    fn at(&self) -> At;

    /// Bytes that are left; a value takes one at least.
    fn remaining(&self) -> usize;

    /// The fewest bytes that a property can take.
    fn shortest(&self, kind: Kind) -> usize;

    /// Bytes that are left, but for space alone.
    fn rest(&self) -> usize;
}

/// Numbers between spaces.
#[derive(Clone)]
pub(super) struct Text<'a> {
    rest: &'a [u8],
    line: usize,
}

impl<'a> Text<'a> {
    /// `lines` come before.
    pub(super) fn new(rest: &'a [u8], lines: usize) -> Self {
        Self { rest, line: lines + 1 }
    }

    fn skip_space(&mut self) {
        let end = self.rest.iter().position(|b| !b.is_ascii_whitespace()).unwrap_or(self.rest.len());
        let (space, rest) = self.rest.split_at(end);
        // A line ends in a line feed, or in a carriage return without one.
        let ends = (0..space.len()).filter(|&i| match space[i] {
            b'\n' => true,
            b'\r' => space.get(i + 1) != Some(&b'\n'),
            _ => false,
        });
        self.line += ends.count();
        self.rest = rest;
    }
}

impl Values for Text<'_> {
    fn next(&mut self, _: Scalar) -> Result<f64, FileError> {
        self.skip_space();
        let end = self.rest.iter().position(u8::is_ascii_whitespace).unwrap_or(self.rest.len());
        let (word, rest) = self.rest.split_at(end);
        self.rest = rest;
        let value = std::str::from_utf8(word).ok().and_then(|word| word.parse().ok());
        value.ok_or_else(|| {
            if word.is_empty() {
                return FileError::new("the file is cut off").at(At::Line(self.line));
            }
            FileError::new(format!("`{}` is no number", String::from_utf8_lossy(word))).at(At::Line(self.line))
        })
    }

    fn at(&self) -> At {
        let mut next = Self { ..*self };
        next.skip_space();
        At::Line(next.line)
    }

    /// The space after the last value may be missing.
    fn remaining(&self) -> usize {
        self.rest.len() + 1
    }

    fn shortest(&self, _: Kind) -> usize {
        2
    }

    fn rest(&self) -> usize {
        self.rest.trim_ascii().len()
    }
}

/// Bytes, the first of a number its highest or its lowest.
#[derive(Clone)]
pub(super) struct Binary<'a, const BIG_ENDIAN: bool> {
    rest: &'a [u8],
    end: usize,
}

impl<'a, const BIG_ENDIAN: bool> Binary<'a, BIG_ENDIAN> {
    /// `start` bytes come before.
    pub(super) fn new(rest: &'a [u8], start: usize) -> Self {
        Self { rest, end: start + rest.len() }
    }

    #[inline]
    fn take<const N: usize>(&mut self) -> Result<[u8; N], FileError> {
        let (bytes, rest) = self.rest.split_first_chunk().ok_or_else(|| self.cut_off())?;
        self.rest = rest;
        let mut bytes: [u8; N] = *bytes;
        if BIG_ENDIAN {
            bytes.reverse();
        }
        Ok(bytes)
    }

    #[cold]
    fn cut_off(&self) -> FileError {
        FileError::new("the file is cut off").at(self.at())
    }
}

impl<const BIG_ENDIAN: bool> Values for Binary<'_, BIG_ENDIAN> {
    #[inline]
    fn next(&mut self, scalar: Scalar) -> Result<f64, FileError> {
        Ok(match scalar {
            Scalar::I8 => i8::from_le_bytes(self.take()?).into(),
            Scalar::U8 => u8::from_le_bytes(self.take()?).into(),
            Scalar::I16 => i16::from_le_bytes(self.take()?).into(),
            Scalar::U16 => u16::from_le_bytes(self.take()?).into(),
            Scalar::I32 => i32::from_le_bytes(self.take()?).into(),
            Scalar::U32 => u32::from_le_bytes(self.take()?).into(),
            Scalar::F32 => f32::from_le_bytes(self.take()?).into(),
            Scalar::F64 => f64::from_le_bytes(self.take()?),
        })
    }

    fn at(&self) -> At {
        At::Byte(self.end - self.rest.len())
    }

    fn remaining(&self) -> usize {
        self.rest.len()
    }

    fn shortest(&self, kind: Kind) -> usize {
        match kind {
            Kind::Scalar(scalar) | Kind::List(scalar, _) => scalar.size(),
        }
    }

    fn rest(&self) -> usize {
        if self.rest.trim_ascii().is_empty() { 0 } else { self.rest.len() }
    }
}
