//! A fast subset of all tests, for the machine of a user: whether what is sampled follows its density, and pictures show
//! what they should.
//!
//! ```no_run
//! use eyebeam_core::testing::selftest::{self, Eyebeam};
//!
//! let passed = selftest::run(&Eyebeam, &mut |outcome| {
//!     println!("{}: {:?} after {:.1} s", outcome.check.name, outcome.result, outcome.seconds);
//! });
//! assert!(passed);
//! ```
//!
//! What is tested is an [`Implementation`], so that a test of the tests can put a wrong part into it and see whether it is
//! found.

mod implementation;
mod parts;
mod pictures;

use std::time::Instant;

pub use implementation::{Eyebeam, Implementation};

type Test = dyn Fn(&dyn Implementation) -> Result<(), String>;

/// One of the tests.
pub struct Check {
    /// A few words.
    pub name: String,
    /// What holds if it passes.
    pub proves: &'static str,
    test: Box<Test>,
}

impl Check {
    fn new(
        name: impl Into<String>,
        proves: &'static str,
        test: impl Fn(&dyn Implementation) -> Result<(), String> + 'static,
    ) -> Self {
        Self { name: name.into(), proves, test: Box::new(test) }
    }

    /// Runs the test.
    ///
    /// # Errors
    /// What is wrong.
    pub fn run(&self, implementation: &dyn Implementation) -> Result<(), String> {
        (self.test)(implementation)
    }
}

/// How a check ended.
pub struct Outcome<'c> {
    /// The check.
    pub check: &'c Check,
    /// What is wrong, if anything.
    pub result: Result<(), String>,
    /// How long it took.
    pub seconds: f64,
}

/// All checks, in the order in which they are run: parts first, then pictures.
pub fn checks() -> Vec<Check> {
    parts::checks().into_iter().chain(pictures::checks()).collect()
}

/// Runs all checks and reports each as it ends; returns whether all have passed.
pub fn run(implementation: &dyn Implementation, report: &mut dyn FnMut(&Outcome<'_>)) -> bool {
    let mut passed = true;
    for check in &checks() {
        let clock = Instant::now();
        let result = check.run(implementation);
        passed &= result.is_ok();
        report(&Outcome { check, result, seconds: clock.elapsed().as_secs_f64() });
    }
    passed
}
