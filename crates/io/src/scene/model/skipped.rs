//! What a text has that is not read: told once for each kind.

use crate::error::At;
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
    /// Notes one in a line.
    pub(super) fn note(&mut self, what: &str, line: usize) {
        if let Some(kind) = self.kinds.iter_mut().find(|kind| kind.what == what) {
            kind.count += 1;
        } else if self.kinds.len() < MOST {
            self.kinds.push(Kind { what: what.to_owned(), count: 1, first: line });
        } else {
            self.others += 1;
        }
    }

    /// What there is to say, each of the line where it was first met.
    pub(super) fn warnings(self, file: &str) -> Vec<Warning> {
        let told = |Kind { what, count, first }: Kind| Warning::counted(&what, count).at(At::Line(first)).of(file);
        let mut warnings: Vec<_> = self.kinds.into_iter().map(told).collect();
        if self.others > 0 {
            warnings.push(Warning::new(format!("{} more lines of other kinds are not read", self.others)).of(file));
        }
        warnings
    }
}
