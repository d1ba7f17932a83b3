//! The scene format: TOML, the kind of a thing as a key.
//!
//! Reading goes on after an error. What deserialisation stumbles over is reported, taken out of the table, and the
//! rest tried again, until it goes through; then the scene is checked as a whole. So all mistakes come in one list,
//! each with its line.

use std::borrow::Cow;
use std::ops::Range;

use eyebeam_core::desc::SceneDesc;
use serde::Deserialize;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use crate::error::Error;
use crate::scene::Override;
use crate::scene::merge::{self, Table};
use crate::scene::source::{Problem, Sources, into_error};

/// More mistakes than this are not worth a list.
const MAX_PROBLEMS: usize = 100;

/// The description in the first of `sources`, changed by settings.
pub(super) fn read(mut sources: Sources, overrides: &[Override]) -> Result<SceneDesc, Error> {
    let settings: Vec<_> =
        overrides.iter().map(|o| (o, sources.add("-D".to_owned(), format!("{}={}", o.path, o.value)))).collect();
    let mut reader = Reader { sources: &sources, problems: Vec::new() };
    let mut table = reader.table(0);
    for (setting, source) in settings {
        reader.set(&mut table, setting, source);
    }
    let desc = reader.deserialize(table);
    if reader.problems.is_empty() { Ok(desc) } else { Err(into_error(reader.problems)) }
}

struct Reader<'a> {
    sources: &'a Sources,
    problems: Vec<Problem>,
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
        merge::merge(&mut table, if source.base == 0 { own } else { merge::shift_table(own, source.base) });
        table
    }

    /// Applies a `-D` setting.
    fn set(&mut self, table: &mut Table<'a>, setting: &'a Override, source: usize) {
        let base = self.sources.get(source).base;
        let value_start = base + setting.path.len() + 1;
        let value = match DeValue::parse(&setting.value) {
            Ok(value) => value.into_inner(),
            Err(_) => DeValue::String(Cow::Borrowed(&setting.value)),
        };
        let mut start = base;
        let mut keys = Vec::new();
        for key in setting.path.split('.') {
            keys.push((key.trim(), start..start + key.len()));
            start += key.len() + 1;
        }
        if let Some(depth) = kind_depth(&setting.path) {
            keep_only_kind(table, &keys[..=depth]);
        }
        let value = Spanned::new(value_start..value_start + setting.value.len(), value);
        if let Err(message) = merge::set(table, &keys, value) {
            self.report(
                base..value_start,
                message,
                Some("settings are key.key=value, as in -D camera.vfov=30".to_owned()),
            );
        }
    }

    /// The description, and a problem for all that is not in it.
    fn deserialize(&mut self, mut table: Table<'_>) -> SceneDesc {
        let mut removed: Vec<Vec<String>> = Vec::new();
        while self.problems.len() < MAX_PROBLEMS {
            let whole = Spanned::new(0..0, table.clone());
            let error = match SceneDesc::deserialize(toml::de::Deserializer::from(whole)) {
                Ok(desc) => {
                    self.check(&desc, &table, &removed);
                    return desc;
                }
                Err(error) => error,
            };
            let span = error.span().unwrap_or_default();
            let Some(path) = merge::find(&table, &span) else {
                self.report(span, explain(error.message(), &[]).0, None);
                break;
            };
            if !follows(error.message(), &path, &removed) {
                let (message, hint) = explain(error.message(), &path);
                self.report(span, message, hint);
            }
            let path = path_to_remove(&table, path);
            merge::remove(&mut table, &path);
            removed.push(path);
        }
        SceneDesc::default()
    }

    /// Reports what is wrong with the scene as a whole, but for what follows from other mistakes.
    fn check(&mut self, desc: &SceneDesc, table: &Table<'_>, removed: &[Vec<String>]) {
        for problem in desc.check() {
            let follows = removed.iter().any(|path| {
                let is_material = path.len() <= 3 && path.first().is_some_and(|key| key == "material");
                let name = path.get(1).map(|name| format!("there is no material `{name}`"));
                *path == problem.path || is_material && name.is_some_and(|message| message == problem.message)
            });
            if follows || self.problems.len() >= MAX_PROBLEMS {
                continue;
            }
            let span = merge::span_of(table, &problem.path).unwrap_or_default();
            let hint = nearest_material(desc, &problem).or(problem.hint);
            let place = place_name(&problem.path);
            let comma = if place.is_empty() { "" } else { "," };
            self.report(span, format!("{}{comma}{place}", problem.message), hint);
        }
    }
}

/// Whether a mistake is there only because of what was taken out before: a field that is missing now, a kind that is.
fn follows(message: &str, path: &[String], removed: &[Vec<String>]) -> bool {
    let missing = quoted(message, "missing field ").map(|field| [path, &[field.to_owned()]].concat());
    let no_kind = message.starts_with("wanted exactly 1 element");
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
    let is_number = |key: &String| key.bytes().all(|b| b.is_ascii_digit());
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

/// Says serde's message in the words of the format, and a hint.
fn explain(message: &str, path: &[String]) -> (String, Option<String>) {
    let place = place_name(path);
    for (prefix, noun) in [("unknown field ", "field"), ("unknown variant ", "kind")] {
        if let Some(name) = quoted(message, prefix) {
            let known: Vec<_> = message.split('`').skip(3).step_by(2).collect();
            return (format!("unknown {noun} `{name}`{place}"), did_you_mean(name, &known));
        }
    }
    if message.starts_with("wanted exactly 1 element") {
        let hint = "name it once, as in [material.NAME.lambertian]";
        return (format!("one kind is needed{place}"), Some(hint.to_owned()));
    }
    let mut message = message.split('\n').collect::<Vec<_>>().join(", ");
    for (rust, word) in [
        ("expected f32", "expected a number"),
        ("expected u32", "expected a whole number from 0 to 4294967295"),
        ("expected u64", "expected a whole number"),
        ("expected an array of length 3", "expected [x, y, z]"),
        ("expected a sequence", "expected a list"),
    ] {
        message = message.replace(rust, word);
    }
    let comma = if place.is_empty() || message.starts_with("missing") { "" } else { "," };
    (format!("{message}{comma}{place}"), None)
}

/// What stands in backticks after a prefix.
fn quoted<'a>(message: &'a str, prefix: &str) -> Option<&'a str> {
    message.strip_prefix(prefix)?.strip_prefix('`')?.split('`').next()
}

fn did_you_mean(name: &str, known: &[&str]) -> Option<String> {
    if let Some(near) = nearest(name, known.iter().copied()) {
        return Some(format!("did you mean `{near}`?"));
    }
    let list: Vec<_> = known.iter().map(|k| format!("`{k}`")).collect();
    (!list.is_empty()).then(|| format!("there is {}", list.join(", ")))
}

/// The known name that a misspelt one stands for, if one is near enough.
fn nearest<'a>(name: &str, known: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    let distance = |k: &&str| strsim::damerau_levenshtein(&name.to_lowercase(), k);
    known.min_by_key(distance).filter(|k| distance(k) <= 1 + name.len().min(k.len()) / 4)
}

fn nearest_material(desc: &SceneDesc, problem: &eyebeam_core::validate::Problem) -> Option<String> {
    let name = problem.message.strip_prefix("there is no material `")?.strip_suffix('`')?;
    nearest(name, desc.material.keys().map(String::as_str)).map(|near| format!("did you mean `{near}`?"))
}

/// ` in material "wall"`: where in the scene a path leads.
fn place_name(path: &[String]) -> String {
    match path.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        ["material", name, ..] => format!(" in material \"{name}\""),
        ["shape", kind, _, ..] => format!(" in a {kind}"),
        [table, _, ..] => format!(" in {table}"),
        _ => String::new(),
    }
}
