//! A scene as TOML that people can read: what nobody needs to say is left out, and each thing has a table of its own.
//!
//! What a key is by default is not known here: a thing is read without it, and what it has then is the default. At last the
//! whole text is read again, and must say the same.

use std::collections::BTreeMap;

use eyebeam_core::desc::SceneDesc;
use serde::Serialize;
use toml_edit::ser::ValueSerializer;
use toml_edit::{Array, ArrayOfTables, DocumentMut, InlineTable, Item, Table, Value};

use crate::error::Error;

/// The text of a scene, with a comment on top.
///
/// # Errors
/// If the text does not say what the scene is, which would be a mistake here.
pub(super) fn of(desc: &SceneDesc, comment: &str) -> Result<String, Error> {
    let whole = serialized(desc)?;
    let mut defaults = Defaults::default();
    let mut document = DocumentMut::new();
    for (section, value) in whole.clone() {
        let Value::InlineTable(things) = value else { continue };
        let section = section.as_str();
        let item = match section {
            "render" | "camera" => {
                let thing = defaults.prune(&[section], things);
                if thing.is_empty() { Item::None } else { Item::Table(thing.into_table()) }
            }
            "environment" => kinds(things, |kind, thing| {
                let thing = defaults.prune(&[section, kind], thing);
                // A gradient is around if nothing is said.
                (kind != "gradient" || !thing.is_empty()).then(|| Item::Table(thing.into_table()))
            }),
            "light" | "shape" => lists(things, |kind, thing| defaults.prune(&[section, kind, LIST], thing)),
            _ => {
                let mut named = implicit();
                for (name, kind) in things {
                    let Value::InlineTable(kind) = kind else { continue };
                    let item = kinds(kind, |kind, thing| {
                        Some(Item::Table(defaults.prune(&[section, NAME, kind], thing).into_table()))
                    });
                    named.insert(&name, item);
                }
                if named.is_empty() { Item::None } else { Item::Table(named) }
            }
        };
        if !item.is_none() {
            document.insert(section, item);
        }
    }
    let comment = comment.replace(|c: char| c.is_control(), " ");
    let text = format!("# {comment}\n\n{document}");
    let again: SceneDesc =
        toml::from_str(&text).map_err(|e| Error::Encode(format!("the scene's text is wrong: {e}")))?;
    if serialized(&again)?.to_string() != whole.to_string() {
        return Err(Error::Encode("the scene's text would say something else".to_owned()));
    }
    Ok(text)
}

/// Stands for any name in a place.
const NAME: &str = "x";
/// Stands for any index.
const LIST: &str = "0";

/// All keys in the order of the scene format, with numbers as short as they can be.
fn serialized(desc: &SceneDesc) -> Result<InlineTable, Error> {
    let value = desc.serialize(ValueSerializer::new()).map_err(|e| Error::Encode(e.to_string()))?;
    match shortened(value) {
        Value::InlineTable(table) => Ok(table),
        _ => Err(Error::Encode("a scene is no table".to_owned())),
    }
}

/// Tables by their kind.
fn kinds(things: InlineTable, mut item: impl FnMut(&str, InlineTable) -> Option<Item>) -> Item {
    let mut table = implicit();
    for (kind, thing) in things {
        let thing = match thing {
            Value::InlineTable(thing) => thing,
            _ => InlineTable::new(),
        };
        if let Some(item) = item(&kind, thing) {
            table.insert(&kind, item);
        }
    }
    if table.is_empty() { Item::None } else { Item::Table(table) }
}

/// Lists of tables by their kind; empty ones are left out.
fn lists(things: InlineTable, mut prune: impl FnMut(&str, InlineTable) -> InlineTable) -> Item {
    let mut table = implicit();
    for (kind, list) in things {
        let Value::Array(list) = list else { continue };
        let mut tables = ArrayOfTables::new();
        for thing in list {
            let Value::InlineTable(thing) = thing else { continue };
            tables.push(prune(&kind, thing).into_table());
        }
        if !tables.is_empty() {
            table.insert(&kind, Item::ArrayOfTables(tables));
        }
    }
    if table.is_empty() { Item::None } else { Item::Table(table) }
}

/// A table whose head need not be written.
fn implicit() -> Table {
    let mut table = Table::new();
    table.set_implicit(true);
    table
}

/// What a key is if nothing is said.
#[derive(Clone)]
enum Standard {
    /// It must be said.
    Required,
    /// This, as text, and as a table if its keys can be left out one by one.
    Value(String, Option<InlineTable>),
}

/// Defaults by the place of a thing and its key.
#[derive(Default)]
struct Defaults(BTreeMap<(String, String), Standard>);

impl Defaults {
    /// The same without what is so by default, and with long lists over several lines.
    fn prune(&mut self, place: &[&str], thing: InlineTable) -> InlineTable {
        let mut pruned = InlineTable::new();
        for (key, value) in &thing {
            match self.get(place, &thing, key) {
                Standard::Value(text, _) if text == value.to_string() => {}
                Standard::Value(_, Some(parts)) => {
                    let mut value = value.clone();
                    if let Some(table) = value.as_inline_table_mut() {
                        table.retain(|key, part| parts.get(key).is_none_or(|d| d.to_string() != part.to_string()));
                    }
                    pruned.insert(key, laid_out(value));
                }
                Standard::Value(..) | Standard::Required => {
                    pruned.insert(key, laid_out(value.clone()));
                }
            }
        }
        pruned
    }

    fn get(&mut self, place: &[&str], thing: &InlineTable, key: &str) -> Standard {
        let known = (place.join("."), key.to_owned());
        self.0.entry(known).or_insert_with(|| found(place, thing, key)).clone()
    }
}

/// Reads a thing without the key.
fn found(place: &[&str], thing: &InlineTable, key: &str) -> Standard {
    let mut without = thing.clone();
    without.remove(key);
    let Some(default) = read(place, without.clone()).and_then(|thing| thing.get(key).cloned()) else {
        return Standard::Required;
    };
    let text = default.to_string();
    let parts = default.as_inline_table().filter(|_| {
        // Without any of its keys it is the same.
        without.insert(key, InlineTable::new().into());
        let empty = read(place, without).and_then(|thing| thing.get(key).map(Value::to_string));
        empty.as_ref() == Some(&text)
    });
    Standard::Value(text.clone(), parts.cloned())
}

/// What a scene says of a thing after it has read it; nothing if it cannot.
fn read(place: &[&str], thing: InlineTable) -> Option<InlineTable> {
    let mut value = Value::InlineTable(thing);
    for key in place.iter().rev() {
        value = if *key == LIST {
            Value::Array(Array::from_iter([value]))
        } else {
            Value::InlineTable(InlineTable::from_iter([(*key, value)]))
        };
    }
    let [root, rest @ ..] = place else { return None };
    let text = value.as_inline_table()?.get(root).map(|value| format!("{root} = {value}"))?;
    let desc: SceneDesc = toml::from_str(&text).ok()?;
    let mut value = serialized(&desc).ok()?.get(root)?.clone();
    for key in rest {
        value = match (&value, *key) {
            (Value::Array(list), LIST) => list.get(0)?.clone(),
            (Value::InlineTable(table), key) => table.get(key)?.clone(),
            _ => return None,
        };
    }
    value.as_inline_table().cloned()
}

/// Numbers in single precision as short as they can be, whole ones without a point.
fn shortened(value: Value) -> Value {
    match value {
        Value::Float(number) => {
            let long = *number.value();
            let short = long as f32;
            let is_whole = short.fract() == 0.0 && short.abs() < 1e7 && !(short == 0.0 && short.is_sign_negative());
            if f64::from(short) != long || !short.is_finite() {
                return Value::Float(number);
            }
            if is_whole {
                return (long as i64).into();
            }
            let text = format!("{short:?}");
            // Read in double precision and rounded it might be another one, if ever so seldom.
            let is_same = text.parse::<f64>().is_ok_and(|again| again as f32 == short);
            text.parse().ok().filter(|_| is_same).unwrap_or(Value::Float(number))
        }
        Value::Array(list) => Value::Array(list.into_iter().map(shortened).collect()),
        Value::InlineTable(table) => {
            let parts = table.into_iter().map(|(key, value)| (key, shortened(value)));
            Value::InlineTable(parts.collect())
        }
        other => other,
    }
}

/// A list of lists or tables gets a line for each, if it is long.
fn laid_out(mut value: Value) -> Value {
    const SHORT: usize = 4;
    let is_deep = |list: &Array| list.iter().all(|item| item.is_array() || item.is_inline_table());
    if let Some(list) = value.as_array_mut().filter(|list| list.len() > SHORT && is_deep(list)) {
        list.iter_mut().for_each(|item| item.decor_mut().set_prefix("\n    "));
        list.set_trailing("\n");
        list.set_trailing_comma(true);
    }
    value
}
