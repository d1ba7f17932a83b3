//! One of several things in a file, by its name or its number.

use crate::error::FileError;

/// The index of the thing of such a name, or else of that number from 0.
///
/// # Errors
/// If there is none; they are listed.
pub(super) fn choose<'n>(
    kind: &str,
    wanted: &str,
    names: impl IntoIterator<Item = &'n str>,
) -> Result<usize, FileError> {
    let names: Vec<_> = names.into_iter().collect();
    let by_name = names.iter().position(|name| *name == wanted);
    let by_number = wanted.parse().ok().filter(|&i: &usize| i < names.len());
    by_name.or(by_number).ok_or_else(|| {
        let told = |(i, name): (usize, &&str)| if name.is_empty() { i.to_string() } else { format!("{i} `{name}`") };
        let list: Vec<_> = names.iter().enumerate().map(told).collect();
        let hint = if list.is_empty() { "it has none".to_owned() } else { format!("it has {}", list.join(", ")) };
        FileError::new(format!("there is no {kind} `{wanted}`")).hint(hint)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_come_before_numbers() {
        let names = ["1", "", "b"];
        let chosen = ["1", "b", "0", "2"].map(|wanted| choose("camera", wanted, names).unwrap());
        assert_eq!(chosen, [0, 2, 0, 2]);
        let error = choose("camera", "c", names).unwrap_err();
        assert_eq!(error.message, "there is no camera `c`");
        assert_eq!(error.hint.as_deref(), Some("it has 0 `1`, 1, 2 `b`"));
        assert_eq!(choose("camera", "0", []).unwrap_err().hint.as_deref(), Some("it has none"));
    }
}
