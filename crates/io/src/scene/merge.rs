//! Tables with spans: how an including file and `-D` settings change them, and how values are found in them.

use std::ops::Range;

use toml::Spanned;
use toml::de::{DeArray, DeString, DeTable, DeValue};

pub(super) type Value<'a> = Spanned<DeValue<'a>>;
pub(super) type Table<'a> = DeTable<'a>;

/// The same table with each span changed.
pub(super) fn map_spans<'a>(table: Table<'a>, map: &mut impl FnMut(Range<usize>) -> Range<usize>) -> Table<'a> {
    let mut mapped = Table::new();
    for (key, value) in table {
        let key = Spanned::new(map(key.span()), key.into_inner());
        mapped.insert(key, map_value_spans(value, map));
    }
    mapped
}

/// As [`map_spans`].
pub(super) fn map_value_spans<'a>(value: Value<'a>, map: &mut impl FnMut(Range<usize>) -> Range<usize>) -> Value<'a> {
    let span = map(value.span());
    let inner = match value.into_inner() {
        DeValue::Array(items) => {
            let mut mapped = DeArray::new();
            items.into_iter().for_each(|item| mapped.push(map_value_spans(item, map)));
            DeValue::Array(mapped)
        }
        DeValue::Table(table) => DeValue::Table(map_spans(table, map)),
        scalar => scalar,
    };
    Spanned::new(span, inner)
}

/// Moves spans for [`map_spans`].
pub(super) fn shift_by(base: usize) -> impl FnMut(Range<usize>) -> Range<usize> {
    move |span| span.start + base..span.end + base
}

/// Puts the including file's table over an included one: settings and materials by name, shapes and lights add up.
pub(super) fn merge<'a>(under: &mut Table<'a>, over: Table<'a>) {
    for (key, value) in over {
        let mix: Option<fn(&mut Table<'a>, Table<'a>)> = match key.get_ref().as_ref() {
            "render" | "camera" | "material" => Some(replace),
            "shape" | "light" => Some(append),
            _ => None,
        };
        match (mix, under.get_mut(&key).map(Spanned::get_mut), value) {
            (Some(mix), Some(DeValue::Table(below)), value) if value.get_ref().is_table() => {
                if let DeValue::Table(above) = value.into_inner() {
                    mix(below, above);
                }
            }
            (_, _, value) => {
                under.insert(key, value);
            }
        }
    }
}

/// What is named above counts.
fn replace<'a>(below: &mut Table<'a>, above: Table<'a>) {
    below.extend(above);
}

/// Lists of the same kind of shape or light become one.
fn append<'a>(below: &mut Table<'a>, above: Table<'a>) {
    for (kind, value) in above {
        match (below.get_mut(&kind).map(Spanned::get_mut), value.get_ref()) {
            (Some(DeValue::Array(things)), DeValue::Array(more)) => more.iter().for_each(|t| things.push(t.clone())),
            _ => {
                below.insert(kind, value);
            }
        }
    }
}

/// Sets the value at a path of keys and indices.
///
/// # Errors
/// Says why there is no such place.
pub(super) fn set<'a>(table: &mut Table<'a>, path: &[(&str, Range<usize>)], value: Value<'a>) -> Result<(), String> {
    let Some(((key, span), rest)) = path.split_first() else {
        return Err("the key is empty".to_owned());
    };
    let name = Spanned::new(span.clone(), DeString::Owned((*key).to_owned()));
    if rest.is_empty() {
        table.insert(name, value);
        return Ok(());
    }
    let child = table.entry(name).or_insert_with(|| Spanned::new(span.clone(), DeValue::Table(Table::new())));
    match child.get_mut() {
        DeValue::Table(child) => set(child, rest, value),
        DeValue::Array(items) => set_in_array(items, key, rest, value),
        _ => Err(format!("`{key}` is a value and has no keys")),
    }
}

fn set_in_array<'a>(
    items: &mut DeArray<'a>,
    name: &str,
    path: &[(&str, Range<usize>)],
    value: Value<'a>,
) -> Result<(), String> {
    let Some(((key, _), rest)) = path.split_first() else {
        return Err(format!("`{name}` is a list"));
    };
    let count = items.len();
    let index = key.parse::<usize>().ok().filter(|&i| i < count);
    let item =
        index.and_then(|i| items.get_mut(i)).ok_or_else(|| format!("`{name}` is a list of {count}, counted from 0"))?;
    match item.get_mut() {
        _ if rest.is_empty() => *item = value,
        DeValue::Table(table) => return set(table, rest, value),
        DeValue::Array(items) => return set_in_array(items, key, rest, value),
        _ => return Err(format!("`{key}` is a value and has no keys")),
    }
    Ok(())
}

/// The path of the key or value that has this span.
pub(super) fn find(table: &Table<'_>, span: &Range<usize>) -> Option<Vec<String>> {
    table.iter().find_map(|(key, value)| {
        let below = if key.span() == *span { Some(Vec::new()) } else { find_value(value, span) };
        below.map(|path| prepend(key.get_ref(), path))
    })
}

fn find_value(value: &Value<'_>, span: &Range<usize>) -> Option<Vec<String>> {
    if value.span() == *span {
        return Some(Vec::new());
    }
    match value.get_ref() {
        DeValue::Table(table) => find(table, span),
        DeValue::Array(items) => {
            items.iter().enumerate().find_map(|(i, item)| Some(prepend(&i.to_string(), find_value(item, span)?)))
        }
        _ => None,
    }
}

fn prepend(key: &str, mut path: Vec<String>) -> Vec<String> {
    path.insert(0, key.to_owned());
    path
}

/// The span of the value at a path, or of the nearest one above it.
pub(super) fn span_of(table: &Table<'_>, path: &[String]) -> Option<Range<usize>> {
    let (key, rest) = path.split_first()?;
    span_of_value(table.get(key.as_str())?, rest)
}

fn span_of_value(value: &Value<'_>, path: &[String]) -> Option<Range<usize>> {
    let below = match (value.get_ref(), path) {
        (DeValue::Table(table), path) => span_of(table, path),
        (DeValue::Array(items), [index, rest @ ..]) => {
            index.parse().ok().and_then(|i: usize| items.get(i)).and_then(|item| span_of_value(item, rest))
        }
        _ => None,
    };
    below.or_else(|| Some(value.span()))
}

/// Takes out the value at a path.
pub(super) fn remove(table: &mut Table<'_>, path: &[String]) {
    match path {
        [] => {}
        [key] => {
            table.remove(key.as_str());
        }
        [key, rest @ ..] => {
            if let Some(value) = table.get_mut(key.as_str()) {
                remove_in(value.get_mut(), rest);
            }
        }
    }
}

fn remove_in(value: &mut DeValue<'_>, path: &[String]) {
    match (value, path) {
        (DeValue::Table(table), path) => remove(table, path),
        (DeValue::Array(items), [index]) => {
            let mut kept = DeArray::new();
            let others = items.iter().enumerate().filter(|(i, _)| i.to_string() != *index);
            others.for_each(|(_, item)| kept.push(item.clone()));
            *items = kept;
        }
        (DeValue::Array(items), [index, rest @ ..]) => {
            if let Some(item) = index.parse().ok().and_then(|i: usize| items.get_mut(i)) {
                remove_in(item.get_mut(), rest);
            }
        }
        _ => {}
    }
}
