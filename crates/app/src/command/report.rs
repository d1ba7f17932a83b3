//! What is worth a word about a scene: of a model, all that was ignored or approximated.

use std::collections::{BTreeMap, BTreeSet};

use eyebeam_io::error::{report, visible};
use eyebeam_io::scene::SceneFile;
use eyebeam_io::{Place, Warning};
use serde::Serialize;

use crate::error::Error;
use crate::progress::say;

/// How much is said.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Talk {
    /// Nothing.
    None,
    /// A few lines.
    Short,
    /// Everything.
    All,
}

impl Talk {
    /// As `-q` and `-v` say.
    pub(super) fn new(quiet: bool, verbose: bool) -> Self {
        match (quiet, verbose) {
            (true, _) => Self::None,
            (_, true) => Self::All,
            _ => Self::Short,
        }
    }
}

/// The most lines that are said if nobody asks for more.
const SHORT: usize = 5;

/// Warnings that say the same, once; for programs, too.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Told<'w> {
    message: &'w str,
    /// Each once, in the order in which they were met.
    places: Vec<&'w Place>,
    hint: Option<&'w str>,
    /// How often it was met.
    count: usize,
}

/// Each warning once, in the order in which they were met.
pub(super) fn told(warnings: &[Warning]) -> Vec<Told<'_>> {
    let (mut known, mut met) = (BTreeMap::new(), BTreeSet::new());
    let mut told: Vec<Told<'_>> = Vec::new();
    for Warning { message, place, hint } in warnings {
        let index = *known.entry((message, hint)).or_insert(told.len());
        if index == told.len() {
            told.push(Told { message, places: Vec::new(), hint: hint.as_deref(), count: 0 });
        }
        if let Some(same) = told.get_mut(index) {
            same.count += 1;
            same.places.extend(place.as_ref().filter(|place| met.insert((index, *place))));
        }
    }
    told
}

impl Told<'_> {
    /// With its places and its hint.
    pub(super) fn whole(&self) -> String {
        let message = format!("{}{}", self.message, self.times());
        report("warning", &message, self.places.iter().copied(), self.hint)
    }

    /// In one line, with the first place, without the hint.
    pub(super) fn line(&self) -> String {
        let place = self.places.first().map(|place| format!("{place}: ")).unwrap_or_default();
        format!("{place}{}{}", visible(self.message), self.times())
    }

    fn times(&self) -> String {
        if self.count > 1 { format!(" ({} times)", self.count) } else { String::new() }
    }
}

/// The lines to say.
fn lines(warnings: &[Warning], talk: Talk) -> Vec<String> {
    let told = told(warnings);
    let whole: Vec<_> = told.iter().map(Told::whole).collect();
    let length: usize = whole.iter().map(|text| text.lines().count()).sum();
    match talk {
        Talk::None => Vec::new(),
        Talk::Short if length > SHORT => {
            let shown = told.len().min(SHORT - 1);
            let rest = match told.len() - shown {
                0 => "-v shows what to do about them".to_owned(),
                rest => format!("and {rest} more: -v shows them all"),
            };
            told.iter().take(shown).map(|told| format!("warning: {}", told.line())).chain([rest]).collect()
        }
        Talk::Short | Talk::All => whole,
    }
}

/// Says of a scene what is worth a word; if `strict`, that is an error.
pub(super) fn say_of(file: SceneFile, strict: bool, talk: Talk) -> Result<SceneFile, Error> {
    if strict && !file.warnings.is_empty() {
        let errors = file.warnings.into_iter().map(Into::into).collect();
        return Err(eyebeam_io::Error::Scene(errors).into());
    }
    lines(&file.warnings, talk).iter().for_each(|line| say(line));
    Ok(file)
}

#[cfg(test)]
mod tests {
    use eyebeam_io::error::At;

    use super::*;

    fn warnings(messages: impl IntoIterator<Item = &'static str>) -> Vec<Warning> {
        let warning = |message: &str| Warning { message: message.to_owned(), place: None, hint: Some("h".to_owned()) };
        messages.into_iter().map(warning).collect()
    }

    #[test]
    fn a_few_are_told_wholly_and_many_in_five_lines() {
        let few = warnings(["a", "b", "a"]);
        let said = ["warning: a (2 times)\nhint: h", "warning: b\nhint: h"];
        assert_eq!(lines(&few, Talk::Short), said);
        let three = warnings(["a", "b", "c"]);
        let said = ["warning: a", "warning: b", "warning: c", "-v shows what to do about them"];
        assert_eq!(lines(&three, Talk::Short), said);
        let many = warnings(["a", "b", "c", "d", "a", "e", "f"]);
        let said = ["warning: a (2 times)", "warning: b", "warning: c", "warning: d", "and 2 more: -v shows them all"];
        assert_eq!(lines(&many, Talk::Short), said);
        assert_eq!((lines(&many, Talk::All).len(), lines(&many, Talk::None).len()), (6, 0));
    }

    #[test]
    fn programs_get_them_too() {
        let at = |line| Some(Place { file: "a.toml".to_owned(), at: At::Character { line, column: 8 } });
        let all = [3, 3, 5].map(|line| Warning { place: at(line), ..warnings(["a\nb"]).remove(0) });
        let told = told(&all);
        let expected = serde_json::json!([{
            "message": "a\nb",
            "places": [{ "file": "a.toml", "line": 3, "column": 8 }, { "file": "a.toml", "line": 5, "column": 8 }],
            "hint": "h",
            "count": 3,
        }]);
        assert_eq!(serde_json::to_value(&told).unwrap(), expected);
        assert_eq!(told[0].line(), "a.toml:3:8: a\\nb (3 times)");
        let whole = "warning: a\\nb (3 times)\n  --> a.toml:3:8\n  --> a.toml:5:8\nhint: h";
        assert_eq!(told[0].whole(), whole);
    }

    #[test]
    fn not_every_place_is_shown() {
        let at = |i| Some(Place { file: "a.glb".to_owned(), at: At::Part(format!("picture {i}")) });
        let all: Vec<_> = (0..13).map(|i| Warning { place: at(i), ..warnings(["a"]).remove(0) }).collect();
        let whole = told(&all)[0].whole();
        assert!(whole.contains("--> a.glb, picture 9\n  --> and 3 more places\nhint"), "{whole}");
    }
}
