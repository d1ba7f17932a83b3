//! x
use eyebeam_core::testing::selftest::{self, Eyebeam};

#[test]
fn eyebeam_passes() {
    let mut failed = Vec::new();
    selftest::run(&Eyebeam, &mut |o| {
        eprintln!("{:6.2} s {} {:?}", o.seconds, o.check.name, o.result);
        if o.result.is_err() { failed.push(o.check.name.clone()) }
    });
    assert_eq!(failed, Vec::<String>::new());
}
