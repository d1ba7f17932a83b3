//! Names by which parts of a scene mean each other: textures and materials.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::validate::Checker;

/// The name of a texture or a material, and, in a scene that is built, its number.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(from = "String", into = "String")]
pub struct Name {
    name: String,
    index: u32,
}

impl Name {
    /// A name that has no number yet.
    pub fn new(name: &str) -> Self {
        name.to_owned().into()
    }

    /// The name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The number that [`Numbers::resolve`] has given it.
    #[inline]
    pub(crate) fn index(&self) -> u32 {
        self.index
    }
}

impl From<String> for Name {
    fn from(name: String) -> Self {
        Self { name, index: u32::MAX }
    }
}

impl From<Name> for String {
    fn from(name: Name) -> Self {
        name.name
    }
}

/// Names by their keys, where a value may be one.
pub(crate) type Named<'a> = Vec<(&'static str, Option<&'a mut Name>)>;

/// The names alone.
pub(crate) fn words(names: Named<'_>) -> Vec<String> {
    names.into_iter().filter_map(|(_, name)| Some(name?.name.clone())).collect()
}

/// The numbers of things, by their names.
#[derive(Clone, Debug)]
pub(crate) struct Numbers<'d>(BTreeMap<&'d str, u32>);

impl<'d> Numbers<'d> {
    /// In their order.
    pub(crate) fn new(names: impl IntoIterator<Item = &'d str>) -> Self {
        Self(names.into_iter().zip(0..).collect())
    }

    /// That of a thing that the check has found to be there.
    pub(crate) fn get(&self, name: &str) -> u32 {
        self.0.get(name).copied().unwrap_or(u32::MAX)
    }

    /// Notes in names which things they mean.
    pub(crate) fn resolve(&self, names: Named<'_>) {
        for name in names.into_iter().filter_map(|(_, name)| name) {
            name.index = self.get(&name.name);
        }
    }
}

/// Things of one kind that name each other.
#[derive(Debug)]
pub(crate) struct Nesting<'d> {
    /// What to call one of them, several, and what to do if there is none.
    words: [&'static str; 3],
    /// What each is made of.
    parts: BTreeMap<&'d str, Vec<String>>,
    /// Of those that are known not to lead too deep or back to themselves.
    depth: BTreeMap<&'d str, usize>,
    /// How many these are made of, themselves counted, and each as often as it is named.
    count: BTreeMap<&'d str, usize>,
}

impl<'d> Nesting<'d> {
    /// The most things within each other.
    const MOST: usize = 16;
    /// The most that one is made of: all of them may be looked at for each point.
    const MOST_PARTS: usize = 1000;

    /// `things` by their names, with the names of their parts.
    pub(crate) fn new(words: [&'static str; 3], things: impl Iterator<Item = (&'d str, Vec<String>)>) -> Self {
        Self { words, parts: things.collect(), depth: BTreeMap::new(), count: BTreeMap::new() }
    }

    /// Notes names, of values below the key of a kind, that nothing has.
    pub(crate) fn check_names(&self, kind: &str, names: Named<'_>, c: &mut Checker) {
        let missing = |name: &&mut Name| !self.parts.contains_key(name.name());
        c.within(kind, |c| {
            for (key, name) in names {
                if let Some(name) = name.filter(missing) {
                    c.no_such(key, self.words, name.name(), self.parts.keys().copied());
                }
            }
        });
    }

    /// Notes that one of them, of a kind, is made of itself, or of too many within each other.
    pub(crate) fn check(&mut self, name: &str, kind: &str, c: &mut Checker) {
        let [one, many, _] = self.words;
        let Err(way) = self.depth(&mut Vec::new(), name) else {
            if self.count.get(name).is_some_and(|&count| count > Self::MOST_PARTS) {
                let hint = format!("at most {} are allowed, each counted as often as it is named", Self::MOST_PARTS);
                c.problem(kind, format!("the {one} is made of too many {many}"), Some(hint));
            }
            return;
        };
        let Some((last, before)) = way.split_last() else { return };
        if before.first() == Some(last) {
            let message = format!("the {one} is made of itself: {}", way.join(" > "));
            c.problem(kind, message, Some("give one of them something else instead".to_owned()));
        } else if !before.contains(last) {
            let hint = format!("at most {} are allowed", Self::MOST);
            c.problem(kind, format!("the {one} is made of too many {many} within each other"), Some(hint));
        }
    }

    /// The depth of one, itself counted, or the way to it from where one has begun, if that is too long or comes back.
    fn depth(&mut self, way: &mut Vec<&'d str>, name: &str) -> Result<usize, Vec<&'d str>> {
        // What does not exist has no depth.
        let Some((&name, parts)) = self.parts.get_key_value(name) else { return Ok(0) };
        if let Some(&depth) = self.depth.get(name) {
            return if way.len() + depth > Self::MOST { Err([&way[..], &[name]].concat()) } else { Ok(depth) };
        }
        let comes_back = way.contains(&name);
        way.push(name);
        if comes_back || way.len() > Self::MOST {
            return Err(way.clone());
        }
        let (mut below, mut count) = (0, 1_usize);
        for part in parts.clone() {
            below = below.max(self.depth(way, &part)?);
            count = count.saturating_add(self.count.get(part.as_str()).copied().unwrap_or(0));
        }
        way.pop();
        self.count.insert(name, count);
        self.depth.insert(name, below + 1);
        Ok(below + 1)
    }
}
