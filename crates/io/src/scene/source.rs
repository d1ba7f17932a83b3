//! Texts and places in them. A scene's texts, its file and all that it includes, share one line of offsets, so a
//! span alone tells file, line and column.

use std::fs::File;
use std::io::{Read, stdin};
use std::ops::Range;
use std::path::{Component, Path, PathBuf};

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use crate::error::{At, Diagnostic, Error, Fault, Place};
use crate::scene::model::Files;
use crate::scene::nesting;
use crate::warning::Warning;

/// Longer scenes are refused: reading takes up to ninety times as much memory.
const MAX_BYTES: u64 = 64 << 20;
/// Files that include files that include files.
const MAX_INCLUDE_DEPTH: usize = 16;
/// Files of a scene; one counts as often as it is included.
const MAX_FILES: usize = 1000;

/// All texts of a scene.
#[derive(Default)]
pub(super) struct Sources {
    texts: Vec<Source>,
    problems: Vec<Problem>,
}

/// One text.
pub(super) struct Source {
    name: String,
    pub(super) text: String,
    /// Where relative names in it are looked for; none for a text that is no file.
    folder: Option<PathBuf>,
    /// Offset of the text's first byte.
    pub(super) base: usize,
    /// The texts that it includes, by index.
    pub(super) includes: Vec<usize>,
}

/// What is wrong, and its offset: problems are told in the order of the text.
pub(super) struct Problem {
    pub(super) start: usize,
    pub(super) diagnostic: Diagnostic,
}

impl Sources {
    /// The text of a file and of all that it includes; the file's comes first.
    ///
    /// # Errors
    /// If one cannot be read, is no TOML, or includes what it must not.
    pub(super) fn load(path: &Path) -> Result<Self, Error> {
        let mut sources = Self::default();
        let text = read_text(path)?;
        let mut open = Vec::from_iter(path.canonicalize());
        sources.load_text(path.display().to_string(), text, path.parent(), &mut open)?;
        sources.finish()
    }

    /// A text that is no file, and so cannot include any.
    ///
    /// # Errors
    /// If it is no TOML.
    pub(super) fn from_text(name: &str, text: &str) -> Result<Self, Error> {
        let mut sources = Self::default();
        sources.load_text(name.to_owned(), text.to_owned(), None, &mut Vec::new())?;
        sources.finish()
    }

    /// As [`load`](Self::load), from bytes.
    ///
    /// # Errors
    /// If they are no TOML, or it includes what it must not.
    pub(super) fn from_bytes(name: &str, bytes: &[u8], files: Files<'_>) -> Result<Self, Error> {
        let mut sources = Self::default();
        let path = Path::new(name);
        let text = text_of(path, read_all(bytes))?;
        let folder = if let Files::In(folder) = files { Some(folder) } else { None };
        let mut open =
            Vec::from_iter(folder.and_then(|folder| Some(folder.canonicalize().ok()?.join(path.file_name()?))));
        sources.load_text(name.to_owned(), text, folder, &mut open)?;
        sources.finish()
    }

    fn finish(mut self) -> Result<Self, Error> {
        if self.problems.is_empty() { Ok(self) } else { Err(into_error(std::mem::take(&mut self.problems))) }
    }

    /// Adds a text; returns its index.
    fn add(&mut self, name: String, text: String, folder: Option<&Path>) -> usize {
        let base = self.length();
        self.texts.push(Source { name, text, folder: folder.map(Path::to_owned), base, includes: Vec::new() });
        self.texts.len() - 1
    }

    /// Adds a setting of the command line; returns its index. Names in it are relative to the current folder.
    pub(super) fn add_setting(&mut self, text: String) -> usize {
        self.add("-D".to_owned(), text, Some(Path::new("")))
    }

    /// Of all texts; one more than each, because the end of a text is a place, too.
    pub(super) fn length(&self) -> usize {
        self.texts.last().map_or(0, |s| s.base + s.text.len() + 1)
    }

    pub(super) fn get(&self, index: usize) -> &Source {
        &self.texts[index]
    }

    fn load_text(
        &mut self,
        name: String,
        text: String,
        folder: Option<&Path>,
        open: &mut Vec<PathBuf>,
    ) -> Result<usize, Error> {
        let (table, errors) = DeTable::parse_recoverable(&text);
        let mut root = DeValue::Table(table.into_inner());
        let too_deep = nesting::cut(&mut root);
        let names: Vec<(Range<usize>, String)> = match root.get("include").map(Spanned::get_ref) {
            Some(DeValue::Array(names)) => {
                names.iter().filter_map(|n| Some((n.span(), n.get_ref().as_str()?.to_owned()))).collect()
            }
            _ => Vec::new(),
        };
        let is_valid = errors.is_empty() && too_deep.is_none();
        let index = self.add(name, text.clone(), folder);
        let base = self.texts[index].base;
        for error in errors {
            let Range { start, end } = error.span().unwrap_or_default();
            let mut message = error.message().replace('\n', ", ");
            if let ("duplicate key", Some(key)) = (error.message(), text.get(start..end)) {
                message += &format!(" `{key}`");
            }
            self.report(start + base..end + base, message, None);
        }
        if let Some(Range { start, end }) = too_deep {
            self.report(start + base..end + base, "nested too deeply".to_owned(), None);
        }
        for (span, name) in names.into_iter().filter(|_| is_valid) {
            match self.include(&name, folder, open) {
                Ok(included) => self.texts[index].includes.push(included),
                Err(Refusal::Here { message, hint, fault }) => {
                    let mut problem = self.problem(span.start + base..span.end + base, message, Some(hint.to_owned()));
                    problem.diagnostic.fault = fault;
                    self.problems.push(problem);
                }
                Err(Refusal::There(error)) => return Err(error),
            }
        }
        Ok(index)
    }

    fn include(&mut self, name: &str, folder: Option<&Path>, open: &mut Vec<PathBuf>) -> Result<usize, Refusal> {
        let refuse = |message, hint| Err(Refusal::Here { message, hint, fault: Fault::File });
        let root = open.first().and_then(|file| file.parent());
        let (Some(folder), Some(root)) = (folder, root) else {
            return refuse(format!("cannot include `{name}`: this scene has no folder"), "save it as a file");
        };
        let path = folder.join(name);
        let real = path.canonicalize();
        let leads_out = Path::new(name).components().any(|c| !matches!(c, Component::Normal(_) | Component::CurDir));
        if leads_out || real.as_ref().is_ok_and(|real| !real.starts_with(root)) {
            return refuse(
                format!("`{name}` is outside the scene's folder"),
                "include files that lie beside the scene or below",
            );
        }
        let unreadable = |e| Refusal::Here {
            message: format!("cannot read `{name}`: {e}"),
            hint: "names are relative to the file that includes",
            fault: Fault::FileSystem,
        };
        let real = real.map_err(unreadable)?;
        if open.contains(&real) {
            return refuse(format!("`{name}` includes itself"), "break the circle");
        }
        if open.len() >= MAX_INCLUDE_DEPTH {
            return refuse(format!("`{name}` is at the end of a chain of {MAX_INCLUDE_DEPTH} files"), "include fewer");
        }
        if self.texts.len() >= MAX_FILES {
            return refuse(format!("`{name}` would be one of more than {MAX_FILES} files"), "include fewer");
        }
        let text = text_of(&path, read_file(&real)).map_err(|e| match e {
            Error::Io { source, .. } => unreadable(source),
            other => Refusal::There(other),
        })?;
        if (self.length() + text.len()) as u64 > MAX_BYTES {
            let message = format!("with `{name}` the scene is longer than {} MiB", MAX_BYTES >> 20);
            return refuse(message, "include fewer or smaller files");
        }
        open.push(real);
        let index = self.load_text(path.display().to_string(), text, path.parent(), open).map_err(Refusal::There);
        open.pop();
        index
    }

    fn report(&mut self, span: Range<usize>, message: String, hint: Option<String>) {
        self.problems.push(self.problem(span, message, hint));
    }

    /// What is wrong at a span.
    pub(super) fn problem(&self, span: Range<usize>, message: String, hint: Option<String>) -> Problem {
        let place = self.place(span.start);
        Problem { start: span.start, diagnostic: Diagnostic { message, place, hint, fault: Fault::File } }
    }

    /// Where relative names at an offset are looked for.
    pub(super) fn folder(&self, offset: usize) -> Option<&Path> {
        self.source(offset)?.folder.as_deref()
    }

    fn source(&self, offset: usize) -> Option<&Source> {
        self.texts.iter().rev().find(|s| s.base <= offset && offset - s.base <= s.text.len())
    }

    fn place(&self, offset: usize) -> Option<Place> {
        let source = self.source(offset)?;
        let before = source.text.get(..offset - source.base).unwrap_or(&source.text);
        let (line, column) = line_and_column(before);
        Some(Place { file: source.name.clone(), at: At::Character { line, column } })
    }
}

/// Why a file is not included.
enum Refusal {
    /// The including file is wrong.
    Here { message: String, hint: &'static str, fault: Fault },
    /// The included file is.
    There(Error),
}

/// The problems of a scene in the order of its text.
pub(super) fn into_error(problems: Vec<Problem>) -> Error {
    Error::Scene(in_order(problems))
}

/// What is only worth a warning, in the order of the scene's text.
pub(super) fn into_warnings(problems: Vec<Problem>) -> Vec<Warning> {
    let warning = |Diagnostic { message, place, hint, .. }| Warning { message, place, hint };
    in_order(problems).into_iter().map(warning).collect()
}

fn in_order(mut problems: Vec<Problem>) -> Vec<Diagnostic> {
    problems.sort_by_key(|p| p.start);
    let mut diagnostics: Vec<_> = problems.into_iter().map(|p| p.diagnostic).collect();
    diagnostics.dedup();
    diagnostics
}

/// The text of a file, or of standard input for `-`.
fn read_text(path: &Path) -> Result<String, Error> {
    let bytes = if path == Path::new("-") { read_all(stdin().lock()) } else { read_file(path) };
    text_of(path, bytes)
}

/// What was read from a file as a text; none is too long.
fn text_of(path: &Path, bytes: std::io::Result<Option<Vec<u8>>>) -> Result<String, Error> {
    let refuse = |message: String, (line, column), hint: &str| {
        let place = Some(Place { file: path.display().to_string(), at: At::Character { line, column } });
        let diagnostic = Diagnostic { message, place, hint: Some(hint.to_owned()), fault: Fault::File };
        Err(Error::Scene(vec![diagnostic]))
    };
    let Some(bytes) = bytes.map_err(|e| Error::read(path, e))? else {
        let message = format!("the scene file is longer than {} MiB", MAX_BYTES >> 20);
        return refuse(message, (1, 1), "is it a scene file at all?");
    };
    match String::from_utf8(bytes) {
        Ok(text) => {
            // The mark that some editors put first takes no column.
            let text = text.strip_prefix('\u{feff}').map(str::to_owned).unwrap_or(text);
            if text.trim_ascii().is_empty() {
                return refuse("the scene file is empty".to_owned(), (1, 1), "begin with [[shape.sphere]]");
            }
            Ok(text)
        }
        Err(e) => {
            let (valid, rest) = e.as_bytes().split_at(e.utf8_error().valid_up_to());
            let byte = rest.first().copied().unwrap_or_default();
            let place = line_and_column(&String::from_utf8_lossy(valid));
            refuse(format!("byte 0x{byte:02x} is not UTF-8"), place, "scene files are UTF-8 text")
        }
    }
}

fn read_file(path: &Path) -> std::io::Result<Option<Vec<u8>>> {
    let file = File::open(path)?;
    if file.metadata()?.len() > MAX_BYTES { Ok(None) } else { read_all(file) }
}

/// All bytes; none if they are more than [`MAX_BYTES`].
fn read_all(source: impl Read) -> std::io::Result<Option<Vec<u8>>> {
    let mut bytes = Vec::new();
    source.take(MAX_BYTES + 1).read_to_end(&mut bytes)?;
    Ok((bytes.len() as u64 <= MAX_BYTES).then_some(bytes))
}

/// Of the character after a text, from 1.
fn line_and_column(before: &str) -> (usize, usize) {
    let line_start = before.rfind('\n').map_or(0, |i| i + 1);
    (before.matches('\n').count() + 1, before[line_start..].chars().count() + 1)
}
