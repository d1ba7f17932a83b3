//! What can be wrong with a description of a scene, and where.

use std::fmt;

use glam::{DVec3, Vec3};

use crate::color::Rgb;

/// Something wrong with a [`SceneDesc`](crate::desc::SceneDesc). Readers turn `path` into a line of their file.
#[derive(Clone, Debug, PartialEq)]
pub struct Problem {
    /// Keys and indices from the root to the value, such as `material`, `wall`, `metal`, `roughness`.
    pub path: Vec<String>,
    /// What is wrong.
    pub message: String,
    /// What to do about it.
    pub hint: Option<String>,
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.path.join("."), self.message)
    }
}

impl std::error::Error for Problem {}

/// Collects problems while it walks down a description.
#[derive(Default)]
pub(crate) struct Checker {
    path: Vec<String>,
    problems: Vec<Problem>,
}

impl Checker {
    pub(crate) fn into_problems(self) -> Vec<Problem> {
        self.problems
    }

    /// Checks what lies below a key or index.
    pub(crate) fn within(&mut self, key: impl ToString, check: impl FnOnce(&mut Self)) {
        self.path.push(key.to_string());
        check(self);
        self.path.pop();
    }

    /// A mesh can be wrong in millions of places; nobody reads more than this.
    const MOST: usize = 1000;

    /// Notes a problem of the value at `key`.
    pub(crate) fn problem(&mut self, key: impl ToString, message: impl Into<String>, hint: Option<String>) {
        if self.problems.len() < Self::MOST {
            let mut path = self.path.clone();
            path.push(key.to_string());
            self.problems.push(Problem { path, message: message.into(), hint });
        }
    }

    /// Notes that nothing has the name at `key`, and tells a few names that there are of this `kind`.
    pub(crate) fn no_such<'n>(
        &mut self,
        key: &str,
        [kind, kinds, otherwise]: [&str; 3],
        name: &str,
        names: impl IntoIterator<Item = &'n str>,
    ) {
        const MOST: usize = 12;
        let mut names = names.into_iter();
        let mut some: Vec<_> = names.by_ref().take(MOST).map(|name| format!("`{name}`")).collect();
        some.extend(names.next().map(|_| "...".to_owned()));
        let hint = if some.is_empty() {
            format!("the scene has no {kinds}; {otherwise}")
        } else {
            format!("{kinds} are {}", some.join(", "))
        };
        self.problem(key, format!("there is no {kind} `{name}`"), Some(hint));
    }

    /// Notes that nobody has read the file that is named.
    pub(crate) fn not_loaded(&mut self, file: &str) {
        let hint = "readers of scenes load files; a program that makes a scene must give what is in them".to_owned();
        self.problem("file", format!("`{file}` is not loaded"), Some(hint));
    }

    fn require(&mut self, holds: bool, key: &str, message: impl FnOnce() -> String, hint: &str) {
        if !holds {
            self.problem(key, message(), Some(hint.to_owned()));
        }
    }

    /// Whether a number is finite and not too large to be squared.
    pub(crate) fn is_finite(value: f32) -> bool {
        value.abs() <= Self::FARTHEST
    }

    pub(crate) fn finite(&mut self, key: &str, values: &[f32]) {
        let bad = values.iter().find(|&&v| !Self::is_finite(v));
        let message = || format!("`{key}` must be finite, not {}", bad.unwrap_or(&f32::NAN));
        self.require(bad.is_none(), key, message, "numbers up to 1e15 in size are allowed");
    }

    /// Farther away, squares of distances leave single precision's range.
    const FARTHEST: f32 = 1e15;

    pub(crate) fn positive(&mut self, key: &str, value: f32) {
        self.require(
            value > 0.0 && value <= Self::FARTHEST,
            key,
            || format!("`{key}` must be above 0, not {value}"),
            "use a finite number above 0",
        );
    }

    pub(crate) fn in_range(&mut self, key: &str, value: f32, lo: f32, hi: f32) {
        self.require(
            (lo..=hi).contains(&value),
            key,
            || format!("`{key}` must be from {lo} to {hi}, not {value}"),
            &format!("use a number from {lo} to {hi}"),
        );
    }

    pub(crate) fn count(&mut self, key: &str, value: u32, hi: u32) {
        self.require(
            (1..=hi).contains(&value),
            key,
            || format!("`{key}` must be from 1 to {hi}, not {value}"),
            &format!("use a whole number from 1 to {hi}"),
        );
    }

    /// An albedo above 1 would make light out of nothing, so it is an error, not a warning.
    pub(crate) fn albedo(&mut self, key: &str, rgb: Rgb) {
        let bad = rgb.0.iter().find(|c| !(0.0..=1.0).contains(*c));
        self.require(
            bad.is_none(),
            key,
            || format!("`{key}` must be from 0 to 1 in each channel, not {}", bad.unwrap_or(&f32::NAN)),
            "a surface cannot reflect more light than it gets; let it shine with an `emissive` material",
        );
    }

    pub(crate) fn radiance(&mut self, key: &str, rgb: Rgb) {
        let bad = rgb.0.iter().find(|c| !(0.0..=Self::BRIGHTEST).contains(*c));
        self.require(
            bad.is_none(),
            key,
            || {
                format!(
                    "`{key}` must be from 0 to {:e} in each channel, not {}",
                    Self::BRIGHTEST,
                    bad.unwrap_or(&f32::NAN)
                )
            },
            "use finite numbers that are not negative",
        );
    }

    /// The film holds sums of samples up to 2³² (see [`film`](crate::film)).
    pub(crate) const BRIGHTEST: f32 = 1e9;

    pub(crate) fn nonzero(&mut self, key: &str, v: [f32; 3]) {
        self.finite(key, &v);
        self.require(v != [0.0; 3], key, || format!("`{key}` must not be [0, 0, 0]"), "give it a length");
    }

    /// That what stands at `from` can look at `look_at`, which `does` says as in "it points".
    pub(crate) fn line_of_sight(&mut self, key: &str, from: [f32; 3], look_at: [f32; 3], does: &str) {
        self.finite(key, &from);
        self.finite("look_at", &look_at);
        let message = || format!("`{key}` and `look_at` are the same point, so {does} nowhere");
        self.require(from != look_at, "look_at", message, "move one of them");
    }

    /// That `up` is a direction, and not the line of sight.
    pub(crate) fn up(&mut self, up: [f32; 3], from: [f32; 3], look_at: [f32; 3]) {
        self.nonzero("up", up);
        let [from, at, up] = [from, look_at, up].map(|v| Vec3::from(v).as_dvec3());
        let sine = (at - from).normalize_or_zero().cross(up.normalize_or_zero()).length();
        let says_something = from != at && from.is_finite() && at.is_finite() && up != DVec3::ZERO;
        let message = || "`up` points along the line of sight".to_owned();
        self.require(!says_something || sine >= 1e-6 || sine.is_nan(), "up", message, "try up = [0, 0, 1]");
    }
}
