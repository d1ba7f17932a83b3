//! What a PLY file has that is not read.

use crate::error::At;
use crate::scene::ply::faces::Faces;
use crate::scene::ply::header::{Element, Header, is_read};
use crate::scene::ply::values::Values;
use crate::scene::ply::vertices::read_columns;
use crate::warning::Warning;

/// Kinds that are told of, and names in each; the rest is only counted.
const MOST: usize = 8;

/// What there is to say; `values` are behind the last element that was read, and `others` are the elements there.
pub(super) fn warnings(header: &Header, faces: &Faces, values: &impl Values, others: &[Element]) -> Vec<Warning> {
    let mut warnings = Vec::new();
    for (name, line) in header.pictures.iter().take(MOST) {
        let what = format!("the picture `{name}` is not read");
        warnings.push(Warning::new(what).at(At::Line(*line)).hint("save the model as glTF or OBJ"));
    }
    let unknown: Vec<_> = header.elements.iter().filter(|e| !is_read(e) && e.count > 0).collect();
    if let Some(first) = unknown.first() {
        warnings.push(names("element", unknown.iter().map(|e| &*e.name), "").at(At::Line(first.line)));
    }
    for element in header.elements.iter().filter(|e| is_read(e) && e.count > 0) {
        let used =
            if element.name == "vertex" { read_columns(element) } else { element.corners().into_iter().collect() };
        let properties = element.properties.iter().enumerate().filter(|(i, _)| !used.contains(i));
        let unused: Vec<_> = properties.map(|(_, property)| &*property.name).collect();
        if !unused.is_empty() {
            let of = format!(" of the element `{}`", element.name);
            warnings.push(names("property", unused.into_iter(), &of).at(At::Line(element.line)));
        }
    }
    let of_faces = header.elements.iter().find(|e| e.name == "face").map_or(At::File, |e| At::Line(e.line));
    let counted = [
        ("a face of fewer than three corners is dropped", faces.dropped),
        ("a face of too many corners is taken as convex", faces.fans),
    ];
    for (what, count) in counted.into_iter().filter(|(_, count)| *count > 0) {
        warnings.push(Warning::counted(what, count).at(of_faces.clone()));
    }
    let rest = values.rest();
    if rest > 0 && others.iter().all(|e| e.count == 0 || e.properties.is_empty()) {
        warnings.push(Warning::new(format!("{rest} bytes after the last element are not read")).at(values.at()));
    }
    warnings
}

/// That things of such names are not read.
fn names<'a>(kind: &str, names: impl ExactSizeIterator<Item = &'a str>, of: &str) -> Warning {
    let count = names.len();
    let told: Vec<_> = names.take(MOST).map(|name| format!("`{name}`")).collect();
    let told = told.join(", ");
    Warning::new(match count {
        1 => format!("the {kind} {told}{of} is not read"),
        _ => {
            let kinds = if kind == "property" { "properties".to_owned() } else { format!("{kind}s") };
            let more = if count > MOST { format!(" and {} more", count - MOST) } else { String::new() };
            format!("the {kinds} {told}{more}{of} are not read")
        }
    })
}
