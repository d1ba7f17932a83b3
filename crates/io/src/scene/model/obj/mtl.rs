//! MTL, the library of materials: its text. What becomes of it is told in [`material`](super::material).
//!
//! Wavefront, "Advanced Visualizer Manual", appendix "MTL material format", 1995; `Pr` and so on: Exocortex 2015, "Extending the
//! Wavefront MTL format for physically-based rendering".

use std::collections::BTreeMap;
use std::io::Cursor;
use std::path::{Path, PathBuf};

use eyebeam_core::texture::Channel;

use super::parse;
use crate::error::Error;
use crate::scene::model::files::Files;
use crate::scene::model::folder;
use crate::scene::model::lines::Lines;
use crate::scene::model::skipped::Skipped;
use crate::warning::Warning;

/// A material as its file says it.
#[derive(Clone, Debug, Default)]
pub(super) struct Mtl {
    /// `Kd`, `Ks`, `Ke`, `Tf`.
    pub(super) colors: BTreeMap<&'static str, [f32; 3]>,
    /// `Ns`, `Ni`, `d`, `Pr` and so on.
    pub(super) numbers: BTreeMap<&'static str, f32>,
    /// By the keyword, in lower case and without `map_`.
    pub(super) maps: BTreeMap<&'static str, Map>,
    /// `Ka`, and the line it is in.
    pub(super) ambient: Option<([f32; 3], usize)>,
    /// Where each of the others stands.
    pub(super) lines: BTreeMap<&'static str, usize>,
    /// That of its `newmtl`.
    line: usize,
    /// Folder of its file below that of the model.
    pub(super) folder: PathBuf,
}

/// A picture and its options.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Map {
    pub(super) file: String,
    /// `-s`
    pub(super) scale: [f32; 3],
    /// `-o`
    pub(super) offset: [f32; 3],
    /// `-clamp on`
    pub(super) clamp: bool,
    /// `-bm`
    pub(super) bump: f32,
    /// `-imfchan`
    pub(super) channel: Option<Part>,
}

/// The part of a picture that is an amount.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Part {
    Color(Channel),
    Alpha,
}

const COLORS: [&str; 4] = ["Kd", "Ks", "Ke", "Tf"];
const NUMBERS: [&str; 12] = ["Ns", "Ni", "d", "Tr", "illum", "Pr", "Pm", "Ps", "Pc", "Pcr", "aniso", "anisor"];
/// What pictures are of that are no amounts.
const COLORED: [&str; 4] = ["kd", "ks", "ke", "norm"];
/// What pictures are of that have a strength.
const RELIEF: [&str; 2] = ["bump", "norm"];
/// Keywords of pictures, in lower case, and what they are of.
const MAPS: [(&str, &str); 10] = [
    ("map_kd", "kd"),
    ("map_ks", "ks"),
    ("map_ke", "ke"),
    ("map_d", "d"),
    ("map_bump", "bump"),
    ("bump", "bump"),
    ("norm", "norm"),
    ("map_pr", "pr"),
    ("map_pm", "pm"),
    ("map_ps", "ps"),
];

/// Adds the materials of a library to those that are known; the first of a name stays.
pub(super) fn read(
    files: Files<'_>,
    path: &Path,
    name: &str,
    known: &mut BTreeMap<String, Mtl>,
) -> Result<Vec<Warning>, Error> {
    let mut skipped = Skipped::default();
    let file = path.display().to_string();
    let mut lines = Lines::new(Box::new(Cursor::new(files.read(path)?)), &file, true)?;
    let folder = folder::plain(Path::new(name)).parent().map(Path::to_owned).unwrap_or_default();
    let mut current: Option<(String, Mtl)> = None;
    let mut keep = |material: Option<(String, Mtl)>, skipped: &mut Skipped| {
        let Some((name, mut mtl)) = material else { return };
        mtl.settle(skipped);
        match known.get(&name) {
            None => drop(known.insert(name, mtl)),
            Some(first) if first.says_the_same(&mtl) => {}
            Some(_) => skipped.note(&format!("a second `newmtl {name}` is not used"), mtl.line),
        }
    };
    while let Some((number, line)) = lines.next()? {
        let line = line.trim();
        let (keyword, rest) = line.split_once(|c: char| c.is_ascii_whitespace()).unwrap_or((line, ""));
        if keyword.is_empty() || keyword.starts_with('#') {
            continue;
        }
        if keyword == "newmtl" {
            let next = (rest.trim().to_owned(), Mtl { line: number, folder: folder.clone(), ..Mtl::default() });
            keep(current.replace(next), &mut skipped);
        } else if let Some((_, mtl)) = &mut current {
            mtl.line(keyword, rest.trim(), number, &mut skipped);
        } else {
            skipped.note("what stands before the first `newmtl` is not read", number);
        }
    }
    keep(current, &mut skipped);
    Ok(skipped.warnings(name))
}

impl Mtl {
    fn line(&mut self, keyword: &str, rest: &str, number: usize, skipped: &mut Skipped) {
        let mut words = rest.split_ascii_whitespace();
        let mut value = || words.next().and_then(parse);
        let map = MAPS.iter().find(|(name, _)| name.eq_ignore_ascii_case(keyword));
        let is_read = if let Some(key) = COLORS.iter().find(|key| **key == keyword) {
            value()
                .map(|r| self.colors.insert(*key, [r, value().unwrap_or(r), value().unwrap_or(r)]))
                .map(|_| self.lines.insert(*key, number))
                .is_some()
        } else if let Some(key) = NUMBERS.iter().find(|key| **key == keyword) {
            value().map(|value| (self.numbers.insert(*key, value), self.lines.insert(*key, number))).is_some()
        } else if let Some((_, key)) = map {
            let map = Map::parse(rest, |option| skipped.note(&format!("the option `{option}` is not read"), number));
            if map.as_ref().is_some_and(|map| map.channel.is_some()) && COLORED.contains(key) {
                skipped.note("the option `-imfchan` is not read", number);
            }
            if map.as_ref().is_some_and(|map| map.bump != 1.0) && !RELIEF.contains(key) {
                skipped.note("the option `-bm` is not read", number);
            }
            map.map(|map| (self.maps.insert(*key, map), self.lines.insert(*key, number))).is_some()
        } else if keyword == "Ka" {
            let ambient = value().map(|r| [r, value().unwrap_or(r), value().unwrap_or(r)]);
            self.ambient = ambient.map(|ambient| (ambient, number));
            ambient.is_some()
        } else {
            false
        };
        if !is_read {
            skipped.note(&format!("`{keyword}` is not read"), number);
        }
    }

    /// `illum`, the way in which light is to be computed.
    pub(super) fn illum(&self) -> Option<i32> {
        self.numbers.get("illum").map(|illum| *illum as i32)
    }

    /// Whether there is anything of the extension for PBR.
    pub(super) fn is_pbr(&self) -> bool {
        ["Pr", "Pm", "Ps", "Pc"].iter().any(|key| self.numbers.contains_key(key))
            || ["pr", "pm", "ps"].iter().any(|key| self.maps.contains_key(key))
    }

    /// Whether another one says the same, wherever it stands.
    fn says_the_same(&self, other: &Self) -> bool {
        let of = |mtl: &Self| (mtl.colors.clone(), mtl.numbers.clone(), mtl.maps.clone(), mtl.folder.clone());
        of(self) == of(other)
    }
}

/// Options with how many words may follow, and whether these are numbers.
const OPTIONS: [(&str, usize, bool); 14] = [
    ("-s", 3, true),
    ("-o", 3, true),
    ("-t", 3, true),
    ("-mm", 2, true),
    ("-bm", 1, true),
    ("-boost", 1, true),
    ("-texres", 1, true),
    ("-clamp", 1, false),
    ("-blendu", 1, false),
    ("-blendv", 1, false),
    ("-imfchan", 1, false),
    ("-type", 1, false),
    ("-cc", 1, false),
    ("-colorspace", 1, false),
];

impl Map {
    /// Options stand before the name, which may have spaces, and by some programs after it.
    fn parse(mut rest: &str, mut skip: impl FnMut(&str)) -> Option<Self> {
        let mut map =
            Self { file: String::new(), scale: [1.0; 3], offset: [0.0; 3], clamp: false, bump: 1.0, channel: None };
        while !rest.is_empty() {
            let (word, after) = split(rest);
            let Some((option, most, is_number)) = OPTIONS.iter().find(|(option, ..)| *option == word) else {
                let end = next_option(rest);
                if !map.file.is_empty() {
                    return None;
                }
                rest.get(..end)?.trim().clone_into(&mut map.file);
                rest = rest.get(end..)?.trim_start();
                continue;
            };
            rest = after;
            let mut values = Vec::new();
            while values.len() < *most && !rest.is_empty() {
                let (word, after) = split(rest);
                if *is_number && parse(word).is_none() {
                    break;
                }
                values.push(word);
                rest = after;
            }
            map.set(option, &values, &mut skip);
        }
        (!map.file.is_empty()).then_some(map)
    }

    fn set(&mut self, option: &str, values: &[&str], skip: &mut impl FnMut(&str)) {
        let mut numbers = values.iter().filter_map(|word| parse(word));
        match option {
            "-s" => self.scale.iter_mut().zip(numbers).for_each(|(to, number)| *to = number),
            "-o" => self.offset.iter_mut().zip(numbers).for_each(|(to, number)| *to = number),
            "-bm" => self.bump = numbers.next().unwrap_or(1.0),
            "-clamp" => self.clamp = values == ["on"],
            "-imfchan" => match values {
                ["r"] => self.channel = Some(Part::Color(Channel::Red)),
                ["g"] => self.channel = Some(Part::Color(Channel::Green)),
                ["b"] => self.channel = Some(Part::Color(Channel::Blue)),
                ["l"] => self.channel = Some(Part::Color(Channel::Luminance)),
                ["m"] => self.channel = Some(Part::Alpha),
                _ => skip(option),
            },
            other => skip(other),
        }
    }
}

/// The first word, and what comes after it.
fn split(text: &str) -> (&str, &str) {
    let (word, rest) = text.split_once(|c: char| c.is_ascii_whitespace()).unwrap_or((text, ""));
    (word, rest.trim_start())
}

/// Where the first option stands after a name.
fn next_option(text: &str) -> usize {
    let starts = text.match_indices(|c: char| c.is_ascii_whitespace()).map(|(at, _)| at);
    let is_option = |at: &usize| {
        let rest = text.get(at + 1..).unwrap_or_default();
        rest.starts_with('-') && OPTIONS.iter().any(|(option, ..)| *option == split(rest).0)
    };
    starts.into_iter().find(is_option).unwrap_or(text.len())
}
