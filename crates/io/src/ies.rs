//! IES LM-63: photometric files of luminaires, of 1986, 1991, 1995, 2002 and 2019.
//!
//! After keywords and a line `TILT=` come numbers: lamps, lumens, a multiplier, how many angles there are, the photometric
//! type, size, ballast factor, watts; then vertical angles, horizontal angles, and the intensities of the first
//! horizontal angle, of the second and so on. ANSI/IES LM-63-19, 2019.
//!
//! Intensities are multiplied by all factors of the file, so they are candela. The size of the luminaire and what `TILT`
//! says of lamps that are not upright is not kept.

use std::path::Path;

use eyebeam_core::light::IesProfile;

use crate::error::{At, Error, FileError};
use crate::file;
use crate::warning::Warning;

/// Reads a profile, and says what of it could not be kept.
///
/// # Errors
/// If the file cannot be read, is damaged, or is of a photometric type other than C.
pub fn read_ies(path: &Path) -> Result<(IesProfile, Vec<Warning>), Error> {
    read_ies_bytes(&path.display().to_string(), &file::read(path)?)
}

/// As [`read_ies`], from the bytes of a file; `name` stands for it in errors.
///
/// # Errors
/// If the bytes are damaged, or are of a photometric type other than C.
pub fn read_ies_bytes(name: &str, bytes: &[u8]) -> Result<(IesProfile, Vec<Warning>), Error> {
    read(bytes).map_err(|e| e.of(name))
}

fn read(bytes: &[u8]) -> Result<(IesProfile, Vec<Warning>), FileError> {
    let (is_old, tilt, mut numbers) = read_labels(bytes)?;
    let mut warnings = Vec::new();
    if tilt == b"INCLUDE" {
        skip_tilt(&mut numbers)?;
    }
    if tilt != b"NONE" {
        warnings.push(Warning::new("the profile's TILT is ignored: the lamp counts as upright"));
    }
    let [_lamps, _lumens, multiplier] = numbers.take()?;
    let (vertical, horizontal) = (numbers.count()?, numbers.count()?);
    read_type(&mut numbers)?;
    let [_units, _width, _length, _height, ballast, lamp_ballast, _watts] = numbers.take()?;
    // In 1995 and later this number is reserved or tells how the file was made.
    let factor = multiplier * ballast * if is_old { lamp_ballast } else { 1.0 };
    if vertical.saturating_mul(horizontal) > IesProfile::MAX_VALUES {
        return Err(numbers.error(format!("{vertical} times {horizontal} angles are too many")));
    }
    let vertical = numbers.list(vertical)?;
    let horizontal = numbers.list(horizontal)?;
    let candela = numbers.list(vertical.len() * horizontal.len())?;
    let single = |values: Vec<f64>, factor: f64| values.into_iter().map(|v| (v * factor) as f32).collect();
    let profile = IesProfile::new(single(vertical, 1.0), single(horizontal, 1.0), single(candela, factor));
    let profile = profile.map_err(|problem| FileError { hint: problem.hint, ..FileError::new(problem.message) })?;
    Ok((profile, warnings))
}

/// A profile as a file of 2002, which reads back the same.
pub fn encode_ies(profile: &IesProfile) -> Vec<u8> {
    let line = |numbers: &[f32]| numbers.iter().map(ToString::to_string).collect::<Vec<_>>().join(" ") + "\n";
    let (vertical, horizontal) = (profile.vertical(), profile.horizontal());
    let mut text = "IESNA:LM-63-2002\nTILT=NONE\n".to_owned();
    text += &format!("1 -1 1 {} {} 1 2 0 0 0\n1 1 0\n", vertical.len(), horizontal.len());
    text += &line(vertical);
    text += &line(horizontal);
    profile.candela().chunks(vertical.len().max(1)).for_each(|column| text += &line(column));
    text.into_bytes()
}

/// Reads up to `TILT=`: whether the file is of 1986 or 1991, what the tilt is, and where numbers begin.
fn read_labels(bytes: &[u8]) -> Result<(bool, &[u8], Numbers<'_>), FileError> {
    let first = bytes.trim_ascii_start();
    let is_old = !first.starts_with(b"IESNA:LM-63-") && !first.starts_with(b"IES:LM-63-");
    let mut at = 0;
    for (line, text) in (1..).zip(bytes.split_inclusive(|&b| b == b'\n')) {
        at += text.len();
        if let Some(tilt) = text.trim_ascii().strip_prefix(b"TILT=") {
            return Ok((is_old, tilt.trim_ascii(), Numbers { rest: &bytes[at..], line: line + 1 }));
        }
    }
    Err(FileError::new("the file has no line `TILT=`").hint("is it an IES LM-63 file at all?"))
}

/// The lamp's position, angles, and a factor for each.
fn skip_tilt(numbers: &mut Numbers) -> Result<(), FileError> {
    numbers.take::<1>()?;
    let pairs = numbers.count()?;
    numbers.list(pairs)?;
    numbers.list(pairs).map(drop)
}

fn read_type(numbers: &mut Numbers) -> Result<(), FileError> {
    match numbers.count()? {
        1 => Ok(()),
        kind @ 2..=3 => Err(numbers
            .error(format!("the photometric type is {}, and only C is read", if kind == 2 { "B" } else { "A" }))
            .hint("convert it to type C")),
        kind => Err(numbers.error(format!("there is no photometric type {kind}"))),
    }
}

/// Numbers between spaces or commas.
struct Numbers<'a> {
    rest: &'a [u8],
    /// Of the next one, from 1.
    line: usize,
}

impl Numbers<'_> {
    fn error(&self, message: impl Into<String>) -> FileError {
        FileError::new(message).at(At::Line(self.line))
    }

    fn next(&mut self) -> Result<f64, FileError> {
        let is_space = |b: u8| b.is_ascii_whitespace() || b == b',' || b == 0x1a;
        let start = self.rest.iter().position(|&b| !is_space(b)).unwrap_or(self.rest.len());
        let (space, rest) = self.rest.split_at(start);
        self.line += space.iter().filter(|&&b| b == b'\n').count();
        let (word, rest) = rest.split_at(rest.iter().position(|&b| is_space(b)).unwrap_or(rest.len()));
        self.rest = rest;
        if word.is_empty() {
            return Err(self.error("the file is cut off"));
        }
        let value = std::str::from_utf8(word).ok().and_then(|w| w.parse().ok()).filter(|v: &f64| v.is_finite());
        value.ok_or_else(|| self.error(format!("`{}` is no number", String::from_utf8_lossy(word))))
    }

    fn take<const N: usize>(&mut self) -> Result<[f64; N], FileError> {
        let mut values = [0.0; N];
        values.iter_mut().try_for_each(|v| self.next().map(|next| *v = next))?;
        Ok(values)
    }

    fn count(&mut self) -> Result<usize, FileError> {
        let value = self.next()?;
        if value >= 1.0 && value <= IesProfile::MAX_VALUES as f64 && value.fract() == 0.0 {
            Ok(value as usize)
        } else {
            Err(self.error(format!("{value} is no number of values")))
        }
    }

    fn list(&mut self, count: usize) -> Result<Vec<f64>, FileError> {
        (0..count).map(|_| self.next()).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn profiles_read_back() {
        let candela = vec![0.1, 1e-7, 3.3e5, 0.0, 7.0, 1.0 / 3.0];
        let profile = IesProfile::new(vec![0.0, 45.5, 90.0], vec![0.0, 90.0], candela).unwrap();
        assert_eq!(read_ies_bytes("a.ies", &encode_ies(&profile)).unwrap(), (profile, vec![]));
    }

    #[test]
    fn old_files_have_two_factors() {
        let numbers = "TILT=NONE\n1 1000 2 2 1 1 1 0 0 0 0.5 0.25 60\n0 90\n0\n100 40\n";
        for (header, factor) in [
            ("", 0.25),
            ("IESNA91\n", 0.25),
            ("IESNA:LM-63-1995\n", 1.0),
            ("IESNA:LM-63-2002\n", 1.0),
            ("IES:LM-63-2019\n", 1.0),
        ] {
            let (profile, warnings) = read_ies_bytes("a.ies", (header.to_owned() + numbers).as_bytes()).unwrap();
            assert_eq!(profile.candela(), [100.0 * factor, 40.0 * factor], "{header}");
            assert!(warnings.is_empty());
        }
    }
}
