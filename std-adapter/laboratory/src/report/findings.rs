//! Sentences about a comparison: the paper's claims and ours, checked against its numbers.

use super::number::{few, grouped};
use super::paper::paper_row;
use crate::methods::Preset;
use crate::study::{Comparison, ComparisonRow};

/// One sentence about a comparison.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Finding {
    /// The sentence, with the numbers that it rests on.
    pub text: String,
    /// Whether the numbers agree with the paper, or with this project's promises.
    pub as_expected: bool,
}

/// The rows of the paper's Table 1 that are compared with each other.
const PAPER_PAIRS: [(Preset, Preset); 3] = [
    (Preset::Curtis2008, Preset::Basic),
    (Preset::Tang2010, Preset::Curtis2008),
    (Preset::Lv2014, Preset::Tang2010),
];

/// Compares candidates and speed with the paper's, our own method with the others, and contacts with the exact verdict. Methods
/// that did not take part are left out.
#[must_use]
pub fn findings(comparison: &Comparison) -> Vec<Finding> {
    let both = |(a, b): (Preset, Preset)| Some((comparison.row(a)?, comparison.row(b)?));
    let pairs = || PAPER_PAIRS.into_iter().filter_map(both);
    let mut findings: Vec<Finding> = pairs().filter_map(|(a, b)| candidates(a, b)).collect();
    let speeds = pairs().chain(both((Preset::Lv2014, Preset::Basic)));
    findings.extend(speeds.filter_map(|(a, b)| speed(a, b)));
    if let Some((ours, paper)) = both((Preset::Selvedge, Preset::Lv2014)) {
        let (a, b) = (ours.candidates, paper.candidates);
        findings.push(Finding {
            text: candidates_of(ours, paper),
            as_expected: a.vertex_face <= b.vertex_face && a.edge_edge <= b.edge_edge,
        });
    }
    let others = comparison.rows.iter().filter(|row| !row.preset.is_ours());
    let fastest = others.max_by(|a, b| a.frames_per_second.total_cmp(&b.frames_per_second));
    if let (Some(ours), Some(fastest)) = (comparison.row(Preset::Selvedge), fastest) {
        findings.push(Finding {
            text: format!("{}; no other method is faster.", speed_of(ours, fastest)),
            as_expected: ours.frames_per_second > fastest.frames_per_second,
        });
    }
    findings.extend(contacts(comparison));
    findings
}

fn candidates(a: &ComparisonRow, b: &ComparisonRow) -> Option<Finding> {
    let [paper_a, paper_b] = [paper_row(a.preset)?, paper_row(b.preset)?];
    let kinds = [
        (a.candidates.vertex_face < b.candidates.vertex_face) == (paper_a.vertex_face < paper_b.vertex_face),
        (a.candidates.edge_edge < b.candidates.edge_edge) == (paper_a.edge_edge < paper_b.edge_edge),
    ];
    let [a_vf, a_ee, b_vf, b_ee] = [paper_a.vertex_face, paper_a.edge_edge, paper_b.vertex_face, paper_b.edge_edge].map(grouped);
    Some(Finding {
        text: format!(
            "{} In the paper {a_vf} and {a_ee}, and {b_vf} and {b_ee}.",
            candidates_of(a, b)
        ),
        as_expected: kinds == [true; 2],
    })
}

fn candidates_of(a: &ComparisonRow, b: &ComparisonRow) -> String {
    let counts = |row: &ComparisonRow| {
        let counts = row.candidates;
        format!("{} VF and {} EE", few(counts.vertex_face), few(counts.edge_edge))
    };
    format!("{} leaves {} candidates, {} {}.", a.preset, counts(a), b.preset, counts(b))
}

fn speed(a: &ComparisonRow, b: &ComparisonRow) -> Option<Finding> {
    let [paper_a, paper_b] = [a, b].map(|row| paper_row(row.preset).map(|paper| paper.frames_per_second));
    let (paper_a, paper_b) = (paper_a?, paper_b?);
    Some(Finding {
        text: format!("{}, in the paper {} times.", speed_of(a, b), few(paper_a / paper_b)),
        as_expected: (a.frames_per_second > b.frames_per_second) == (paper_a > paper_b),
    })
}

fn speed_of(a: &ComparisonRow, b: &ComparisonRow) -> String {
    let [own, other] = [a, b].map(|row| row.frames_per_second);
    format!(
        "{} runs {} steps a second, {} {}: {} times as many",
        a.preset,
        few(own),
        b.preset,
        few(other),
        few(own / other),
    )
}

/// Names the methods that miss contacts. A certified method must miss none.
fn contacts(comparison: &Comparison) -> Vec<Finding> {
    let misses = |row: &&ComparisonRow| row.missed.vertex_face + row.missed.edge_edge > 0.0;
    let missing: Vec<_> = comparison.rows.iter().filter(misses).collect();
    if missing.is_empty() && !comparison.rows.is_empty() {
        return vec![Finding {
            text: "No method misses a contact.".to_owned(),
            as_expected: true,
        }];
    }
    let finding = |row: &ComparisonRow| Finding {
        text: format!(
            "{} misses {} VF and {} EE contacts a step.",
            row.preset,
            few(row.missed.vertex_face),
            few(row.missed.edge_edge)
        ),
        as_expected: !row.preset.stages().is_certified(),
    };
    missing.into_iter().map(finding).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::comparison::tests::comparison_like_the_papers;

    /// Returns the sentences that are not as expected, after `change` to the row of `preset`.
    fn unexpected(preset: Preset, change: impl FnOnce(&mut ComparisonRow)) -> Vec<String> {
        let mut comparison = comparison_like_the_papers();
        let mut rows = comparison.rows.iter_mut();
        change(rows.find(|row| row.preset == preset).unwrap());
        let findings = findings(&comparison).into_iter().filter(|finding| !finding.as_expected);
        findings.map(|finding| finding.text).collect()
    }

    #[test]
    fn the_papers_own_numbers_are_as_expected() {
        assert_eq!(unexpected(Preset::Selvedge, |_| ()), [""; 0]);
        let all = findings(&comparison_like_the_papers());
        assert_eq!(all.len(), 3 + 4 + 2 + 1);
        assert!(
            all[0]
                .text
                .starts_with("curtis_2008 leaves 74 VF and 475 EE candidates, basic 1,122 VF")
        );
        assert_eq!(all[9].text, "No method misses a contact.");
    }

    #[test]
    fn what_goes_against_the_paper_or_a_promise_is_reported() {
        let found = [
            unexpected(Preset::Curtis2008, |row| row.candidates.edge_edge = 3000.0),
            unexpected(Preset::Lv2014, |row| row.frames_per_second = 39.0),
            unexpected(Preset::Selvedge, |row| row.candidates.vertex_face = 32.0),
            unexpected(Preset::Selvedge, |row| row.frames_per_second = 37.0),
            unexpected(Preset::Selvedge, |row| row.missed.edge_edge = 1.5),
            unexpected(Preset::Basic, |row| row.missed.edge_edge = 1.5),
        ];
        let begins = [
            "curtis_2008 leaves 74 VF and 3,000 EE",
            "lv_2014 runs 39 steps a second, tang_2010 37.5",
            "selvedge leaves 32 VF",
            "selvedge runs 37 steps",
            "selvedge misses 0 VF and 1.5 EE",
        ];
        for (found, begin) in found.iter().zip(begins) {
            assert!(matches!(&found[..], [one] if one.starts_with(begin)), "{found:?}");
        }
        assert_eq!(found[5], [""; 0], "the plain cubic is expected to miss contacts");
    }
}
