//! What serde finds wrong, in the words of the format.

use eyebeam_core::desc::SceneDesc;

/// How the check of a scene begins to say that a material is missing.
pub(super) const MISSING_MATERIAL: &str = "there is no material ";

/// Words of serde, and ours.
const WORDS: [(&str, &str); 12] = [
    ("expected f32", "expected a number"),
    ("expected u32", "expected a whole number from 0 to 4294967295"),
    ("expected u64", "expected a whole number from 0"),
    ("expected an array of length 3", "expected [x, y, z]"),
    ("expected a sequence", "expected a list"),
    ("expected a map", "expected a table"),
    ("expected option", "expected a value"),
    ("type: sequence", "type: list"),
    ("type: map", "type: table"),
    ("type: floating point", "type: number"),
    ("type: unit variant", "type: string"),
    ("` as i128", "`"),
];

/// A message, and a hint.
pub(super) fn explain(message: &str, path: &[String]) -> (String, Option<String>) {
    let place = place_name(path);
    for (prefix, noun) in [("unknown field ", "field"), ("unknown variant ", "kind")] {
        if let Some(name) = quoted(message, prefix) {
            if name.starts_with("$__toml") {
                return (format!("a date has no place here{place}"), None);
            }
            let (_, known) = message.rsplit_once("`, expected ").unwrap_or_default();
            let known: Vec<_> = known.split('`').skip(1).step_by(2).collect();
            return (format!("unknown {noun} `{name}`{place}"), did_you_mean(name, &known));
        }
    }
    if lacks_kind(message) {
        let example =
            if path.first().is_some_and(|k| k == "material") { "material.NAME.lambertian" } else { "environment.none" };
        return (format!("one kind is needed{place}"), Some(format!("name it once, as in [{example}]")));
    }
    let mut message = message.replace('\n', ", ");
    for (rust, word) in WORDS {
        message = message.replace(rust, word);
    }
    if let Some((start, _)) = message.split_once("expected struct ") {
        message = format!("{start}expected a table");
    }
    let comma = if place.is_empty() || message.starts_with("missing") { "" } else { "," };
    (format!("{message}{comma}{place}"), None)
}

/// Whether no kind was named, or more than one, or something else than a table.
pub(super) fn lacks_kind(message: &str) -> bool {
    ["wanted exactly 1 element", "wanted string or table", "invalid type: unit variant"]
        .iter()
        .any(|m| message.starts_with(m))
}

/// What stands in backticks after a prefix.
pub(super) fn quoted<'a>(message: &'a str, prefix: &str) -> Option<&'a str> {
    let name = message.strip_prefix(prefix)?.strip_prefix('`')?;
    Some(name.split_once("`, ").or(name.split_once('`'))?.0)
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
    // Names are short; comparing longer ones costs the square of their length.
    const LONGEST: usize = 100;
    let name = name.to_lowercase();
    let distance = |k: &&str| strsim::damerau_levenshtein(&name, k);
    let known = known.filter(|k| name.len().max(k.len()) <= LONGEST);
    known.min_by_key(distance).filter(|k| distance(k) <= 1 + name.len().min(k.len()) / 4)
}

/// How the check of a scene says that a material is missing.
pub(super) fn missing_material(name: &str) -> String {
    format!("{MISSING_MATERIAL}`{name}`")
}

pub(super) fn nearest_material(desc: &SceneDesc, message: &str) -> Option<String> {
    let name = message.strip_prefix(MISSING_MATERIAL)?.strip_prefix('`')?.strip_suffix('`')?;
    nearest(name, desc.material.keys().map(String::as_str)).map(|near| format!("did you mean `{near}`?"))
}

/// ` in material "wall"`: where in the scene a path leads.
pub(super) fn place_name(path: &[String]) -> String {
    match path.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        [table @ ("material" | "texture"), name, ..] => format!(" in {table} \"{name}\""),
        ["shape", kind, _, ..] => format!(" in a {kind}"),
        ["light", kind, _, ..] => format!(" in a light of kind {kind}"),
        ["environment"] => " in environment".to_owned(),
        [table, _, ..] => format!(" in {table}"),
        _ => String::new(),
    }
}
