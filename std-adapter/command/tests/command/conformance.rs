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
    let message = Workplace::new().refusal(1, &["conformance", "--list"]);
    assert!(message.contains("verification/conformance"), "{message}");
}
