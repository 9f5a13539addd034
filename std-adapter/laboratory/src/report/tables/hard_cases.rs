use crate::hard_cases::ExactContact;
use crate::methods::QueryMethod;
use crate::study::{HardAnswer, HardResult};
use std::fmt::Write;

/// Returns a table of cases and methods beside the exact answers, with wrong answers marked and counted.
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
            ExactContact::Never => "never",
            ExactContact::Undefined => "undefined",
            ExactContact::First { exact, .. } => exact,
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
        ✗ MISSED: culled, although it touches or is not finite;\n\
        + false alarm: kept, although it never touches; · right.\n\
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
