//! The scene format: TOML, the kind of a thing as a key.
//!
//! Reading goes on after an error. What deserialisation stumbles over is reported, taken out of the table, and the
//! rest tried again, until it goes through; then the scene is checked as a whole. So all mistakes come in one list,
//! each with its line.

use std::borrow::Cow;
use std::ops::Range;

use eyebeam_core::desc::SceneDesc;
use eyebeam_core::setup::Given;
use serde::Deserialize;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use crate::error::Error;
use crate::memory::Memory;
use crate::scene::assets::{self, Note};
use crate::scene::explain::{
    MISSING_MATERIAL, explain, lacks_kind, missing_material, nearest_material, place_name, quoted,
};
use crate::scene::merge::{self, Table};
use crate::scene::nesting::{self, MAX_DEPTH};
use crate::scene::source::{Problem, Sources, into_error, into_warnings};
use crate::scene::{Contents, Override, ReadOptions, SceneFile};

/// How many mistakes are looked for: each costs a walk through the scene, so fewer in long ones.
fn most_problems(length: usize) -> usize {
    (16_000_000 / length.max(1)).clamp(20, 1000)
}

/// The description in the first of `sources`, changed by settings.
pub(super) fn read(mut sources: Sources, options: &ReadOptions<'_>) -> Result<SceneFile, Error> {
    let settings: Vec<_> =
        options.overrides.iter().map(|o| (o, sources.add_setting(format!("{}={}", o.path, o.value)))).collect();
    let most = most_problems(sources.length());
    let memory = Memory::new(options.memory);
    let mut reader = Reader { sources: &sources, memory: &memory, most, problems: Vec::new(), warnings: Vec::new() };
    let mut table = reader.table(0);
    for (setting, source) in settings {
        reader.set(&mut table, setting, source);
    }
    let desc = reader.deserialize(table);
    if reader.problems.len() >= most {
        let message = format!("these are the first {most} mistakes; there may be more");
        reader.report(usize::MAX..usize::MAX, message, None);
    }
    let Reader { problems, warnings, .. } = reader;
    if problems.is_empty() {
        let contents = Contents { format: "scene", ..Contents::default() };
        let (warnings, memory) = (into_warnings(warnings), memory.taken());
        Ok(SceneFile { desc, warnings, given: Given::ALL, contents, memory })
    } else {
        Err(into_error(problems))
    }
}

struct Reader<'a> {
    sources: &'a Sources,
    memory: &'a Memory,
    /// Where the list of problems ends.
    most: usize,
    problems: Vec<Problem>,
    warnings: Vec<Problem>,
}

impl<'a> Reader<'a> {
    fn report(&mut self, span: Range<usize>, message: String, hint: Option<String>) {
        self.problems.push(self.sources.problem(span, message, hint));
    }

    /// A source's table over those that it includes.
    fn table(&self, source: usize) -> Table<'a> {
        let source = self.sources.get(source);
        let mut table = Table::new();
        for &included in &source.includes {
            merge::merge(&mut table, self.table(included));
        }
        let own = DeTable::parse_recoverable(&source.text).0.into_inner();
        merge::merge(&mut table, merge::map_spans(own, &mut merge::shift_by(source.base)));
        table
    }

    /// Applies a `-D` setting.
    fn set(&mut self, table: &mut Table<'a>, setting: &'a Override, source: usize) {
        let base = self.sources.get(source).base;
        let value_start = base + setting.path.len() + 1;
        let mut value = match DeValue::parse(&setting.value) {
            Ok(value) => value,
            Err(_) => Spanned::new(0..setting.value.len(), DeValue::String(Cow::Borrowed(&setting.value))),
        };
        let mut start = base;
        let mut keys = Vec::new();
        for key in setting.path.split('.') {
            keys.push((key.trim(), start..start + key.len()));
            start += key.len() + 1;
        }
        let refuse = |message: &str| Err((message.to_owned(), "settings are key.key=value, as in -D camera.vfov=30"));
        let result = match keys[..] {
            [("include", _), ..] => Err(("`include` can only be said in the file".to_owned(), "include it there")),
            _ if keys.len() > MAX_DEPTH => refuse("the key is too long"),
            _ if nesting::cut(value.get_mut()).is_some() => refuse("the value is nested too deeply"),
            _ => {
                if let Some(depth) = kind_depth(&setting.path) {
                    keep_only_kind(table, &keys[..=depth]);
                }
                let value = merge::map_value_spans(value, &mut merge::shift_by(value_start));
                merge::set(table, &keys, value).or_else(|message| refuse(&message))
            }
        };
        if let Err((message, hint)) = result {
            self.report(base..value_start, message, Some(hint.to_owned()));
        }
    }

    /// The description, and a problem for all that is not in it.
    fn deserialize(&mut self, table: Table<'_>) -> SceneDesc {
        let mut numbered = Numbered::new(table);
        let mut removed: Vec<Vec<String>> = Vec::new();
        while self.problems.len() < self.most {
            let whole = Spanned::new(0..0, numbered.table.clone());
            let error = match SceneDesc::deserialize(toml::de::Deserializer::from(whole)) {
                Ok(mut desc) => {
                    removed.extend(self.load(&mut desc, &numbered));
                    self.check(&desc, &numbered, &removed);
                    if self.problems.is_empty() {
                        self.warn(&desc, &numbered);
                    }
                    return desc;
                }
                Err(error) => error,
            };
            let number = error.span().unwrap_or_default();
            let span = numbered.span(&number);
            let Some(path) = merge::find(&numbered.table, &number) else {
                self.report(span, explain(error.message(), &[]).0, None);
                break;
            };
            if !follows(error.message(), &path, &removed) {
                let (message, hint) = explain(error.message(), &path);
                self.report(span, message, hint);
            }
            let path = path_to_remove(&numbered.table, path);
            merge::remove(&mut numbered.table, &path);
            // What follows in a list moves up to the place of what was removed.
            removed.retain(|r| !r.starts_with(&path));
            removed.push(path);
        }
        SceneDesc::default()
    }

    /// Loads the files that the scene names; returns the paths of those names that lead nowhere.
    fn load(&mut self, desc: &mut SceneDesc, numbered: &Numbered<'_>) -> Vec<Vec<String>> {
        let sources = self.sources;
        let notes = assets::load(desc, self.memory, |path| sources.folder(numbered.span_of(path).start));
        let mut missing = Vec::new();
        for Note { path, message, hint, fault } in notes {
            let span = numbered.span_of(&path);
            let Some(fault) = fault else {
                self.warnings.push(self.sources.problem(span, message, hint));
                continue;
            };
            if self.problems.len() < self.most {
                let mut problem = self.sources.problem(span, format!("{message},{}", place_name(&path)), hint);
                problem.diagnostic.fault = fault;
                self.problems.push(problem);
                missing.push(path);
            }
        }
        missing
    }

    /// Reports what is allowed and yet hardly meant.
    fn warn(&mut self, desc: &SceneDesc, numbered: &Numbered<'_>) {
        let told =
            desc.warnings().into_iter().map(|w| self.sources.problem(numbered.span_of(&w.path), w.message, w.hint));
        self.warnings.extend(told);
    }

    /// Reports what is wrong with the scene as a whole, but for what follows from other mistakes.
    fn check(&mut self, desc: &SceneDesc, numbered: &Numbered<'_>, removed: &[Vec<String>]) {
        for problem in desc.check() {
            let follows = removed.iter().any(|path| {
                let is_material = path.len() <= 3 && path.first().is_some_and(|key| key == "material");
                let is_named = path.get(1).is_none_or(|name| problem.message == missing_material(name));
                // Without its file or one of its lists, a mesh is another one.
                let is_mesh = matches!(path.as_slice(), [s, m, _, _] if s == "shape" && m == "mesh")
                    && problem.path.starts_with(&path[..3]);
                *path == problem.path
                    || is_mesh
                    || is_material && is_named && problem.message.starts_with(MISSING_MATERIAL)
            });
            if follows || self.problems.len() >= self.most {
                continue;
            }
            let hint = nearest_material(desc, &problem.message).or(problem.hint);
            let place = place_name(&problem.path);
            let comma = if place.is_empty() { "" } else { "," };
            self.report(numbered.span_of(&problem.path), format!("{}{comma}{place}", problem.message), hint);
        }
    }
}

/// A table whose spans are numbers. Places in the text do not tell values apart: `[material.wall.metal]` is where three
/// tables begin.
struct Numbered<'a> {
    table: Table<'a>,
    /// By number.
    spans: Vec<Range<usize>>,
}

impl<'a> Numbered<'a> {
    fn new(table: Table<'a>) -> Self {
        // 0 is the table itself.
        let mut spans = vec![Range::default()];
        let table = merge::map_spans(table, &mut |span| {
            spans.push(span);
            spans.len() - 1..spans.len()
        });
        Self { table, spans }
    }

    /// Where in the text a number stands.
    fn span(&self, number: &Range<usize>) -> Range<usize> {
        self.spans.get(number.start).cloned().unwrap_or_default()
    }

    /// Where in the text the value at a path stands, or the nearest one above it.
    fn span_of(&self, path: &[String]) -> Range<usize> {
        self.span(&merge::span_of(&self.table, path).unwrap_or_default())
    }
}

/// Whether a mistake is there only because of what was taken out before.
fn follows(message: &str, path: &[String], removed: &[Vec<String>]) -> bool {
    let missing = quoted(message, "missing field ").map(|field| [path, &[field.to_owned()]].concat());
    let no_kind = lacks_kind(message);
    removed.iter().any(|r| missing.as_ref() == Some(r) || no_kind && r.len() == path.len() + 1 && r.starts_with(path))
}

/// How deep the key lies that says the kind of a thing, if a path leads through one.
fn kind_depth(path: &str) -> Option<usize> {
    let keys: Vec<_> = path.split('.').collect();
    match keys[..] {
        ["environment", _, ..] => Some(1),
        ["material", _, _, ..] => Some(2),
        _ => None,
    }
}

/// A thing has one kind: a setting of another kind replaces it.
fn keep_only_kind(table: &mut Table<'_>, keys: &[(&str, Range<usize>)]) {
    let Some(((kind, _), above)) = keys.split_last() else {
        return;
    };
    let mut table = table;
    for (key, _) in above {
        match table.get_mut(*key).map(Spanned::get_mut) {
            Some(DeValue::Table(child)) => table = child,
            _ => return,
        }
    }
    let kept = table.remove_entry(*kind);
    table.clear();
    table.extend(kept);
}

/// An element of a list of numbers goes with its list: a shorter one would only be another mistake.
fn path_to_remove(table: &Table<'_>, mut path: Vec<String>) -> Vec<String> {
    let is_number = |key: &String| !key.is_empty() && key.bytes().all(|b| b.is_ascii_digit());
    while path.last().is_some_and(is_number) && !holds_table(table, &path) {
        path.pop();
    }
    path
}

fn holds_table(table: &Table<'_>, path: &[String]) -> bool {
    let mut value = path.first().and_then(|key| table.get(key.as_str())).map(Spanned::get_ref);
    for key in path.iter().skip(1) {
        value = match value {
            Some(DeValue::Table(table)) => table.get(key.as_str()).map(Spanned::get_ref),
            Some(DeValue::Array(items)) => key.parse().ok().and_then(|i: usize| items.get(i)).map(Spanned::get_ref),
            _ => None,
        };
    }
    value.is_some_and(DeValue::is_table)
}
