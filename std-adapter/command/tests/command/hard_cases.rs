//! `selvedge hard-cases`.

use crate::support::{Workplace, keys};

#[test]
fn each_case_has_its_exact_answer_beside_and_ours_are_right() {
    let document = Workplace::new().json(&["hard-cases", "edge", "--json"]);
    let cases = document["cases"].as_array().unwrap();
    assert!(cases.len() > 50);
    let mut missed_by_the_plain_test = 0;
    for case in cases {
        assert_eq!(
            keys(case),
            ["case", "placement", "kind", "first_contact", "between", "answers"]
        );
        for method in ["selvedge", "time_of_impact", "non_coplanarity", "relative_boxes"] {
            assert_ne!(case["answers"][method], "missed", "{case}");
        }
        missed_by_the_plain_test += usize::from(case["answers"]["cubic"] == "missed");
    }
    assert!(missed_by_the_plain_test > 0);
}

#[test]
fn the_table_marks_what_is_wrong_and_says_what_the_marks_mean() {
    let text = Workplace::new().stdout(&["hard-cases", "coplanar throughout"]);
    for part in [
        "coplanar throughout, slides in (vertex-face)",
        "1 um, far",
        " 1/2 ",
        " never ",
        "✗",
        "cubic!",
        "MISSED",
    ] {
        assert!(text.contains(part), "{part}: {text}");
    }
    assert!(!text.contains("shared vertex"));
    assert!(text.lines().all(|line| line.chars().count() <= 80), "{text}");
}

#[test]
fn a_name_that_no_case_has_is_refused() {
    let message = Workplace::new().refusal(1, &["hard-cases", "no such thing"]);
    assert!(message.contains("`no such thing`"), "{message}");
}
