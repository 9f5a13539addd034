//! `selvedge conformance`.

use crate::support::Workplace;

#[test]
fn it_lists_runners_of_the_suite() {
    let suite = concat!(env!("CARGO_MANIFEST_DIR"), "/../../verification/conformance");
    let text = Workplace::new().stdout(&["conformance", "--suite", suite, "--list"]);
    for runner in ["selvedge ", "ipctk", "libigl", "parry"] {
        assert!(text.contains(runner), "{text}");
    }
}

#[test]
fn a_folder_without_the_suite_is_refused() {
    let output = Workplace::new().run(&["conformance", "--list"]);
    assert_eq!(output.status.code(), Some(1));
    assert!(String::from_utf8_lossy(&output.stderr).contains("verification/conformance"));
}
