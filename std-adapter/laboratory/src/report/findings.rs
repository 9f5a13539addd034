//! What a comparison says about the paper's claims and about ours, computed from its numbers.

use super::number::{figures, mean};
use super::paper::paper_row;
use crate::methods::{Preset, Redundancy, Source, Stages};
use crate::study::{Comparison, ComparisonRow};

/// One sentence about a comparison.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Finding {
    /// The sentence, with the numbers that it rests on.
    pub text: String,
    /// Whether it is what the paper has, or what this project promises.
    pub as_expected: bool,
}

/// The rows of the paper's Table 1 that are compared with each other.
const PAPER_PAIRS: [(Preset, Preset); 3] = [
    (Preset::Curtis2008, Preset::Basic),
    (Preset::Tang2010, Preset::Curtis2008),
    (Preset::Lv2014, Preset::Tang2010),
];

/// What the numbers say: the paper's order of methods by candidates and by speed, our own method's place, and whether
/// all methods find as many contacts. Methods that did not take part are left out.
#[must_use]
pub fn findings(comparison: &Comparison) -> Vec<Finding> {
    let mut findings = Vec::new();
    let both = |a, b| Some((comparison.row(a)?, comparison.row(b)?));
    let pairs = || PAPER_PAIRS.iter().filter_map(|&(a, b)| both(a, b));
    findings.extend(pairs().filter_map(|(a, b)| candidates_beside_paper(a, b)));
    let speed = pairs().chain(both(Preset::Lv2014, Preset::Basic));
    findings.extend(speed.filter_map(|(a, b)| speed_beside_paper(a, b)));
    if let Some(ours) = comparison.row(Preset::Selvedge) {
        findings.extend(comparison.row(Preset::Lv2014).map(|paper| no_more_candidates(ours, paper)));
        findings.extend(fastest(ours, comparison));
    }
    findings.extend(contacts(comparison));
    findings
}

fn candidates_beside_paper(a: &ComparisonRow, b: &ComparisonRow) -> Option<Finding> {
    let (paper_a, paper_b) = (paper_row(a.preset)?, paper_row(b.preset)?);
    let fewer = |a: f64, b: f64| a < b;
    let ours = [
        fewer(a.candidates.vertex_face, b.candidates.vertex_face),
        fewer(a.candidates.edge_edge, b.candidates.edge_edge),
    ];
    let paper = [
        paper_a.vertex_face < paper_b.vertex_face,
        paper_a.edge_edge < paper_b.edge_edge,
    ];
    let as_expected = ours == paper;
    let relation = match ours {
        [true, true] => "fewer candidates",
        [false, false] => "no fewer candidates",
        [true, false] => "fewer VF candidates, but no fewer EE",
        [false, true] => "fewer EE candidates, but no fewer VF",
    };
    let text = format!(
        "{} leaves {relation} than {} ({}), {} ({} against {}, {} against {}).",
        a.preset,
        b.preset,
        candidates_against(a, b),
        beside_paper(as_expected),
        paper_a.vertex_face,
        paper_b.vertex_face,
        paper_a.edge_edge,
        paper_b.edge_edge,
    );
    Some(Finding { text, as_expected })
}

fn speed_beside_paper(a: &ComparisonRow, b: &ComparisonRow) -> Option<Finding> {
    let (paper_a, paper_b) = (paper_row(a.preset)?, paper_row(b.preset)?);
    let faster = a.frames_per_second > b.frames_per_second;
    let as_expected = faster == (paper_a.frames_per_second > paper_b.frames_per_second);
    let text = format!(
        "{} is {} than {} ({} against {} steps a second, {} times), {} ({} against {} frames a second, {} times).",
        a.preset,
        if faster { "faster" } else { "not faster" },
        b.preset,
        figures(a.frames_per_second),
        figures(b.frames_per_second),
        figures(a.frames_per_second / b.frames_per_second),
        beside_paper(as_expected),
        paper_a.frames_per_second,
        paper_b.frames_per_second,
        figures(paper_a.frames_per_second / paper_b.frames_per_second),
    );
    Some(Finding { text, as_expected })
}

fn candidates_against(a: &ComparisonRow, b: &ComparisonRow) -> String {
    let [a, b] = [a, b].map(|row| [row.candidates.vertex_face, row.candidates.edge_edge].map(mean));
    format!("{} against {} VF, {} against {} EE", a[0], b[0], a[1], b[1])
}

const fn beside_paper(as_expected: bool) -> &'static str {
    if as_expected { "as in the paper" } else { "against the paper" }
}

fn no_more_candidates(ours: &ComparisonRow, paper: &ComparisonRow) -> Finding {
    let (a, b) = (ours.candidates, paper.candidates);
    let as_expected = a.vertex_face <= b.vertex_face && a.edge_edge <= b.edge_edge;
    let text = format!(
        "{} leaves {} candidates than {} ({}).",
        ours.preset,
        if as_expected { "no more" } else { "more" },
        paper.preset,
        candidates_against(ours, paper),
    );
    Finding { text, as_expected }
}

/// Beside the methods that are not ours; nothing to say where there is none.
fn fastest(ours: &ComparisonRow, comparison: &Comparison) -> Option<Finding> {
    let others = comparison.rows.iter().filter(|row| !row.preset.is_ours());
    let best = others.max_by(|a, b| a.frames_per_second.total_cmp(&b.frames_per_second))?;
    let as_expected = ours.frames_per_second > best.frames_per_second;
    let (ours_rate, best_rate) = (figures(ours.frames_per_second), figures(best.frames_per_second));
    let text = if as_expected {
        format!(
            "{} is the fastest: {ours_rate} steps a second, before {} with {best_rate}.",
            ours.preset, best.preset
        )
    } else {
        format!(
            "{} is not the fastest: {} runs {best_rate} steps a second, {} {ours_rate}.",
            ours.preset, best.preset, ours.preset
        )
    };
    Some(Finding { text, as_expected })
}

/// Whether every method finds as many contacts as one that culls nothing. Methods that keep duplicates count a contact
/// once for each triangle pair that holds it, and are left out. A method with a certified elementary test may find more
/// than one whose test misses some.
fn contacts(comparison: &Comparison) -> Vec<Finding> {
    let culls_nothing = |stages: Stages| stages.tests.is_empty();
    let counts_once = |row: &&ComparisonRow| row.preset.stages().source != Source::TrianglePairs(Redundancy::Kept);
    let rows: Vec<_> = comparison.rows.iter().filter(counts_once).collect();
    let Some(reference) = rows.iter().find(|row| culls_nothing(row.preset.stages())) else {
        return Vec::new();
    };
    let found = |row: &ComparisonRow| {
        format!(
            "{} VF and {} EE",
            mean(row.contacts.vertex_face),
            mean(row.contacts.edge_edge)
        )
    };
    let (known, is_certified) = (reference.contacts, |row: &ComparisonRow| {
        row.preset.stages().elementary.is_certified()
    });
    let mut all_agree = true;
    let mut findings = Vec::new();
    for row in rows.iter().filter(|row| row.contacts != known) {
        let own = row.contacts;
        let finds_more = is_certified(row)
            && !is_certified(reference)
            && own.vertex_face >= known.vertex_face
            && own.edge_edge >= known.edge_edge;
        all_agree &= finds_more;
        let end = if finds_more {
            "its test is certified, the other's is not."
        } else {
            "they should agree."
        };
        findings.push(Finding {
            text: format!(
                "{} finds {} contacts a step, {} finds {}: {end}",
                row.preset,
                found(row),
                reference.preset,
                found(reference),
            ),
            as_expected: finds_more,
        });
    }
    if all_agree && rows.len() > 1 {
        let who = if findings.is_empty() { "All methods" } else { "All others" };
        findings.insert(
            0,
            Finding {
                text: format!(
                    "{who} find as many contacts: {} a step (naive counts duplicates).",
                    found(reference)
                ),
                as_expected: true,
            },
        );
    }
    findings
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::MeanCounts;

    fn row(preset: Preset, vertex_face: f64, edge_edge: f64, rate: f64) -> ComparisonRow {
        let counts = |vertex_face, edge_edge| MeanCounts { vertex_face, edge_edge };
        ComparisonRow {
            preset,
            triangle_pairs: 5000.0,
            has_triangle_pairs: true,
            broad_phase_seconds: 0.0,
            stages: Vec::new(),
            after_boxes: counts(2000.0, 3000.0),
            candidates: counts(vertex_face, edge_edge),
            contacts: counts(1.0, 2.0),
            missed: counts(0.0, 0.0),
            frames_per_second: rate,
        }
    }

    fn comparison(rows: Vec<ComparisonRow>) -> Comparison {
        Comparison {
            name: "test".to_owned(),
            vertices: 693,
            edges: 2038,
            triangles: 1345,
            steps: 1,
            threads: 1,
            rounds: 1,
            rows,
        }
    }

    /// The paper's own numbers, and ours better than all of them.
    fn as_in_the_paper() -> Vec<ComparisonRow> {
        let mut rows = vec![row(Preset::Selvedge, 30.0, 100.0, 40.0)];
        for preset in Preset::ALL {
            rows.extend(paper_row(preset).map(|paper| {
                row(
                    preset,
                    paper.vertex_face.into(),
                    paper.edge_edge.into(),
                    paper.frames_per_second,
                )
            }));
        }
        rows
    }

    /// The sentences that are not as expected, after `change` to the row of `preset`.
    fn unexpected(preset: Preset, change: impl FnOnce(&mut ComparisonRow)) -> Vec<String> {
        let mut rows = as_in_the_paper();
        change(rows.iter_mut().find(|row| row.preset == preset).unwrap());
        let findings = findings(&comparison(rows)).into_iter();
        findings
            .filter(|finding| !finding.as_expected)
            .map(|finding| finding.text)
            .collect()
    }

    #[track_caller]
    fn assert_only(found: &[String], parts: &[&str]) {
        assert_eq!(found.len(), 1, "{found:?}");
        for part in parts {
            assert!(found[0].contains(part), "`{part}` is missing in: {}", found[0]);
        }
    }

    #[test]
    fn the_papers_own_numbers_go_against_nothing() {
        assert_eq!(unexpected(Preset::Selvedge, |_| ()), [""; 0]);
        let all = findings(&comparison(as_in_the_paper()));
        assert_eq!(all.len(), 3 + 4 + 2 + 1);
    }

    #[test]
    fn more_candidates_than_the_paper_has_are_told() {
        let found = unexpected(Preset::Curtis2008, |row| row.candidates.edge_edge = 3000.0);
        let parts = ["fewer VF candidates, but no fewer EE than basic", "against the paper"];
        assert_only(&found, &parts);
    }

    #[test]
    fn a_speed_against_the_paper_is_told() {
        let found = unexpected(Preset::Lv2014, |row| row.frames_per_second = 39.0);
        assert_only(&found, &["lv_2014 is faster than tang_2010", "against the paper"]);
    }

    #[test]
    fn ours_with_more_candidates_than_the_paper_is_told() {
        let found = unexpected(Preset::Selvedge, |row| row.candidates.vertex_face = 32.0);
        assert_only(&found, &["selvedge leaves more candidates than lv_2014 (32 against 31 VF"]);
    }

    #[test]
    fn ours_not_the_fastest_is_told() {
        let found = unexpected(Preset::Selvedge, |row| row.frames_per_second = 37.0);
        assert_only(&found, &["selvedge is not the fastest: tang_2010"]);
    }

    #[test]
    fn a_method_that_loses_contacts_is_told() {
        let found = unexpected(Preset::Tang2010, |row| row.contacts.vertex_face = 0.5);
        assert_only(
            &found,
            &["tang_2010 finds 0.5 VF and 2 EE contacts a step, basic finds 1 VF and 2 EE"],
        );
    }

    #[test]
    fn a_certified_test_may_find_more() {
        let mut rows = as_in_the_paper();
        let ours = rows.iter_mut().find(|row| row.preset == Preset::Selvedge);
        ours.unwrap().contacts.edge_edge = 3.0;
        let found = findings(&comparison(rows));
        assert!(found.iter().all(|finding| finding.as_expected));
        assert!(found.iter().any(|finding| {
            finding
                .text
                .starts_with("selvedge finds 1 VF and 3 EE contacts a step, basic finds 1 VF and 2 EE")
        }));
    }

    #[test]
    fn a_certified_test_that_finds_less_is_told() {
        let found = unexpected(Preset::Selvedge, |row| row.contacts.edge_edge = 1.0);
        assert_only(&found, &["selvedge finds 1 VF and 1 EE contacts a step"]);
    }

    #[test]
    fn duplicates_are_no_lost_contacts() {
        let mut rows = as_in_the_paper();
        rows.insert(0, row(Preset::Naive, 9e3, 9e3, 1.0));
        rows[0].contacts.edge_edge = 70.0;
        assert!(findings(&comparison(rows)).iter().all(|finding| finding.as_expected));
    }

    #[test]
    fn a_method_alone_leaves_nothing_to_say() {
        let rows = vec![row(Preset::Selvedge, 1.0, 1.0, 1.0)];
        assert_eq!(findings(&comparison(rows)), []);
    }

    #[test]
    fn tables_of_a_large_mesh_still_fit_80_columns() {
        let mut rows = as_in_the_paper();
        for row in &mut rows {
            let millions = MeanCounts {
                vertex_face: 27_345_678.0,
                edge_edge: 41_345_678.0,
            };
            row.after_boxes = millions;
            row.candidates = millions;
            row.frames_per_second = 0.123;
            row.broad_phase_seconds = 12.0;
        }
        rows.push(row(Preset::HutterFuhrmann2007, 27_345_678.0, 4e7, 1e5));
        let text = crate::report::tables::comparison(&comparison(rows));
        for line in text.lines() {
            assert!(line.chars().count() <= 80, "{line}");
        }
    }
}
