//! Tables in tables. Dotted keys in inline tables nest thousands deep, where every walk, even dropping them, would use
//! up the stack: so they are cut first.

use std::mem;
use std::ops::Range;

use toml::de::DeValue;

use crate::scene::merge::Value;

/// Deeper than any scene.
pub(super) const MAX_DEPTH: usize = 32;

/// Cuts off what is nested too deeply; says where that begins.
pub(super) fn cut(value: &mut DeValue<'_>) -> Option<Range<usize>> {
    let mut first = None;
    cut_below(value, MAX_DEPTH, &mut first);
    first
}

fn cut_below(value: &mut DeValue<'_>, depth: usize, first: &mut Option<Range<usize>>) {
    let cut_child = |child: &mut Value<'_>| {
        if depth > 0 {
            cut_below(child.get_mut(), depth - 1, first);
        } else if child.get_ref().is_table() || child.get_ref().is_array() {
            first.get_or_insert(child.span());
            dismantle(mem::replace(child.get_mut(), DeValue::Boolean(false)));
        }
    };
    match value {
        DeValue::Table(table) => table.iter_mut().map(|(_, child)| child).for_each(cut_child),
        DeValue::Array(items) => items.iter_mut().for_each(cut_child),
        _ => {}
    }
}

/// Drops a value without recursion.
fn dismantle(value: DeValue<'_>) {
    let mut values = vec![value];
    while let Some(value) = values.pop() {
        match value {
            DeValue::Table(table) => values.extend(table.into_iter().map(|(_, v)| v.into_inner())),
            DeValue::Array(items) => values.extend(items.into_iter().map(|v| v.into_inner())),
            _ => {}
        }
    }
}
