//! What the reader makes of scenes, above all of wrong ones.

mod assets;
mod errors;
mod files;
mod includes;
mod models;
#[path = "../shared/pictures.rs"]
mod pictures;
mod robustness;
mod schema;
mod settings;
mod textures;
mod write;

use eyebeam_io::scene::{Override, read_str};
use eyebeam_io::{At, Diagnostic, Error, Place};

/// Stands in a test's scene before each thing that is wrong.
const MARK: char = '▸';

/// The scene without marks, and the line and column of each.
fn unmark(marked: &str) -> (String, Vec<(usize, usize)>) {
    let (mut text, mut places, mut line, mut column) = (String::new(), Vec::new(), 1, 1);
    for c in marked.chars() {
        if c == MARK {
            places.push((line, column));
            continue;
        }
        text.push(c);
        (line, column) = if c == '\n' { (line + 1, 1) } else { (line, column + 1) };
    }
    (text, places)
}

fn problems(error: Error) -> Vec<Diagnostic> {
    match error {
        Error::Scene(problems) => problems,
        other => panic!("{other}"),
    }
}

/// Lines and columns of what is wrong.
fn places(problems: &[Diagnostic]) -> Vec<(usize, usize)> {
    problems.iter().map(|p| p.place.as_ref().map_or((0, 0), character)).collect()
}

/// The line and the column of a place.
fn character(place: &Place) -> (usize, usize) {
    match place.at {
        At::Character { line, column } => (line, column),
        _ => panic!("{place}"),
    }
}

fn setting(text: &str) -> Override {
    let (path, value) = text.split_once('=').unwrap();
    Override { path: path.to_owned(), value: value.to_owned() }
}

/// Reads wrong scenes, compares the places of their mistakes with the marks, and lists what is said.
fn report(scenes: &[&str]) -> String {
    let mut report = String::new();
    for marked in scenes {
        let (text, expected) = unmark(marked);
        let error = read_str("a.toml", &text, &[]).expect_err(marked);
        let said = error.to_string();
        assert_eq!(places(&problems(error)), expected, "{marked}\n{said}");
        report += &format!("{}\n\n{said}\n\n------\n", marked.trim().escape_debug().to_string().replace("\\n", "\n"));
    }
    report
}
