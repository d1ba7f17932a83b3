//! What a text has that is not read: told once for each kind.

use crate::warning::Warning;

/// Kinds that are told of; the rest is only counted.
const MOST: usize = 32;

/// Counts by kind, in the order in which they were met.
#[derive(Debug, Default)]
pub(super) struct Skipped {
    kinds: Vec<Kind>,
    others: usize,
}

#[derive(Debug)]
struct Kind {
    what: String,
    count: usize,
    first: usize,
}

impl Skipped {
    /// Notes one in a line; `what` goes on with "in line 7".
    pub(super) fn note(&mut self, what: &str, line: usize) {
        if let Some(kind) = self.kinds.iter_mut().find(|kind| kind.what == what) {
            kind.count += 1;
        } else if self.kinds.len() < MOST {
            self.kinds.push(Kind { what: what.to_owned(), count: 1, first: line });
        } else {
            self.others += 1;
        }
    }

    /// What there is to say; `file` stands before each.
    pub(super) fn warnings(self, file: &str) -> Vec<Warning> {
        let told = |Kind { what, count, first }: Kind| {
            let place =
                if count == 1 { format!("in line {first}") } else { format!("{count} times, first in line {first}") };
            Warning::new(format!("`{file}`: {what} {place}"))
        };
        let mut warnings: Vec<_> = self.kinds.into_iter().map(told).collect();
        if self.others > 0 {
            warnings.push(Warning::new(format!("`{file}`: {} more lines of other kinds are not read", self.others)));
        }
        warnings
    }
}
