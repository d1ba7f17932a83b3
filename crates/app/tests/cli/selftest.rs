//! The selftest as a user runs it.

use std::time::Duration;

use crate::Place;

#[test]
fn selftest_passes() {
    let place = Place::new();
    let before = place.files();
    let run = place.run_within(Duration::from_secs(120), "selftest").ends_with(0);
    let lines: Vec<_> = run.text().lines().collect();
    let (verdict, checks) = lines.split_last().unwrap();
    assert!(checks.len() > 30 && checks.iter().all(|line| line.starts_with("ok ")), "{checks:#?}");
    assert!(verdict.starts_with(&format!("all {} checks passed in ", checks.len())), "{verdict}");
    assert!(run.stderr.is_empty() && place.files() == before);
}
