use crate::hard_cases::Contact;
use crate::methods::QueryMethod;
use crate::study::{HardAnswer, HardResult};
use std::fmt::Write;

/// Case by method, the exact answer beside, wrong ones marked; then how many of each.
#[must_use]
pub fn hard_cases(scalar: &str, results: &[HardResult]) -> String {
    let letters: Vec<char> = ('A'..).take(QueryMethod::ALL.len()).collect();
    let mut text = format!("{} cases, {scalar}\n\n", results.len());
    let heading: String = letters.iter().flat_map(|letter| [' ', *letter]).collect();
    let header = format!("{:38}{:13} {}", "case", "first contact", heading);
    text += &format!("{header}\n{}\n", "─".repeat(header.chars().count()));
    let mut before = "";
    for result in results {
        let case = result.case;
        if case.name != before {
            text += &format!("{} ({})\n", case.name, case.pair.kind.name());
            before = &case.name;
        }
        let first = match &case.contact {
            Contact::Never => "never",
            Contact::Undefined => "undefined",
            Contact::First { exact, .. } => exact,
        };
        let marks: String = result.answers.iter().flat_map(|answer| [' ', mark(*answer)]).collect();
        let line = format!("  {:36}{first:13.13} {marks}", case.placement);
        text += line.trim_end();
        text.push('\n');
    }
    text += "\n";
    for (index, (method, letter)) in QueryMethod::ALL.into_iter().zip(letters).enumerate() {
        let count = |wanted| results.iter().filter(|result| result.answers[index] == wanted).count();
        let certified = if method.is_certified() { "" } else { "!" };
        writeln!(
            text,
            "{letter} {:24} {:4} missed, {:4} false alarms",
            format!("{method}{certified}"),
            count(HardAnswer::Missed),
            count(HardAnswer::FalseAlarm),
        )
        .expect("a string has room");
    }
    text += "\n\
        ✗ MISSED: culled, though it touches (or is not finite, and undefined);\n\
        + false alarm: kept, though it never touches; · right.\n\
        ! not certified: may miss collisions by rounding\n";
    text
}

const fn mark(answer: HardAnswer) -> char {
    match answer {
        HardAnswer::Right => '·',
        HardAnswer::FalseAlarm => '+',
        HardAnswer::Missed => '✗',
    }
}
