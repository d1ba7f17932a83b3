//! Wavefront OBJ: polygons with materials of a library (MTL) beside them.
//!
//! Read are `v` (also with a colour after x y z, as sRGB signals that count to 1, 255 or 65535), `vt`, `vn`, `f`, `s`, `usemtl` and `mtllib`; `o` and `g` change
//! nothing, since faces of a material are one mesh. Where a face has no normals it is flat, or smooth within its smoothing group.
//! The file is read line by line. Wavefront, "Advanced Visualizer Manual", appendix B1, 1993.

mod material;
mod meshes;
mod mtl;
mod pictures;
mod settle;

use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::path::Path;
use std::sync::Arc;

use eyebeam_core::shape::MeshDesc;
use glam::{DVec3, Vec3};

use crate::error::{At, Error, FileError};
use crate::memory::Memory;
use crate::scene::model::Model;
use crate::scene::model::files::{Files, Input};
use crate::scene::model::lines::Lines;
use crate::scene::model::skipped::Skipped;
use crate::scene::{ReadOptions, polygon};
use crate::warning::Warning;
use meshes::{Corner, Meshes, Normal, Points, WHITE};
use mtl::Mtl;
use pictures::Pictures;

pub(super) fn read(input: &Input<'_>, _: &ReadOptions<'_>, memory: &Memory) -> Result<Model, Error> {
    let name = &input.name;
    let mut reader = Reader::default();
    let mut lines = Lines::new(input.open()?.0, name, true)?;
    while let Some((number, line)) = lines.next()? {
        let is_read = reader.line(line, number).and_then(|()| match number % LINES_BETWEEN_CHECKS {
            0 => memory.check(reader.bytes()),
            _ => Ok(()),
        });
        is_read.map_err(|e| e.at(At::Line(number)).of(name))?;
    }
    memory.take(reader.bytes()).map_err(|e| e.of(name))?;
    if reader.faces == 0 {
        return Err(FileError::new("the file has no faces")
            .hint("it is empty, or holds curves or points alone")
            .of(name));
    }
    Ok(reader.finish(input.files, name, memory))
}

/// After so many lines it is seen how much memory they take.
const LINES_BETWEEN_CHECKS: usize = 1 << 16;

#[derive(Default)]
struct Reader {
    points: Points,
    meshes: Meshes,
    /// Names by their numbers, from 1; 0 is none.
    materials: Vec<String>,
    numbers: HashMap<String, u32>,
    /// The number of the material in use.
    material: u32,
    /// The smoothing group, 0 is none.
    group: u32,
    /// Names after `mtllib`, whole.
    libraries: Vec<String>,
    skipped: Skipped,
    /// The line of the first colour that is a little too bright.
    too_bright: Option<usize>,
    /// The least and the largest alpha of a position, and the line of the least.
    alphas: Option<(f32, f32, usize)>,
    /// Of any number of corners.
    faces: usize,
    corners: Vec<Corner>,
    triangles: Vec<[usize; 3]>,
}

impl Reader {
    /// That was read takes, about.
    fn bytes(&self) -> u64 {
        self.points.bytes() + self.meshes.bytes()
    }

    fn line(&mut self, line: &str, number: usize) -> Result<(), FileError> {
        let line = line.trim();
        let (keyword, rest) = line.split_once(|c: char| c.is_ascii_whitespace()).unwrap_or((line, ""));
        let words = || rest.split_ascii_whitespace().take_while(|word| !word.starts_with('#'));
        match keyword {
            "v" => self.position(words(), number),
            "vt" => {
                let ([u, v, _], _) = numbers(words(), 1)?;
                push(&mut self.points.uvs, [u, v])
            }
            "vn" => push(&mut self.points.normals, numbers::<3>(words(), 3)?.0),
            "f" | "fo" => self.face(words(), number),
            "s" => {
                let group = words().next().unwrap_or("off");
                match if group.eq_ignore_ascii_case("off") { Ok(0) } else { group.parse() } {
                    Ok(group) => self.group = group,
                    Err(_) => self.skipped.note("a smoothing group that is no number is not read", number),
                }
                Ok(())
            }
            "usemtl" => self.use_material(rest.trim()),
            "mtllib" => {
                let rest = rest.trim().to_owned();
                if !self.libraries.contains(&rest) && self.libraries.len() < MOST_LIBRARIES {
                    self.libraries.push(rest);
                }
                Ok(())
            }
            "" | "o" | "g" => Ok(()),
            _ if keyword.starts_with('#') => Ok(()),
            other => {
                self.skipped.note(&format!("`{other}` is not read"), number);
                Ok(())
            }
        }
    }

    fn position<'a>(&mut self, words: impl Iterator<Item = &'a str>, number: usize) -> Result<(), FileError> {
        let ([x, y, z, r, g, b, alpha, _], count) = numbers::<8>(words, 3)?;
        push(&mut self.points.positions, [x, y, z])?;
        if matches!(count, 6 | 7) {
            self.points.color([r, g, b]);
            if [r, g, b].iter().any(|signal| *signal > 1.0) {
                self.too_bright.get_or_insert(number);
            }
        }
        match count {
            5 | 8 => self.skipped.note("what follows `v x y z` is neither a weight nor a colour, and not read", number),
            7 => {
                let (least, most, line) = self.alphas.unwrap_or((alpha, alpha, number));
                let line = if alpha < least { number } else { line };
                self.alphas = Some((least.min(alpha), most.max(alpha), line));
            }
            _ => {}
        }
        Ok(())
    }

    /// Notes what of the colours of positions is not kept.
    fn check_colors(&mut self) {
        let white = self.points.white();
        if white == 1.0
            && let Some(line) = self.too_bright
        {
            self.skipped.note("colours of vertices above 1 are clamped", line);
        }
        if let Some((least, most, line)) = self.alphas
            && least < if most > 1.0 { white } else { 1.0 }
        {
            self.skipped.note("alphas of vertices are not read", line);
        }
    }

    fn use_material(&mut self, name: &str) -> Result<(), FileError> {
        if let Some(&number) = self.numbers.get(name) {
            self.material = number;
            return Ok(());
        }
        self.materials.push(name.to_owned());
        self.material =
            u32::try_from(self.materials.len()).map_err(|_| FileError::new("there are too many materials"))?;
        self.numbers.insert(name.to_owned(), self.material);
        Ok(())
    }

    fn face<'a>(&mut self, words: impl Iterator<Item = &'a str>, number: usize) -> Result<(), FileError> {
        self.faces += 1;
        self.corners.clear();
        let mut has_normals = true;
        for word in words {
            let mut parts = word.split('/');
            let part = parts.next().unwrap_or_default();
            let position = index(part, self.points.positions.len(), "vertex")?;
            let mut optional = |count, what| match parts.next() {
                None | Some("") => Ok(None),
                // Some programs number what they do not write.
                Some(_) if count == 0 => {
                    self.skipped.note(&format!("a face with a `{what}`, of which there is none, goes without"), number);
                    Ok(None)
                }
                Some(part) => index(part, count, what).map(Some),
            };
            let uv = optional(self.points.uvs.len(), "vt")?;
            let normal = optional(self.points.normals.len(), "vn")?;
            if parts.next().is_some() {
                return Err(FileError::new(format!("`{word}` is no corner")).hint("write v, v/vt, v//vn or v/vt/vn"));
            }
            has_normals &= normal.is_some();
            self.corners.push(Corner { position, uv, normal: normal.map_or(Normal::None, Normal::Given) });
        }
        if self.corners.len() < 3 {
            self.skipped.note("a face of fewer than three corners is dropped", number);
            return Ok(());
        }
        if !has_normals {
            for corner in &mut self.corners {
                corner.normal =
                    if self.group == 0 { Normal::None } else { self.meshes.made(corner.position, self.group)? };
            }
        }
        let place = |c: &Corner| self.points.positions.get(c.position as usize).copied().unwrap_or_default();
        let places: Vec<DVec3> = self.corners.iter().map(|c| Vec3::from(place(c)).as_dvec3()).collect();
        self.triangles.clear();
        polygon::triangulate(&places, &mut self.triangles);
        let key = (self.material, has_normals || self.group != 0);
        for &[a, b, c] in &self.triangles {
            if let (Some(&a), Some(&b), Some(&c)) = (self.corners.get(a), self.corners.get(b), self.corners.get(c)) {
                self.meshes.push(key, [a, b, c], &self.points)?;
            }
        }
        Ok(())
    }

    fn finish(mut self, files: Files<'_>, file: &str, memory: &Memory) -> Model {
        self.check_colors();
        let Self { points, meshes, materials, libraries, skipped, .. } = self;
        let mut model = Model::new();
        model.warnings = skipped.warnings(file);
        let mut pictures = Pictures::new(files, memory);
        let mut known = BTreeMap::new();
        read_libraries(files, &libraries, &mut known, &mut model.warnings);
        let mut made = BTreeMap::new();
        let mut is_covered = false;
        for ((number, _), data) in meshes.finish(&points) {
            let name = (number as usize).checked_sub(1).and_then(|i| materials.get(i));
            let material = name.and_then(|name| {
                let outcome = made.entry(name.clone()).or_insert_with(|| match known.get(name) {
                    Some(mtl) => Some(material::add(name, mtl, &mut pictures, &mut model)),
                    None => {
                        let message = "there is no such material: what has it is grey";
                        model.warnings.push(Warning::new(message).part(format!("material `{name}`")));
                        None
                    }
                });
                outcome.clone()
            });
            is_covered |= material.is_some() && data.colors.iter().any(|color| *color != WHITE);
            let material = material.or_else(|| (!data.colors.is_empty()).then(|| model.vertex_color()));
            let data = Some(Arc::new(data));
            model.desc.shape.mesh.push(MeshDesc { file: Some(file.to_owned()), material, data, ..MeshDesc::default() });
        }
        if is_covered {
            let message = "colours of vertices are not used where faces have a material";
            model.warnings.push(Warning::new(message).hint("leave out `usemtl` to see them"));
        }
        model
    }
}

/// Appends to a list that indices of 32 bits reach.
fn push<T>(list: &mut Vec<T>, item: T) -> Result<(), FileError> {
    if list.len() >= u32::MAX as usize {
        return Err(FileError::new("there are too many vertices"));
    }
    list.push(item);
    Ok(())
}

/// Up to `N` finite numbers, of which `least` must be there, and how many there are.
fn numbers<'a, const N: usize>(
    words: impl Iterator<Item = &'a str>,
    least: usize,
) -> Result<([f32; N], usize), FileError> {
    let mut found = [0.0; N];
    let mut count = 0;
    for (number, word) in found.iter_mut().zip(words) {
        *number = parse(word).ok_or_else(|| FileError::new(format!("`{word}` is no finite number")))?;
        count += 1;
    }
    if count < least {
        return Err(FileError::new(format!("there are {count} numbers, and not {least}")));
    }
    Ok((found, count))
}

/// A finite number; some programs write `3.1+e2` for `3.1e+2`.
fn parse(word: &str) -> Option<f32> {
    let number = word.parse().or_else(|e| match word.split_once("+e").or_else(|| word.split_once("-e")) {
        Some((mantissa, exponent)) => {
            let sign = if word.contains("-e") { '-' } else { '+' };
            format!("{mantissa}e{sign}{exponent}").parse()
        }
        None => Err(e),
    });
    number.ok().filter(|number: &f32| number.is_finite())
}

/// The place in a list of which a file has had `count`: from 1, or from its end if negative.
fn index(word: &str, count: usize, what: &str) -> Result<u32, FileError> {
    let number: i64 = word.parse().map_err(|_| FileError::new(format!("`{word}` is no whole number")))?;
    let index = if number < 0 { number.checked_add_unsigned(count as u64) } else { number.checked_sub(1) };
    let index = index.and_then(|i| u32::try_from(i).ok()).filter(|&i| (i as usize) < count);
    index.ok_or_else(|| FileError::new(format!("there is no {what} {number}: there are {count} before this line")))
}

/// Libraries of a file; more are not read.
const MOST_LIBRARIES: usize = 1000;

/// Reads the libraries after each `mtllib`: one whose name has spaces, or several. None is read twice.
fn read_libraries(files: Files<'_>, lines: &[String], known: &mut BTreeMap<String, Mtl>, warnings: &mut Vec<Warning>) {
    let find = |name: &str| files.find(Path::new(name));
    let names_of = |line| if find(line).is_ok() { vec![line] } else { line.split_ascii_whitespace().collect() };
    let (mut names, mut read) = (BTreeSet::new(), BTreeSet::new());
    for name in lines.iter().flat_map(|line| names_of(line)) {
        if names.len() == MOST_LIBRARIES {
            warnings.push(Warning::new(format!("only the first {MOST_LIBRARIES} libraries of materials are read")));
            break;
        }
        if !names.insert(name) {
            continue;
        }
        let refused = |e: FileError| Warning {
            hint: e.hint,
            ..Warning::new(format!("the library `{name}` is not read: {}", e.message))
        };
        match find(name) {
            Ok(path) if !read.insert(path.clone()) => {}
            Ok(path) => match mtl::read(files, &path, name, known) {
                Ok(found) => warnings.extend(found),
                Err(e) => warnings.push(refused(e.into())),
            },
            Err(e) => warnings.push(refused(e)),
        }
    }
}
