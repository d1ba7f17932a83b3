//! `eyebeam selftest`: whether what is sampled follows its density, and pictures are as bright as formulas say, here.

use std::io::{Write, stdout};

use eyebeam_core::testing::selftest::{self, Eyebeam, Outcome};

use crate::error::Error;

pub(super) fn run() -> Result<(), Error> {
    let (mut count, mut failures, mut seconds, mut written) = (0, 0, 0.0, Ok(()));
    selftest::run(&Eyebeam, &mut |outcome| {
        count += 1;
        failures += usize::from(outcome.result.is_err());
        seconds += outcome.seconds;
        if written.is_ok() {
            written = print(&line(outcome));
        }
    });
    written?;
    if failures > 0 {
        return Err(Error::Selftest { failures, count });
    }
    print(&format!("all {count} checks passed in {seconds:.1} s"))
}

fn print(line: &str) -> Result<(), Error> {
    let mut out = stdout().lock();
    writeln!(out, "{line}").and_then(|()| out.flush()).map_err(Error::Stdout)
}

fn line(outcome: &Outcome<'_>) -> String {
    let Outcome { check, result, seconds } = outcome;
    match result {
        Ok(()) => format!("ok      {seconds:5.2} s  {}: {}", check.name, check.proves),
        Err(reason) => format!("FAILED  {seconds:5.2} s  {}: {reason}", check.name),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_say_what_is_wrong() {
        let check = &selftest::checks()[0];
        let outcome = Outcome { check, result: Ok(()), seconds: 0.25 };
        assert_eq!(line(&outcome), "ok       0.25 s  random numbers: they are uniform and independent");
        let outcome = Outcome { check, result: Err("all are 4".to_owned()), seconds: 12.0 };
        assert_eq!(line(&outcome), "FAILED  12.00 s  random numbers: all are 4");
    }
}
